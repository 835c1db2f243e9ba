#include "scabo/contact/kkt/saddle_system.hpp"

#include <utility>

#include "scabo/contact/kkt/rigid_system.hpp"
#include "scabo/linalg/general_solver.hpp"

namespace scabo::contact {

struct SaddleSystem::Backend {
  virtual ~Backend() = default;
  virtual bool factorise(const SaddleRows& rows) = 0;
  virtual void solve(const Vector& b, Vector& x) const = 0;
};

struct SaddleSystem::Dense : Backend {
  explicit Dense(const Problem& of) : problem(of) {}

  bool factorise(const SaddleRows& rows) override {
    const Eigen::Index n = rows.size() + problem.G.cols();
    LU.resize(n, n);
    assemble_dense(problem, rows, moved, LU);
    return solver.factorise(LU, n);
  }
  void solve(const Vector& b, Vector& x) const override { solver.solve_in_place(x = b); }

  const Problem& problem;
  Vector moved;
  Matrix LU;
  linalg::GeneralSolver solver;
};

struct SaddleSystem::Sparse : Backend {
  explicit Sparse(const Problem& problem) : saddle(problem) {}

  bool factorise(const SaddleRows& rows) override {
    saddle.assemble(rows, A);
    return saddle.factorise(rows, A);
  }
  void solve(const Vector& b, Vector& x) const override { saddle.factor().solve(b, x); }

  SparseSaddle saddle;
  Eigen::SparseMatrix<double> A;
};

struct SaddleSystem::Rigid : Backend {
  explicit Rigid(std::unique_ptr<RigidSystem> of) : bodies(std::move(of)) {}

  bool factorise(const SaddleRows& rows) override { return bodies->factorise(rows, rows.D); }
  void solve(const Vector& b, Vector& x) const override { bodies->solve(b, x); }

  std::unique_ptr<RigidSystem> bodies;
};

SaddleSystem::SaddleSystem(const Problem& problem) : problem_(problem) {
  if (std::unique_ptr<RigidSystem> rigid = RigidSystem::of(problem))
    backend_ = std::make_unique<Rigid>(std::move(rigid));
  else if (problem.W.is_sparse())
    backend_ = std::make_unique<Sparse>(problem);
  else
    backend_ = std::make_unique<Dense>(problem);
}
SaddleSystem::~SaddleSystem() = default;
SaddleSystem::SaddleSystem(SaddleSystem&&) noexcept = default;

bool SaddleSystem::factorise(const SaddleRows& rows) {
  rows_ = rows;
  row_.setOnes(rows.size() + problem_.G.cols());
  row_.head(rows.size()) = (1.0 + rows.D.head(rows.size()).array()).inverse();
  for (Eigen::Index j = 0; j < rows.size(); ++j) rows_.L.col(j) *= row_[j], rows_.D[j] *= row_[j];
  return backend_->factorise(rows_);
}

Vector SaddleSystem::solve(const Vector& right) const {
  const Vector b = row_.cwiseProduct(right);
  Vector x, more;
  backend_->solve(b, x);
  backend_->solve(b - rows_.times(problem_, x), more);
  return x + more;
}

}  // namespace scabo::contact
