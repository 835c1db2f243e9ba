#include "scabo/element/sbfem/mass.hpp"

#include "scabo/element/sbfem/lyapunov.hpp"

namespace scabo::element {

Matrix mass_matrix(const Eigen::SparseMatrix<double>& M0, const SuperElementSolution& solution,
                   const ModalSolution& modal, bool coupled, int threads) {
  return solve_lyapunov(solution, modal, 1.0, coupled, threads, [&](const Block& i, const Block& j) {
    return Matrix(Eigen::SparseMatrix<double>(i.T.transpose() * M0 * j.T));
  });
}

}  // namespace scabo::element
