// Checks of a whole model, whoever built it: ranges of values, indices, geometry, and relations between its parts.
//
// Every mistake has the path of the key that it concerns, as in a model file: `bodies.upper.mesh.size`. Items of lists
// are counted from 0: `supports.2.on`. One mistake gives one message: parts that depend on a wrong part are not judged.
#pragma once

#include <string>
#include <vector>

#include "scabo/base/error.hpp"
#include "scabo/model/model.hpp"

namespace scabo::model {

struct Mistake {
  Source at;            ///< path; line and column of the part of the model that contains it, 0 if it has none
  std::string message;  ///< what is wrong, and how to correct it
  std::string given;    ///< the wrong number as `message` ends with it (`..., not 0`); a file may spell it differently
  bool of_key = false;  ///< concerns the key (it must not be here, or the whole part is meant) rather than its value
  bool of_whole = false;  ///< is true whatever else is wrong within the part
};

/// What the reader of a text could not read and has reported: checks that need it are left out.
struct Gaps {
  bool materials = false;   ///< a material is not in the model
  bool bodies = false;      ///< a body is not in the model
  bool places = false;      ///< it is not known which bodies have a support or contact
  bool conditions = false;  ///< a load, support or contact is not in the model
  bool steps = false;       ///< the steps are not known
  /// Per body: named by a support, or by a contact, that may not be in the model. May be empty.
  std::vector<char> held, touched;
};

/// All mistakes of a model, in the order of its parts. Takes time proportional to its size.
std::vector<Mistake> validate(const Model& model, const Gaps& gaps = {});

/// Throws InputError with all mistakes of the model, if it has any.
void require_valid(const Model& model);

// Sentences of a reader about keys that stand beside others although they have no effect there.
inline constexpr const char* no_effect_beside_bond = "has no effect where 'bond' is true: leave one of them out";
inline constexpr const char* replaced_by_shear_strength =
    "cannot be combined with 'shear_strength', which replaces friction: leave one of them out";
inline constexpr const char* no_gap_beside_bond =
    "a bonded contact keeps the initial distance of its sides: leave 'gap' out";
inline constexpr const char* not_for_rigid = "does not apply to a rigid body: leave it out";

}  // namespace scabo::model
