// Why the stiffness matrix of a part is not positive definite to working precision, as far as can be measured.
#pragma once

#include <string>
#include <vector>

#include "scabo/mesh/mesh.hpp"
#include "scabo/model/model.hpp"

namespace scabo::system {

/// `bodies`: of the part. `springs`: the largest stiffness of its springs at a node, 0 without any; `stiffest`: that of
/// its cells.
std::string why_digits_are_lost(const model::Model& model, const mesh::Mesh& mesh, const std::vector<int>& bodies,
                                double springs, double stiffest);

}  // namespace scabo::system
