#pragma once

#include <set>

#include "scabo/model/model.hpp"

namespace scabo::model {

/// Indices of the materials of a body, of all its regions and sectors; only those that exist.
std::set<int> materials_of(const Model& model, const Body& body);

}  // namespace scabo::model
