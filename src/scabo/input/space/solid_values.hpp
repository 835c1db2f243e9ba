// Values of models in space: numbers with a limit, vectors, shapes of bodies and sizes of their meshes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scabo/input/reader.hpp"
#include "scabo/model/cad_shape.hpp"
#include "scabo/model/solid_model.hpp"

namespace scabo::input {

/// For every key that has a meaning in the plane alone.
Later only_in_the_plane(const std::vector<const char*>& keys);

/// A number above `least`, or `least` itself as well; `least` if there is none.
double read_number_from(Report& report, const std::optional<Value>& value, double least, bool itself);

/// A number above 0; 0 if there is none.
double read_positive(Report& report, const std::optional<Value>& value);

/// `[x, y, z]`; zero if it is anything else, which is reported.
Eigen::Vector3d read_vector_in_space(Report& report, const Value& value);

/// The same of a key that must be there.
Eigen::Vector3d needed_vector(Report& report, const MapReader& map, std::string_view key);

/// A formula of the coordinates x, y and z, or a number; none if it is broken.
model::SpaceFormula read_formula_in_space(Report& report, const Value& value);

/// `{profile: {rectangle: ...}, holes: {...}, plane: xz, from: 0, to: 2}`.
model::SolidExtrusion read_extrusion(Report& report, const Value& value);

/// `{profile: {rectangle: ...}, plane: xz, axis: {from: [0, 0], to: [0, 1]}, angle: 90}`.
model::SolidRevolution read_revolution(Report& report, const Value& value);

/// Keys of a shape that only models in space have.
const std::vector<std::string>& kinds_of_solid_shapes();
/// `{box: {corner: [0, 0, 0], size: [1, 1, 1]}}`; nothing after a mistake. Names of files count from `folder`.
std::optional<model::AnyShape> read_solid_shape(Report& report, const Value& value, const std::string& folder);

/// `{size: 0.1, refine: [{near: [0, 0, 0], size: 0.01}]}`.
/// `has_hexahedra`: whether the shape can be divided into them.
model::SolidSizes read_solid_sizes(Report& report, const Value& value, bool has_hexahedra);
/// `kind` of a mesh: whether it is hexahedra.
bool read_solid_kind(Report& report, const std::optional<Value>& value);

}  // namespace scabo::input
