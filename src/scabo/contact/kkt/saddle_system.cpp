#include "scabo/contact/kkt/saddle_system.hpp"

#include "scabo/linalg/general_solver.hpp"

namespace scabo::contact {

struct SaddleSystem::Backend {
  virtual ~Backend() = default;
  /// Rows of the matrix multiplied by `row`.
  virtual bool factorise(const SaddleRows& rows, const Vector& row) = 0;
  virtual Vector solve(const Vector& b) const = 0;
  virtual Vector product(const Vector& x) const = 0;
};

struct SaddleSystem::Dense : Backend {
  explicit Dense(const Problem& of) : problem(of) {}

  bool factorise(const SaddleRows& rows, const Vector& row) override {
    A.resize(row.size(), row.size());
    assemble_dense(problem, rows, moved, A);
    A.array().colwise() *= row.array();
    LU = A;
    return solver.factorise(LU, A.rows());
  }
  Vector solve(const Vector& b) const override {
    Vector x = b;
    solver.solve_in_place(x);
    return x;
  }
  Vector product(const Vector& x) const override { return A * x; }

  const Problem& problem;
  Vector moved;
  Matrix A, LU;
  linalg::GeneralSolver solver;
};

struct SaddleSystem::Sparse : Backend {
  explicit Sparse(const Problem& problem) : saddle(problem) {}

  bool factorise(const SaddleRows& rows, const Vector& row) override {
    saddle.assemble(rows, A);
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      for (Eigen::SparseMatrix<double>::InnerIterator it(A, j); it; ++it) it.valueRef() *= row[it.row()];
    return saddle.factorise(rows, A);
  }
  Vector solve(const Vector& b) const override {
    Vector x;
    saddle.factor().solve(b, x);
    return x;
  }
  Vector product(const Vector& x) const override { return A * x; }

  SparseSaddle saddle;
  Eigen::SparseMatrix<double> A;
};

SaddleSystem::SaddleSystem(const Problem& problem) : motions_(problem.G.cols()) {
  if (problem.W.is_sparse())
    backend_ = std::make_unique<Sparse>(problem);
  else
    backend_ = std::make_unique<Dense>(problem);
}
SaddleSystem::~SaddleSystem() = default;
SaddleSystem::SaddleSystem(SaddleSystem&&) noexcept = default;

bool SaddleSystem::factorise(const SaddleRows& rows) {
  row_.setOnes(rows.size() + motions_);
  row_.head(rows.size()) = (1.0 + rows.D.head(rows.size()).array()).inverse();
  return backend_->factorise(rows, row_);
}

Vector SaddleSystem::solve(const Vector& right) const {
  const Vector b = row_.cwiseProduct(right), x = backend_->solve(b);
  return x + backend_->solve(b - backend_->product(x));
}

}  // namespace scabo::contact
