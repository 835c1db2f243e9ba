// The textbook solution of a bounded super-element, as an oracle: eigenvectors of the 2n x 2n matrix
//
//     Z = [[-E0^-1 E1', E0^-1], [E2 - E1 E0^-1 E1', E1 E0^-1]],   xi X,xi = Z X,   X = [u; q]
//
// of which the n - 2 of largest real part are taken and the two translations put in: K = Phi_q Phi_u^-1
// (Song, The Scaled Boundary Finite Element Method, 2018, section 3.2). It loses its digits as n grows: only
// for small n.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <complex>
#include <numeric>
#include <vector>

#include "scabo/element/coefficient_matrices.hpp"

namespace scabo::test {

struct TextbookSolution {
  Matrix K;                                     // n x n
  std::vector<std::complex<double>> exponents;  // n, ascending real part
};

inline TextbookSolution textbook_route(const element::CoefficientMatrices& matrices) {
  const double unit = Matrix(matrices.E0).cwiseAbs().maxCoeff();  // u and q of one size: Eigen does not balance
  const Matrix E0 = matrices.E0 / unit, E1 = matrices.E1 / unit, E2 = matrices.E2 / unit;
  const Eigen::Index n = E0.rows();
  const Matrix inverse = E0.inverse();
  Matrix Z(2 * n, 2 * n);
  Z << -inverse * E1.transpose(), inverse, E2 - E1 * inverse * E1.transpose(), E1 * inverse;
  const Eigen::EigenSolver<Matrix> eigen(Z);
  std::vector<Eigen::Index> order(static_cast<std::size_t>(2 * n));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
    return eigen.eigenvalues()[a].real() < eigen.eigenvalues()[b].real();
  });

  Eigen::MatrixXcd phi = Eigen::MatrixXcd::Zero(2 * n, n);
  TextbookSolution solution;
  for (Eigen::Index i = 0; i < n; ++i) phi(i, i % 2) = 1.0;  // the translations, q = 0
  solution.exponents.assign(2, 0.0);
  for (Eigen::Index k = 2; k < n; ++k) {
    const Eigen::Index column = order[static_cast<std::size_t>(n + k)];
    phi.col(k) = eigen.eigenvectors().col(column);
    solution.exponents.push_back(eigen.eigenvalues()[column]);
  }
  const Eigen::MatrixXcd transposed = phi.topRows(n).transpose().fullPivLu().solve(phi.bottomRows(n).transpose());
  solution.K = unit * transposed.transpose().real();
  return solution;
}

}  // namespace scabo::test
