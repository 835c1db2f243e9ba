// The certificate's figure of equilibrium against the residual that displacements and stiffness really leave, computed
// in long double: rounding is there in every solution, and a figure of 0 would be none.
#include <algorithm>
#include <cmath>

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

}  // namespace
}  // namespace scabo::verification
