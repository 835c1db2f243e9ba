#include "scabo/linalg/multifrontal_lu.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "scabo/linalg/sparse_general_solver.hpp"

namespace scabo::linalg {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Blocks of 1 to 5 unknowns on a grid of `side` x `side`, each a neighbour of the four beside it.
struct Grid {
  OrderedBlocks blocks;
  std::vector<int> block_of;
  explicit Grid(int side) {
    std::vector<int> at(static_cast<std::size_t>(side * side));
    // Every second row first, so that the order is one with fill and with several branches.
    int next = 0;
    for (int parity = 0; parity < 2; ++parity)
      for (int y = parity; y < side; y += 2)
        for (int x = 0; x < side; ++x) at[static_cast<std::size_t>(y * side + x)] = next++;
    blocks.members.resize(at.size());
    blocks.later.resize(at.size());
    for (int cell = 0; cell < side * side; ++cell)
      for (int k = 0; k <= cell % 5; ++k) {
        blocks.members[static_cast<std::size_t>(at[static_cast<std::size_t>(cell)])].push_back(
            static_cast<int>(block_of.size()));
        block_of.push_back(at[static_cast<std::size_t>(cell)]);
      }
    const auto join = [&](int a, int b) {
      const auto [first, second] = std::minmax(at[static_cast<std::size_t>(a)], at[static_cast<std::size_t>(b)]);
      blocks.later[static_cast<std::size_t>(first)].push_back(second);
    };
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        if (x + 1 < side) join(y * side + x, y * side + x + 1);
        if (y + 1 < side) join(y * side + x, (y + 1) * side + x);
      }
    for (std::vector<int>& later : blocks.later) std::sort(later.begin(), later.end());
  }
  int size() const { return static_cast<int>(block_of.size()); }
  bool neighbours(int a, int b) const {
    const auto [first, second] =
        std::minmax(block_of[static_cast<std::size_t>(a)], block_of[static_cast<std::size_t>(b)]);
    const std::vector<int>& later = blocks.later[static_cast<std::size_t>(first)];
    return first == second || std::binary_search(later.begin(), later.end(), second);
  }
  Sparse matrix(unsigned seed) const {
    std::mt19937 random(seed);
    std::normal_distribution<double> value;
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < size(); ++i)
      for (int j = 0; j < size(); ++j)
        if (neighbours(i, j) && (i == j || random() % 4 > 0))
          entries.emplace_back(i, j, value(random) + (i == j ? 8.0 : 0.0));
    Sparse A(size(), size());
    A.setFromTriplets(entries.begin(), entries.end());
    return A;
  }
};

TEST(MultifrontalLU, AgreesWithTheDenseFactorisation) {
  for (const int side : {1, 2, 7, 12}) {
    const Grid grid(side);
    MultifrontalLU lu(grid.blocks);
    for (unsigned seed = 1; seed < 4; ++seed) {  // another pattern within the blocks each time
      const Sparse A = grid.matrix(seed);
      ASSERT_TRUE(lu.factorise(A));
      EXPECT_GT(lu.reciprocal_condition(), 1e-6);
      // One right-hand side, and several with unit vectors among them.
      Matrix several = Matrix::Identity(grid.size(), std::min(grid.size(), 3));
      several.col(0).setLinSpaced(-1.0, 2.0);
      for (const Matrix& b : {Matrix(several.col(0)), several}) {
        Matrix x;
        lu.solve(b, x);
        EXPECT_LT((x - Matrix(A).partialPivLu().solve(b)).norm(), 1e-12 * x.norm()) << side << " " << seed;
      }
    }
  }
}

TEST(MultifrontalLU, TellsOfASingularMatrix) {
  const Grid grid(5);
  MultifrontalLU lu(grid.blocks);
  Sparse A = grid.matrix(1);
  const Sparse regular = A;
  for (Sparse::InnerIterator it(A, 3); it; ++it) it.valueRef() = 0.0;
  EXPECT_FALSE(lu.factorise(A));
  EXPECT_TRUE(lu.factorise(regular));
}

