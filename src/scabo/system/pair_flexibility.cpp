#include "scabo/system/pair_flexibility.hpp"

#include <algorithm>
#include <array>

namespace scabo::system {

namespace {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// N A N' of a symmetric A, exactly symmetric, by tiles of its columns: no other matrix is as large.
Matrix congruent(const SparseRows& N, const Matrix& A) {
  constexpr Eigen::Index tile = 64;
  using Row = SparseRows::InnerIterator;
  const Eigen::Index rows = N.rows();
  Matrix result(rows, rows), half(A.rows(), tile);
  for (Eigen::Index first = 0; first < rows; first += tile) {
    const Eigen::Index count = std::min(tile, rows - first), last = first + count;
    for (Eigen::Index j = first; j < last; ++j) {
      auto column = half.col(j - first);
      column.setZero();
      for (Row it(N, j); it; ++it) column += it.value() * A.col(it.col());
      for (Eigen::Index i = j; i < rows; ++i) {
        double sum = 0.0;
        for (Row it(N, i); it; ++it) sum += it.value() * column[it.col()];
        result(i, j) = sum;
      }
    }
    for (Eigen::Index j = first; j < last; ++j)
      for (Eigen::Index i = j + 1; i < last; ++i) result(j, i) = result(i, j);
    for (Eigen::Index below = last; below < rows; below += tile) {
      const Eigen::Index height = std::min(tile, rows - below);
      result.block(first, below, count, height) = result.block(below, first, height, count).transpose();
    }
  }
  return result;
}

/// The columns of `motion` that are `chosen`.
SparseRows columns_of(const SparseRows& motion, const std::vector<int>& chosen) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < chosen.size(); ++k) entries.emplace_back(chosen[k], static_cast<int>(k), 1.0);
  SparseRows selection(motion.cols(), static_cast<Eigen::Index>(chosen.size()));
  selection.setFromTriplets(entries.begin(), entries.end());
  return motion * selection;
}

}  // namespace

Matrix pair_flexibility(const SparseRows& motion, const std::vector<int>& dofs, const BodySystem& part,
                        std::size_t most) {
  // Without what supports hold, whose entries are 0.
  std::vector<int> moving;  // indices into `dofs`
  for (std::size_t k = 0; k < dofs.size(); ++k)
    if (part.moves(dofs[k])) moving.push_back(static_cast<int>(k));
  const auto flexibility = [&](const std::vector<int>& chosen) {
    std::vector<int> at;
    for (const int k : chosen) at.push_back(dofs[static_cast<std::size_t>(k)]);
    return part.flexibility(at);
  };
  const auto rows = static_cast<std::size_t>(motion.rows());
  if (moving.size() <= std::max(most, 2 * rows))  // else A is more than four times as large as the result
    return congruent(moving.size() == dofs.size() ? motion : columns_of(motion, moving), flexibility(moving));
  Matrix sum = Matrix::Zero(motion.rows(), motion.rows());
  const auto start_of = [&](std::size_t group) {
    return moving.begin() + static_cast<std::ptrdiff_t>(group * moving.size() / 3);
  };
  std::array<bool, 3> counted{};  // groups whose own entries are in the sum
  for (const auto& [one, other] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
    std::vector<int> chosen(start_of(one), start_of(one + 1));
    const auto first = static_cast<Eigen::Index>(chosen.size());
    chosen.insert(chosen.end(), start_of(other), start_of(other + 1));
    Matrix A = flexibility(chosen);
    if (counted[one]) A.topLeftCorner(first, first).setZero();
    if (counted[other]) A.bottomRightCorner(A.rows() - first, A.rows() - first).setZero();
    counted[one] = counted[other] = true;
    sum += congruent(columns_of(motion, chosen), A);
  }
  return sum;
}

}  // namespace scabo::system
