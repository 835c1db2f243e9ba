#include "scabo/analysis/growth/grow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/analysis/growth/criteria.hpp"
#include "scabo/analysis/growth/critical.hpp"
#include "scabo/analysis/growth/tips.hpp"
#include "scabo/analysis/march/increment_warnings.hpp"
#include "scabo/analysis/march/reports.hpp"
#include "scabo/base/stopwatch.hpp"
#include "scabo/mesh/crack_faces.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::analysis {

namespace {

/// A crack meets what lies within so many steps ahead of it.
constexpr double reach_of_tip = 1.5;

/// The tips in the state of a load factor.
GrowthResult tips_at(const model::Model& model, const std::vector<Tip>& tips, const std::vector<TipPattern>& patterns) {
  const model::GrowthStep& growth = *model.steps.back().growth;
  GrowthResult result;
  result.load_factor = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < tips.size(); ++t) {
    TipResult tip;
    tip.name = name_of(model, tips[t]);
    tip.position = position_of(model, tips[t]);
    tip.length = length_of(crack_of(model, tips[t]));
    tip.load_factor = critical_factor(growth.criterion, patterns[t]);
    result.load_factor = std::min(result.load_factor, tip.load_factor);
    result.tips.push_back(std::move(tip));
  }
  for (TipResult& tip : result.tips) tip.grows = tip.load_factor <= (1.0 + together) * result.load_factor;
  return result;
}

/// Why a crack does not grow at the load factor found; empty if it does.
std::string why_not(const GrowthResult& at, const std::vector<TipPattern>& patterns) {
  if (at.load_factor == 0.0)
    return "a tip is critical under the loads that stay alone: let 'scale' name them, or make them smaller";
  if (!std::isfinite(at.load_factor))
    return "no factor of the scaled loads makes a tip critical: they close the crack, or do not reach it";
  for (std::size_t t = 0; t < at.tips.size(); ++t) {
    const Vec2 K = patterns[t].at(at.load_factor);
    constexpr double rounding = 1e-6;
    if (K[0] < -rounding * K.norm())
      return fmt::format(
          "the loads close the crack at its tip '{}' (K_I < 0), and growth of cracks in contact is not available in "
          "this "
          "version",
          at.tips[t].name);
  }
  return {};
}

/// Factors, T and G from the state itself, and the kinks.
void add_factors(const IncrementResult& increment, const std::vector<TipPattern>& patterns,
                 model::GrowthCriterion criterion, GrowthResult& growth) {
  for (std::size_t t = 0; t < growth.tips.size(); ++t) {
    TipResult& tip = growth.tips[t];
    const auto crack = std::find_if(increment.cracks.begin(), increment.cracks.end(),
                                    [&](const CrackResult& one) { return one.name == tip.name; });
    tip.K_I = crack->factors.K_I;
    tip.K_II = crack->factors.K_II;
    tip.T = crack->factors.T_left;
    tip.G = crack->factors.G;
    const Vec2 open(std::max(tip.K_I, 0.0), tip.K_II);
    if (open.norm() > 0.0) tip.kink = kink_of(criterion, open, patterns[t].kappa).angle;
  }
}

/// Where faces of cracks overlap, which nothing keeps them from; empty if they do not.
std::string overlap(const Prepared& prepared, const IncrementResult& increment) {
  constexpr double rounding = 1e-6;  // of the largest opening of the crack
  for (std::size_t b = 0; b < prepared.model.bodies.size(); ++b) {
    const model::Body& body = prepared.model.bodies[b];
    const Vector& u = increment.fields.displacements[b];
    for (std::size_t c = 0; c < body.cracks.size(); ++c) {
      double widest = 0.0, least = 0.0;
      Vec2 where = Vec2::Zero();
      for (const mesh::FacePair& pair : mesh::face_pairs(prepared.mesh.bodies[b], static_cast<int>(c))) {
        const Vec2 apart = u.segment<2>(2 * pair.right) - u.segment<2>(2 * pair.left);
        const double opening = apart.dot(pair.normal.normalized());
        widest = std::max(widest, apart.norm());
        if (opening < least) {
          least = opening;
          where = prepared.mesh.bodies[b].nodes[static_cast<std::size_t>(pair.left)];
        }
      }
      if (least < -rounding * widest)
        return fmt::format(
            "the faces of crack '{}.{}' overlap by {:.3g} near {}, and growth of cracks in contact is "
            "not available in this version",
            body.name, body.cracks[c].name, -least, model::point_text(where));
    }
  }
  return {};
}

GrownCracks cracks_of(const model::Model& model, const std::vector<Tip>& tips, std::string ended) {
  GrownCracks grown;
  grown.ended = std::move(ended);
  for (const Tip& tip : tips)
    if (const std::string name = name_of_crack(model, tip); grown.paths.empty() || grown.paths.back().crack != name)
      grown.paths.push_back({name, crack_of(model, tip).path});
  return grown;
}

