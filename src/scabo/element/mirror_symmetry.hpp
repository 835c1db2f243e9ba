// Mirror symmetries of a super-element and the bases in which its matrices fall apart into blocks.
//
// A mirror line through the scaling centre that maps the boundary nodes and elements onto themselves, and the
// elasticity of every element onto that of its image, commutes with the scaled boundary equation, so displacements
// symmetric and antisymmetric about it do not interact. One line gives two blocks of half the size, two perpendicular
// ones four of a quarter: a rectangle's stiffness costs a sixteenth.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "scabo/element/coefficient_matrices.hpp"

namespace scabo::element {

/// Orthonormal bases T_k (n x n_k, sparse) of the blocks; their sizes add up to n. One identity where there is no
/// symmetry. An open ring (a crack, a notch) has at most one mirror line, which exchanges its faces.
std::vector<Eigen::SparseMatrix<double>> symmetry_blocks(const Ring& ring, const Elasticity& D);

}  // namespace scabo::element
