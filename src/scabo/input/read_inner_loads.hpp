// Loads on side faces and inside bodies, where there are no boundary elements. Each function reads one value and
// returns nothing if it is broken.
#pragma once

#include "scabo/input/reading.hpp"

namespace scabo::input {

/// `traction` or `pressure` on a side face: a constant, {powers: ...} or {points: ...} in xi.
std::optional<FaceTraction> read_face_traction(Reading& reading, const Value& value, bool pressure);

/// `[bx, by]` or {constant: [...], x: [...], y: [...]}.
std::optional<BodyForce> read_body_force(Reading& reading, const Value& value);

/// `field: {stress: [sxx, syy, sxy]}` or `{vertical: {...}, K0: 0.5}`.
std::optional<decltype(Load::kind)> read_field(Reading& reading, const Value& value);

/// A number, {constant: ..., x: ..., y: ...} or {over: y, at: [...], values: [...]}.
std::optional<Temperature> read_temperature(Reading& reading, const Value& value);

}  // namespace scabo::input