/// Why growth ends in state `number` though nothing is met; empty if it goes on.
std::string end_wanted(const model::GrowthStep& growth, const GrowthResult& at, int number) {
  constexpr double rounding = 1e-9;
  if (growth.steps && number > *growth.steps) return model::counted(*growth.steps, "growth step") + " done";
  if (growth.load_factor && at.load_factor > *growth.load_factor)
    return fmt::format("further growth needs the load factor {:.6g}, above {}", at.load_factor,
                       model::number_text(*growth.load_factor));
  for (const TipResult& tip : at.tips) {
    if (growth.length && tip.length >= (1.0 - rounding) * *growth.length)
      return fmt::format("the crack of '{}' has the length {:.6g}", tip.name, tip.length);
    if (growth.tip && (tip.position - *growth.tip).norm() <= 0.5 * growth.step)
      return fmt::format("'{}' is at {}", tip.name, model::point_text(tip.position));
  }
  return {};
}

/// How far each of the growing tips grows.
double growth_of_each(const model::GrowthStep& growth, const GrowthResult& at) {
  const auto count = std::count_if(at.tips.begin(), at.tips.end(), [](const TipResult& tip) { return tip.grows; });
  double whole = growth.step;
  if (growth.length)
    for (const TipResult& tip : at.tips)
      if (tip.grows) whole = std::min(whole, *growth.length - tip.length);
  return whole / static_cast<double>(count);
}

Vec2 turned(const Vec2& direction, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * direction.x() - s * direction.y(), s * direction.x() + c * direction.y()};
}

/// What follows a state: longer cracks, the end, or a mesh or solution that there is not.
struct Next {
  std::optional<model::Model> model;
  std::optional<GrownCracks> end;
  std::string failed;
};

class Growing {
 public:
  Growing(StaticSolution& solution, const Options& options)
      : solution_(solution), options_(options), tips_(growing_tips(solution.model)) {
    for (const model::Body& body : solution.model.bodies) sizes_.push_back(body.mesh.refine);
    for (const Tip& tip : tips_) first_length_ = std::max(first_length_, length_of(crack_of(solution.model, tip)));
  }

  /// One state, and the cracks that follow; false at the end.
  bool advance(int number);

 private:
  const model::Model& model() const { return solution_.model; }
  const model::GrowthStep& growth() const { return *model().steps.back().growth; }
  model::Model longer(const std::vector<Vec2>& directions, const GrowthResult& at, double length) const;
  Discretisation divided(model::Model model);
  std::optional<GrownCracks> meetings(const std::vector<Vec2>& directions, const GrowthResult& at, double length) const;
  Next next(const GrowthResult& at, const std::vector<TipPattern>& patterns, int number);
  double part_done(int number) const;
  IncrementResult result_at(const Prepared& prepared, Reached& reached, int number);
  bool fail(const Prepared& prepared, std::string reason, int number);

  StaticSolution& solution_;
  const Options& options_;
  std::vector<Tip> tips_;
  std::vector<std::vector<model::LocalSize>> sizes_;  // given by the user
  double first_length_ = 0.0;
};

model::Model Growing::longer(const std::vector<Vec2>& directions, const GrowthResult& at, double length) const {
  model::Model longer = model();
  for (std::size_t t = 0; t < tips_.size(); ++t)
    if (at.tips[t].grows) extend(longer, tips_[t], at.tips[t].position + length * directions[t]);
  refine_at_tips(longer, tips_, sizes_);
  return longer;
}

Discretisation Growing::divided(model::Model model) {
  Discretisation of;
  of.model = std::move(model);
  of.mesh = timed(solution_.timing.mesh, [&] { return mesh::make_mesh(of.model); });
  of.threads = solution_.threads;
  discretise(of, solution_.cells, {}, solution_.timing);
  return of;
}

/// The cracks where some of them meet something ahead.
std::optional<GrownCracks> Growing::meetings(const std::vector<Vec2>& directions, const GrowthResult& at,
                                             double length) const {
  model::Model there = model();
  std::string ended;
  for (std::size_t t = 0; t < tips_.size(); ++t) {
    if (!at.tips[t].grows) continue;
    const auto met = meeting(model(), tips_[t], at.tips[t].position + reach_of_tip * length * directions[t]);
    if (!met) continue;
    extend(there, tips_[t], met->at);
    ended += fmt::format("{}'{}' meets {} at {}", ended.empty() ? "" : ", ", at.tips[t].name, met->what,
                         model::point_text(met->at));
  }
  if (ended.empty()) return {};
  return cracks_of(there, tips_, std::move(ended));
}

