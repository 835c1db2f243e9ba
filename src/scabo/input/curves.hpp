// What models in the plane and in space read alike of curves and of the steps in which factors follow them.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "scabo/input/reader.hpp"
#include "scabo/model/step.hpp"

namespace scabo::input {

using CurveKind = std::variant<model::CurveTable, model::CurveSine>;
/// Of a map with one of the keys table, ramp and sine; nothing if it is broken.
std::optional<CurveKind> read_curve_kind(Report& report, const MapReader& map);

/// Lets increments end at the corners of curves, besides their equal parts.
void divide_at_corners(const std::vector<model::Curve>& curves, model::Step& step);

/// `cycles`, how often a step is run, of the map of a step.
long read_cycles(Report& report, const Value& value, const model::Step& step);

}  // namespace scabo::input
