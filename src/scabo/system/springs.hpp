// Springs between bodies and the ground (model::Spring).
//
// On an edge they are an elastic foundation: the traction on the body is -(k_n n n' + k_t t t') u, with n the outward
// normal and t the tangent at the point, and
//
//     S = thickness * integral of N'(k_n n n' + k_t t t') N ds
//
// with the shape functions N of its elements (consistent matrix), or those of a rigid motion. At a point S has k_x and
// k_y on its diagonal. The force on the body is -S u, which is zero at the start of the analysis. Springs that are at
// rest at a displacement a along their axes (Spring::at_rest) have in addition, times the factor of their load,
//
//     f = thickness * integral of N'(k_n a_n n + k_t a_t t) ds
//
// which is S u for a motion u = a_n n + a_t t of the whole edge.
#pragma once

#include <vector>

#include "scabo/system/body_system.hpp"
#include "scabo/system/dofs.hpp"

namespace scabo::system {

/// Springs of a model.
struct ModelSprings {
  std::vector<Springs> of_part;                 ///< sum over the springs on each part
  std::vector<linalg::SparseMatrix> of_spring;  ///< S of each spring of the model, on the part of its body
  std::vector<Vector> at_rest;                  ///< f of each spring of the model, on the part of its body
};

ModelSprings springs_of(const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs);

/// Forces [F_x, F_y] of each spring of the model on its body, for displacements u of the parts; `factors`: of the
/// loads.
std::vector<Vec2> spring_resultants(const ModelSprings& springs, const model::Model& model, const Dofs& dofs,
                                    const std::vector<Vector>& u, const std::vector<double>& factors);

}  // namespace scabo::system
