#include "scabo/element/sbfem/internal_level.hpp"

#include "scabo/element/sbfem/lyapunov.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/linalg/dense.hpp"

namespace scabo::element {

namespace {

/// E0^-1 X, n x n.
Matrix by_E0(const SuperElementSolution& solution, const Matrix& X) {
  Matrix made = Matrix::Zero(X.rows(), X.cols());
  for (const Block& block : solution.blocks) made += block.T * block.E0.llt().solve(Matrix(block.T.transpose() * X));
  return made;
}

/// Blocks that one mass couples, as one.
struct CoupledBlocks {
  Eigen::SparseMatrix<double> T;
  std::vector<int> I, J;
  Matrix R, E0, A, modes_T, modes_U;
};

void append(Matrix& to, const Matrix& block) {  // along the diagonal
  const Eigen::Index rows = to.rows(), columns = to.cols();
  Matrix made = Matrix::Zero(rows + block.rows(), columns + block.cols());
  made.topLeftCorner(rows, columns) = to;
  made.bottomRightCorner(block.rows(), block.cols()) = block;
  to = std::move(made);
}

void append(CoupledBlocks& to, const Block& block, const ModalBlock& modes) {
  const auto before = static_cast<int>(to.R.rows());
  for (const int i : block.I) to.I.push_back(before + i);
  for (const int j : block.J) to.J.push_back(before + j);
  append(to.R, block.R), append(to.E0, block.E0), append(to.A, block.A);
  append(to.modes_T, modes.modes.T()), append(to.modes_U, modes.modes.U());
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](const Eigen::SparseMatrix<double>& T, Eigen::Index first) {
    for (Eigen::Index column = 0; column < T.outerSize(); ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator it(T, column); it; ++it)
        entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(first + column), it.value());
  };
  add(to.T, 0), add(block.T, before);
  Eigen::SparseMatrix<double> made(block.T.rows(), before + block.T.cols());
  made.setFromTriplets(entries.begin(), entries.end());
  to.T = std::move(made);
}

/// Of the system of [v; a_y; y_v] with y = xi^2 xi^S w = E y_v + R a_y, whose matrix is quasi-triangular.
InternalModes::Group modes_of(const CoupledBlocks& of, const Matrix& M) {
  const Matrix by_w = of.E0.llt().solve(Matrix(of.T.transpose() * M * of.T));  // xi u,xi = S u + by_w y
  Matrix by_y(by_w.rows(), by_w.cols());                                       // on a_y, then on y_v
  const auto all = by_w.cols(), m = static_cast<Eigen::Index>(of.J.size()), n = all - m;
  by_y << by_w * of.R, by_w(Eigen::all, of.I);
  const Matrix on_v = by_y(of.I, Eigen::all) - of.R(of.I, Eigen::all) * by_y(of.J, Eigen::all);
  const Matrix &U = of.modes_U, &T = of.modes_T;

  linalg::RealSchur schur{Matrix::Zero(n + all, n + all), Matrix::Zero(n + all, n + all)};
  schur.U.topLeftCorner(n, n) = U;
  schur.U.block(n, n, m, m).setIdentity();
  schur.U.bottomRightCorner(n, n) = U;
  schur.T.topLeftCorner(n, n) = T;
  schur.T.block(0, n, n, m) = U.transpose() * on_v.leftCols(m);
  schur.T.block(0, n + m, n, n) = linalg::multiply(linalg::multiply_transposed(U, on_v.rightCols(n)), U);
  schur.T.block(n, n, m, m) = 2.0 * Matrix::Identity(m, m);
  schur.T.block(n, n + m, m, n) = of.A * U;
  schur.T.bottomRightCorner(n, n) = T + 2.0 * Matrix::Identity(n, n);

  Matrix A(m, n + all);  // xi a,xi
  A << of.A, by_y(of.J, Eigen::all);
  const Matrix moving = schur.T.transpose().partialPivLu().solve((A * schur.U).transpose()).transpose();
  InternalModes::Group made;
  made.T = of.T;
  made.R = of.R;
  made.modal.Phi = of.R * moving;
  made.modal.Phi(of.I, Eigen::all) += schur.U.topRows(n);
  made.start = Matrix::Zero(n + all, all);
  for (Eigen::Index k = 0; k < m; ++k) made.start(n + k, of.J[static_cast<std::size_t>(k)]) = 1.0;
  Matrix v_of = Matrix::Zero(n, all);
  for (Eigen::Index k = 0; k < n; ++k) v_of(k, of.I[static_cast<std::size_t>(k)]) = 1.0;
  for (Eigen::Index k = 0; k < m; ++k) v_of.col(of.J[static_cast<std::size_t>(k)]) -= of.R(of.I, k);
  made.start.bottomRows(n) = U.transpose() * v_of;
  made.still = -made.modal.Phi(of.J, Eigen::all) * made.start;
  made.modal.modes = linalg::SchurExponential(std::move(schur));
  return made;
}

}  // namespace

InternalLevel internal_level(const Matrix& M, const SuperElementSolution& solution, const ModalSolution& modal,
                             bool coupled, int threads) {
  const Matrix by_M = by_E0(solution, M);
  const auto solved = [&](double k, const Matrix& C) {
    return solve_lyapunov(solution, modal, k, coupled, threads,
                          [&](const Block& i, const Block& j) { return Matrix(i.T.transpose() * C * j.T); });
  };
  InternalLevel level;
  level.Z = solved(2.0, linalg::multiply_transposed(M, by_M));
  const Matrix half = linalg::multiply_transposed(by_M, level.Z);
  level.Q = solved(3.0, half + half.transpose());
  return level;
}

InternalModes internal_modes(const Matrix& M, const SuperElementSolution& solution, const ModalSolution& modal,
                             bool coupled) {
  InternalModes made;
  CoupledBlocks together;
  for (std::size_t k = 0; k < solution.blocks.size(); ++k) {
    append(together, solution.blocks[k], modal.blocks[k]);
    if (coupled && k + 1 < solution.blocks.size()) continue;
    made.groups.push_back(modes_of(together, M));
    together = {};
  }
  return made;
}

}  // namespace scabo::element
