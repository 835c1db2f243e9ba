// Assembly of the saddle matrix of a problem (saddle_system.hpp), for all who factorise it.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "scabo/contact/kkt/joint_order.hpp"
#include "scabo/contact/problem.hpp"
#include "scabo/linalg/sparse_general_solver.hpp"

namespace scabo::contact {

/// The unknowns of a system, pair after pair.
struct SaddleRows {
  using Columns = Eigen::Matrix<double, 3, Eigen::Dynamic>;
  std::vector<int> pair;  ///< n, ascending
  Columns L, C;           ///< 3 x n, or more columns: memory; in the plane the last row is not used
  Vector D;               ///< n, or more
  double E = 0.0;

  void resize(std::size_t n);
  Eigen::Index size() const { return static_cast<Eigen::Index>(pair.size()); }
  /// C z, added to the first dN numbers of `p`.
  void add_forces(const Vector& z, int dimension, Vector& p) const;
  /// L'u, into the first n numbers of `result`.
  void motions(const Vector& u, int dimension, Vector& result) const;
  /// The saddle matrix times [z; da].
  Vector times(const Problem& problem, const Vector& x) const;
};

/// Into the first n + m rows and columns of `A`, which has them; a W that is not dense is formed. `moved` is memory.
template <typename Scalar>
void assemble_dense(const Problem& problem, const SaddleRows& rows, Vector& moved,
                    Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& A);
extern template void assemble_dense<double>(const Problem&, const SaddleRows&, Vector&, Matrix&);
extern template void assemble_dense<float>(const Problem&, const SaddleRows&, Vector&, Eigen::MatrixXf&);

/// Of a sparse W.
class SparseSaddle {
 public:
  /// Keeps a reference to `problem`.
  explicit SparseSaddle(const Problem& problem);

  void assemble(const SaddleRows& rows, Eigen::SparseMatrix<double>& A);
  /// LU of a matrix with the pattern of that of `rows`, in whole blocks of the pairs. False where a pivot is zero.
  [[nodiscard]] bool factorise(const SaddleRows& rows, const Eigen::SparseMatrix<double>& A);
  const linalg::SparseGeneralSolver& factor() const { return factor_; }

 private:
  void add_motion(const SaddleRows& rows, Eigen::Index pair, Eigen::Index column, Eigen::SparseMatrix<double>& A) const;
  void add_balance(const SaddleRows& rows, Eigen::Index column, Eigen::SparseMatrix<double>& A);

  const Problem& problem_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> by_rows_;  // G
  std::vector<std::size_t> first_;                        // N + 1
  std::vector<int> beside_;         // pairs coupled with pair i: first_[i] .. first_[i + 1], ascending
  std::vector<int> first_of_pair_;  // N + 1, unknowns of the pairs
  SaddleRows::Columns moved_;       // motions of the pairs
  std::vector<std::pair<Eigen::Index, double>> motions_;
  linalg::SparseGeneralSolver factor_;
  std::unique_ptr<JointOrder> order_;
};

}  // namespace scabo::contact
