// An order of elimination that keeps the factor of a sparse symmetric matrix sparse.
//
// The degrees of freedom of a node have the same neighbours. Consecutive unknowns whose columns have the same pattern
// therefore become one vertex of a graph. It is ordered by minimum degree (AMD; Amestoy, Davis and Duff, ACM Trans.
// Math. Software 30 (2004) 381), which is best in most plane meshes of up to a million degrees of freedom, or, if the
// factor costs so much that it pays, by nested dissection: by the positions of the unknowns, or by METIS (Karypis and
// Kumar, SIAM J. Sci. Comput. 20 (1998) 359). Without positions, the result depends on the pattern alone.
#pragma once

#include <cstdint>
#include <vector>

#include "scabo/linalg/symmetric_positive_solver.hpp"

namespace scabo::linalg {

/// Groups of consecutive unknowns with equal columns: first unknown of each group, and n.
std::vector<int> equal_columns(const SparseMatrix& A);

/// order[k]: the unknown that is eliminated at step k. `A`: n x n, symmetric pattern, both triangles stored, rows of
/// each column ascending. `positions` of the unknowns, if they are known: dissection_by_position needs them.
std::vector<std::int64_t> elimination_order(const SparseMatrix& A, Ordering method = Ordering::automatic,
                                            const std::vector<Vec2>& positions = {});

}  // namespace scabo::linalg
