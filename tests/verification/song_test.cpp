// Song, The Scaled Boundary Finite Element Method, 2018: exponents, stiffness and mass of two super-elements.
#include <gtest/gtest.h>

#include "scabo/element/facet/mass.hpp"
#include "scabo/element/plane/stiffness.hpp"
#include "theory/rings.hpp"

namespace scabo::element {
namespace {

using namespace test;
using std::numbers::pi;

std::vector<double> real_exponents(const SuperElementSolution& solution) {
  std::vector<double> values;
  for (const auto& exponent : modal_solution(solution).exponents) {
    EXPECT_LT(std::abs(exponent.imag()), 1e-6);  // equal ones may come out as a pair a rounding error apart
    values.push_back(exponent.real());
  }
  return values;
}

// Song, The Scaled Boundary Finite Element Method, 2018, example 3.1.
TEST(PublishedSuperElement, SquareOfSongsExample) {
  const auto solution = solve_super_element(polygon_ring(rectangle(2, 2), 1, 1), elasticity(10, 0), 1.0);
  EXPECT_NEAR(solution.K(0, 0), 4.89357, 5e-6);
  const std::vector<double> exponents = real_exponents(solution);
  const std::vector<double> expected = {0, 0, 1, 1, 1, 1, 1.91485, 1.91485};
  ASSERT_EQ(exponents.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(exponents[i], expected[i], i < 6 ? 1e-12 : 5e-6);
}

TEST(PublishedSuperElement, MassOfTheSquareOfSongsExample) {
  const Ring ring = polygon_ring(rectangle(2, 2), 1, 1);
  const auto solution = solve_super_element(ring, elasticity(10, 0), 1.0);
  EXPECT_NEAR(mass_matrix(ring, solution, modal_solution(solution), {2.0}, 1.0)(0, 0), 0.89538, 5e-6);
}

// Song 2018, example 3.2: a regular pentagon in the unit circle, standing on an edge.
TEST(PublishedSuperElement, PentagonOfSongsExample) {
  const auto solution =
      solve_super_element(polygon_ring(regular_polygon(5, 1.0, -0.7 * pi), 1, 1), elasticity(10, 0), 1.0);
  EXPECT_NEAR(solution.K(0, 0), 4.888726, 5e-7);
  const std::vector<double> exponents = real_exponents(solution);
  ASSERT_EQ(exponents.size(), 10u);
  const std::vector<double> expected = {0, 0, 1, 1, 1, 1, 2.173094, 2.173094, 2.192227, 2.192227};
  for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(exponents[i], expected[i], i < 6 ? 1e-12 : 5e-7);
}

}  // namespace
}  // namespace scabo::element
