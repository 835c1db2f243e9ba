// The contribution of a part to W: B A B', with its flexibility A at the degrees of freedom that pairs touch.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "scabo/system/body_system.hpp"

namespace scabo::system {

/// So many degrees of freedom have their flexibility as a whole: 1.2 GB.
inline constexpr std::size_t most_flexible_at_once = 12'000;

/// `motion`: B, a column for each of `dofs`. A face in space has four nodes for each pair, and its A many times the
/// entries of the result. Of more than `most` degrees of freedom it is never there as a whole: they are three groups,
/// and of each two of them A is made, and added, by itself. This takes 4/9 of the memory, and each entry of Y'Y
/// (linalg/supernodal_sweep.hpp) at most twice the work.
Matrix pair_flexibility(const Eigen::SparseMatrix<double, Eigen::RowMajor>& motion, const std::vector<int>& dofs,
                        const BodySystem& part, std::size_t most = most_flexible_at_once);

}  // namespace scabo::system
