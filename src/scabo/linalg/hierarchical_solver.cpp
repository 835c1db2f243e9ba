#include "scabo/linalg/hierarchical_solver.hpp"

#include <cblas.h>
#include <lapacke.h>

#include <algorithm>
#include <random>

#include "scabo/base/error.hpp"
#include "scabo/base/interruption.hpp"
#include "scabo/linalg/decompositions.hpp"

namespace scabo::linalg {

namespace {

using Index = Eigen::Index;

constexpr Index smallest_block = 96;   // unknowns that are not halved
constexpr Index vectors_at_once = 40;  // random, of which the last eight test the others
constexpr Index testing_vectors = 8;
constexpr Index most_rank = 200;  // beyond, of more than 4 x most_rank unknowns, an LU costs as much

/// result = alpha op(A) B + beta result, by BLAS.
void multiply(bool transposed, const Matrix& A, const double* B, Index columns, Index stride_B, double alpha,
              double beta, double* result, Index stride) {
  const Index rows = transposed ? A.cols() : A.rows(), inner = transposed ? A.rows() : A.cols();
  if (rows == 0 || columns == 0) return;
  cblas_dgemm(CblasColMajor, transposed ? CblasTrans : CblasNoTrans, CblasNoTrans, static_cast<int>(rows),
              static_cast<int>(columns), static_cast<int>(inner), alpha, A.data(),
              static_cast<int>(std::max<Index>(A.rows(), 1)), B, static_cast<int>(stride_B), beta, result,
              static_cast<int>(stride));
}

Matrix product(bool transposed, const Matrix& A, const Matrix& B) {
  Matrix result = Matrix::Zero(transposed ? A.cols() : A.rows(), B.cols());
  if (A.size() > 0 && B.size() > 0)
    multiply(transposed, A, B.data(), B.cols(), B.rows(), 1.0, 0.0, result.data(), result.rows());
  return result;
}

/// The first `columns` columns of an orthonormal basis of those of Y.
Matrix orthonormal(const Matrix& Y, Index columns) {
  const Eigen::HouseholderQR<Matrix> qr(Y.leftCols(columns));
  return qr.householderQ() * Matrix::Identity(Y.rows(), columns);
}

/// block = U V, V k x n; false where k would be too large.
bool compress(const Matrix& block, double tolerance, Matrix& U, Matrix& V) {
  const Index m = block.rows(), n = block.cols(), least = std::min(m, n);
  std::minstd_rand random(static_cast<unsigned>(m + 1));
  const auto number = [&] {
    return static_cast<double>(random() >> 8) / static_cast<double>(std::minstd_rand::max() >> 8) - 0.5;
  };
  Matrix Y(m, 0);
  for (Index vectors = vectors_at_once; 2 * (vectors - testing_vectors) < least; vectors += vectors_at_once) {
    if (vectors - testing_vectors > most_rank && least > 4 * most_rank) return false;
    Matrix omega(n, vectors_at_once);
    for (double& entry : omega.reshaped()) entry = number();
    Y.conservativeResize(m, vectors);
    Y.rightCols(vectors_at_once) = product(false, block, omega);
    if (!Y.rightCols(vectors_at_once).allFinite()) return false;
    const Matrix last = Y.rightCols(testing_vectors);
    const double norm = last.norm();
    if (norm == 0.0) {
      U.resize(m, 0);
      V.resize(0, n);
      return true;
    }
    U = orthonormal(Y, vectors - testing_vectors);
    Matrix left = last;
    left.noalias() -= product(false, U, product(true, U, last));
    if (left.norm() > tolerance * norm) continue;
    V = product(true, U, block);
    return true;
  }
  if (m <= n) {  // as it is
    U.setIdentity(m, m);
    V = block;
  } else {
    U = block;
    V.setIdentity(n, n);
  }
  return V.allFinite() && U.allFinite();
}

bool factorise_lu(Matrix& A, std::vector<int>& pivots) {
  const auto n = static_cast<int>(A.rows());
  pivots.resize(static_cast<std::size_t>(n));
  if (n == 0) return true;
  return LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, A.data(), n, pivots.data()) == 0 && A.diagonal().allFinite();
}

void solve_lu(const Matrix& lu, const std::vector<int>& pivots, double* x, Index columns, Index stride) {
  const auto n = static_cast<int>(lu.rows());
  if (n > 0 && columns > 0)
    LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', n, static_cast<int>(columns), lu.data(), n, pivots.data(), x,
                        static_cast<int>(stride));
}

}  // namespace

