// A model before it is solved, for a picture of it.
#pragma once

#include <string>

#include "scabo/mesh/mesh.hpp"

namespace scabo::result {

/// JSON that `scabo plot` draws: title; bodies with their outlines, names of edges and sides of cells (without these
/// beyond 20,000 cells); contacts and ties with the points of their pairs; supports, springs and loads with the points
/// at which they act and unit vectors along which they do; bars with their ends. Lengths are those of the model.
std::string model_drawing(const model::Model& model, const mesh::Mesh& mesh);

}  // namespace scabo::result
