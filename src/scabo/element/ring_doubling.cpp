#include "scabo/element/ring_doubling.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/element/ill_posed.hpp"
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

/// Eq. (2); of the result only K22 where `last`.
RingMatrices join(const RingMatrices& a, const RingMatrices& b, bool last) {
  Matrix B = a.K22 + b.K11;
  if (!linalg::cholesky_in_place(B)) throw IllPosed("a ring is not positive definite");
  RingMatrices joined;
  Matrix X = b.K12;
  linalg::solve_lower_in_place(B, X);
  joined.K22 = b.K22;
  linalg::add_gram(joined.K22, X, -1.0, 1.0);
  if (last) return joined;
  Matrix Y = a.K12.transpose();
  linalg::solve_lower_in_place(B, Y);
  joined.K11 = a.K11;
  linalg::add_gram(joined.K11, Y, -1.0, 1.0);
  joined.K12 = linalg::multiply_transposed(Y, X, -1.0);
  return joined;
}

/// Largest entry of K12 where the diagonal of K22 is scaled to 1: sectors of other stiffness count alike.
double coupling(const RingMatrices& ring) {
  const Vector scale = ring.K22.diagonal().cwiseSqrt().cwiseInverse();
  double largest = 0.0;
  for (Eigen::Index j = 0; j < ring.K12.cols(); ++j)
    largest = std::max(largest, scale[j] * ring.K12.col(j).cwiseProduct(scale).cwiseAbs().maxCoeff());
  return largest;
}

/// Largest exponent, roughly: the square root of the largest entry of E2 against E0 on their diagonals. 3: the diagonals of
/// [1 -1; -1 1] against [2 1; 1 2] / 3, and their largest eigenvalue, 4 times as large; less at higher order.
double largest_exponent(const Matrix& E0, const Matrix& E2) {
  double largest = 1.0;
  for (Eigen::Index i = 0; i < E0.rows(); ++i)
    if (E0(i, i) > 0.0) largest = std::max(largest, E2(i, i) / E0(i, i));
  return std::sqrt(3.0 * largest);
}

}  // namespace

RingStiffness ring_doubling(const Matrix& E0, const Matrix& E1, const Matrix& E2, Side side) {
  if (E0.rows() == 0) return {E0, 0};
  if (side == Side::outside) return ring_doubling(E0, -E1, E2);  // s -> -s exchanges 1 and 2
  const double h = largest_exponent(E0, E2), w = std::sqrt(0.5 * std::sqrt(h) * (1.0 + h)), spread = std::sqrt(w * w - h);
  RingMatrices ring = join(first_ring(E0, E1, E2, w - spread), first_ring(E0, E1, E2, w + spread), false);  // eq. (3)
  constexpr int most = 60;
  for (int doublings = 1; doublings <= most; ++doublings) {
    // |X'X| of the next step is about the square of the coupling, of the step after it the fourth power.
    const double coupled = coupling(ring);
    if (coupled < 1e-10) return {ring.K22, doublings - 1};
    const bool last = coupled < 1e-5;
    ring = join(ring, ring, last);
    if (last) return {ring.K22, doublings};
  }
  throw IllPosed("ring doubling did not end: an exponent is 0");
}

}  // namespace scabo::element
