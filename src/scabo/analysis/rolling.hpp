// Bodies that roll, by a check after the solve.
//
// With small displacements arms of forces are those of the bodies as drawn. Where a round body turns by theta, the
// pairs that press are other ones, by its radius of curvature times theta away, but the loads stay where they are
// drawn: this moment seems to hold the body. In truth it takes its loads along, and on a disc they stay above the
// contact, whatever it turns by: nothing holds it. For the forces f of a part at its points x, which are displaced by
// u, the moment that displaced arms leave unbalanced is
//
//     M = sum (x + u) x f = sum u x f        since sum x x f = 0; of any point, since sum f = 0
//
// It is compared with the moment that contact has come to carry by moving along the sides: for each contact the
// resultant of its forces times the distance of its line from where the two sides touch first as they are drawn. Of
// straight sides that lie on each other that is anywhere between the ends, and nothing is carried; between the nodes of
// a round side it is where a parabola through the gaps of three nodes has its least value.
//
// The ratio of the two moments is h / rho for a rocker of radius rho whose weight is by h above the contact: 1 for a
// disc, 0 for a body that stays where it is. Beyond one half the body turns by more than twice what was found, or does
// not come to rest, and the increment is none.
#pragma once

#include <optional>
#include <string>

#include "scabo/analysis/increment.hpp"

namespace scabo::analysis {

/// A part that rolls.
struct Rolling {
  std::size_t part = 0;
  double missed = 0.0;   ///< |M|
  double carried = 0.0;  ///< the moment that contact carries, and that of springs
  bool sprung = false;   ///< springs hold it, so that it may come to rest elsewhere
};

/// The part whose moments miss balance most, by more than half of what contact carries; nothing where no part that may
/// turn does. Shifts of the contact below a twentieth of an element do not count.
std::optional<Rolling> rolling_part(const Prepared& prepared, const State& state);

/// `body 'disc' rolls ...`: a sentence without a full stop.
std::string describe_rolling(const Prepared& prepared, const State& state, const Rolling& rolling);

/// The rigid motions of this part in a state, m; those of all other parts are zero.
Vector motion_of_rolling(const Prepared& prepared, const State& state, const Rolling& rolling);

}  // namespace scabo::analysis
