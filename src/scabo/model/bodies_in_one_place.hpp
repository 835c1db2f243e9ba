// Bodies that occupy the same place although nothing joins them: copies that were written twice, a wrong coordinate.
#pragma once

#include <optional>

#include "scabo/base/warning.hpp"
#include "scabo/model/model.hpp"

namespace scabo::model {

/// A warning of bodies that have some area in common, are there at the same time, and have no contact or tie with each
/// other: the model then counts their common area twice, and neither hinders the other. Bodies with a contact are left
/// out, as an interference presses them together. So are pairs of rigid bodies, unbounded bodies, and bodies from
/// images, whose outlines enclose empty pixels. The model is valid.
std::optional<Warning> warning_of_bodies_in_one_place(const Model& model);

}  // namespace scabo::model
