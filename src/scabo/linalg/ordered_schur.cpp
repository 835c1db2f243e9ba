#include "scabo/linalg/ordered_schur.hpp"

#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>
#include <unsupported/Eigen/MatrixFunctions>

#include "scabo/base/error.hpp"
#include "scabo/linalg/decompositions.hpp"

namespace scabo::linalg {

namespace {

std::vector<std::complex<double>> eigenvalues_of(const Matrix& T) {
  std::vector<std::complex<double>> values;
  for (Eigen::Index i = 0; i < T.rows(); ++i) {
    const bool pair = pair_begins(T, i);
    // LAPACK's standard form: equal diagonal, off-diagonal entries of opposite sign.
    const std::complex<double> value(T(i, i),
                                     pair ? std::sqrt(std::abs(T(i, i + 1))) * std::sqrt(std::abs(T(i + 1, i))) : 0.0);
    values.push_back(value);
    if (pair) values.push_back(std::conj(value)), ++i;
  }
  return values;
}

int length(Eigen::Index value) { return static_cast<int>(value); }

/// X of op(A) X + sign X B = C, A and B quasi-triangular.
Matrix sylvester(char operation, const Matrix& A, const Matrix& B, Matrix C, int sign) {
  if (C.size() == 0) return C;
  double scale = 1.0;
  const int info = LAPACKE_dtrsyl(LAPACK_COL_MAJOR, operation, 'N', sign, length(A.rows()), length(B.rows()), A.data(),
                                  length(A.rows()), B.data(), length(B.rows()), C.data(), length(C.rows()), &scale);
  ensure(info >= 0, "dtrsyl refused its arguments");
  ensure(info == 0, "two groups of exponents are too close to be separated");
  return C / scale;
}

/// A position near the middle that does not split a pair.
Eigen::Index middle_of(const Matrix& T) {
  const Eigen::Index half = T.rows() / 2;
  return T(half, half - 1) != 0.0 ? half + 1 : half;
}

/// Solves A'X + X B = C. dtrsyl works column by column; halving the longer side leaves small blocks for it and turns
/// the remaining work into products of matrices.
Matrix halved_sylvester(const Matrix& A, const Matrix& B, const Matrix& C) {
  constexpr Eigen::Index small = 48;
  const Eigen::Index m = A.rows(), n = B.rows();
  if (std::max(m, n) <= small) return sylvester('T', A, B, C, 1);
  Matrix X(m, n);
  if (m >= n) {
    const Eigen::Index k = middle_of(A);
    const Matrix upper = halved_sylvester(A.topLeftCorner(k, k), B, C.topRows(k));
    Matrix rest = C.bottomRows(m - k);
    rest -= multiply_transposed(A.topRightCorner(k, m - k), upper);
    X << upper, halved_sylvester(A.bottomRightCorner(m - k, m - k), B, rest);
  } else {
    const Eigen::Index k = middle_of(B);
    const Matrix left = halved_sylvester(A, B.topLeftCorner(k, k), C.leftCols(k));
    Matrix rest = C.rightCols(n - k);
    add_product(-1.0, left, B.topRightCorner(k, n - k), rest);
    X << left, halved_sylvester(A, B.bottomRightCorner(n - k, n - k), rest);
  }
  return X;
}

}  // namespace

OrderedSchur::OrderedSchur(const Matrix& S, const GroupOf& group_of) : schur_(real_schur(S)) {
  Matrix& T = schur_.T;
  const int n = length(T.rows());
  const auto rank_at = [&](int row) {
    return group_of(
        eigenvalues_of(T.block(row, row, pair_begins(T, row) ? 2 : 1, pair_begins(T, row) ? 2 : 1)).front());
  };
  // Insertion sort of the diagonal blocks by neighbour swaps (dtrexc), stable within a group.
  for (int done = 0; done < n;) {
    int best = done, best_rank = rank_at(done);
    for (int row = done; row < n; row += pair_begins(T, row) ? 2 : 1)
      if (const int rank = rank_at(row); rank < best_rank) best = row, best_rank = rank;
    const int size = pair_begins(T, best) ? 2 : 1;
    if (best != done) {
      lapack_int from = best + 1, to = done + 1;  // LAPACK counts from 1
      const int info = LAPACKE_dtrexc(LAPACK_COL_MAJOR, 'V', n, T.data(), n, schur_.U.data(), n, &from, &to);
      if (info == LAPACK_WORK_MEMORY_ERROR) throw std::bad_alloc();
      ensure(info == 0, "two groups of exponents are too close to be separated");
    }
    for (int i = 0; i < size; ++i) groups_.push_back(best_rank);
    done += size;
  }
  eigenvalues_ = eigenvalues_of(T);
}

InvariantSubspace OrderedSchur::subspace(int first, int count) const {
  const Matrix &T = schur_.T, &U = schur_.U;
  const Eigen::Index n = T.rows(), rest = n - first - count;
  ensure(first >= 0 && count >= 0 && rest >= 0, "a group of exponents is out of range");
  InvariantSubspace result;
  result.eigenvalues.assign(eigenvalues_.begin() + first, eigenvalues_.begin() + first + count);
  result.T = T.block(first, first, count, count);
  result.V = U.middleCols(first, count);
  result.Q = result.V.transpose();
  if (count == 0) return result;
  const Matrix Y =
      sylvester('N', T.topLeftCorner(first, first), result.T, -T.block(0, first, first, count), -1);  // eq. (1)
  const Matrix W =
      sylvester('N', result.T, T.bottomRightCorner(rest, rest), T.block(first, first + count, count, rest), -1);
  result.V += multiply(U.leftCols(first), Y);  // eq. (2)
  result.Q += multiply(W, U.rightCols(rest).transpose());
  // |V Q| from small matrices: V'V = 1 + Y'Y, Q Q' = 1 + W W'.
  const Matrix identity = Matrix::Identity(count, count);
  const Matrix left = (identity + Y.transpose() * Y).llt().matrixU(),
               right = (identity + W * W.transpose()).llt().matrixL();
  result.projection_norm = Eigen::JacobiSVD<Matrix>(left * right).singularValues()[0];
  return result;
}

InvariantSubspace OrderedSchur::group(int group) const {
  const auto [begin, end] = std::equal_range(groups_.begin(), groups_.end(), group);
  return subspace(static_cast<int>(begin - groups_.begin()), static_cast<int>(end - begin));
}

std::vector<int> clusters(const std::vector<std::complex<double>>& eigenvalues, double gap) {
  const std::size_t n = eigenvalues.size();
  std::vector<int> of(n);
  std::iota(of.begin(), of.end(), 0);
  const auto join = [&](int a, int b) {
    for (int& cluster : of)
      if (cluster == b) cluster = a;
  };
  // The eigenvalue in the upper half plane represents a pair.
  const auto folded = [&](std::size_t i) {
    return std::complex<double>(eigenvalues[i].real(), std::abs(eigenvalues[i].imag()));
  };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      if (of[i] != of[j] && std::abs(folded(i) - folded(j)) <= gap) join(of[i], of[j]);
  std::vector<std::pair<double, int>> means;
  for (std::size_t c = 0; c < n; ++c) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < n; ++i)
      if (of[i] == static_cast<int>(c)) sum += eigenvalues[i].real(), ++count;
    if (count > 0) means.emplace_back(sum / count, static_cast<int>(c));
  }
  std::sort(means.begin(), means.end());
  std::vector<int> number(n, 0);
  for (std::size_t k = 0; k < means.size(); ++k)
    number[static_cast<std::size_t>(means[k].second)] = static_cast<int>(k);
  for (int& cluster : of) cluster = number[static_cast<std::size_t>(cluster)];
  return of;
}

bool is_defective(const Matrix& T, const std::vector<std::complex<double>>& eigenvalues, double spread) {
  for (Eigen::Index i = 0; i < T.rows(); ++i)
    for (Eigen::Index j = i + 1; j < T.rows(); ++j) {
      const double apart =
          std::abs(eigenvalues[static_cast<std::size_t>(i)] - eigenvalues[static_cast<std::size_t>(j)]);
      if (apart > spread) continue;
      const double coupling = std::max(std::abs(T(i, j)), std::abs(T(j, i)));
      if (coupling > 1e-6 && coupling > 10.0 * apart) return true;
    }
  return false;
}

Matrix small_exponential(const Matrix& T, double s) {
  if (T.rows() == 0) return T;
  return Matrix(T * s).exp();
}

Matrix solve_lyapunov(const Matrix& T, const Matrix& P) { return halved_sylvester(T, T, P); }

}  // namespace scabo::linalg
