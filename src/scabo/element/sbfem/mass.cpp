#include "scabo/element/sbfem/mass.hpp"

#include "scabo/linalg/parallel.hpp"
#include "scabo/linalg/sylvester.hpp"

namespace scabo::element {

namespace {

Matrix shifted(const Matrix& T, double shift) { return T + shift * Matrix::Identity(T.rows(), T.cols()); }

/// X_va of eq. (4) for one block.
Matrix solve_mixed(const ModalBlock& modes, const Matrix& right) {
  const Matrix& U = modes.modes.U();
  const Matrix twice = 2.0 * Matrix::Identity(right.cols(), right.cols());
  return U * linalg::solve_sylvester(modes.modes.T(), twice, U.transpose() * right);
}

/// The part of M between two symmetry blocks, in their coordinates: n_k x n_l.
Matrix mass_between(const Block& k, const ModalBlock& modes_k, const Block& l, const ModalBlock& modes_l,
                    const Eigen::SparseMatrix<double>& M0) {
  const Matrix M0_kl = Eigen::SparseMatrix<double>(k.T.transpose() * M0 * l.T);
  const Matrix M0_k = M0_kl * l.R, M0_l = M0_kl(Eigen::all, l.I);  // the sides of l: on a, on v
  const Matrix M0_vv = k.on_v(M0_l), M0_va = k.on_v(M0_k), M0_av = k.on_a(M0_l), M0_aa = k.on_a(M0_k);

  const Matrix aa = 0.5 * M0_aa;                                         // eq. (3)
  const Matrix va = solve_mixed(modes_k, M0_va - k.A.transpose() * aa);  // eq. (4)
  const Matrix av = solve_mixed(modes_l, (M0_av - aa * l.A).transpose()).transpose();
  const Matrix &U_k = modes_k.modes.U(), &U_l = modes_l.modes.U();
  const Matrix right = M0_vv - k.A.transpose() * av - va * l.A;
  const Matrix Y = linalg::solve_sylvester(shifted(modes_k.modes.T(), 1.0), shifted(modes_l.modes.T(), 1.0),
                                           linalg::multiply(linalg::multiply_transposed(U_k, right), U_l));
  const Matrix vv = linalg::multiply(linalg::multiply(U_k, Y), U_l.transpose());  // eq. (5)

  // Back to displacements: Q' and the rows J from both sides.
  Matrix on_v = l.from_v(vv.transpose()).transpose(), on_a = l.from_v(av.transpose()).transpose();
  on_v(Eigen::all, l.J) += va;
  on_a(Eigen::all, l.J) += aa;
  Matrix M = k.from_v(on_v);
  M(k.J, Eigen::all) += on_a;
  return M;
}

}  // namespace

Matrix mass_matrix(const Eigen::SparseMatrix<double>& M0, const SuperElementSolution& solution,
                   const ModalSolution& modal, bool coupled, int threads) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t k = 0; k < solution.blocks.size(); ++k)
    for (std::size_t l = k; l < solution.blocks.size(); ++l)
      if (l == k || coupled) pairs.emplace_back(k, l);

  std::vector<Matrix> parts(pairs.size());
  linalg::parallel_for(static_cast<int>(pairs.size()), threads, [&](int i) {
    const auto [k, l] = pairs[static_cast<std::size_t>(i)];
    parts[static_cast<std::size_t>(i)] =
        mass_between(solution.blocks[k], modal.blocks[k], solution.blocks[l], modal.blocks[l], M0);
  });
  const Eigen::Index n = M0.rows();
  Matrix M = Matrix::Zero(n, n);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto [k, l] = pairs[i];
    const Matrix part = solution.blocks[k].T * parts[i] * solution.blocks[l].T.transpose();
    M += k == l ? part : Matrix(part + part.transpose());
  }
  return 0.5 * (M + M.transpose());
}

}  // namespace scabo::element
