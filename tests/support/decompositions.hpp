// Decompositions of small dense matrices for tests, compiled once. Each of Eigen's decompositions takes seconds to
// compile wherever it is used; here they are plain functions of matrices. A test that needs another one adds it here.
// Where a test only multiplies, or inverts a matrix of fixed size (Mat2, Mat3), Eigen itself is as cheap.
//
// Right-hand sides are matrices; a vector is one column, and the result can be assigned to a Vector.
#pragma once

#include "scabo/base/types.hpp"

namespace scabo::test {

using ComplexVector = Eigen::VectorXcd;
using ComplexMatrix = Eigen::MatrixXcd;

/// A^-1 and A^-1 B by LU with partial pivoting; A is square and regular.
Matrix inverse(const Matrix& A);
Matrix solve_lu(const Matrix& A, const Matrix& B);
double determinant(const Matrix& A);

/// The same of complex matrices, with full pivoting.
ComplexMatrix complex_inverse(const ComplexMatrix& A);
ComplexMatrix complex_solve_lu(const ComplexMatrix& A, const ComplexMatrix& B);

/// A^-1 B of a symmetric A: by L L', which must be positive definite (std::domain_error otherwise), or by L D L' with
/// pivots, which need not.
Matrix solve_cholesky(const Matrix& A, const Matrix& B);
Matrix solve_ldlt(const Matrix& A, const Matrix& B);

/// L of A = L L', lower triangle; std::domain_error where A is not positive definite.
Matrix cholesky_factor(const Matrix& A);
bool is_positive_definite(const Matrix& A);

/// x of least |A x - b| for each column of B, by QR with pivots; rows(A) >= columns(A).
Matrix least_squares(const Matrix& A, const Matrix& B);

/// Orthonormal columns that span those of A, by QR; A has full column rank.
Matrix orthonormal_columns(const Matrix& A);

/// A = U diag(values) V', values descending; U and V have as many columns as there are values.
struct SingularValues {
  Matrix U;
  Vector values;
  Matrix V;
};
SingularValues singular_value_decomposition(const Matrix& A);
Vector singular_values(const Matrix& A);

/// Number of singular values above tolerance times the largest.
Eigen::Index rank(const Matrix& A, double tolerance = 1e-10);

/// Orthonormal columns x with A x = 0: singular values of at most tolerance times the largest.
Matrix null_space(const Matrix& A, double tolerance = 1e-10);

/// A v = value v of a symmetric A, ascending; vectors are the orthonormal columns.
struct SymmetricEigen {
  Vector values;
  Matrix vectors;
};
SymmetricEigen symmetric_eigen(const Matrix& A);
Vector symmetric_eigenvalues(const Matrix& A);

/// A v = value B v of a symmetric pair, B positive definite, ascending.
Vector symmetric_eigenvalues(const Matrix& A, const Matrix& B);

/// A v = value v of any square matrix, in no order; vectors are the columns, each of length 1.
struct ComplexEigen {
  ComplexVector values;
  ComplexMatrix vectors;
};
ComplexEigen complex_eigen(const Matrix& A);
ComplexVector eigenvalues(const Matrix& A);

/// exp(A) by Pade approximants, scaling and squaring.
Matrix exponential(const Matrix& A);

}  // namespace scabo::test
