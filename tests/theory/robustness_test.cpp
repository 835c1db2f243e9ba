// Ten thousand random super-elements, from good ones to what no mesh generator should make, and ill-posed ones: what must hold
// exactly holds, and what has no solution says so. docs/methods/18_robustness.md has the worst figures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "scabo/element/batch.hpp"
#include "scabo/element/ill_posed.hpp"
#include "scabo/element/modal_solution.hpp"
#include "scabo/linalg/dense.hpp"
#include "theory/random_super_elements.hpp"

namespace scabo::element {
namespace {

using namespace test;

/// Worst figure met, and where.
struct Worst {
  double value = 0.0;
  int sample = -1;
  void raise(double other, int at) {
    if (!(other <= value)) value = other, sample = at;  // what is not a number is the worst
  }
};

/// max_i |K r|_i / sum_j |K_ij| |r_j|: every row against itself, so that soft sectors count as stiff ones do.
double relative_force(const Matrix& K, const Vector& r) {
  const Vector force = K * r, size = K.cwiseAbs() * r.cwiseAbs();
  return force.cwiseAbs().cwiseQuotient(size.cwiseMax(std::numeric_limits<double>::min())).maxCoeff();
}

/// |(K - E1) E0^-1 (K - E1') - E2| / |E2|, rows and columns divided by the root of the diagonal of E2.
double riccati_residual(const CoefficientMatrices& matrices, const Matrix& K) {
  Matrix L = matrices.E0, X = K - Matrix(matrices.E1.transpose());
  const Matrix E2 = matrices.E2;
  if (!linalg::cholesky_in_place(L)) return std::numeric_limits<double>::infinity();
  linalg::solve_lower_in_place(L, X);
  const Vector scale = E2.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix residual = linalg::multiply_transposed(X, X) - E2;
  return (scale.asDiagonal() * residual * scale.asDiagonal()).norm() / (scale.asDiagonal() * E2 * scale.asDiagonal()).norm();
}

/// Linear displacements that are a solution: any for a closed ring, uniaxial stress along a crack.
Mat2 exact_gradient(std::mt19937& random, const Sample& sample) {
  Mat2 gradient;
  if (!sample.ring.is_open()) {
    for (double& entry : gradient.reshaped()) entry = uniform(random, -1.0, 1.0);
    return gradient;
  }
  const Vec2 t = sample.ring.nodes.front().normalized();
  const Vec3 strain = sample.D[0].inverse() * Vec3(t.x() * t.x(), t.y() * t.y(), t.x() * t.y()) * sample.D[0].trace();
  gradient << strain[0], 0.5 * strain[2], 0.5 * strain[2], strain[1];
  return gradient;
}

TEST(Robustness, TenThousandRandomSuperElements) {
  std::mt19937 random(2024);
  Worst asymmetry, translation, rotation, patch, riccati, fewest;
  int cracked = 0, largest_size = 0;
  for (int k = 0; k < 10000; ++k) {
    SCOPED_TRACE("sample " + std::to_string(k));
    const int most = k % 1000 == 0 ? 640 : static_cast<int>(std::pow(2.0, uniform(random, 4.0, 7.5)));
    const Sample sample = random_sample(random, most);
    const auto solution = solve_super_element(sample.ring, sample.D, sample.thickness);
    const Matrix& K = solution.K;
    const CoefficientMatrices matrices = coefficient_matrices(sample.ring, sample.D, sample.thickness);
    cracked += sample.ring.is_open() ? 1 : 0;
    largest_size = std::max(largest_size, static_cast<int>(K.rows()));

    asymmetry.raise(largest(K - K.transpose()) / largest(K), k);
    translation.raise(relative_force(K, at_nodes(sample.ring.nodes, [](const Vec2&) { return Vec2(1, 0); })), k);
    translation.raise(relative_force(K, at_nodes(sample.ring.nodes, [](const Vec2&) { return Vec2(0, 1); })), k);
    rotation.raise(relative_force(K, at_nodes(sample.ring.nodes, [](const Vec2& x) { return Vec2(-x.y(), x.x()); })), k);
    riccati.raise(riccati_residual(matrices, K), k);
    if (sample.uniform_material()) {
      const Mat2 gradient = exact_gradient(random, sample);
      const Vector u = at_nodes(sample.ring.nodes, [&](const Vec2& x) { return Vec2(gradient * x); });
      const Vector q = matrices.E0 * u + matrices.E1.transpose() * u;  // xi u,xi = u
      patch.raise((K * u - q).norm() / (K.norm() * u.norm()), k);
    }
    // Exponents: zero exactly twice, all others in the right half plane.
    std::size_t zeros = 0;
    for (const Block& block : solution.blocks) {
      zeros += block.J.size();
      if (block.S.rows() == 0) continue;
      const Eigen::VectorXcd exponents = block.S.eigenvalues();
      fewest.raise(-exponents.real().minCoeff(), k);
      EXPECT_GT(exponents.real().minCoeff(), sample.uniform_material() ? (sample.ring.is_open() ? 0.49 : 0.99) : 0.0);
    }
    EXPECT_EQ(zeros, 2u);
    if (HasFatalFailure() || HasNonfatalFailure()) break;
  }
  EXPECT_EQ(asymmetry.value, 0.0);
  const auto expect = [](const char* name, const Worst& worst, double most) {
    std::printf("%-24s %.1e  (sample %d)\n", name, worst.value, worst.sample);
    testing::Test::RecordProperty(name, testing::PrintToString(worst.value));
    EXPECT_LT(worst.value, most) << name << ", sample " << worst.sample;
  };
  expect("translations", translation, 1e-9);
  expect("rotation", rotation, 1e-9);
  expect("patch test", patch, 1e-12);
  expect("Riccati", riccati, 1e-9);
  std::printf("cracked %d, largest %d degrees of freedom\n", cracked, largest_size);
  EXPECT_GT(cracked, 3000);
  EXPECT_GE(largest_size, 400);
}

void expect_refused(const Ring& ring, const Elasticity& D, double thickness, const char* reason) {
  const auto refused = testing::ThrowsMessage<IllPosed>(testing::HasSubstr(reason));
  EXPECT_THAT([&] { solve_super_element(ring, D, thickness); }, refused);
  EXPECT_THAT([&] { solve_batch(std::vector<BatchItem>{{ring, D, thickness}}); }, refused);
}

TEST(Robustness, IllPosedOnesAreNamed) {
  const Ring good = polygon_ring(regular_polygon(7, 1.0, 0.3), 1, 2);
  const Mat3 D = elasticity(1.0, 0.3);
  ASSERT_NO_THROW(solve_super_element(good, D, 1.0));

  Ring hidden = good;  // the centre lies outside: the far edges are seen from behind
  for (Vec2& x : hidden.nodes) x += Vec2(3.0, 0.0);
  expect_refused(hidden, D, 1.0, "the scaling centre does not see boundary element");

  Ring grazed = good;  // the centre lies on element 3
  const Vec2 middle = grazed.nodes[7];
  for (Vec2& x : grazed.nodes) x -= middle;
  expect_refused(grazed, D, 1.0, "boundary element 3");

  Ring turned = good;
  for (Vec2& x : turned.nodes) x.y() = -x.y();  // clockwise
  expect_refused(turned, D, 1.0, "the scaling centre does not see boundary element 0");

  Ring without_length = good;
  for (std::size_t i : {4u, 5u, 6u}) without_length.nodes[i] = good.nodes[4];  // element 2
  expect_refused(without_length, D, 1.0, "boundary element 2 has no length");

  Ring not_a_number = good;
  not_a_number.nodes[9].x() = std::numeric_limits<double>::quiet_NaN();
  expect_refused(not_a_number, D, 1.0, "boundary element 4");

  std::vector<Mat3> sectors(7, D);
  sectors[5](2, 2) = -1.0;
  expect_refused(good, sectors, 1.0, "the elasticity of boundary element 5 is not positive definite");
  expect_refused(good, Mat3(Mat3::Zero()), 1.0, "not positive definite");
  sectors[5] = Mat3::Constant(std::numeric_limits<double>::quiet_NaN());
  expect_refused(good, sectors, 1.0, "the elasticity of boundary element 5 is not positive definite");
  expect_refused(good, D, 0.0, "thickness");
  expect_refused(good, D, -1.0, "thickness");
}

}  // namespace
}  // namespace scabo::element
