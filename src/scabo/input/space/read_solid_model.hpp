// Model file in space (`analysis: {space: true}`, docs/model/space.md) -> model::SpaceModel.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "scabo/input/read_model.hpp"
#include "scabo/input/reader.hpp"
#include "scabo/model/solid_model.hpp"

namespace scabo::input {

/// Whether a model is one in space: as `analysis` says, else if a body has a shape that only these have.
bool is_in_space(const Node& root);

/// The model of a tree; `report` has the mistakes found before. Throws InputError with all mistakes.
model::SpaceModel solid_model_of_tree(const NodePtr& root, Report& report, const std::string& file);

/// A model file of either kind.
using AnyModel = std::variant<model::Model, model::SpaceModel>;
AnyModel read_any_model(const std::string& file, const std::vector<Override>& overrides = {});

}  // namespace scabo::input