bool HierarchicalSolver::factorise(Index size, const Fill& fill, double tolerance) {
  size_ = size;
  largest_rank_ = 0;
  nodes_.clear();
  return factorise(divide(0, size), fill, tolerance);
}

/// Halves before the whole, so that the last node is all of A.
int HierarchicalSolver::divide(Index first, Index size) {
  Node node;
  node.first = first;
  node.size = size;
  if (size > smallest_block) {
    node.halves[0] = divide(first, size / 2);
    node.halves[1] = divide(first + size / 2, size - size / 2);
  }
  nodes_.push_back(std::move(node));
  return static_cast<int>(nodes_.size()) - 1;
}

/// The largest blocks first: if the ranks are too large for this to pay, it turns out there.
bool HierarchicalSolver::factorise(int number, const Fill& fill, double tolerance) {
  interruption_point();
  Node& node = nodes_[static_cast<std::size_t>(number)];
  if (node.halves[0] < 0) {
    node.lu.resize(node.size, node.size);
    fill(node.first, node.first, node.lu);
    return factorise_lu(node.lu, node.pivots);
  }
  const Node &one = nodes_[static_cast<std::size_t>(node.halves[0])],
             &two = nodes_[static_cast<std::size_t>(node.halves[1])];
  {
    Matrix block(one.size, two.size);
    fill(one.first, two.first, block);
    if (!compress(block, tolerance, node.Z[0], node.V[0])) return false;
    block.resize(two.size, one.size);
    fill(two.first, one.first, block);
    if (!compress(block, tolerance, node.Z[1], node.V[1])) return false;
  }
  for (const int half : node.halves)
    if (!factorise(half, fill, tolerance)) return false;
  solve(node.halves[0], node.Z[0].data(), node.Z[0].cols(), std::max<Index>(one.size, 1));
  solve(node.halves[1], node.Z[1].data(), node.Z[1].cols(), std::max<Index>(two.size, 1));
  const Index k1 = node.V[0].rows(), k2 = node.V[1].rows();
  largest_rank_ = std::max({largest_rank_, k1, k2});
  node.lu.setIdentity(k1 + k2, k1 + k2);
  node.lu.topRightCorner(k1, k2) = product(false, node.V[0], node.Z[1]);
  node.lu.bottomLeftCorner(k2, k1) = product(false, node.V[1], node.Z[0]);
  return factorise_lu(node.lu, node.pivots);
}

/// x, of the unknowns of the node only, becomes A_node^-1 x.
void HierarchicalSolver::solve(int number, double* x, Index columns, Index stride) const {
  if (columns == 0) return;
  const Node& node = nodes_[static_cast<std::size_t>(number)];
  if (node.halves[0] < 0) {
    solve_lu(node.lu, node.pivots, x, columns, stride);
    return;
  }
  double* const second = x + nodes_[static_cast<std::size_t>(node.halves[0])].size;
  solve(node.halves[0], x, columns, stride);
  solve(node.halves[1], second, columns, stride);
  const Index k1 = node.V[0].rows(), k2 = node.V[1].rows();
  Matrix w(k1 + k2, columns);
  if (w.size() == 0) return;
  multiply(false, node.V[0], second, columns, stride, 1.0, 0.0, w.data(), k1 + k2);
  multiply(false, node.V[1], x, columns, stride, 1.0, 0.0, w.data() + k1, k1 + k2);
  solve_lu(node.lu, node.pivots, w.data(), columns, k1 + k2);
  if (k1 > 0) multiply(false, node.Z[0], w.data(), columns, k1 + k2, -1.0, 1.0, x, stride);
  if (k2 > 0) multiply(false, node.Z[1], w.data() + k1, columns, k1 + k2, -1.0, 1.0, second, stride);
}

void HierarchicalSolver::solve(const Vector& x, Vector& result) const {
  ensure(x.size() == size_, "HierarchicalSolver: sizes differ");
  result = x;
  if (size_ > 0) solve(static_cast<int>(nodes_.size()) - 1, result.data(), 1, size_);
}

}  // namespace scabo::linalg
