// Stiffness of slender super-elements against the same theory in 64-bit significands, solved by another method.
#include <gtest/gtest.h>

#include "scabo/element/plane/stiffness.hpp"
#include "scabo/element/sbfem/modal_solution.hpp"
#include "support/decompositions.hpp"
#include "theory/long_double_route.hpp"
#include "theory/rings.hpp"

namespace scabo::element {
namespace {

using namespace test;

const Mat3 concrete = elasticity(10e9, 0.3);

// Bending of a body of length L and depth h is (h / L)^3 of the entries of K, and (h / L)^2 more of those of E2: where
// it is slender K must be right to its last digits. In double precision the error is 2.6e-12.
TEST(ExactStiffness, SlenderRectangleHasAllDigits) {
  for (const Ring& ring : {rectangle_ring(1000.0, 1.0, 20, 1, 3), rectangle_ring(1.0, 1000.0, 1, 20, 3),
                           unsplit(rectangle_ring(1000.0, 1.0, 20, 1, 3))}) {
    const SuperElementSolution solution = solve_super_element(ring, concrete, 1.0);
    const oracle::Dense exact = oracle::stiffness(ring, concrete, 1.0);
    const Vector scale = solution.K.diagonal().cwiseSqrt().cwiseInverse();
    const Matrix error =
        scale.asDiagonal() * (solution.K.cast<oracle::Real>() - exact).cast<double>() * scale.asDiagonal();
    EXPECT_LT(test::largest(error), 1e-13);
    EXPECT_LT(solution.rounding, 1e-15);
  }
}

}  // namespace
}  // namespace scabo::element
