#include "scabo/analysis/growth/critical.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "scabo/analysis/quasistatic/attempt.hpp"
#include "scabo/analysis/state/cracks.hpp"
#include "scabo/analysis/state/loads.hpp"
#include "scabo/analysis/state/step_factors.hpp"

namespace scabo::analysis {

namespace {

/// The material around a tip.
int material_at(const Prepared& prepared, const Tip& tip) {
  const mesh::BodyMesh& mesh = prepared.mesh.bodies[static_cast<std::size_t>(tip.body)];
  const Vec2 here = position_of(prepared.model, tip);
  const auto cell = std::find_if(mesh.cells.begin(), mesh.cells.end(),
                                 [&](const mesh::Cell& one) { return one.is_open() && one.centre == here; });
  ensure(cell != mesh.cells.end(), "a tip with factors has a cell");
  return cell->materials.front();
}

/// Whether displacements are those of the parts under their loads, with no pairs and no motions besides.
bool has_loads_alone(const Prepared& prepared) {
  return prepared.contact.pairs.empty() && prepared.contact.rigid_motions() == 0 && prepared.references.empty();
}

/// From rest, with the displacements of the cells at tips and anything elsewhere: half of a solution, without the
/// refinement that the balance at every node takes.
State at_tips_alone(const Prepared& prepared, const Factors& factors) {
  State state = initial_state(prepared);
  state.factors = factors;
  state.forces = applied_forces(prepared, factors, state.released);
  state.prescribed = prescribed_values(prepared, factors.supports, state.replaced.moved);
  const system::Structure& structure = prepared.structure;
  std::vector<std::vector<int>> wanted(structure.parts.size());
  for (std::size_t b = 0; b < prepared.mesh.bodies.size(); ++b)
    for (const mesh::Cell& cell : prepared.mesh.bodies[b].cells) {
      if (!cell.is_open()) continue;
      const std::vector<int> dofs = structure.dofs.of(static_cast<int>(b), cell.nodes());
      std::vector<int>& of_part = wanted[structure.dofs.part_of(static_cast<int>(b))];
      of_part.insert(of_part.end(), dofs.begin(), dofs.end());
    }
  for (std::size_t p = 0; p < wanted.size(); ++p)
    state.u[p] = structure.parts[p]->displacement_at(state.forces[p], state.prescribed[p], wanted[p]);
  return state;
}

}  // namespace

bool is_at_rest(const Prepared& prepared, const Factors& factors) {
  const auto is_zero = [](const Vector& of_part) { return of_part.isZero(0.0); };
  const std::vector<Vector> forces = applied_forces(prepared, factors, {}),
                            prescribed = prescribed_values(prepared, factors.supports, {});
  return std::all_of(forces.begin(), forces.end(), is_zero) &&
         std::all_of(prescribed.begin(), prescribed.end(), is_zero);
}

MaterialConstants material_constants(const Prepared& prepared, const Tip& tip) {
  const int at = material_at(prepared, tip);
  const model::Material& material = prepared.model.materials[static_cast<std::size_t>(at)];
  const double nu = material.poisson;
  if (prepared.model.analysis.plane == model::Plane::strain)
    return {3.0 - 4.0 * nu, material.young / (1.0 - nu * nu), at};
  return {(3.0 - nu) / (1.0 + nu), material.young, at};
}

Factors factors_at(const model::Model& model, double lambda) {
  const model::GrowthStep& growth = *model.steps.back().growth;
  Factors factors = factors_in(model, model.steps.size() - 1, 1.0);
  for (std::size_t i = 0; i < factors.loads.size(); ++i)
    if (growth.loads[i]) factors.loads[i] *= lambda;
  for (std::size_t i = 0; i < factors.supports.size(); ++i)
    if (growth.supports[i]) factors.supports[i] *= lambda;
  return factors;
}

Reached reach_from_rest(const Prepared& prepared, const Factors& factors, const Options& options) {
  return reach_from(prepared, initial_state(prepared), factors, options);
}

Reached reach_from(const Prepared& prepared, const State& from, const Factors& factors, const Options& options) {
  Reached reached;
  reached.state = from;
  Attempt tried = attempt(prepared, from, factors);
  reached.iterations = tried.solution.iterations;
  record(prepared, tried, options, reached);
  if (tried.accepted)
    accept(std::move(tried), 1.0, reached);
  else
    give_up(prepared, tried, 1.0, reached);
  return reached;
}

TipFactors tip_factors(const model::GrowthStep& growth, const element::StressIntensity& factors) {
  TipFactors found{{factors.K_I, factors.K_II}};
  if (growth.distance)
    found.T = std::sqrt(2.0 * std::numbers::pi * *growth.distance) *
              factors.T_left.value_or(std::numeric_limits<double>::quiet_NaN());
  return found;
}

FactorsOfTips factors_of_tips(const Prepared& prepared, const std::vector<Tip>& tips, const State& state) {
  const std::vector<CrackResult> cracks = crack_results(prepared, state);
  std::vector<TipFactors> found;
  for (const Tip& tip : tips) {
    const std::string name = name_of(prepared.model, tip);
    const auto crack =
        std::find_if(cracks.begin(), cracks.end(), [&](const CrackResult& one) { return one.name == name; });
    if (crack == cracks.end())
      return fmt::format("the mesh has no cell around the tip '{}': use smaller cells there", name);
    if (crack->factors.kind != element::CornerKind::crack)
      return fmt::format("the tip '{}' lies where materials meet, from where growth is not known", name);
    found.push_back(tip_factors(*prepared.model.steps.back().growth, crack->factors));
    if (!found.back().K.allFinite() || !std::isfinite(found.back().T))
      return fmt::format("the stress intensity factors of '{}' are undefined under these loads", name);
  }
  return found;
}

FactorsOfTips factors_of_tips(const Prepared& prepared, const std::vector<Tip>& tips, const Factors& factors,
                              const Options& options) {
  if (has_loads_alone(prepared)) return factors_of_tips(prepared, tips, at_tips_alone(prepared, factors));
  const Reached reached = reach_from_rest(prepared, factors, options);
  if (!reached.reason.empty()) return reached.reason;
  return factors_of_tips(prepared, tips, reached.state);
}

std::variant<std::vector<TipPattern>, std::string> tip_patterns(const Prepared& prepared, const std::vector<Tip>& tips,
                                                                const Options& options) {
  const model::GrowthStep& growth = *prepared.model.steps.back().growth;
  std::vector<TipFactors> constant(tips.size());
  if (const Factors none = factors_at(prepared.model, 0.0); !is_at_rest(prepared, none)) {
    auto found = factors_of_tips(prepared, tips, none, options);
    if (auto* reason = std::get_if<std::string>(&found)) return *reason;
    constant = std::get<std::vector<TipFactors>>(found);
  }
  auto found = factors_of_tips(prepared, tips, factors_at(prepared.model, 1.0), options);
  if (auto* reason = std::get_if<std::string>(&found)) return *reason;
  const std::vector<TipFactors>& whole = std::get<std::vector<TipFactors>>(found);
  std::vector<TipPattern> patterns;
  for (std::size_t t = 0; t < tips.size(); ++t) {
    const MaterialConstants material = material_constants(prepared, tips[t]);
    patterns.push_back({constant[t], whole[t] - constant[t], material, toughness_of(growth, material)});
  }
  return patterns;
}

double equivalent_factor(model::GrowthCriterion criterion, const TipFactors& factors, double kappa) {
  const TipFactors open = factors.opened();
  return open.K.norm() > 0.0 ? kink_of(criterion, open, kappa).equivalent : 0.0;
}

double toughness_of(const model::GrowthStep& growth, const MaterialConstants& material) {
  return growth.K_Ic ? growth.K_Ic->of(material.material)
                     : std::sqrt(material.modulus * growth.G_c->of(material.material));
}

double critical_factor(model::GrowthCriterion criterion, const TipPattern& tip) {
  const auto equivalent = [&](double lambda) {
    return equivalent_factor(criterion, tip.at(lambda), tip.material.kappa);
  };
  if (tip.constant.K == Vec2(0.0, 0.0) && tip.constant.T == 0.0) {
    const double at_one = equivalent(1.0);
    return at_one > 0.0 ? tip.toughness / at_one : std::numeric_limits<double>::infinity();
  }
  if (equivalent(0.0) >= tip.toughness) return 0.0;
  double low = 0.0, high = tip.toughness / tip.per_lambda.K.norm();
  for (int doublings = 0; !(equivalent(high) >= tip.toughness); ++doublings) {
    constexpr int most = 40;
    if (doublings == most || !std::isfinite(high)) return std::numeric_limits<double>::infinity();
    low = high;
    high *= 2.0;
  }
  while (true) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return high;
    (equivalent(middle) < tip.toughness ? low : high) = middle;
  }
}

}  // namespace scabo::analysis
