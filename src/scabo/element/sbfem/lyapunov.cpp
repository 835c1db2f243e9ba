#include "scabo/element/sbfem/lyapunov.hpp"

#include "scabo/linalg/parallel.hpp"
#include "scabo/linalg/sylvester.hpp"

namespace scabo::element {

namespace {

Matrix shifted(const Matrix& T, double shift) { return T + shift * Matrix::Identity(T.rows(), T.cols()); }

/// X_va of eq. (3) for one block.
Matrix solve_mixed(const ModalBlock& modes, const Matrix& right, double k) {
  const Matrix& U = modes.modes.U();
  const Matrix twice = 2.0 * k * Matrix::Identity(right.cols(), right.cols());
  return U * linalg::solve_sylvester(modes.modes.T(), twice, U.transpose() * right);
}

/// The part of X between two symmetry blocks, in their coordinates: n_i x n_j.
Matrix solve_between(const Block& i, const ModalBlock& modes_i, const Block& j, const ModalBlock& modes_j, double k,
                     const Matrix& C) {
  const Matrix C_i = C * j.R, C_j = C(Eigen::all, j.I);  // the sides of j: on a, on v
  const Matrix C_vv = i.on_v(C_j), C_va = i.on_v(C_i), C_av = i.on_a(C_j), C_aa = i.on_a(C_i);

  const Matrix aa = 0.5 / k * C_aa;                                        // eq. (2)
  const Matrix va = solve_mixed(modes_i, C_va - i.A.transpose() * aa, k);  // eq. (3)
  const Matrix av = solve_mixed(modes_j, (C_av - aa * j.A).transpose(), k).transpose();
  const Matrix &U_i = modes_i.modes.U(), &U_j = modes_j.modes.U();
  const Matrix right = C_vv - i.A.transpose() * av - va * j.A;
  const Matrix Y = linalg::solve_sylvester(shifted(modes_i.modes.T(), k), shifted(modes_j.modes.T(), k),
                                           linalg::multiply(linalg::multiply_transposed(U_i, right), U_j));
  const Matrix vv = linalg::multiply(linalg::multiply(U_i, Y), U_j.transpose());  // eq. (4)

  // Back to displacements: Q' and the rows J from both sides.
  Matrix on_v = j.from_v(vv.transpose()).transpose(), on_a = j.from_v(av.transpose()).transpose();
  on_v(Eigen::all, j.J) += va;
  on_a(Eigen::all, j.J) += aa;
  Matrix X = i.from_v(on_v);
  X(i.J, Eigen::all) += on_a;
  return X;
}

}  // namespace

Matrix solve_lyapunov(const SuperElementSolution& solution, const ModalSolution& modal, double k, bool coupled,
                      int threads, const std::function<Matrix(const Block&, const Block&)>& C) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < solution.blocks.size(); ++i)
    for (std::size_t j = i; j < solution.blocks.size(); ++j)
      if (j == i || coupled) pairs.emplace_back(i, j);

  std::vector<Matrix> parts(pairs.size());
  linalg::parallel_for(static_cast<int>(pairs.size()), threads, [&](int number) {
    const auto [i, j] = pairs[static_cast<std::size_t>(number)];
    const Block &one = solution.blocks[i], &other = solution.blocks[j];
    parts[static_cast<std::size_t>(number)] =
        solve_between(one, modal.blocks[i], other, modal.blocks[j], k, C(one, other));
  });
  const Eigen::Index n = solution.K.rows();
  Matrix X = Matrix::Zero(n, n);
  for (std::size_t number = 0; number < pairs.size(); ++number) {
    const auto [i, j] = pairs[number];
    const Matrix part = solution.blocks[i].T * parts[number] * solution.blocks[j].T.transpose();
    X += i == j ? part : Matrix(part + part.transpose());
  }
  return 0.5 * (X + X.transpose());
}

}  // namespace scabo::element
