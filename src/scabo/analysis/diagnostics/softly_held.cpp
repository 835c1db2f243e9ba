#include "scabo/analysis/diagnostics/softly_held.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/base/components.hpp"

namespace scabo::analysis {

namespace {

constexpr double soft = 1e4;  // flexibility of a pair times the stiffness of a body: held softly

/// By how much a pair moves against its law: into the other side, where it sticks, or along its friction.
double against_the_law(const contact::Problem& problem, const contact::Solution& solution, Eigen::Index i) {
  const contact::ContactState state = solution.states[static_cast<std::size_t>(i)];
  const double gap = solution.gap[i], slip = solution.slip_increment[i];
  const bool slips_wrongly =
      state == contact::ContactState::stick ||
      (state == contact::ContactState::slip && solution.p[problem.dimension * i + 1] * slip > 0.0);
  return std::max(std::isinf(problem.tension_of(i)) ? 0.0 : -gap, slips_wrongly ? std::abs(slip) : 0.0);
}

/// Largest stiffness of a node, of every part; 0 of those that are absent or rigid.
std::vector<double> stiffnesses(const Prepared& prepared, const State& state) {
  const auto& parts = prepared.structure.parts;
  std::vector<double> stiffness(parts.size(), 0.0);
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (!prepared.is_absent(p) && state.u[p].size() > 0)
      stiffness[p] = parts[p]->stiff_force(Vector::Ones(state.u[p].size()));
  return stiffness;
}

const model::Contact& contact_at(const Prepared& prepared, Eigen::Index pair) {
  const auto contact = prepared.contact.pairs[static_cast<std::size_t>(pair)].contact;
  return prepared.model.contacts[static_cast<std::size_t>(contact)];
}

/// Pairs of which a body may be held softly. `flexibility`: W_ii, of both bodies.
std::vector<Eigen::Index> soft_pairs(const Prepared& prepared, const Vector& flexibility,
                                     const std::vector<double>& stiffness) {
  const auto is_soft = [&](int body, Eigen::Index pair) {
    const std::size_t p = prepared.structure.dofs.part_of(body);
    return prepared.structure.parts[p]->has_springs() ||
           flexibility.segment<2>(place_of(pair)).maxCoeff() * stiffness[p] > soft;
  };
  std::vector<Eigen::Index> found;
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    const auto pair = static_cast<Eigen::Index>(i);
    if (prepared.contact.pairs[i].is_bar()) continue;  // it gives way as it should
    const model::Contact& contact = contact_at(prepared, pair);
    if (is_soft(contact.a.body, pair) || is_soft(contact.b.body, pair)) found.push_back(pair);
  }
  return found;
}

/// By how much force a gap that is wrong is answered: the stiffness of a node of the less stiff body of a pair, of
/// those that deform, or where both are rigid that of the springs that hold them.
double resisting_at(const Prepared& prepared, const Vector& flexibility, const std::vector<double>& stiffness,
                    Eigen::Index pair) {
  const model::Contact& contact = contact_at(prepared, pair);
  double least = 0.0;
  for (const int body : {contact.a.body, contact.b.body})
    if (const double of_body = stiffness[prepared.structure.dofs.part_of(body)]; of_body > 0.0)
      least = least > 0.0 ? std::min(least, of_body) : of_body;
  if (least > 0.0) return least;
  const double of_springs = flexibility.segment<2>(place_of(pair)).maxCoeff();
  return of_springs > 0.0 ? 1.0 / of_springs : 0.0;
}

/// How far a force at a pair moves the part of a body there, without contact.
double flexibility_at(const Prepared& prepared, int body, Eigen::Index pair) {
  const std::size_t p = prepared.structure.dofs.part_of(body);
  if (!prepared.structure.parts[p]->is_flexible()) return 0.0;
  double flexibility = 0.0;
  for (const Eigen::Index row : {place_of(pair), place_of(pair, 1)}) {
    const auto& motion = prepared.contact.motion[p];
    const Vector along = motion.transpose() * Vector::Unit(motion.rows(), row);
    std::vector<int> dofs;
    std::vector<double> parts;
    for (Eigen::Index k = 0; k < along.size(); ++k)
      if (along[k] != 0.0) dofs.push_back(static_cast<int>(k)), parts.push_back(along[k]);
    if (dofs.empty()) continue;
    const Vector force = Eigen::Map<const Vector>(parts.data(), static_cast<Eigen::Index>(parts.size()));
    flexibility = std::max(flexibility, force.dot(prepared.structure.parts[p]->flexed(dofs, force)));
  }
  return flexibility;
}

/// The body of a pair that gives way.
int softer_body(const Prepared& prepared, Eigen::Index pair) {
  const model::Contact& contact = contact_at(prepared, pair);
  return flexibility_at(prepared, contact.b.body, pair) > flexibility_at(prepared, contact.a.body, pair)
             ? contact.b.body
             : contact.a.body;
}

}  // namespace

