// Contact forces that are lost in the rounding of how far a body would move without contact.
//
// A slender body that contact alone holds, or one that only soft springs or far softer parts hold, would move without
// contact by many orders of magnitude more than it does: W p and q are each that large, and their sum keeps the digits
// that are left. The displaced bodies, found from the contact forces, tell how many: the motions of the pairs that
// follow from them must be those of the contact problem. Where they are not, the difference is added to q and the
// problem solved again. Its certificate measures gaps and slips by the way that loads would move bodies without
// contact; here they are measured by the displacements. Bodies may hardly be displaced although large forces act or
// have acted on them (ground at rest under its weight, a load that has returned to zero): what a gap may then be wrong
// by follows from the force by which the less stiff body of the pair, or the springs of rigid ones, would answer it,
// against the scale of forces.
#pragma once

#include <optional>
#include <string>

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// Of a solution with a body in contact that is held softly.
struct SoftlyHeld {
  Vector difference;  ///< 2N: motions of the pairs by the displaced bodies less those of the contact problem
  /// The largest difference, or motion against the law, of pairs of bodies that are held softly, over the largest
  /// displacement, or over what the largest force would displace one node of the less stiff body, or springs that hold
  /// rigid ones, if that is more.
  double wrong = 0.0;
  double apart = 0.0;   ///< the same of the difference alone
  int body = -1;        ///< the body where it is, if it is above `allowed`
  double softer = 0.0;  ///< how far a force there moves the pair, over how far it displaces one node of the less stiff
                        ///< body; 1 where both are rigid

  static constexpr double good = 1e-6;     ///< of `apart`: not worth another solve
  static constexpr double allowed = 3e-5;  ///< of `wrong`: forces are lost beyond
};

/// Nothing where no body in contact is held softly. `to`: with its displacements; `drawn`: 2N, motions of the pairs
/// where no body is displaced; `force_scale`: what forces are judged against.
std::optional<SoftlyHeld> softly_held(const Prepared& prepared, const State& to, const contact::Problem& problem,
                                      const contact::Solution& solution, const Vector& drawn, double force_scale);

/// Why the forces of a solution are lost.
std::string lost_where_softly_held(const Prepared& prepared, const SoftlyHeld& held);

}  // namespace scabo::analysis
