#include "support/decompositions.hpp"

#include <Eigen/Dense>
#include <stdexcept>
#include <unsupported/Eigen/MatrixFunctions>

namespace scabo::test {
namespace {

Eigen::LLT<Matrix> factorised(const Matrix& A) {
  const Eigen::LLT<Matrix> root(A);
  if (root.info() != Eigen::Success) throw std::domain_error("the matrix is not positive definite");
  return root;
}

}  // namespace

Matrix inverse(const Matrix& A) { return A.partialPivLu().inverse(); }
Matrix solve_lu(const Matrix& A, const Matrix& B) { return A.partialPivLu().solve(B); }
double determinant(const Matrix& A) { return A.partialPivLu().determinant(); }
ComplexMatrix complex_inverse(const ComplexMatrix& A) { return A.fullPivLu().inverse(); }
ComplexMatrix complex_solve_lu(const ComplexMatrix& A, const ComplexMatrix& B) { return A.fullPivLu().solve(B); }

Matrix solve_cholesky(const Matrix& A, const Matrix& B) { return factorised(A).solve(B); }
Matrix solve_ldlt(const Matrix& A, const Matrix& B) { return A.ldlt().solve(B); }
Matrix cholesky_factor(const Matrix& A) { return factorised(A).matrixL(); }
bool is_positive_definite(const Matrix& A) { return Eigen::LLT<Matrix>(A).info() == Eigen::Success; }

Matrix least_squares(const Matrix& A, const Matrix& B) { return A.colPivHouseholderQr().solve(B); }
Matrix orthonormal_columns(const Matrix& A) {
  return Eigen::HouseholderQR<Matrix>(A).householderQ() * Matrix::Identity(A.rows(), A.cols());
}

SingularValues singular_value_decomposition(const Matrix& A) {
  const Eigen::JacobiSVD<Matrix> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

Vector singular_values(const Matrix& A) { return singular_value_decomposition(A).values; }

Eigen::Index rank(const Matrix& A, double tolerance) {
  const Vector values = singular_values(A);
  return values.size() == 0 ? 0 : (values.array() > tolerance * values[0]).count();
}

Matrix null_space(const Matrix& A, double tolerance) {
  if (A.size() == 0) return Matrix::Identity(A.cols(), A.cols());
  const Eigen::JacobiSVD<Matrix> svd(A, Eigen::ComputeFullV);
  const Vector values = svd.singularValues();
  const Eigen::Index range = (values.array() > tolerance * values[0]).count();
  return svd.matrixV().rightCols(A.cols() - range);
}

SymmetricEigen symmetric_eigen(const Matrix& A) {
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(A);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Vector symmetric_eigenvalues(const Matrix& A) {
  return Eigen::SelfAdjointEigenSolver<Matrix>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

Vector symmetric_eigenvalues(const Matrix& A, const Matrix& B) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix>(A, B, Eigen::EigenvaluesOnly | Eigen::Ax_lBx).eigenvalues();
}

ComplexEigen complex_eigen(const Matrix& A) {
  const Eigen::EigenSolver<Matrix> eigen(A);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

ComplexVector eigenvalues(const Matrix& A) { return Eigen::EigenSolver<Matrix>(A, false).eigenvalues(); }

Matrix exponential(const Matrix& A) { return A.exp(); }

}  // namespace scabo::test
