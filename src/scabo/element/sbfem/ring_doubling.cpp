#include "scabo/element/sbfem/ring_doubling.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scabo/element/sbfem/ill_posed.hpp"
#include "scabo/element/sbfem/riccati.hpp"
#include "scabo/linalg/cholesky_factor.hpp"

namespace scabo::element {

namespace {

/// Stiffness of a ring on its inner and outer nodes, [K11, K12; K12', K22]: the lower triangle.
using RingMatrix = Matrix;

/// Joins rings. Its memory is allocated once: new matrices for every step would take a tenth of the time at n = 160.
class Joiner {
 public:
  /// The ring of eq. (3): two of eq. (1), g = `inner` and `outer`, joined by eq. (2).
  void start(const Matrix& E0, const Matrix& E1, const Matrix& E2, double inner, double outer, RingMatrix& ring) {
    const Eigen::Index n = E0.rows();
    const double a0 = 0.5 * inner, a2 = 0.5 / inner, b0 = 0.5 * outer, b2 = 0.5 / outer;
    const Matrix E1t = E1.transpose();
    resize(n);
    ring.resize(2 * n, 2 * n);
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto e0 = E0.col(j).array(), e1 = E1.col(j).array(), e1t = E1t.col(j).array(), e2 = E2.col(j).array();
      B_.A.col(j) = (a0 + b0) * e0 + (a2 + b2) * e2;  // E1 cancels
      Z_.col(j).head(n) = a2 * e2 - a0 * e0 + 0.5 * (e1 - e1t);
      Z_.col(j).tail(n) = b2 * e2 - b0 * e0 + 0.5 * (e1t - e1);
      ring.col(j).head(n) = a0 * e0 + a2 * e2 - 0.5 * (e1 + e1t);
      ring.col(n + j).tail(n) = b0 * e0 + b2 * e2 + 0.5 * (e1 + e1t);
    }
    eliminate(ring);
  }

  /// Eq. (2): the ring inside itself.
  void double_ring(RingMatrix& ring) {
    const Eigen::Index n = ring.rows() / 2;
    resize(n);
    set_middle(ring);
    Z_.bottomRows(n) = ring.bottomLeftCorner(n, n);
    Z_.topRows(n) = Z_.bottomRows(n).transpose();
    eliminate(ring);
  }

  /// K22 of the ring inside itself.
  Matrix outer_of_doubled(const RingMatrix& ring) {
    const Eigen::Index n = ring.rows() / 2;
    set_middle(ring);
    factorise();
    Z_ = ring.bottomLeftCorner(n, n);
    B_.divide(Z_);
    Matrix K22 = ring.bottomRightCorner(n, n);
    linalg::subtract_square(Z_, K22);
    return K22;
  }

 private:
  void resize(Eigen::Index n) {
    B_.A.resize(n, n);
    Z_.resize(2 * n, n);
  }
  void set_middle(const RingMatrix& ring) {
    const Eigen::Index n = ring.rows() / 2;
    for (Eigen::Index j = 0; j < n; ++j)
      B_.A.col(j).tail(n - j) = ring.col(j).segment(j, n - j) + ring.col(n + j).tail(n - j);
  }
  void factorise() {
    if (!B_.factorise()) throw IllPosed("a ring is not positive definite");
  }
  /// Eliminates the outer nodes of the inner ring, which are the inner ones of the outer ring: Z = [K12a; K12b']
  /// divided by L', then one symmetric product.
  void eliminate(RingMatrix& ring) {
    const Eigen::Index n = ring.rows() / 2;
    factorise();
    B_.divide(Z_);
    ring.bottomLeftCorner(n, n).setZero();
    linalg::subtract_square(Z_, ring);
  }

  linalg::CholeskyFactor B_;
  Matrix Z_;
};

/// Largest entry of K12 with the diagonal of K22 scaled to 1, so that sectors of different stiffness have equal weight.
double coupling(const RingMatrix& ring) {
  const Eigen::Index n = ring.rows() / 2;
  const Vector scale = ring.diagonal().tail(n).cwiseSqrt().cwiseInverse();
  double largest = 0.0;
  for (Eigen::Index j = 0; j < n; ++j)
    largest = std::max(largest, scale[j] * ring.col(j).tail(n).cwiseProduct(scale).cwiseAbs().maxCoeff());
  return largest;
}

/// Estimate of the largest exponent: the square root of the largest entry of E2 relative to E0 on their diagonals. It
/// is between half of the exponent and the exponent for edge orders 1 to 8; too small a value costs less than too large
/// a value.
double largest_exponent(const Matrix& E0, const Matrix& E2) {
  double largest = 2.0;
  for (Eigen::Index i = 0; i < E0.rows(); ++i)
    if (E0(i, i) > 0.0) largest = std::max(largest, E2(i, i) / E0(i, i));
  return std::sqrt(largest);
}

/// K22 of rings that are doubled until it has converged.
RingStiffness doubled(const Matrix& E0, const Matrix& E1, const Matrix& E2) {
  const double h = largest_exponent(E0, E2), w = std::sqrt(0.5 * std::sqrt(h) * (1.0 + h)),
               spread = std::sqrt(w * w - h);
  RingMatrix ring;
  Joiner joiner;
  joiner.start(E0, E1, E2, w - spread, w + spread, ring);
  constexpr int most = 60;
  for (int doublings = 0; doublings < most; ++doublings) {
    // A step changes K22 by about the square of the coupling, and the next one by some 1e4 times the fourth power.
    const double coupled = coupling(ring);
    if (coupled < 1e-5) {
      const bool arrived = coupled < 1e-9;
      RingStiffness result;
      result.K = arrived ? Matrix(ring.bottomRightCorner(E0.rows(), E0.rows())) : joiner.outer_of_doubled(ring);
      result.K.triangularView<Eigen::StrictlyUpper>() = result.K.transpose();
      result.doublings = doublings + (arrived ? 0 : 1);
      return result;
    }
    joiner.double_ring(ring);
  }
  throw IllPosed("ring doubling did not converge because an exponent is 0");
}

}  // namespace

RingStiffness ring_doubling(const Matrix& E0, const Matrix& E1, const Matrix& E2, Side side) {
  if (E0.rows() == 0) return {E0, E0, 0, 0.0};
  if (side == Side::outside) {  // s -> -s exchanges 1 and 2
    RingStiffness outside = ring_doubling(E0, -E1, E2);
    outside.S = -outside.S;
    return outside;
  }
  RingStiffness result = doubled(E0, E1, E2);
  linalg::CholeskyFactor L;
  L.A = E0;
  if (!L.factorise()) throw IllPosed("E0 is not positive definite");
  RiccatiResidual residual = riccati_residual(L, E1, E2, result.K);
  // Remaining residual due to rounding: 1e-13 at n = 640, 3e-13 at 1280, 3e-12 at 2560, 3e-11 at 5000.
  const auto n = static_cast<double>(E0.rows());
  const double enough = std::max(1e-13, 1e-15 * n * std::max(1.0, 1e-6 * n * n));
  constexpr int most = 3;
  for (int corrections = 0; residual.size > enough && corrections < most; ++corrections) {
    const Matrix corrected = result.K + newton_step(residual, E0.diagonal().cwiseSqrt());
    RiccatiResidual next = riccati_residual(L, E1, E2, corrected);
    if (!(next.size < residual.size)) break;
    result.K = corrected;
    const bool slow = next.size > 0.1 * residual.size;  // only rounding is left
    residual = std::move(next);
    if (slow) break;
  }
  result.residual = residual.size;
  result.S = std::move(residual.S);
  return result;
}

}  // namespace scabo::element
