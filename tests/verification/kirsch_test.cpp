// Kirsch 1898: a plate with a circular hole of radius 1 pulled along x by 1. Stress everywhere, three times the tension
// at the hole. Once as a quarter plate, closed and with exact tractions; once as the infinite plate, an unbounded
// super-element.
#include <gtest/gtest.h>

#include <numbers>

#include "scabo/geometry/line_basis.hpp"
#include "scabo/system/body_system.hpp"
#include "scabo/system/loads.hpp"
#include "support/decompositions.hpp"
#include "theory/rings.hpp"
#include "verification/stress_error.hpp"

namespace scabo::element {
namespace {

using namespace test;
using std::numbers::pi;

/// About the centre of the hole.
Vec3 kirsch(const Vec2& x) {
  const double r = x.norm(), theta = std::atan2(x.y(), x.x()), a2 = 1.0 / (r * r), a4 = a2 * a2;
  const double c2 = std::cos(2 * theta), c4 = std::cos(4 * theta), s2 = std::sin(2 * theta), s4 = std::sin(4 * theta);
  return {1 - a2 * (1.5 * c2 + c4) + 1.5 * a4 * c4, -a2 * (0.5 * c2 - c4) - 1.5 * a4 * c4,
          -a2 * (0.5 * s2 + s4) + 1.5 * a4 * s4};
}

/// A chain of `n` elements along a curve, t from 0 to 1; the last node is the next chain's first.
void add_curve(Ring& ring, int n, int order, const std::function<Vec2(double)>& curve) {
  const auto points = geometry::lobatto_points(order);
  for (int part = 0; part < n; ++part) {
    mesh::LineElement element;
    for (int k = 0; k <= order; ++k) element.nodes.push_back(static_cast<int>(ring.nodes.size()) + k);
    for (int k = 0; k < order; ++k)
      ring.nodes.push_back(curve((part + 0.5 * (points[static_cast<std::size_t>(k)] + 1)) / n));
    ring.elements.push_back(element);
  }
  ring.elements.back().nodes.back() = 0;
}

const Vec2 centre(2.3, 2.3);

/// 4 x 4 about the hole's quarter, seen from (2.3, 2.3).
Ring quarter(int n, int order) {
  Ring ring;
  const std::vector<Vec2> corners = {{1, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 1}};
  for (std::size_t i = 0; i < 4; ++i) {
    add_curve(ring, n, order, [&](double t) { return Vec2(corners[i] + t * (corners[i + 1] - corners[i]) - centre); });
    ring.elements.back().nodes.back() = static_cast<int>(ring.nodes.size());
  }
  add_curve(ring, n, order,
            [&](double t) { return Vec2(Vec2(std::cos(0.5 * pi * (1 - t)), std::sin(0.5 * pi * (1 - t))) - centre); });
  return ring;
}

Vector solve(const Ring& ring, const Matrix& K, const Vector& f) {
  std::vector<system::Constraint> constraints(3);  // (1, 0): both; a node far from it on the line y = 0: y
  int far = 0;
  for (std::size_t i = 0; i < ring.nodes.size(); ++i)
    if (std::abs(ring.nodes[i].y() - ring.nodes[0].y()) < 1e-12 &&
        std::abs(ring.nodes[i].x() - ring.nodes[0].x()) >
            std::abs(ring.nodes[static_cast<std::size_t>(far)].x() - ring.nodes[0].x()))
      far = static_cast<int>(i);
  constraints[0].dof = 0, constraints[1].dof = 1, constraints[2].dof = 2 * far + 1;
  system::Stiffness stiffness;
  stiffness.dense = std::make_shared<const Matrix>(K);
  return system::elastic_body(stiffness, ring.nodes, constraints)->displacement(f, Eigen::Vector3d::Zero());
}

TEST(Kirsch, StressOfAQuarterPlateConvergesToTheClosedForm) {
  const Mat3 D = elasticity(1.0, 0.3);
  const auto stress = [](const Vec2& x) { return kirsch(x + centre); };
  for (const int order : {2, 4}) {
    double before = 0.0;
    for (const int n : {12, 24}) {
      const Ring ring = quarter(n, order);
      const auto solution = solve_super_element(ring, D, 1.0);
      const auto modal = modal_solution(solution);
      const Vector f = system::traction_forces(ring.elements, ring.nodes, 1.0, [&](const Vec2& x, const Vec2& normal) {
        return traction_of(stress(x), normal);
      });
      const double error = stress_error(ring, RadialField(solution, modal, solve(ring, solution.K, f)), D, stress);
      std::cout << "quarter, order " << order << ", " << n << " elements a side: " << error << "\n";
      if (before > 0.0) {
        EXPECT_NEAR(std::log2(before / error), order, 0.3);
      }
      before = error;
    }
    EXPECT_LT(before, order == 2 ? 6e-4 : 2e-6);
  }
}

TEST(Kirsch, StressAtTheHoleOfAQuarterPlateIsThreeTimesTheTension) {
  const Mat3 D = elasticity(1.0, 0.3);
  const Ring ring = quarter(4, 10);
  const auto solution = solve_super_element(ring, D, 1.0);
  const auto modal = modal_solution(solution);
  const auto stress = [](const Vec2& x) { return kirsch(x + centre); };
  const Vector f = system::traction_forces(ring.elements, ring.nodes, 1.0, [&](const Vec2& x, const Vec2& normal) {
    return traction_of(stress(x), normal);
  });
  const Vector u = solve(ring, solution.K, f);
  const int arc = 16;  // the first element of the arc begins at (0, 1)
  const PointValues top = point_values(ring, RadialField(solution, modal, u).at(1.0), D, arc, -1.0);
  std::cout << "stress at the hole: " << top.stress[0] << "\n";
  EXPECT_NEAR(top.stress[0], 3.0, 1e-3);
  EXPECT_NEAR(top.stress[1], 0.0, 1e-3);
}

// Far away the plate is pulled by [1, 0, 0]; what the hole adds is the field of the tractions that take
// [1, 0, 0] off it, and decays. Normals point from the hole into the body.
TEST(Kirsch, StressAroundTheHoleOfAnInfinitePlate) {
  const Mat3 D = elasticity(1.0, 0.3);
  Ring ring;
  add_curve(ring, 8, 10, [](double t) { return Vec2(std::cos(2 * pi * t), std::sin(2 * pi * t)); });
  const auto solution = solve_super_element(ring, D, 1.0, 1, {true});
  const auto modal = modal_solution(solution);
  const Vector f = system::traction_forces(ring.elements, ring.nodes, 1.0, [](const Vec2&, const Vec2& normal) {
    return traction_of(Vec3(1, 0, 0), normal);
  });
  const Vector u = solve_ldlt(solution.K, f);  // the plane far away holds the rotation too
  const RadialField field(solution, modal, u);
  double worst = 0.0;
  for (const double xi : {1.0, 1.2, 2.0, 5.0, 20.0})
    for (int e = 0; e < 8; ++e)
      for (const double eta : {-1.0, -0.4, 0.3}) {
        const Vec3 found = Vec3(1, 0, 0) + point_values(ring, field.at(xi), D, e, eta).stress;
        worst = std::max(worst, (found - kirsch(xi * boundary_position(ring, e, eta))).cwiseAbs().maxCoeff());
      }
  std::cout << "infinite plate: worst error of the stress " << worst << "\n";
  EXPECT_LT(worst, 1e-6);
  const Vec3 top = Vec3(1, 0, 0) + point_values(ring, field.at(1.0), D, 2, -1.0).stress;  // at (0, 1)
  EXPECT_NEAR(top[0], 3.0, 1e-7);
}

}  // namespace
}  // namespace scabo::element
