// Mass matrix of a body with curved edges that elements of order 2 follow exactly.
#include "scabo/element/facet/mass.hpp"
#include "scabo/element/plane/stiffness.hpp"

#include <gtest/gtest.h>

#include "theory/rings.hpp"

namespace scabo::element {
namespace {

/// The lens |y| <= h (1 - x^2): one parabola below, one above, each an element with its middle node at the crest.
Ring lens(double h) {
  Ring ring;
  ring.nodes = {{-1, 0}, {0, -h}, {1, 0}, {0, h}};
  ring.elements.resize(2);
  ring.elements[0].nodes = {0, 1, 2};
  ring.elements[1].nodes = {2, 3, 0};
  return ring;
}

// int 1 = 8 h / 3, int x^2 = 8 h / 15, int y^2 = 64 h^3 / 105, int x y = 0. On these elements positions, and with them
// linear velocities v = A x, are exact, |J| is of degree 3 - 1 and N'N |J| of degree 6: what the quadrature has to
// meet.
TEST(MassOfCurvedEdges, OfLinearVelocitiesIsExact) {
  const double rho = 3.0, thickness = 0.5;
  for (const double h : {0.4, 1.0}) {
    const Ring ring = lens(h);
    const SuperElementSolution solution = solve_super_element(ring, test::elasticity(7.0, 0.25), thickness);
    const Matrix M = mass_matrix(ring, solution, modal_solution(solution), {rho}, thickness);
    Mat2 moments = Mat2::Zero();
    moments.diagonal() << 8.0 * h / 15.0, 64.0 * h * h * h / 105.0;
    const auto energy = [&](const Vec2& v, const Mat2& A) {  // twice the kinetic energy of v + A x
      const Vector u = test::at_nodes(ring.nodes, [&](const Vec2& x) { return Vec2(v + A * x); });
      return u.dot(M * u);
    };
    const double mass = rho * thickness * 8.0 * h / 3.0;
    EXPECT_NEAR(energy({1, 0}, Mat2::Zero()), mass, 1e-13 * mass);
    EXPECT_NEAR(energy({0, 1}, Mat2::Zero()), mass, 1e-13 * mass);
    for (const Mat2& A : {(Mat2() << 1, 0, 0, 0).finished(), (Mat2() << 0, 1, 0, 0).finished(),
                          (Mat2() << 0, -1, 1, 0).finished(), (Mat2() << 0.3, -1.2, 0.7, 0.4).finished()}) {
      const double exact = rho * thickness * (A * moments * A.transpose()).trace();
      EXPECT_NEAR(energy(Vec2::Zero(), A), exact, 1e-12 * exact) << A;
    }
  }
}

}  // namespace
}  // namespace scabo::element
