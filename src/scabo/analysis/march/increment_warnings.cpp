#include "scabo/analysis/march/increment_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scabo/analysis/diagnostics/large_rotations.hpp"
#include "scabo/analysis/diagnostics/near_collapse.hpp"
#include "scabo/analysis/diagnostics/undetermined_forces.hpp"
#include "scabo/analysis/diagnostics/undetermined_motions.hpp"
#include "scabo/analysis/state/cracks.hpp"
#include "scabo/analysis/state/outside.hpp"
#include "scabo/analysis/state/quantities.hpp"
#include "scabo/element/plane/conditioning.hpp"

namespace scabo::analysis {

namespace {

/// The part whose stiffness rounding changes most: its name, and why, as far as it is measured.
struct Rounded {
  std::string name, why;
};
Rounded most_rounded_part(const Prepared& prepared, const State& state, double lost_to_rounding) {
  std::size_t worst = 0;
  double largest = 0.0;
  for (std::size_t p = 0; p < state.u.size(); ++p)
    if (const double lost = prepared.structure.parts[p]->energy_lost(state.u[p]); lost > largest)
      largest = lost, worst = p;
  const system::Dofs& dofs = prepared.structure.dofs;
  bool all_finite = true;
  double slenderness = 1.0;
  for (const int b : dofs.bodies_of(worst)) {
    const auto body = static_cast<std::size_t>(b);
    all_finite = all_finite && prepared.model.bodies[body].mesh.kind == model::MeshKind::fem;
    slenderness = std::max(slenderness, element::measured(prepared.mesh.bodies[body]).slenderness);
  }
  constexpr double slender = 100.0;  // of less slender bodies rounding changes less than 1e-7
  std::string why = slenderness >= slender ? fmt::format("it is {:.0f} times as long as deep", slenderness)
                                           : fmt::format(
                                                 "it resists a displacement of one node about {:.0e} times as "
                                                 "much as what these loads do to it",
                                                 lost_to_rounding / std::numeric_limits<double>::epsilon());
  if (!all_finite) why += "; mesh {kind: fem} is changed less";
  return {dofs.name_of(worst, prepared.model), why};
}

/// Contacts more than a tenth of whose closed pairs lack their lasting cohesion: with it they open, without it they
/// close.
std::vector<Warning> without_cohesion(const Prepared& prepared, const State& state) {
  std::vector<int> closed(prepared.model.contacts.size(), 0), without = closed;
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    if (prepared.contact.pairs[i].is_bar() || state.states[i] == contact::ContactState::open) continue;
    const auto c = static_cast<std::size_t>(prepared.contact.pairs[i].contact);
    ++closed[c];
    without[c] += state.history[i].broken && prepared.model.contacts[c].lasting_cohesion > 0.0;
  }
  std::vector<Warning> warnings;
  for (std::size_t c = 0; c < closed.size(); ++c)
    if (10 * without[c] > closed[c])
      warnings.push_back(
          {WarningKind::open_shear, prepared.model.contacts[c].name,
           fmt::format("{} of {} closed pairs of contact '{}' have no cohesion: with it they open, and without it they "
                       "close, so that the joint carries less than its law: compare with a smaller cohesion",
                       without[c], closed[c], prepared.model.contacts[c].name)});
  return warnings;
}

/// One warning of large displacements is enough.
void add_large_rotation(const Prepared& prepared, const State& state, const IncrementResult& at,
                        StaticSolution& solution) {
  for (const Warning& warning : solution.warnings)
    if (warning.kind == WarningKind::large_displacement && warning.subject.empty()) return;
  if (const std::string sentence = large_rotation(prepared, state); !sentence.empty())
    solution.warnings.push_back({WarningKind::large_displacement, "",
                                 fmt::format("step {}, increment {}: {}", at.step_name, at.increment, sentence)});
}

}  // namespace

void add_warnings(const Prepared& prepared, const Reached& reached, const IncrementResult& at,
                  StaticSolution& solution) {
  std::vector<Warning>& warnings = solution.warnings;
  const auto add = [&](WarningKind kind, const std::string& subject, const std::string& sentence) {
    for (const Warning& warning : warnings)
      if (warning.kind == kind && warning.subject == subject) return;
    warnings.push_back({kind, subject, fmt::format("step {}, increment {}: {}", at.step_name, at.increment, sentence)});
  };
  if (const auto motions = undetermined_motion_warning(prepared, reached.undetermined, warnings))
    add(motions->kind, motions->subject, motions->text);
  const bool told_of_forces = std::any_of(warnings.begin(), warnings.end(), [](const Warning& warning) {
    return warning.kind == WarningKind::undetermined_force;
  });
  if (!told_of_forces && reached.problem.pairs() == static_cast<int>(prepared.contact.pairs.size()))
    if (const auto forces = undetermined_forces_warning(prepared, reached.state, reached.problem))
      add(forces->kind, forces->subject, forces->text);
  if (reached.uniqueness && reached.uniqueness->others > 0)
    add(WarningKind::several_solutions, "",
        fmt::format("other solutions exist ({} found); the one closest to the previous "
                    "increment was chosen: see 'uniqueness' in summary.json",
                    reached.uniqueness->others));
  for (std::size_t c = 0; c < at.contacts.size(); ++c) {
    if (prepared.model.contacts[c].shear_strength.value_or(0.0) == 0.0) continue;
    if (at.contacts[c].open > 0)
      add(WarningKind::open_shear, at.contacts[c].name,
          fmt::format("open pairs of contact '{}' carry shear: a prescribed shear strength does not depend on pressure",
                      at.contacts[c].name));
  }
  constexpr double worth_saying = 3e-5;  // errors of three times the estimate were seen
  if (at.lost_to_rounding > worth_saying) {
    const Rounded most_rounded = most_rounded_part(prepared, reached.state, at.lost_to_rounding);
    add(WarningKind::rounding, "",
        fmt::format("rounding of the stiffness of {} may change its displacements by a part of about {:.0e}: {}",
                    most_rounded.name, at.lost_to_rounding, most_rounded.why));
  }
  if (const std::string large = large_displacement(prepared, reached.state); !large.empty())
    add(WarningKind::large_displacement, "", large);
  for (const Warning& turned : rotations_at_large_slip(prepared, reached.state))
    add(turned.kind, turned.subject, turned.text);
  const bool in_time = at.time.has_value();  // bodies may move
  if (const std::string close =
          near_collapse(prepared, reached.state, solution.increments, static_cast<std::size_t>(at.step) - 1);
      !in_time && !close.empty())
    add(WarningKind::near_collapse, "", close);
  if (const std::string relative = without_reference(prepared, reached.state); !relative.empty())
    add(WarningKind::no_reference, "", relative);
  for (const Warning& warning : without_cohesion(prepared, reached.state))
    add(warning.kind, warning.subject, warning.text);
  for (const Warning& warning : crack_warnings(at.cracks)) add(warning.kind, warning.subject, warning.text);
  for (const Warning& warning : quantity_warnings(prepared.model, at)) add(warning.kind, warning.subject, warning.text);
  add_large_rotation(prepared, reached.state, at, solution);
}

}  // namespace scabo::analysis
