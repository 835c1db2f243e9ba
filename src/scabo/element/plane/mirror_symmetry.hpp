// Mirror symmetries of a super-element and the bases in which its matrices become block diagonal.
//
// A reflection in a line through the scaling centre that maps the boundary nodes and elements onto themselves, and the
// elasticity of every element onto that of its image, commutes with the scaled boundary equation. Displacements
// symmetric and antisymmetric about the line therefore do not interact. One line gives two blocks of half the size, and
// two perpendicular lines give four of a quarter: the stiffness of a rectangle costs a sixteenth.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "scabo/element/facet/coefficient_matrices.hpp"

namespace scabo::element {

/// Orthonormal bases T_k (n x n_k, sparse) of the blocks; their sizes add up to n. Without symmetry there is one, the
/// identity. An open ring (a crack, a notch) has at most one mirror line, which exchanges its faces.
std::vector<Eigen::SparseMatrix<double>> symmetry_blocks(const Ring& ring, const Elasticity& D);
/// How many: 1, 2 or 4.
int symmetry_block_count(const Ring& ring, const Elasticity& D);

}  // namespace scabo::element
