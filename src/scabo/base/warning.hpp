// Warnings: input that was analysed as written but is probably not what was intended, and results that need care.
#pragma once

#include <string>
#include <vector>

namespace scabo {

enum class WarningKind {
  input,  ///< a part of the input that has no effect, or is named otherwise than expected
  load_without_effect,
  overlap,       ///< bodies overlap at the start by more than small strains cover, or without a contact or tie
  pressure,      ///< a pressure beyond small strains
  open_contact,  ///< never closes
  few_pairs,     ///< too few pairs in contact for a reliable pressure
  slides_off,    ///< the sides of a contact with large slip leave each other
  open_shear,    ///< open pairs carry a prescribed shear strength
  undetermined_motion,
  undetermined_force,  ///< forces of pairs that are not unique although displacements are
  several_solutions,
  rounding,  ///< of the stiffness of a slender body or of stiff springs, or of a load far larger than another
  slender,   ///< a slender super-element whose sides are too long for its order to bend
  large_displacement,
  near_collapse,  ///< friction dissipates more than bodies store that only contact holds
  no_reference,   ///< an unbounded body under a resultant, without a reference point
  crack,          ///< stress intensity factors that are undefined or not resolved; overlapping faces
  infinite_stress,
  no_estimate,  ///< of the error
  few_modes
};

struct Warning {
  WarningKind kind = WarningKind::input;
  std::string subject;  ///< what it is about; two warnings of one kind and subject are the same
  std::string text;     ///< a sentence, with a remedy
};

/// `few_pairs`.
const char* name_of(WarningKind kind);

std::vector<std::string> texts_of(const std::vector<Warning>& warnings);

}  // namespace scabo
