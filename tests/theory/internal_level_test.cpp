// One internal level: fields phi(xi) w inside, against the dense exponential and quadrature over xi.
#include "scabo/element/sbfem/internal_level.hpp"

#include <gtest/gtest.h>

#include "scabo/element/facet/mass.hpp"
#include "scabo/element/plane/stiffness.hpp"
#include "scabo/geometry/line_basis.hpp"
#include "support/decompositions.hpp"
#include "theory/rings.hpp"

namespace scabo::element {
namespace {

using namespace test;

struct LevelCase {
  const char* name;
  Ring ring;
  std::vector<double> density;
};

/// A square with a crack from its left side to its centre.
Ring square_with_a_crack(int order) {
  const Ring closed = polygon_ring({{-1, 0}, {-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, 1, order);
  Ring ring;
  ring.nodes = closed.nodes;
  ring.elements = closed.elements;
  ring.elements.back().nodes.back() = static_cast<int>(ring.nodes.size());
  ring.nodes.push_back(ring.nodes.front());
  return ring;
}

std::vector<LevelCase> level_cases() {
  const std::vector<Vec2> skew = {{-0.7, -0.9}, {1.1, -0.6}, {1.4, 0.2}, {0.3, 0.4}, {-0.2, 1.3}, {-1.0, 0.1}};
  const Ring rectangle = rectangle_ring(3, 1, 2, 1, 2);
  std::vector<double> different;
  for (std::size_t e = 0; e < rectangle.elements.size(); ++e) different.push_back(1.0 + static_cast<double>(e % 3));
  return {{"no symmetry", polygon_ring(skew, 1, 2), {2.0}},
          {"four blocks", rectangle, {1.0}},
          {"four blocks that densities couple", rectangle, different},
          {"four blocks in one", unsplit(rectangle), {1.0}},
          {"crack", square_with_a_crack(2), {3.0}}};
}

struct SolvedLevel {
  explicit SolvedLevel(const LevelCase& c)
      : ring(c.ring),
        solution(solve_super_element(ring, D, 1.0)),
        modal(modal_solution(solution)),
        M(mass_matrix(ring, solution, modal, c.density, 1.0)),
        M0(boundary_mass(ring, c.density, 1.0)),
        coupled(!is_uniform(c.density)),
        level(internal_level(M, solution, modal, coupled)) {}
  /// [xi^S; phi(xi)], by the dense exponential of eq. (2) and its right-hand side, with the whole S = E0^-1 (K - E1').
  std::pair<Matrix, Matrix> fields(double xi) const {
    const CoefficientMatrices matrices = coefficient_matrices(ring, D, 1.0);
    const Matrix S = solve_cholesky(Matrix(matrices.E0), solution.K - Matrix(matrices.E1).transpose());
    const Eigen::Index n = S.rows();
    Matrix all = Matrix::Zero(2 * n, 2 * n);
    all << S, -solve_cholesky(Matrix(matrices.E0), M), Matrix::Zero(n, n), S + 2.0 * Matrix::Identity(n, n);
    const Matrix power = exponential(all * std::log(xi));
    return {power.topLeftCorner(n, n), power.topRightCorner(n, n)};
  }

  const Mat3 D = elasticity(10.0, 0.3);
  Ring ring;
  SuperElementSolution solution;
  ModalSolution modal;
  Matrix M, M0;
  bool coupled;
  InternalLevel level;
};

TEST(InternalLevel, IsTheMassOfItsFieldsByQuadrature) {
  for (const LevelCase& c : level_cases()) {
    const SolvedLevel solved(c);
    const Eigen::Index n = solved.M.rows();
    Matrix Z = Matrix::Zero(n, n), Q = Z;
    const geometry::GaussRule rule = geometry::gauss_rule(100);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double t = 0.5 * (1.0 + rule.points[q]), xi = t * t * t * t;
      const auto [follows, deflects] = solved.fields(xi);
      const double weight = 0.5 * rule.weights[q] * 4.0 * t * t * t * xi;
      Z += weight * follows.transpose() * solved.M0 * deflects;
      Q += weight * deflects.transpose() * solved.M0 * deflects;
    }
    EXPECT_LT(largest(solved.level.Z - Z), 1e-11 * largest(Z)) << c.name;
    EXPECT_LT(largest(solved.level.Q - Q), 1e-11 * largest(Q)) << c.name;
  }
}

TEST(InternalLevel, HasPositiveMassAndStiffness) {
  for (const LevelCase& c : level_cases()) {
    const SolvedLevel solved(c);
    const Eigen::Index n = solved.M.rows();
    EXPECT_GT(symmetric_eigenvalues(solved.level.Z).minCoeff(), 0.0) << c.name;
    // In coordinates of w of the size of the displacements.
    const Vector scale = (solved.M.diagonal().array() / solved.level.Q.diagonal().array()).sqrt();
    Matrix mass(2 * n, 2 * n);
    const Matrix coupling = -solved.level.Z * scale.asDiagonal();
    mass << solved.M, coupling, coupling.transpose(), Matrix(scale.asDiagonal() * solved.level.Q * scale.asDiagonal());
    const Vector values = symmetric_eigenvalues(mass);
    EXPECT_GT(values.minCoeff(), 1e-8 * values.maxCoeff()) << c.name;
  }
}

TEST(InternalLevel, MovesTheInsideAsTheDenseExponentialSays) {
  for (const LevelCase& c : level_cases()) {
    const SolvedLevel solved(c);
    const Eigen::Index n = solved.M.rows();
    const Vector u = Vector::LinSpaced(n, 1.0, -0.5), w = (Vector::LinSpaced(n, 0.0, 9.0).array().sin()).matrix();
    const auto modes =
        std::make_shared<const InternalModes>(internal_modes(solved.M, solved.solution, solved.modal, solved.coupled));
    const RadialField field(solved.solution, solved.modal, u, {}, {modes, w});
    double size = 0.0, error = 0.0, error_of_slope = 0.0;
    for (const double xi : {1.0, 0.9, 0.5, 0.1}) {
      const auto value = [&](double at) {
        const auto [follows, deflects] = solved.fields(at);
        return Vector(follows * u - deflects * w);
      };
      const double step = 1e-5;
      const Vector slope = (value(xi * (1.0 + step)) - value(xi * (1.0 - step))) / (2.0 * step * xi);
      size = std::max(size, (solved.fields(xi).second * w).lpNorm<Eigen::Infinity>());
      error = std::max(error, (field.at(xi).u - value(xi)).lpNorm<Eigen::Infinity>());
      error_of_slope = std::max(error_of_slope, (field.at(xi).u_xi - slope).lpNorm<Eigen::Infinity>());
    }
    EXPECT_LT(error, 1e-11 * size) << c.name;
    EXPECT_LT(error_of_slope, 1e-6 * size) << c.name;
  }
}

}  // namespace
}  // namespace scabo::element
