// Products in twice the working precision against whole numbers, and the kernels of all instruction sets against each
// other: the same bits.
#include "scabo/linalg/twofold.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "scabo/linalg/twofold_kernel.hpp"
#include "support/random.hpp"

namespace scabo::linalg {
namespace {

using namespace test;

__extension__ typedef __int128 Whole;

double whole_number(std::mt19937& random, double most) { return std::nearbyint(uniform(random, -most, most)); }

/// Whole entries of up to 40 bits, and x of up to 50 bits with low parts of whole units of 2^-60.
struct Case {
  Matrix A;
  TwofoldVector x;
};
Case random_case(std::mt19937& random, Eigen::Index rows, Eigen::Index columns) {
  Case made{Matrix(rows, columns), {}};
  for (Eigen::Index k = 0; k < made.A.size(); ++k) made.A.data()[k] = whole_number(random, 0x1p40);
  for (Eigen::Index j = 0; j < columns; ++j)
    made.x.push_back({whole_number(random, 0x1p50), whole_number(random, 0x1p50) * 0x1p-60});
  // Nearly orthogonal rows: what is left is 2^-40 of the terms.
  for (Eigen::Index i = 0; i < rows; ++i) {
    double sum = 0.0;
    for (Eigen::Index j = 1; j < columns; ++j) sum += made.A(i, j) * made.x[static_cast<std::size_t>(j)].high;
    made.A(i, 0) = std::nearbyint(-sum / made.x[0].high);
  }
  return made;
}

TEST(Twofold, ProductsAgreeWithWholeNumbers) {
  std::mt19937 random(11);
  for (const auto& [rows, columns] : {std::pair(1, 1), std::pair(7, 5), std::pair(33, 40)}) {
    const Case given = random_case(random, rows, columns);
    const TwofoldVector dense = product(given.A, given.x),
                        sparse = product(SparseMatrix(given.A.sparseView()), given.x);
    for (Eigen::Index i = 0; i < rows; ++i) {
      Whole high = 0, low = 0;  // units of 1 and 2^-60
      double terms = 0.0;
      for (Eigen::Index j = 0; j < columns; ++j) {
        const Twofold& x = given.x[static_cast<std::size_t>(j)];
        const auto a = static_cast<Whole>(given.A(i, j));
        high += a * static_cast<Whole>(x.high);
        low += a * static_cast<Whole>(x.low * 0x1p60);
        terms += std::abs(given.A(i, j) * x.high);
      }
      for (const TwofoldVector& y : {dense, sparse}) {
        const Twofold& found = y[static_cast<std::size_t>(i)];
        const double whole_part = std::floor(found.high);
        const double rest = (static_cast<double>(high - static_cast<Whole>(whole_part)) - (found.high - whole_part)) +
                            static_cast<double>(low) * 0x1p-60;
        EXPECT_NEAR(found.low, rest, 0x1p-98 * terms) << i;
      }
    }
  }
}

TEST(Twofold, AllKernelsGiveTheSameBits) {
  std::mt19937 random(12);
  for (long rows = 1; rows < 40; ++rows) {
    const Case given = random_case(random, rows, 1);
    Vector start(rows), rest(rows);
    for (double& value : start) value = uniform(random, -1.0, 1.0);
    for (double& value : rest) value = 1e-17 * uniform(random, -1.0, 1.0);
    const Twofold x{uniform(random, -1.0, 1.0), 1e-17 * uniform(random, -1.0, 1.0)};
    Vector first_high, first_low;
    int kernels = 0;
    for (; const TwofoldKernel* kernel = twofold_kernel(kernels); ++kernels) {
      Vector high = start, low = rest;
      kernel->add_column(given.A.data(), rows, x.high, x.low, high.data(), low.data());
      if (kernels == 0) first_high = high, first_low = low;
      EXPECT_EQ(high, first_high) << kernel->instructions;
      EXPECT_EQ(low, first_low) << kernel->instructions;
    }
    EXPECT_GE(kernels, 1);
  }
}

}  // namespace
}  // namespace scabo::linalg
