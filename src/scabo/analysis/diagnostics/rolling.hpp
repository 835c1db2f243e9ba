// Bodies that roll away.
//
// The theory of small rotations lets a round body on a slope rest: as it turns by theta, the pairs ahead of it close,
// and the contact force moves by R theta, whereas the weight stays. In truth the body goes along with its contact. So
// the moments of a solution are taken once more with displaced arms: contact forces and reactions at the points to
// which they have moved, loads at the centre of the body as it is displaced,
//
//     missing = sum (u_i - u_c - w_i) x f_i
//
// w_i: what the rotation of the other body of the pair moves the arm by, as a body that tips together with its ground
// does not roll. What a contact carries is the moment of its forces, and what their spread would carry: with the
// displaced arms y_i = x_i - x_c + u_i - u_c - w_i, the resultant F and the normal forces N_i as shares
//
//     carried = max(|sum y_i x f_i|, sum |N_i / N  y_i x F|) + sum |f_i| l_i / 4,    N = sum |N_i|
//
// l_i: tributary length of a pair, over which its force is distributed. Forces along the contact that balance each
// other, as where a round body sticks while it is flattened, do not count. A body rolls where more than half of the
// moment that its contacts carry is missing: where it has gone about as far as its contact is wide.
#pragma once

#include <string>

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// Names the body that rolls, of several the one that misses the largest part; empty if none does. Bodies that supports
/// or springs keep from turning do not roll.
std::string rolling_body(const Prepared& prepared, const State& state);

}  // namespace scabo::analysis
