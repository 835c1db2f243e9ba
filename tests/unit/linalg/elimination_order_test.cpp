#include "scabo/linalg/elimination_order.hpp"

#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <numeric>
#include <set>
#include <thread>

namespace scabo::linalg {
namespace {

/// Pattern of a grid of side x side nodes, each with `dofs` unknowns, coupled to its four neighbours.
SparseMatrix grid(int side, int dofs) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < side * side; ++i)
    for (const int j : {i, i % side + 1 < side ? i + 1 : i, i + side < side * side ? i + side : i})
      for (int a = 0; a < dofs; ++a)
        for (int b = 0; b < dofs; ++b) {
          entries.emplace_back(dofs * i + a, dofs * j + b, 1.0);
          entries.emplace_back(dofs * j + b, dofs * i + a, 1.0);
        }
  SparseMatrix A(dofs * side * side, dofs * side * side);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

std::vector<Vec2> positions(int side, int dofs) {
  std::vector<Vec2> of_unknowns;
  for (int i = 0; i < dofs * side * side; ++i) of_unknowns.emplace_back(i / dofs % side, i / dofs / side);
  return of_unknowns;
}

/// Entries of the Cholesky factor, by elimination of the graph.
long entries_of_factor(const SparseMatrix& A, const std::vector<std::int64_t>& order) {
  const auto n = static_cast<std::size_t>(A.rows());
  std::vector<std::size_t> step(n);
  for (std::size_t k = 0; k < n; ++k) step[static_cast<std::size_t>(order[k])] = k;
  std::vector<std::set<std::size_t>> later(n);
  for (int j = 0; j < A.cols(); ++j)
    for (SparseMatrix::InnerIterator it(A, j); it; ++it) {
      const std::size_t a = step[static_cast<std::size_t>(it.row())], b = step[static_cast<std::size_t>(j)];
      if (a > b) later[b].insert(a);
    }
  long entries = 0;
  for (std::size_t k = 0; k < n; ++k) {
    entries += 1 + static_cast<long>(later[k].size());
    if (later[k].empty()) continue;
    const std::size_t parent = *later[k].begin();
    later[parent].insert(std::next(later[k].begin()), later[k].end());
  }
  return entries;
}

TEST(EliminationOrder, UnknownsOfANodeAreOneVertex) {
  const SparseMatrix A = grid(5, 2);
  const std::vector<int> groups = equal_columns(A);
  ASSERT_EQ(groups.size(), 26u);
  for (int g = 0; g <= 25; ++g) EXPECT_EQ(groups[static_cast<std::size_t>(g)], 2 * g);
}

TEST(EliminationOrder, AHeldUnknownLeavesTheOtherAlone) {  // the second unknown of node 3 is left out
  const Matrix all = Matrix(grid(4, 2));
  std::vector<int> kept(32);
  std::iota(kept.begin(), kept.end(), 0);
  kept.erase(kept.begin() + 7);
  SparseMatrix A = Matrix(all(kept, kept)).sparseView();
  A.makeCompressed();
  const std::vector<int> groups = equal_columns(A);
  EXPECT_EQ(groups.size(), 17u);
  EXPECT_EQ(groups[3], 6);
  EXPECT_EQ(groups[4], 7);
  EXPECT_EQ(groups.back(), 31);
}

TEST(EliminationOrder, EqualNumbersOfNeighboursAreNotEqualColumns) { EXPECT_EQ(equal_columns(grid(6, 1)).size(), 37u); }

TEST(EliminationOrder, NoUnknownsAndOne) {
  EXPECT_TRUE(elimination_order(SparseMatrix(0, 0)).empty());
  SparseMatrix one(1, 1);
  one.insert(0, 0) = 2.0;
  one.makeCompressed();
  for (const Ordering method : {Ordering::automatic, Ordering::minimum_degree, Ordering::nested_dissection})
    EXPECT_EQ(elimination_order(one, method), std::vector<std::int64_t>{0});
}

class EliminationOrders : public testing::TestWithParam<Ordering> {};
INSTANTIATE_TEST_SUITE_P(Methods, EliminationOrders,
                         testing::Values(Ordering::automatic, Ordering::minimum_degree, Ordering::nested_dissection,
                                         Ordering::dissection_by_position));

TEST_P(EliminationOrders, IsAPermutationThatKeepsNodesTogether) {
  std::vector<std::int64_t> order = elimination_order(grid(12, 2), GetParam(), positions(12, 2));
  for (std::size_t k = 0; k < order.size(); k += 2) {
    EXPECT_EQ(order[k] % 2, 0);
    EXPECT_EQ(order[k + 1], order[k] + 1);
  }
  std::sort(order.begin(), order.end());
  for (std::size_t k = 0; k < order.size(); ++k) EXPECT_EQ(order[k], static_cast<std::int64_t>(k));
}

// Nested dissection of a grid by hand needs at most 31/4 n log2(n) entries (George, SIAM J. Numer. Anal. 10 (1973)
// 345); the order of the numbers n^1.5.
TEST_P(EliminationOrders, KeepsTheFactorSparse) {
  const SparseMatrix A = grid(40, 1);
  std::vector<std::int64_t> natural(1600);
  std::iota(natural.begin(), natural.end(), 0);
  const long entries = entries_of_factor(A, elimination_order(A, GetParam(), positions(40, 1)));
  EXPECT_LT(entries, 31.0 / 4.0 * 1600.0 * std::log2(40.0));
  EXPECT_LT(2 * entries, entries_of_factor(A, natural));
}

TEST_P(EliminationOrders, IsTheSameEveryTime) {
  const SparseMatrix A = grid(30, 2);
  EXPECT_EQ(elimination_order(A, GetParam(), positions(30, 2)), elimination_order(A, GetParam(), positions(30, 2)));
}

/// The first cut of a grid of 41 x 41 is its middle column, which is eliminated last.
TEST(EliminationOrder, TheMiddleColumnOfAGridSeparatesItsHalves) {
  const auto order = elimination_order(grid(41, 1), Ordering::dissection_by_position, positions(41, 1));
  std::set<std::int64_t> columns;
  for (std::size_t k = order.size() - 41; k < order.size(); ++k) columns.insert(order[k] % 41);
  EXPECT_EQ(columns.size(), 1u);
  EXPECT_NEAR(static_cast<double>(*columns.begin()), 20.0, 1.0);
}

/// Rows of nodes, each with half as many as the one below and coupled to it, at heights that double: fine at one edge.
/// Half of all nodes of a box lie in its lowest row, which separates nothing.
TEST(EliminationOrder, AMeshThatIsFineAtAnEdgeIsCutAcrossIt) {
  constexpr int finest = 1024;
  std::vector<Vec2> places;
  std::vector<Eigen::Triplet<double>> entries;
  const auto couple = [&](std::size_t a, std::size_t b) {
    entries.emplace_back(static_cast<int>(a), static_cast<int>(b), 1.0);
    entries.emplace_back(static_cast<int>(b), static_cast<int>(a), 1.0);
  };
  std::size_t below = 0;
  for (int count = finest, step = 1; count > 1; count /= 2, step *= 2) {
    const std::size_t first = places.size();
    for (int i = 0; i < count; ++i) {
      const std::size_t at = places.size();
      places.emplace_back((i + 0.5) * step, step - 1.0);
      entries.emplace_back(static_cast<int>(at), static_cast<int>(at), 1.0);
      if (i > 0) couple(at, at - 1);
      if (first > 0)
        couple(at, below + 2 * static_cast<std::size_t>(i)), couple(at, below + 2 * static_cast<std::size_t>(i) + 1);
    }
    below = first;
  }
  const auto n = static_cast<Eigen::Index>(places.size());
  SparseMatrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  EXPECT_LT(entries_of_factor(A, elimination_order(A, Ordering::dissection_by_position, places)),
            2 * entries_of_factor(A, elimination_order(A, Ordering::minimum_degree)));
}

TEST(EliminationOrder, AllNodesInOnePlace) {
  auto order = elimination_order(grid(20, 1), Ordering::dissection_by_position, std::vector<Vec2>(400, Vec2(1, 1)));
  std::sort(order.begin(), order.end());
  for (std::size_t k = 0; k < order.size(); ++k) EXPECT_EQ(order[k], static_cast<std::int64_t>(k));
}

// A cube of nodes fills its factor so much that nested dissection pays.
TEST(EliminationOrder, DissectsWhatFillsItsFactor) {
  const int side = 16, n = side * side * side;
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < n; ++k) {
    const int x = k % side, y = k / side % side, z = k / (side * side);
    for (int dz = -1; dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int a = x + dx, b = y + dy, c = z + dz;
          if (std::min({a, b, c}) < 0 || std::max({a, b, c}) >= side) continue;
          for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
              entries.emplace_back(3 * (a + side * (b + side * c)) + row, 3 * k + column, 1.0);
        }
  }
  SparseMatrix A(3 * n, 3 * n);
  A.setFromTriplets(entries.begin(), entries.end());
  const auto order = elimination_order(A);
  EXPECT_EQ(order, elimination_order(A, Ordering::nested_dissection));
  EXPECT_NE(order, elimination_order(A, Ordering::minimum_degree));
}

volatile std::sig_atomic_t signals_taken = 0;

extern "C" void take_signal(int) { signals_taken = signals_taken + 1; }

// METIS takes SIGTERM for an error of its own, and its handler jumps out of what was being done.
TEST(EliminationOrder, IsFoundAlthoughSignalsArrive) {
  const auto before = std::signal(SIGTERM, take_signal);
  const SparseMatrix A = grid(60, 1);
  const std::vector<std::int64_t> undisturbed = elimination_order(A, Ordering::nested_dissection);
  const pthread_t here = pthread_self();
  for (int k = 0; k < 20; ++k) {
    std::jthread sender([&](const std::stop_token& over) {
      while (!over.stop_requested()) {
        pthread_kill(here, SIGTERM);
        std::this_thread::sleep_for(std::chrono::microseconds(200));
      }
    });
    EXPECT_EQ(elimination_order(A, Ordering::nested_dissection), undisturbed);
  }
  EXPECT_GT(signals_taken, 0);
  std::signal(SIGTERM, before);
}

}  // namespace
}  // namespace scabo::linalg
