// The motion of the bodies where an analysis ends as a mechanism or collapse, from amplitudes of the rigid motions of
// the contact problem. A part moves as one, without deformation:
//
//     u(x) = shift + rotation x (x - about),   opening = (u_B - u_A).n,   slip = (u_B - u_A).t
//
// Its size means nothing, so that the largest displacement of any node (of a rigid body: of its outline) is made 1 in
// the model's unit of length.
#pragma once

#include <Eigen/SparseCore>
#include <string>

#include "scabo/analysis/state/solution.hpp"
#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// `rigid`: m amplitudes, not all zero; `loads`: m, work of the loads per amplitude.
Mechanism mechanism_of(const Prepared& prepared, const Vector& rigid, FlowRule rule, const Vector& loads);

/// The integral of |u|^2 over the area of part `p` is v'M v for the rigid motion v = [u_x, u_y, L rotation] at its
/// reference point: M, from area and moments of area (of an unbounded part those of a square of its size).
Eigen::Matrix3d moments_of_part(const Prepared& prepared, std::size_t p);

/// [u_x, u_y, L rotation] of the rigid motion nearest to displacements of the nodes of a part.
Eigen::Vector3d nearest_rigid_motion(const Prepared& prepared, std::size_t p, const Vector& u);

/// M^-1 of the parts as rigid bodies, m x m, as if all were of one material: area, and moments of area about the
/// reference point (of an unbounded body those of a square of its size).
Eigen::SparseMatrix<double> inverse_mass(const Prepared& prepared);

/// The name of the rule in results: `coulomb` or `associated`.
const char* name_of(FlowRule rule);

/// `3 of 17 bodies move, most of all 'b_3_1'`, `1 of 2 bodies moves, 'block'`.
std::string describe(const Mechanism& mechanism, const model::Model& model);

}  // namespace scabo::analysis
