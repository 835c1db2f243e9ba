#include "scabo/linalg/twofold.hpp"

#include "scabo/linalg/twofold_kernel.hpp"

namespace scabo::linalg {

namespace {

/// sum <- sum + a x; the low part is normalised at the end.
void add_product(Twofold& sum, double a, const Twofold& x) {
  const Twofold product = exact_product(a, x.high), high = exact_sum(sum.high, product.high);
  sum.high = high.high;
  sum.low += high.low + product.low + a * x.low;
}

void in_order(TwofoldVector& y) {
  for (Twofold& value : y) value = exact_sum(value.high, value.low);
}

}  // namespace

TwofoldVector twofold(const Vector& x) {
  TwofoldVector y;
  for (const double value : x) y.push_back({value, 0.0});
  return y;
}

Vector rounded(const TwofoldVector& x) {
  Vector high(static_cast<Eigen::Index>(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i) high[static_cast<Eigen::Index>(i)] = x[i].high;
  return high;
}

TwofoldVector product(const Matrix& A, const TwofoldVector& x) {
  static const TwofoldKernel& fastest = *twofold_kernel(0);
  Vector high = Vector::Zero(A.rows()), low = Vector::Zero(A.rows());
  for (Eigen::Index column = 0; column < A.cols(); ++column) {
    const Twofold& of_column = x[static_cast<std::size_t>(column)];
    fastest.add_column(A.col(column).data(), A.rows(), of_column.high, of_column.low, high.data(), low.data());
  }
  TwofoldVector y;
  y.reserve(static_cast<std::size_t>(A.rows()));
  for (Eigen::Index row = 0; row < A.rows(); ++row) y.push_back(exact_sum(high[row], low[row]));
  return y;
}

TwofoldVector product(const SparseMatrix& A, const TwofoldVector& x) {
  TwofoldVector y(static_cast<std::size_t>(A.rows()));
  for (Eigen::Index column = 0; column < A.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(A, column); entry; ++entry)
      add_product(y[static_cast<std::size_t>(entry.row())], entry.value(), x[static_cast<std::size_t>(column)]);
  in_order(y);
  return y;
}

}  // namespace scabo::linalg