Next Growing::next(const GrowthResult& at, const std::vector<TipPattern>& patterns, int number) {
  if (std::string ended = end_wanted(growth(), at, number); !ended.empty())
    return {{}, cracks_of(model(), tips_, std::move(ended)), {}};
  const double length = growth_of_each(growth(), at);
  std::vector<Vec2> directions;
  for (std::size_t t = 0; t < tips_.size(); ++t)
    directions.push_back(turned(direction_of(model(), tips_[t]), at.tips[t].kink));
  if (auto met = meetings(directions, at, length)) return {{}, std::move(met), {}};
  try {
    const Discretisation half = divided(longer(directions, at, 0.5 * length));
    const auto found = factors_of_tips(Prepared(half), tips_, factors_at(half.model, at.load_factor), options_);
    if (const auto* reason = std::get_if<std::string>(&found)) return {{}, {}, *reason};
    for (std::size_t t = 0; t < tips_.size(); ++t) {
      const Vec2& K = std::get<std::vector<Vec2>>(found)[t];
      if (at.tips[t].grows && K[0] > 0.0)
        directions[t] = turned(directions[t], kink_of(growth().criterion, K, patterns[t].kappa).angle);
    }
  } catch (const InputError& error) {
    return {{}, {}, error.diagnostics().front().message};
  }
  if (auto met = meetings(directions, at, length)) return {{}, std::move(met), {}};
  return {longer(directions, at, length), {}, {}};
}

/// Of the step, if nothing ends it before.
double Growing::part_done(int number) const {
  double states = std::numeric_limits<double>::infinity();
  if (growth().steps) states = *growth().steps + 1.0;
  if (growth().length) states = std::min(states, 1.0 + std::ceil((*growth().length - first_length_) / growth().step));
  return number < states && std::isfinite(states) ? number / states : number / (number + 1.0);
}

IncrementResult Growing::result_at(const Prepared& prepared, Reached& reached, int number) {
  IncrementResult result = result_of(prepared, reached, solution_);
  result.step = static_cast<int>(model().steps.size());
  result.step_name = model().steps.back().name;
  result.increment = number;
  result.reached = part_done(number);
  return result;
}

bool Growing::fail(const Prepared& prepared, std::string reason, int number) {
  Reached reached;
  reached.reason = std::move(reason);
  solution_.increments.push_back(result_at(prepared, reached, number));
  solution_.grown = cracks_of(model(), tips_, reached.reason);
  end_unsolved(reached, solution_, options_);
  return false;
}

bool Growing::advance(int number) {
  const Prepared prepared(solution_, options_.on_iteration);
  const auto found = tip_patterns(prepared, tips_, options_);
  if (const auto* reason = std::get_if<std::string>(&found)) return fail(prepared, *reason, number);
  const auto& patterns = std::get<std::vector<TipPattern>>(found);
  GrowthResult at = tips_at(model(), tips_, patterns);
  if (std::string reason = why_not(at, patterns); !reason.empty()) return fail(prepared, std::move(reason), number);
  Reached reached = reach_from_rest(prepared, factors_at(model(), at.load_factor), options_);
  IncrementResult result = result_at(prepared, reached, number);
  if (!result.converged) return fail(prepared, reached.reason, number);
  if (std::string reason = overlap(prepared, result); !reason.empty()) return fail(prepared, std::move(reason), number);
  add_factors(result, patterns, growth().criterion, at);
  Next after = next(at, patterns, number);
  if (after.end) result.reached = 1.0;
  result.growth = std::move(at);
  add_warnings(prepared, reached, result, solution_);
  solution_.increments.push_back(std::move(result));
  solution_.grown = after.end ? std::move(*after.end) : cracks_of(model(), tips_, {});
  const RunState run{model().steps.size() - 1, {number, solution_.increments.back().reached}, std::move(reached.state)};
  tell_accepted(prepared, run, solution_, options_);
  if (!after.model) return after.failed.empty() ? false : fail(prepared, std::move(after.failed), number + 1);
  try {
    Discretisation longer = divided(*std::move(after.model));
    solution_.model.bodies = longer.model.bodies;
    replace(solution_, std::move(longer));
  } catch (const InputError& error) {
    return fail(prepared, error.diagnostics().front().message, number + 1);
  }
  ++solution_.pairings;
  for (IncrementResult& increment : solution_.increments) increment.fields = {};  // of another mesh
  return true;
}

}  // namespace

void check_growth(const model::Model& model) {
  if (!model::has_growth(model) || !growing_tips(model).empty()) return;
  throw InputError(model.file.empty() ? "model" : model.file,
                   {{model.steps.back().source,
                     "no crack of the step has a tip that could grow: both ends of each lie on the boundary or on "
                     "another crack"}});
}

void grow(StaticSolution& solution, const Options& options) {
  Growing growing(solution, options);
  try {
    for (int number = 1;; ++number) {
      if (options.stop && *options.stop) return interrupt(solution);
      tell_begin(options, solution.model.steps.back(), solution.model.steps.size() - 1, number);
      if (!growing.advance(number)) return;
    }
  } catch (const EndAtOnce&) {
    interrupt(solution);
  }
}

}  // namespace scabo::analysis
