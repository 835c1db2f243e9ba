// Pictures of models that are not solved.
#pragma once

#include <string>
#include <vector>

#include "exit_status.hpp"
#include "scabo/mesh/mesh.hpp"

namespace scabo::app {

/// Draws the model with the words of `scabo plot`, of which the first one is its file.
ExitStatus draw_model(const model::Model& model, const mesh::Mesh& mesh, std::vector<std::string> arguments);

}  // namespace scabo::app
