// What summary.json says of the model itself: its materials, bodies, contacts and steps by their names.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "scabo/mesh/mesh.hpp"
#include "scabo/model/model.hpp"

namespace scabo::result {

/// The keys `plane`, `thickness`, `materials`, `bodies`, `contacts` and `steps` of `model` in summary.json
/// (docs/results.md), in the units of the model.
nlohmann::ordered_json model_content(const model::Model& model, const mesh::Mesh& mesh);

}  // namespace scabo::result