std::optional<SoftlyHeld> softly_held(const Prepared& prepared, const State& to, const contact::Problem& problem,
                                      const contact::Solution& solution, const Vector& drawn, double force_scale) {
  const std::vector<double> stiffness = stiffnesses(prepared, to);
  const Vector flexibility = problem.W.diagonal();
  const std::vector<Eigen::Index> pairs = soft_pairs(prepared, flexibility, stiffness);
  if (pairs.empty()) return {};
  SoftlyHeld held;
  held.difference = drawn;
  double largest = 0.0;
  for (std::size_t p = 0; p < to.u.size(); ++p) {
    if (prepared.is_absent(p) || to.u[p].size() == 0) continue;
    held.difference.noalias() += prepared.contact.motion[p] * to.u[p];
    largest = std::max(largest, to.u[p].lpNorm<Eigen::Infinity>());
  }
  for (Eigen::Index i = 0; i < solution.gap.size(); ++i) {
    const double of_spring = prepared.contact.softness[i] * solution.p[place_of(i)];
    held.difference.segment<2>(place_of(i)) -= Vec2(solution.gap[i] - of_spring, solution.slip_increment[i]);
  }
  const double force = std::max(force_scale, solution.p.lpNorm<Eigen::Infinity>());
  Eigen::Index worst = pairs.front();
  for (const Eigen::Index pair : pairs) {
    const double resisting = resisting_at(prepared, flexibility, stiffness, pair),
                 allowed = std::max(largest, resisting > 0.0 ? force / resisting : 0.0);
    const double apart = held.difference.segment<2>(place_of(pair)).lpNorm<Eigen::Infinity>();
    const double wrong = std::max(apart, against_the_law(problem, solution, pair));
    if (apart > held.apart * allowed) held.apart = apart / allowed;
    if (wrong > held.wrong * allowed) held.wrong = wrong / allowed, worst = pair;
  }
  if (!(held.wrong > SoftlyHeld::allowed)) return held;
  held.body = softer_body(prepared, worst);
  held.softer = flexibility.segment<2>(2 * worst).maxCoeff() * resisting_at(prepared, flexibility, stiffness, worst);
  return held;
}

namespace {

/// How far a force at a contact moves a body there, over how far it would move one of its nodes alone.
double flexibility_in_contact(const Prepared& prepared, int body) {
  double most = 0.0;
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    const auto pair = static_cast<Eigen::Index>(i);
    if (prepared.contact.pairs[i].is_bar()) continue;
    const model::Contact& contact = contact_at(prepared, pair);
    if (contact.a.body == body || contact.b.body == body) most = std::max(most, flexibility_at(prepared, body, pair));
  }
  const system::BodySystem& part = part_of(prepared, body);
  return most * part.stiff_force(Vector::Ones(part.size()));
}

}  // namespace

std::string lost_where_softly_held(const Prepared& prepared, const SoftlyHeld& held) {
  const model::Body& body = prepared.model.bodies[static_cast<std::size_t>(held.body)];
  const std::string lost = fmt::format(
      "the motions that follow from its contact forces are wrong by {:.1g} of the displacements, and {:.0e} is allowed",
      held.wrong, SoftlyHeld::allowed);
  if (part_of(prepared, held.body).has_springs())
    return fmt::format(
        "the springs of body '{}' give way {:.0e} times as far under a force at its contact as a node there would, so "
        "that {}: leave these springs out, if contact holds the body, or make them stiffer",
        body.name, held.softer, lost);
  return fmt::format(
      "body '{}' gives way {:.0e} times as far under a force at its contact as its elements do, so that {}: hold it "
      "more stiffly (leave out soft parts that are tied to it, if contact holds it, or make them stiffer), or use "
      "larger elements",
      body.name, flexibility_in_contact(prepared, held.body), lost);
}

}  // namespace scabo::analysis
