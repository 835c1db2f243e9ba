#include "theory/textbook_route.hpp"

#include <algorithm>
#include <numeric>

#include "support/decompositions.hpp"

namespace scabo::test {

TextbookSolution textbook_route(const element::CoefficientMatrices& matrices) {
  const double unit = Matrix(matrices.E0).cwiseAbs().maxCoeff();  // u and q of one size: Eigen does not balance
  const Matrix E0 = matrices.E0 / unit, E1 = matrices.E1 / unit, E2 = matrices.E2 / unit;
  const Eigen::Index n = E0.rows();
  const Matrix inverse = test::inverse(E0);
  Matrix Z(2 * n, 2 * n);
  Z << -inverse * E1.transpose(), inverse, E2 - E1 * inverse * E1.transpose(), E1 * inverse;
  const ComplexEigen eigen = complex_eigen(Z);
  std::vector<Eigen::Index> order(static_cast<std::size_t>(2 * n));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return eigen.values[a].real() < eigen.values[b].real(); });

  Eigen::MatrixXcd phi = Eigen::MatrixXcd::Zero(2 * n, n);
  TextbookSolution solution;
  for (Eigen::Index i = 0; i < n; ++i) phi(i, i % 2) = 1.0;  // the translations, q = 0
  solution.exponents.assign(2, 0.0);
  for (Eigen::Index k = 2; k < n; ++k) {
    const Eigen::Index column = order[static_cast<std::size_t>(n + k)];
    phi.col(k) = eigen.vectors.col(column);
    solution.exponents.push_back(eigen.values[column]);
  }
  const ComplexMatrix transposed = complex_solve_lu(phi.topRows(n).transpose(), phi.bottomRows(n).transpose());
  solution.K = unit * transposed.transpose().real();
  return solution;
}

}  // namespace scabo::test
