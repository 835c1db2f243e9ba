#include "scabo/element/ring_doubling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scabo/element/ill_posed.hpp"
#include "scabo/element/riccati.hpp"
#include "scabo/linalg/dense.hpp"

namespace scabo::element {

namespace {

struct RingMatrices {
  Matrix K11, K12, K22;
};

RingMatrices first_ring(const Matrix& E0, const Matrix& E1, const Matrix& E2, double g) {  // eq. (1)
  const Matrix even = E0 * (0.5 * g) + E2 * (0.5 / g), odd = 0.5 * (E1 + E1.transpose());
  return {even - odd, E2 / g - even + 0.5 * (E1 - E1.transpose()), even + odd};
}

/// Joins rings; its room is made once: new matrices for every join cost a tenth of the time at n = 160.
class Joiner {
 public:
  /// Eq. (2): b <- a inside b, of which only K22 counts where `last`. Of K11 and K22 only the lower triangle is kept. a may be b.
  void join(const RingMatrices& a, RingMatrices& b, bool last) {
    B_ = a.K22 + b.K11;
    if (!linalg::cholesky_in_place(B_)) throw IllPosed("a ring is not positive definite");
    const Eigen::Index n = B_.rows();
    Z_.resize(n, last ? n : 2 * n);  // X and Y side by side: one solve
    Z_.leftCols(n) = b.K12;
    if (!last) Z_.rightCols(n) = a.K12.transpose();
    linalg::solve_lower_in_place(B_, Z_);
    linalg::add_gram_lower(b.K22, Z_.leftCols(n), -1.0);
    if (last) return;
    if (&a != &b) b.K11 = a.K11;
    linalg::add_gram_lower(b.K11, Z_.rightCols(n), -1.0);
    linalg::set_multiply_transposed(Z_.rightCols(n), Z_.leftCols(n), -1.0, b.K12);
  }

 private:
  Matrix B_, Z_;
};

/// Largest entry of K12 where the diagonal of K22 is scaled to 1: sectors of other stiffness count alike.
double coupling(const RingMatrices& ring) {
  const Vector scale = ring.K22.diagonal().cwiseSqrt().cwiseInverse();
  double largest = 0.0;
  for (Eigen::Index j = 0; j < ring.K12.cols(); ++j)
    largest = std::max(largest, scale[j] * ring.K12.col(j).cwiseProduct(scale).cwiseAbs().maxCoeff());
  return largest;
}

/// Largest exponent, roughly: the square root of the largest entry of E2 against E0 on their diagonals. It is between a half
/// and the whole of it for edge orders 1 to 8; too small a value costs less than one too large.
double largest_exponent(const Matrix& E0, const Matrix& E2) {
  double largest = 2.0;
  for (Eigen::Index i = 0; i < E0.rows(); ++i)
    if (E0(i, i) > 0.0) largest = std::max(largest, E2(i, i) / E0(i, i));
  return std::sqrt(largest);
}

/// K22 of rings doubled until it has arrived.
RingStiffness doubled(const Matrix& E0, const Matrix& E1, const Matrix& E2) {
  const double h = largest_exponent(E0, E2), w = std::sqrt(0.5 * std::sqrt(h) * (1.0 + h)), spread = std::sqrt(w * w - h);
  RingMatrices ring = first_ring(E0, E1, E2, w + spread);
  Joiner joiner;
  joiner.join(first_ring(E0, E1, E2, w - spread), ring, false);  // eq. (3)
  constexpr int most = 60;
  for (int doublings = 0; doublings < most; ++doublings) {
    // |X'X| of the next step is about the square of the coupling, of the step after it the fourth power.
    const double coupled = coupling(ring);
    const bool last = coupled < 3e-5, done = coupled < 1e-10;
    if (!done) joiner.join(ring, ring, last);
    if (last) {
      ring.K22.triangularView<Eigen::StrictlyUpper>() = ring.K22.transpose();
      RingStiffness result;
      result.K = std::move(ring.K22);
      result.doublings = doublings + (done ? 0 : 1);
      return result;
    }
  }
  throw IllPosed("ring doubling did not end: an exponent is 0");
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
  Matrix L = E0;
  if (!linalg::cholesky_in_place(L)) throw IllPosed("E0 is not positive definite");
  RiccatiResidual residual = riccati_residual(L, E1, E2, result.K);
  const double enough = std::max(1e-13, 1e-15 * static_cast<double>(E0.rows()));  // what rounding leaves
  constexpr double too_much = 1e-9;
  constexpr int most = 3;
  for (int corrections = 0; residual.size > enough && corrections < most; ++corrections) {
    const Matrix corrected = result.K + newton_step(residual, E0.diagonal().cwiseSqrt());
    RiccatiResidual next = riccati_residual(L, E1, E2, corrected);
    if (!(next.size < residual.size)) break;
    result.K = corrected;
    const bool slow = next.size > 0.1 * residual.size;  // rounding is all that is left
    residual = std::move(next);
    if (slow) break;
  }
  if (!(residual.size <= too_much)) throw IllPosed(fmt::format("digits were lost: the Riccati residual stays at {:.0e}", residual.size));
  result.residual = residual.size;
  result.S = std::move(residual.S);
  return result;
}

}  // namespace scabo::element
