#include "scabo/analysis/soft_springs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scabo::analysis {

namespace {

constexpr double allowed = 3e-5;  // of the largest displacement: what motions of pairs may be wrong by
constexpr double good = 1e-7;     // what stiffer springs should reach; the difference falls with their stiffness

/// By how much a pair moves against its law: into the other side, where it sticks, or along its friction.
double against_the_law(const contact::Problem& problem, const contact::Solution& solution, Eigen::Index i) {
  const contact::ContactState state = solution.states[static_cast<std::size_t>(i)];
  const double gap = solution.gap[i], slip = solution.slip_increment[i];
  const bool slips_wrongly = state == contact::ContactState::stick ||
                             (state == contact::ContactState::slip && solution.p[2 * i + 1] * slip > 0.0);
  return std::max(std::isinf(problem.tension_of(i)) ? 0.0 : -gap, slips_wrongly ? std::abs(slip) : 0.0);
}

}  // namespace

std::string lost_on_soft_springs(const Prepared& prepared, const State& to, const contact::Problem& problem,
                                 const contact::Solution& solution, const Vector& drawn) {
  const auto& parts = prepared.structure.parts;
  if (std::none_of(parts.begin(), parts.end(), [](const auto& part) { return part->has_springs(); })) return {};
  Vector motion = drawn;
  double largest = 0.0, stiffest = 0.0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (prepared.is_absent(p) || to.u[p].size() == 0) continue;
    motion.noalias() += prepared.contact.motion[p] * to.u[p];
    largest = std::max(largest, to.u[p].lpNorm<Eigen::Infinity>());
    stiffest = std::max(stiffest, parts[p]->stiff_force(Vector::Ones(to.u[p].size())));
  }
  // Bodies may rest under large forces: a force then stands for the displacement that it would cause at one node.
  if (stiffest > 0.0) largest = std::max(largest, solution.p.lpNorm<Eigen::Infinity>() / stiffest);
  double most = 0.0;
  int body = -1;
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    const model::Contact& contact =
        prepared.model.contacts[static_cast<std::size_t>(prepared.contact.pairs[i].contact)];
    const bool on_springs_a = part_of(prepared, contact.a.body).has_springs();
    if (!on_springs_a && !part_of(prepared, contact.b.body).has_springs()) continue;
    const auto k = static_cast<Eigen::Index>(i);
    const double wrong =
        std::max({std::abs(motion[2 * k] - solution.gap[k]), std::abs(motion[2 * k + 1] - solution.slip_increment[k]),
                  against_the_law(problem, solution, k)});
    if (wrong > most) most = wrong, body = on_springs_a ? contact.a.body : contact.b.body;
  }
  if (!(most > allowed * largest)) return {};
  return fmt::format(
      "the springs of body '{}' are so soft that its contact forces are lost in the rounding of how far the loads "
      "would "
      "move it without contact: leave these springs out, if contact holds the body, or make them {:.0e} times as stiff",
      prepared.model.bodies[static_cast<std::size_t>(body)].name,
      std::pow(10.0, std::ceil(std::log10(most / (good * largest)))));
}

}  // namespace scabo::analysis
