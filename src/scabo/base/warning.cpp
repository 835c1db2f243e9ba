#include "scabo/base/warning.hpp"

namespace scabo {

const char* name_of(WarningKind kind) {
  switch (kind) {
    case WarningKind::input:
      return "input";
    case WarningKind::load_without_effect:
      return "load_without_effect";
    case WarningKind::overlap:
      return "overlap";
    case WarningKind::pressure:
      return "pressure";
    case WarningKind::open_contact:
      return "open_contact";
    case WarningKind::few_pairs:
      return "few_pairs";
    case WarningKind::slides_off:
      return "slides_off";
    case WarningKind::open_shear:
      return "open_shear";
    case WarningKind::undetermined_motion:
      return "undetermined_motion";
    case WarningKind::undetermined_force:
      return "undetermined_force";
    case WarningKind::several_solutions:
      return "several_solutions";
    case WarningKind::rounding:
      return "rounding";
    case WarningKind::slender:
      return "slender";
    case WarningKind::large_displacement:
      return "large_displacement";
    case WarningKind::near_collapse:
      return "near_collapse";
    case WarningKind::no_reference:
      return "no_reference";
    case WarningKind::crack:
      return "crack";
    case WarningKind::infinite_stress:
      return "infinite_stress";
    case WarningKind::no_estimate:
      return "no_estimate";
    case WarningKind::few_modes:
      return "few_modes";
  }
  return "";
}

std::vector<std::string> texts_of(const std::vector<Warning>& warnings) {
  std::vector<std::string> texts;
  for (const Warning& warning : warnings) texts.push_back(warning.text);
  return texts;
}

}  // namespace scabo
