// Many small super-elements at once give what each gives alone.
#include "scabo/element/plane/batch.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "scabo/element/plane/batch_kernel.hpp"
#include "scabo/element/plane/stiffness.hpp"
#include "theory/rings.hpp"

namespace scabo::element {
namespace {

using namespace test;

/// A random star with `edges` edges.
std::vector<Vec2> star(std::mt19937& random, int edges) {
  std::vector<Vec2> vertices;
  const double size = std::pow(10.0, uniform(random, -3.0, 3.0));
  for (int i = 0; i < edges; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + uniform(random, -0.2, 0.2)) / edges;
    const double radius = size * uniform(random, 0.8, 1.0);
    vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return vertices;
}

BatchItem random_item(std::mt19937& random, int edges, int order) {
  return {polygon_ring(star(random, edges), 1, order), random_elasticity(random), uniform(random, 0.1, 2.0)};
}

/// Largest relative difference of those that were solved from solve_super_element.
double error_of(const std::vector<BatchItem>& items, const BatchSolution& solution) {
  double worst = 0.0;
  EXPECT_EQ(solution.K.size(), items.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (std::binary_search(solution.alone.begin(), solution.alone.end(), static_cast<int>(i))) {
      EXPECT_EQ(solution.K[i].size(), 0);
      continue;
    }
    const auto [K, blocks, domain, doublings, residual, rounding] =
        solve_super_element(items[i].ring, items[i].D, items[i].thickness);
    EXPECT_EQ(solution.K[i].rows(), K.rows());
    // Of all rows here, of the largest symmetry block there.
    EXPECT_NEAR(solution.rounding[i] / rounding, 1.0, 1e-6) << "item " << i;
    const double error = largest(solution.K[i] - K) / largest(K);
    EXPECT_LT(error, 1e-13) << "item " << i << ", " << K.rows() << " degrees of freedom";
    EXPECT_EQ(solution.K[i], Matrix(solution.K[i].transpose()));
    worst = std::max(worst, error);
  }
  return worst;
}

/// Every instruction set that this machine has.
class Batch : public testing::TestWithParam<const BatchKernel*> {
 protected:
  BatchOptions options() const {
    BatchOptions options;
    options.kernel = GetParam();
    return options;
  }
};

std::vector<const BatchKernel*> kernels() {
  std::vector<const BatchKernel*> all;
  for (int rank = 0; batch_kernel(rank); ++rank) all.push_back(batch_kernel(rank));
  return all;
}

// 3 to 32 nodes, every edge order that divides them, one to seventeen items of each: full and part-filled registers.
TEST_P(Batch, GivesEveryStiffnessOfSixToSixtyFourDegreesOfFreedom) {
  std::mt19937 random(5);
  std::vector<BatchItem> items;
  for (int nodes = 3; nodes <= 32; ++nodes)
    for (int order = 1; order <= 8; ++order) {
      if (nodes % order != 0 || nodes / order < 3) continue;
      for (int count = whole(random, 1, 17); count > 0; --count)
        items.push_back(random_item(random, nodes / order, order));
    }
  const BatchSolution solution = solve_batch(items, options());
  EXPECT_TRUE(solution.alone.empty());
  RecordProperty("error", testing::PrintToString(error_of(items, solution)));
}

TEST_P(Batch, TakesMixedShapesInAnyOrder) {
  std::mt19937 random(6);
  std::vector<BatchItem> items;
  for (int i = 0; i < 300; ++i) items.push_back(random_item(random, whole(random, 3, 9), whole(random, 1, 3)));
  const BatchSolution solution = solve_batch(items, options());
  EXPECT_TRUE(solution.alone.empty());
  error_of(items, solution);
}

TEST_P(Batch, GivesTheSameOnSeveralThreads) {
  std::mt19937 random(7);
  std::vector<BatchItem> items;
  for (int i = 0; i < 1500; ++i) items.push_back(random_item(random, whole(random, 3, 8), 1));
  BatchOptions threads = options();
  threads.threads = 4;
  const BatchSolution one = solve_batch(items, options()), four = solve_batch(items, threads);
  for (std::size_t i = 0; i < items.size(); ++i) EXPECT_EQ(one.K[i], four.K[i]);
}

TEST_P(Batch, TakesAMaterialForEachEdge) {
  std::mt19937 random(8);
  std::vector<BatchItem> items;
  for (int i = 0; i < 50; ++i) {
    BatchItem item = random_item(random, 8, 1 + i % 2);
    std::vector<Mat3> D;
    for (int e = 0; e < 8; ++e) D.push_back(std::pow(10.0, uniform(random, -1.5, 1.5)) * elasticity(1.0, 0.3));
    item.D = D;
    items.push_back(item);
  }
  const BatchSolution solution = solve_batch(items, options());
  EXPECT_TRUE(solution.alone.empty());
  error_of(items, solution);
}

// A crack from the centre to a doubled node.
TEST_P(Batch, TakesOpenSuperElements) {
  std::mt19937 random(9);
  std::vector<BatchItem> items;
  for (int i = 0; i < 20; ++i) {
    BatchItem item = random_item(random, 8, 2);
    item.ring.elements.back().nodes.back() = static_cast<int>(item.ring.nodes.size());
    item.ring.nodes.push_back(item.ring.nodes.front());
    items.push_back(item);
  }
  const BatchSolution solution = solve_batch(items, options());
  EXPECT_TRUE(solution.alone.empty());
  error_of(items, solution);
}

TEST_P(Batch, LeavesWhatDoesNotFitToTheSolverOfOne) {
  std::mt19937 random(10);
  std::vector<BatchItem> items;
  for (int i = 0; i < 9; ++i) items.push_back(random_item(random, 5, 1));
  items.push_back(random_item(random, 33, 1));  // 66 degrees of freedom
  items.push_back(random_item(random, 12, 4));
  items.push_back(random_item(random, 5, 1));  // one sector far softer than the others
  std::vector<Mat3> D(5, elasticity(1.0, 0.3));
  D[2] *= 1e-5;
  items.back().D = D;
  const BatchSolution solution = solve_batch(items, options());
  EXPECT_EQ(solution.alone, (std::vector<int>{9, 10, 11}));
  error_of(items, solution);
  BatchOptions strict = options();  // rounding is too much: all are left
  strict.largest_residual = 0.0;
  const BatchSolution exact = solve_batch(items, strict);
  EXPECT_GE(exact.alone.size(), 9U);
  error_of(items, exact);
}

TEST_P(Batch, LeavesWhatCannotBeSolved) {
  std::mt19937 random(11);
  std::vector<BatchItem> items;
  for (int i = 0; i < 9; ++i) items.push_back(random_item(random, 5, 1));
  std::vector<BatchItem> hidden = items, empty = items, nothing = items;
  for (Vec2& node : hidden[4].ring.nodes) node += 10.0 * items[4].ring.nodes[0];  // the centre lies outside
  EXPECT_EQ(solve_batch(hidden, options()).alone, std::vector<int>{4});
  empty[4].D = Mat3(Mat3::Zero());
  EXPECT_EQ(solve_batch(empty, options()).alone, std::vector<int>{4});
  nothing[4].ring.nodes[2] = nothing[4].ring.nodes[1];
  EXPECT_EQ(solve_batch(nothing, options()).alone, std::vector<int>{4});
}

TEST_P(Batch, OfNothingIsNothing) { EXPECT_TRUE(solve_batch({}, options()).K.empty()); }

INSTANTIATE_TEST_SUITE_P(Kernels, Batch, testing::ValuesIn(kernels()), [](const auto& info) {
  std::string name = info.param->instructions;
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace scabo::element