/// [d 1; 1 0] with the first unknowns in eight blocks: for small d regular, but not without exchanges between blocks.
TEST(MultifrontalLU, TellsOfPivotsThatAreTooSmall) {
  constexpr int leaves = 8, size = 40, n = leaves * size;
  OrderedBlocks blocks;
  blocks.members.resize(leaves + 1);
  for (int i = 0; i < n; ++i) blocks.members[static_cast<std::size_t>(i / size)].push_back(i);
  for (int i = n; i < 2 * n; ++i) blocks.members.back().push_back(i);
  blocks.later.assign(leaves, {leaves});
  blocks.later.emplace_back();
  MultifrontalLU lu(blocks);
  for (const double d : {1.0, 1e-18}) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i) {
      entries.emplace_back(i, i, d);
      entries.emplace_back(i, n + i, 1.0);
      entries.emplace_back(n + i, i, 1.0);
    }
    Sparse A(2 * n, 2 * n);
    A.setFromTriplets(entries.begin(), entries.end());
    EXPECT_EQ(lu.factorise(A), d == 1.0) << d;
  }
}

/// A wall in running bond: forces of joints with the flexibilities of two bodies, three motions for each body.
Sparse wall(int columns, int courses, int unknowns, double on_diagonal) {
  std::vector<std::vector<int>> joints_of(static_cast<std::size_t>(columns * courses));
  int joints = 0;
  const auto join = [&](int a, int b) {
    if (a >= 0) joints_of[static_cast<std::size_t>(a)].push_back(joints);
    joints_of[static_cast<std::size_t>(b)].push_back(joints++);
  };
  for (int z = 0; z < courses; ++z)
    for (int k = 0; k < columns; ++k) {
      const int body = z * columns + k;
      if (k > 0) join(body - 1, body);
      join(z > 0 ? body - columns : -1, body);
      if (z > 0 && k > 0) join(body - columns - 1, body);
    }
  std::mt19937 random(1);
  std::normal_distribution<double> value;
  const int forces = unknowns * joints, n = forces + 3 * columns * courses;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t body = 0; body < joints_of.size(); ++body) {
    std::vector<int> rows;
    for (const int joint : joints_of[body])
      for (int k = 0; k < unknowns; ++k) rows.push_back(joint * unknowns + k);
    const auto size = static_cast<Eigen::Index>(rows.size());
    const Matrix F = Matrix::NullaryExpr(size, 4, [&] { return 0.3 * value(random); });
    const Matrix W = F * F.transpose();
    for (Eigen::Index i = 0; i < size; ++i) {
      const int row = rows[static_cast<std::size_t>(i)];
      for (Eigen::Index j = 0; j < size; ++j)
        entries.emplace_back(row, rows[static_cast<std::size_t>(j)],
                             W(i, j) + (i == j ? on_diagonal * (1 + i % 3) : 0.0));
      for (int k = 0; k < 3; ++k) {
        const int motion = forces + 3 * static_cast<int>(body) + k;
        const double g = value(random);
        entries.emplace_back(row, motion, (1 + i % 2) * g);  // not symmetric
        entries.emplace_back(motion, row, g);
      }
    }
  }
  Sparse A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

TEST(SparseGeneralSolver, SolvesLargeSaddleSystemsByFronts) {
  SparseGeneralSolver solver;
  for (const double on_diagonal : {0.2, 1e-3, 1e4}) {
    const Sparse A = wall(14, 11, 10, on_diagonal);
    ASSERT_GT(A.rows(), 4000);
    ASSERT_TRUE(solver.factorise(A));
    EXPECT_GT(solver.reciprocal_condition(), 1e-13);
    const Vector expected = Vector::LinSpaced(A.rows(), -1.0, 2.0);
    Vector x, correction;
    const Vector b = A * expected;
    solver.solve(b, x);
    solver.solve(b - A * x, correction);
    EXPECT_LT((x + correction - expected).norm(), 1e-9 * expected.norm()) << on_diagonal;
  }
}

}  // namespace
}  // namespace scabo::linalg
