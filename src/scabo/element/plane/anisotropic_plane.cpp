#include "scabo/element/plane/anisotropic_plane.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "scabo/base/error.hpp"

namespace scabo::element {

namespace {

using std::numbers::pi;

/// strain = B(a) times the gradient vector for a field that varies along `a`.
Eigen::Matrix<double, 3, 2> strain_of(const Vec2& a) {
  Eigen::Matrix<double, 3, 2> B;
  B << a.x(), 0.0, 0.0, a.y(), a.y(), a.x();
  return B;
}

}  // namespace

Mat3 rotated_elasticity(const Mat3& D, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Mat3 to_old;  // stress along the old axes = to_old stress along the new ones
  to_old << c * c, s * s, -2.0 * c * s, s * s, c * c, 2.0 * c * s, c * s, -c * s, c * c - s * s;
  const Mat3 back = to_old.inverse();
  return back * D * back.transpose();
}

Mat4 fundamental_elasticity(const Mat3& D, double t) {
  const auto M = strain_of({std::cos(t), std::sin(t)}), N = strain_of({-std::sin(t), std::cos(t)});
  const Mat2 mm = M.transpose() * D * M, nm = N.transpose() * D * M, nn = N.transpose() * D * N;
  const Mat2 inverse = nn.inverse();
  Mat4 result;
  result << -inverse * nm, inverse, nm.transpose() * inverse * nm - mm, -nm.transpose() * inverse;
  return result;
}

BarnettLothe barnett_lothe(const Mat3& D) {
  const double unit = D.trace() / 3.0;
  Mat4 Y = fundamental_elasticity(D / unit, 0.0);
  for (int step = 0; step < 100; ++step) {
    const Mat4 inverse = Y.inverse();
    // det(N) = product of |p|^2: the scaling moves the eigenvalues to the circle where the iteration converges quickly.
    const double c = step < 20 ? std::pow(std::abs(Y.determinant()), -0.25) : 1.0;
    const Mat4 next = 0.5 * (c * Y - inverse / c);
    const double change = (next - Y).norm();
    Y = next;
    if (change < 1e-13 * Y.norm()) break;
    ensure(step < 99, "the Barnett-Lothe tensors did not converge: the material is not positive definite");
  }
  BarnettLothe tensors;
  tensors.S = Y.topLeftCorner<2, 2>();
  const Mat2 H = Y.topRightCorner<2, 2>(), L = -Y.bottomLeftCorner<2, 2>();
  tensors.H = 0.5 / unit * (H + H.transpose());
  tensors.L = 0.5 * unit * (L + L.transpose());
  return tensors;
}

CrackedBimaterial cracked_bimaterial(const Mat3& above, const Mat3& below) {
  const BarnettLothe a = barnett_lothe(above), b = barnett_lothe(below);
  CrackedBimaterial pair;
  pair.D = a.L.inverse() + b.L.inverse();
  pair.G.setZero();
  if ((above - below).norm() <= 1e-12 * above.norm()) return pair;
  Mat2 W = a.S * a.L.inverse() - b.S * b.L.inverse();
  W = 0.5 * (W - W.transpose()).eval();
  const Mat2 ratio = pair.D.inverse() * W;
  const double beta = std::sqrt(std::max(0.0, -0.5 * (ratio * ratio).trace()));
  if (beta == 0.0) return pair;
  const double epsilon = std::atanh(beta) / pi;
  pair.G = -epsilon / beta * ratio;  // eq. (4)
  pair.epsilon = std::copysign(epsilon, pair.G(0, 1));
  return pair;
}

Mat2 CrackedBimaterial::oscillation(double r_over_l) const {
  if (epsilon == 0.0) return Mat2::Identity();
  const double angle = epsilon * std::log(r_over_l);
  return std::cos(angle) * Mat2::Identity() + std::sin(angle) / epsilon * G;
}

Vec2 CrackedBimaterial::intensity(const Vec2& opening, double r, double l) const {
  const Mat2 factor = std::cosh(pi * epsilon) * (Mat2::Identity() + 2.0 * G);
  return oscillation(l / r) * factor * (2.0 * D).inverse() * opening * std::sqrt(2.0 * pi / r);
}

Vec2 CrackedBimaterial::opening(const Vec2& k, double r, double l) const {
  const Mat2 factor = std::cosh(pi * epsilon) * (Mat2::Identity() + 2.0 * G);
  return 2.0 * D * std::sqrt(r / (2.0 * pi)) * factor.inverse() * oscillation(r / l) * k;
}

double CrackedBimaterial::energy_release_rate(const Vec2& k) const {
  const double cosine = std::cosh(pi * epsilon);
  return k.dot(D * k) / (4.0 * cosine * cosine);
}

}  // namespace scabo::element
