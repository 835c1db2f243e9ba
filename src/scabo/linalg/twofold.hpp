// Numbers of twice the working precision, as the sum of two doubles, for residuals of ill-conditioned systems.
//
// Iterative refinement solves A x = b to all digits of x if the residual b - A x is computed with more digits than the
// factor of A has. x itself then needs more digits as well, because rounding x to double alone leaves a residual of |A|
// |x| times 1e-16, which can exceed b: in a slender beam, stiffness times displacement is (L / h)^3 times the load.
// Error-free sums and products: Dekker, Numer. Math. 18 (1971) 224; products of matrices: Ogita, Rump, Oishi, SIAM J.
// Sci. Comput. 26 (2005) 1955. About 30 digits, at about ten times the cost; the results are the same on every
// processor.
#pragma once

#include <cmath>
#include <vector>

#include "scabo/linalg/symmetric_positive_solver.hpp"

namespace scabo::linalg {

/// high + low, |low| <= half a unit in the last place of high.
struct Twofold {
  double high = 0.0, low = 0.0;
};

/// a + b exactly.
inline Twofold exact_sum(double a, double b) {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}
/// a b exactly.
inline Twofold exact_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}
inline Twofold operator-(const Twofold& a) { return {-a.high, -a.low}; }
inline Twofold operator+(const Twofold& a, const Twofold& b) {
  const Twofold sum = exact_sum(a.high, b.high);
  return exact_sum(sum.high, sum.low + (a.low + b.low));
}
inline Twofold operator-(const Twofold& a, const Twofold& b) { return a + (-b); }
inline Twofold operator*(const Twofold& a, const Twofold& b) {
  const Twofold product = exact_product(a.high, b.high);
  return exact_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}
inline Twofold operator/(const Twofold& a, const Twofold& b) {
  const double first = a.high / b.high;
  const Twofold rest = a - b * Twofold{first, 0.0};
  return exact_sum(first, rest.high / b.high);
}

using TwofoldVector = std::vector<Twofold>;

TwofoldVector twofold(const Vector& x);
Vector rounded(const TwofoldVector& x);

/// A x, A n x n.
TwofoldVector product(const Matrix& A, const TwofoldVector& x);
TwofoldVector product(const SparseMatrix& A, const TwofoldVector& x);

}  // namespace scabo::linalg
