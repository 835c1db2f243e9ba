#include "scabo/system/stiffness.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <functional>

#include "scabo/system/ranks.hpp"

namespace scabo::system {

Eigen::Index Stiffness::size() const { return divided ? divided->size() : dense ? dense->rows() : sparse.rows(); }

double Stiffness::entries() const {
  return divided ? divided->entries() : static_cast<double>(dense ? dense->size() : sparse.nonZeros());
}

Vector Stiffness::times(const Vector& u) const {
  if (divided) return divided->times(u);
  return dense ? Vector(*dense * u) : Vector(sparse * u);
}

linalg::TwofoldVector Stiffness::times(const linalg::TwofoldVector& u) const {
  if (divided) return divided->times(u);
  return dense ? linalg::product(*dense, u) : linalg::product(sparse, u);
}

Vector Stiffness::times_squares(const Vector& u) const {
  if (divided) return divided->times_squares(u);
  if (dense) return dense->cwiseAbs2() * u;
  Vector product(u.size());  // K is symmetric: rows are columns
  for (Eigen::Index j = 0; j < sparse.cols(); ++j) {
    double sum = 0.0;
    for (linalg::SparseMatrix::InnerIterator it(sparse, j); it; ++it) sum += it.value() * it.value() * u[it.row()];
    product[j] = sum;
  }
  return product;
}

double Stiffness::largest_diagonal() const {
  if (size() == 0) return 0.0;
  if (divided) return divided->largest_diagonal();
  return dense ? dense->diagonal().maxCoeff() : Vector(sparse.diagonal()).maxCoeff();
}

linalg::SparseMatrix with_springs(const Stiffness& stiffness) { return stiffness.sparse + stiffness.springs.matrix; }

linalg::SparseMatrix principal_part(const linalg::SparseMatrix& K, const std::vector<int>& dofs,
                                    const std::vector<int>& place) {
  const auto n = static_cast<Eigen::Index>(dofs.size());
  linalg::SparseMatrix part(n, n);
  part.reserve(K.nonZeros());
  for (Eigen::Index j = 0; j < n; ++j) {
    part.startVec(j);
    for (linalg::SparseMatrix::InnerIterator it(K, dofs[static_cast<std::size_t>(j)]); it; ++it)
      if (const int row = place[static_cast<std::size_t>(it.row())]; row >= 0) part.insertBack(row, j) = it.value();
  }
  part.finalize();
  return part;
}

namespace {

/// Bit for bit.
bool equal(const linalg::SparseMatrix& a, const linalg::SparseMatrix& b) {
  const auto same = [](const auto* first, const auto* second, Eigen::Index count) {
    return count == 0 || std::memcmp(first, second, static_cast<std::size_t>(count) * sizeof(*first)) == 0;
  };
  return a.cols() == b.cols() && a.nonZeros() == b.nonZeros() &&
         same(a.outerIndexPtr(), b.outerIndexPtr(), a.cols() + 1) &&
         same(a.innerIndexPtr(), b.innerIndexPtr(), a.nonZeros()) && same(a.valuePtr(), b.valuePtr(), a.nonZeros());
}

}  // namespace

bool equal(const Stiffness& a, const Stiffness& b) {
  if (a.resists_rigid_motions != b.resists_rigid_motions || !equal(a.springs.matrix, b.springs.matrix)) return false;
  if (a.divided || b.divided) return a.divided == b.divided;
  if (a.dense || b.dense) return a.dense == b.dense;
  return a.rounding == b.rounding && equal(a.sparse, b.sparse);
}

std::size_t hash_of(const Stiffness& stiffness) {
  if (stiffness.divided) return std::hash<const void*>()(stiffness.divided.get());
  if (stiffness.dense) return std::hash<const void*>()(stiffness.dense.get());
  constexpr Eigen::Index most = 4096;  // entries: equal() compares all of them
  const Eigen::Index count = stiffness.sparse.nonZeros(), samples = std::min(count, most);
  std::uint64_t hash = static_cast<std::uint64_t>(count);
  for (Eigen::Index k = 0; k < samples; ++k) {
    hash =
        (hash ^ std::bit_cast<std::uint64_t>(stiffness.sparse.valuePtr()[k * count / samples])) * 0x9e3779b97f4a7c15ULL;
    hash ^= hash >> 32;
  }
  return hash;
}

}  // namespace scabo::system
