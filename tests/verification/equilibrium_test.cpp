// The certificate's figure of equilibrium against the residual that displacements and stiffness really leave, computed
// in long double: rounding is there in every solution, and a figure of 0 would be none.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "run.hpp"

namespace scabo::verification {
namespace {

/// Largest of |K u - f| on the degrees of freedom right of the support (x > 0) over the largest force at work, for a
/// force of 1 downwards at `tip`.
double residual_of_cantilever(const analysis::StaticSolution& solution, const Vec2& tip) {
  using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  const Matrix& K = solution.cells[0][0]->K();
  const std::vector<Vec2>& nodes = solution.mesh.bodies[0].nodes;
  LongVector u = last(solution).fields.displacements[0].cast<long double>();
  // K of a translation is 0 but for the rounding of K itself, which is no imbalance: about the mean.
  auto by_node = u.reshaped(2, u.size() / 2);
  const Eigen::Matrix<long double, 2, 1> mean = by_node.rowwise().mean();
  by_node.colwise() -= mean;
  LongVector remaining = LongVector::Zero(u.size());
  for (Eigen::Index j = 0; j < u.size(); ++j)
    for (Eigen::Index i = 0; i < u.size(); ++i) remaining[i] += static_cast<long double>(K(i, j)) * u[j];
  long double residual = 0.0L, largest = 1.0L;
  for (std::size_t node = 0; node < nodes.size(); ++node)
    for (Eigen::Index c = 0; c < 2; ++c) {
      long double force = remaining[2 * static_cast<Eigen::Index>(node) + c];
      if (nodes[node].x() == 0.0) {
        largest = std::max(largest, std::abs(force));  // a reaction
        continue;
      }
      if (c == 1 && (nodes[node] - tip).norm() < 1e-9) force += 1.0L;
      residual = std::max(residual, std::abs(force));
    }
  return static_cast<double>(residual / largest);
}

TEST(CertificateOfARun, TellsTheImbalanceOfTheNodes) {
  for (const double length : {4.0, 10.0}) {
    const auto solution = run(R"(
scabo: 1
materials: {m: {young: 1e9, poisson: 0.3}}
bodies: {beam: {material: m, shape: {rectangle: {corner: [0, 0], size: [4, 1]}}, mesh: {size: 0.25}}}
supports: [{on: beam.left, fix: [x, y]}]
loads: {tip: {on: beam.top_right, force: [0, -1]}}
)",
                              {"bodies.beam.shape.rectangle.size=[" + std::to_string(length) + ", 1]"});
    const double residual = residual_of_cantilever(solution, {length, 1.0}),
                 figure = last(solution).certificate.equilibrium;
    std::cout << length << ": residual " << residual << ", certificate " << figure << "\n";
    EXPECT_GT(residual, 0.0);
    // Both are sums of rounding errors. Slender bodies are solved in twice the working precision: the figure is that of
    // the displacements before they are rounded to double, far below the residual of the rounded ones, and still not 0.
    EXPECT_GT(figure, length < 5.0 ? 0.1 * residual : 0.0) << length;
    EXPECT_LT(figure, 10.0 * residual) << length;
  }
}

/// Bodies of more than 20,000 degrees of freedom, a cantilever and a block on another: rounding the displacements alone
/// leaves up to 4e-12 of the largest force at a node, and 2e-11 of all forces as a moment. In twice the working
/// precision what is left is rounding of the contact forces, 3e-13.
TEST(CertificateOfARun, OfALargeBodyIsAsSmallAsTheToleranceAsks) {
  const std::string materials = "scabo: 1\nmaterials: {steel: {young: 210e9, poisson: 0.3}}\n";
  const std::string models[] = {materials + R"(
bodies:
  beam: {material: steel, shape: {rectangle: {corner: [0, 0], size: [6, 1]}}, mesh: {kind: fem, order: 2, size: 0.04}}
supports: [{on: beam.left, fix: [x, y]}]
loads: {push: {on: beam.top, pressure: 1e6}}
)",
                                materials + R"(
bodies:
  lower: {material: steel, shape: {rectangle: {corner: [0, -1], size: [3, 1]}},
          mesh: {kind: fem, order: 2, size: 0.024}}
  upper: {material: steel, shape: {rectangle: {corner: [0.5, 0], size: [2, 1]}},
          mesh: {kind: fem, order: 2, size: 0.024}}
supports: [{on: lower.bottom, fix: [x, y]}]
loads: {down: {on: upper.top, pressure: 100e6}, push: {on: upper.left, traction: [1e6, 0]}}
contacts: {joint: {between: [lower.top, upper.bottom], friction: 0.5}}
)"};
  for (const std::string& model : models) {
    Vector plain;
    for (const double tolerance : {1e-10, 1e-11, 1e-12}) {
      std::ostringstream setting;
      setting << "solver.tolerance=" << tolerance;
      const auto solution = run(model, {setting.str()});
      const analysis::IncrementResult& increment = last(solution);
      EXPECT_LE(increment.certificate.worst(), tolerance);
      EXPECT_LE(increment.certificate.equilibrium, std::max(0.1 * tolerance, 3e-13));
      const Vector& u = increment.fields.displacements[0];
      ASSERT_GT(u.size(), 20000);
      if (plain.size() == 0) plain = u;
      EXPECT_LT((u - plain).lpNorm<Eigen::Infinity>(), 1e-10 * u.lpNorm<Eigen::Infinity>()) << tolerance;
    }
  }
}

/// Weight is many small forces. What rounding leaves of the balance between weight and contact forces must not be found
/// at one of the nodes that hold the floating body in its equations.
TEST(CertificateOfARun, OfAHeavyBodyDoesNotGrowWithItsNodes) {
  const auto solution = run(R"(
scabo: 1
materials: {stone: {young: 20e9, poisson: 0.2, density: 2300}}
bodies:
  ground: {material: stone, shape: {rectangle: {corner: [-1, -1], size: [42, 1]}},
           mesh: {kind: quadtree, size: 0.25, order: 1}}
  wall: {material: stone, shape: {rectangle: {corner: [0, 0], size: [40, 12]}},
         mesh: {kind: quadtree, size: 0.125, order: 1}}
supports: [{on: ground.bottom, fix: [x, y]}]
loads: {weight: {gravity: [0.981, -9.81]}}
contacts: {joint: {between: [ground.top, wall.bottom], friction: 0.6}}
)");
  const analysis::IncrementResult& increment = last(solution);
  EXPECT_LE(increment.certificate.equilibrium, 1e-13);  // 6.9e-12 with sums in working precision
  EXPECT_LE(increment.certificate.rigid_balance, 1e-12);
}

}  // namespace
}  // namespace scabo::verification
