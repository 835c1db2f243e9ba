#include "scabo/analysis/softly_held.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scabo::analysis {

namespace {

constexpr double allowed = 3e-5;  // of the largest displacement: what motions of pairs may be wrong by
constexpr double good = 1e-7;     // what stiffer parts should reach; the difference falls with their stiffness
constexpr double soft = 1e6;      // flexibility of a pair times the stiffness of a body: held softly

/// By how much a pair moves against its law: into the other side, where it sticks, or along its friction.
double against_the_law(const contact::Problem& problem, const contact::Solution& solution, Eigen::Index i) {
  const contact::ContactState state = solution.states[static_cast<std::size_t>(i)];
  const double gap = solution.gap[i], slip = solution.slip_increment[i];
  const bool slips_wrongly = state == contact::ContactState::stick ||
                             (state == contact::ContactState::slip && solution.p[2 * i + 1] * slip > 0.0);
  return std::max(std::isinf(problem.tension_of(i)) ? 0.0 : -gap, slips_wrongly ? std::abs(slip) : 0.0);
}

std::string sentence(const Prepared& prepared, int body, double stiffer) {
  const std::string& name = prepared.model.bodies[static_cast<std::size_t>(body)].name;
  const char* lost =
      "that its contact forces are lost in the rounding of how far the loads would move it without contact";
  if (part_of(prepared, body).has_springs())
    return fmt::format(
        "the springs of body '{}' are so soft {}: leave these springs out, if contact holds the body, or make them "
        "{:.0e} times as stiff",
        name, lost, stiffer);
  return fmt::format(
      "body '{}' is held by parts so soft {}: leave the soft parts out, if contact holds the body, or make them {:.0e} "
      "times as stiff",
      name, lost, stiffer);
}

}  // namespace

std::string lost_where_softly_held(const Prepared& prepared, const State& to, const contact::Problem& problem,
                                   const contact::Solution& solution, const Vector& drawn) {
  const auto& parts = prepared.structure.parts;
  std::vector<double> stiffness(parts.size(), 0.0);
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (!prepared.is_absent(p) && to.u[p].size() > 0)
      stiffness[p] = parts[p]->stiff_force(Vector::Ones(to.u[p].size()));
  const Vector flexibility = problem.W.diagonal();
  const auto held_softly = [&](int body, Eigen::Index pair) {
    const std::size_t p = prepared.structure.dofs.part_of(body);
    return parts[p]->has_springs() || flexibility.segment<2>(2 * pair).maxCoeff() * stiffness[p] > soft;
  };
  std::vector<std::pair<Eigen::Index, int>> judged;  // pairs, and the body that is held softly
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    const model::Contact& contact =
        prepared.model.contacts[static_cast<std::size_t>(prepared.contact.pairs[i].contact)];
    for (const int body : {contact.a.body, contact.b.body})
      if (held_softly(body, static_cast<Eigen::Index>(i))) {
        judged.emplace_back(i, body);
        break;
      }
  }
  if (judged.empty()) return {};
  Vector motion = drawn;
  double largest = 0.0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (prepared.is_absent(p) || to.u[p].size() == 0) continue;
    motion.noalias() += prepared.contact.motion[p] * to.u[p];
    largest = std::max(largest, to.u[p].lpNorm<Eigen::Infinity>());
  }
  // Bodies may rest under large forces: a force then stands for the displacement that it would cause at one node.
  const double stiffest = *std::max_element(stiffness.begin(), stiffness.end());
  if (stiffest > 0.0) largest = std::max(largest, solution.p.lpNorm<Eigen::Infinity>() / stiffest);
  double most = 0.0;
  int worst = 0;
  for (const auto& [i, body] : judged) {
    const double wrong =
        std::max({std::abs(motion[2 * i] - solution.gap[i]), std::abs(motion[2 * i + 1] - solution.slip_increment[i]),
                  against_the_law(problem, solution, i)});
    if (wrong > most) most = wrong, worst = body;
  }
  if (!(most > allowed * largest)) return {};
  return sentence(prepared, worst, std::pow(10.0, std::ceil(std::log10(most / (good * largest)))));
}

}  // namespace scabo::analysis
