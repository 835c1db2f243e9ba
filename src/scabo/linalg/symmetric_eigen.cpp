#include "scabo/linalg/symmetric_eigen.hpp"

#include <Spectra/SymGEigsShiftSolver.h>
#include <lapacke.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <new>
#include <random>
#include <vector>

#include "scabo/base/error.hpp"
#include "scabo/base/interruption.hpp"

namespace scabo::linalg {

namespace {

/// Interface required by Spectra for (A - sigma B)^-1; sigma is 0 here.
class Inverse {
 public:
  using Scalar = double;
  Inverse(const Operator& inverse, Eigen::Index n, double factor) : inverse_(inverse), n_(n), factor_(factor) {}
  Eigen::Index rows() const { return n_; }
  Eigen::Index cols() const { return n_; }
  void set_shift(double) {}
  void perform_op(const double* x, double* y) const {
    interruption_point();
    Eigen::Map<Vector>(y, n_) = factor_ * inverse_(Eigen::Map<const Vector>(x, n_));
  }

 private:
  const Operator& inverse_;
  Eigen::Index n_;
  double factor_;
};

class Product {
 public:
  using Scalar = double;
  explicit Product(const Eigen::SparseMatrix<double>& B) : B_(B) {}
  Eigen::Index rows() const { return B_.rows(); }
  Eigen::Index cols() const { return B_.cols(); }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Vector>(y, B_.rows()) = B_ * Eigen::Map<const Vector>(x, B_.cols());
  }

 private:
  const Eigen::SparseMatrix<double>& B_;
};

/// A power of four near x > 0: scaling by it and by its root changes no digit.
double power_of_four(double x) {
  int exponent = 0;
  std::frexp(x, &exponent);
  return std::ldexp(1.0, 2 * (exponent / 2));
}

}  // namespace

EigenPairs largest_eigenpairs(Matrix A, Matrix B, int count) {
  const auto n = static_cast<int>(A.rows());
  ensure(A.cols() == n && B.rows() == n && B.cols() == n && count <= n, "largest_eigenpairs: sizes differ");
  if (count <= 0) return {Vector(0), Matrix(n, 0)};
  Vector values(n);
  Matrix vectors(n, count);
  int found = 0;
  std::vector<int> failed(static_cast<std::size_t>(n));
  const int info =
      LAPACKE_dsygvx(LAPACK_COL_MAJOR, 1, 'V', 'I', 'L', n, A.data(), n, B.data(), n, 0.0, 0.0, n - count + 1, n,
                     2.0 * LAPACKE_dlamch('S'), &found, values.data(), vectors.data(), n, failed.data());
  if (info == LAPACK_WORK_MEMORY_ERROR) throw std::bad_alloc();
  ensure(info == 0 && found == count, "eigenvalues of a pair of symmetric matrices were not found");
  return {values.head(count).reverse(), vectors.rowwise().reverse()};
}

EigenPairs largest_by_lanczos(const Operator& inverse, const Eigen::SparseMatrix<double>& B, int count,
                              unsigned start) {
  const auto n = static_cast<int>(B.rows());
  ensure(count > 0 && count < n, "largest_by_lanczos: needs fewer eigenvalues than there are");
  std::mt19937 random(start + 1);
  Vector residual(n);
  for (double& value : residual) value = std::uniform_real_distribution<double>(-1.0, 1.0)(random);
  residual = inverse(B * residual);  // no part outside the range of `inverse`
  const auto size_of = [&](const Vector& x) { return std::sqrt(x.dot(B * x)); };
  const double size = size_of(residual), next = size_of(inverse(B * residual));
  ensure(size > 0.0 && next > 0.0, "largest_by_lanczos: the operator is not positive");
  // Spectra compares eigenvalues and entries of vectors with fixed numbers. Here both are near 1 in all units.
  const double values = power_of_four(next / size), masses = power_of_four(B.diagonal().mean());
  const Eigen::SparseMatrix<double> scaled = B / masses;
  Inverse op(inverse, n, masses / values);
  Product product(scaled);
  const int basis = std::min(n, std::max(2 * count + 1, count + 20));
  Spectra::SymGEigsShiftSolver<Inverse, Product, Spectra::GEigsMode::ShiftInvert> solver(op, product, count, basis,
                                                                                         0.0);
  residual *= std::sqrt(masses) / size;
  solver.init(residual.data());
  solver.compute(Spectra::SortRule::LargestMagn, 300, 1e-12, Spectra::SortRule::SmallestAlge);
  const Vector eigenvalues = solver.eigenvalues();
  return {values * eigenvalues.cwiseInverse(), solver.eigenvectors() / std::sqrt(masses)};
}

int eigenvalues_below(const Eigen::SparseMatrix<double>& A, const Eigen::SparseMatrix<double>& B, double shift) {
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(A - shift * B);
  if (factor.info() != Eigen::Success) return -1;
  return static_cast<int>((factor.vectorD().array() < 0.0).count());
}

}  // namespace scabo::linalg
