#include "scabo/contact/kkt/saddle_system.hpp"

#include <algorithm>

#include "scabo/contact/kkt/joint_order.hpp"
#include "scabo/linalg/general_solver.hpp"
#include "scabo/linalg/sparse_general_solver.hpp"

namespace scabo::contact {

using Index = Eigen::Index;

void SaddleRows::resize(std::size_t n) {
  const auto size = static_cast<Index>(n);
  pair.resize(n);
  L.setZero(3, size);
  C.setZero(3, size);
  D.setZero(size);
}

Vector SaddleRows::forces(const Vector& z, int dimension, Index pairs) const {
  Vector p = Vector::Zero(dimension * pairs);
  for (Index j = 0; j < size(); ++j)
    p.segment(dimension * pair[static_cast<std::size_t>(j)], dimension) += z[j] * C.col(j).head(dimension);
  return p;
}

struct SaddleSystem::Backend {
  virtual ~Backend() = default;
  /// Rows of the matrix multiplied by `row`.
  virtual bool factorise(const SaddleRows& rows, const Vector& row) = 0;
  virtual Vector solve(const Vector& b) const = 0;
  virtual Vector product(const Vector& x) const = 0;
};

struct SaddleSystem::Dense : Backend {
  explicit Dense(const Problem& problem) : W(problem.W.dense()), G(problem.G.dense()), d(problem.dimension) {}

  bool factorise(const SaddleRows& rows, const Vector& row) override {
    const Index n = rows.size(), m = G.cols();
    A.resize(n + m, n + m);
    for (Index j = 0; j < n; ++j) {
      const Index from = d * rows.pair[static_cast<std::size_t>(j)];
      moved.noalias() = W.middleCols(from, d) * rows.C.col(j).head(d);
      A.col(j).tail(m).noalias() = G.middleRows(from, d).transpose() * rows.C.col(j).head(d);
      gather(rows, row, j);
      A(j, j) += row[j] * rows.D[j];
    }
    for (Index k = 0; k < m; ++k) {
      moved = G.col(k);
      gather(rows, row, n + k);
      A.col(n + k).tail(m).setZero();
      A(n + k, n + k) = -rows.E;
    }
    LU = A;
    return solver.factorise(LU, n + m);
  }

  /// Rows of `moved`, the motions of the pairs, in column j.
  void gather(const SaddleRows& rows, const Vector& row, Index j) {
    for (Index i = 0; i < rows.size(); ++i)
      A(i, j) = row[i] * rows.L.col(i).head(d).dot(moved.segment(d * rows.pair[static_cast<std::size_t>(i)], d));
  }

  Vector solve(const Vector& b) const override {
    Vector x = b;
    solver.solve_in_place(x);
    return x;
  }
  Vector product(const Vector& x) const override { return A * x; }

  const Matrix& W;
  const Matrix G;
  int d;
  Vector moved;
  Matrix A, LU;
  linalg::GeneralSolver solver;
};

struct SaddleSystem::Sparse : Backend {
  explicit Sparse(const Problem& of)
      : problem(of), by_rows(of.G.cols() > 0 ? Rows(of.G.sparse()) : Rows(of.W.size(), 0)) {
    first.push_back(0);
    const Index d = problem.dimension, N = problem.pairs();
    std::vector<int> seen(static_cast<std::size_t>(N), -1);
    for (Index j = 0; j < N; ++j) {
      const auto start = static_cast<std::ptrdiff_t>(beside.size());
      const auto see = [&](Index i) {
        if (seen[static_cast<std::size_t>(i)] == j) return;
        seen[static_cast<std::size_t>(i)] = static_cast<int>(j);
        beside.push_back(static_cast<int>(i));
      };
      see(j);
      for (Index k = 0; k < d; ++k)
        for (Eigen::SparseMatrix<double>::InnerIterator at(problem.W.sparse(), d * j + k); at; ++at) see(at.row() / d);
      std::sort(beside.begin() + start, beside.end());
      first.push_back(beside.size());
    }
    moved.setZero(3, N);
  }

  bool factorise(const SaddleRows& rows, const Vector& row) override {
    const Index n = rows.size(), m = by_rows.cols(), d = problem.dimension;
    first_of_pair.assign(static_cast<std::size_t>(problem.pairs()) + 1, 0);
    for (const int pair : rows.pair) ++first_of_pair[static_cast<std::size_t>(pair) + 1];
    for (std::size_t i = 1; i < first_of_pair.size(); ++i) first_of_pair[i] += first_of_pair[i - 1];
    A.resize(n + m, n + m);
    A.reserve(problem.W.sparse().nonZeros() + 4 * by_rows.nonZeros() + n + m);
    for (Index j = 0; j < n; ++j) {
      A.startVec(j);
      const auto pair = static_cast<std::size_t>(rows.pair[static_cast<std::size_t>(j)]);
      for (std::size_t at = first[pair]; at < first[pair + 1]; ++at) moved.col(beside[at]).setZero();
      for (Index k = 0; k < d; ++k)
        for (Eigen::SparseMatrix<double>::InnerIterator it(problem.W.sparse(), d * static_cast<Index>(pair) + k); it;
             ++it)
          moved(it.row() % d, it.row() / d) += it.value() * rows.C(k, j);
      for (std::size_t at = first[pair]; at < first[pair + 1]; ++at) gather(rows, row, beside[at], j);
      add_balance(rows, pair, j);
    }
    for (Index motion = 0; motion < m; ++motion) {
      A.startVec(n + motion);
      const RigidMap::Sparse& G = problem.G.sparse();
      for (RigidMap::Sparse::InnerIterator it(G, motion); it;) {
        const Index pair = it.row() / d;
        moved.col(pair).setZero();
        for (; it && it.row() / d == pair; ++it) moved(it.row() % d, pair) = it.value();
        gather(rows, row, pair, n + motion);
      }
      if (rows.E > 0.0) A.insertBack(n + motion, n + motion) = -rows.E;
    }
    A.finalize();
    return m == 0 ? lu.factorise(A) : lu.factorise(A, [&] {
      if (!order) order = std::make_unique<JointOrder>(problem);
      return order->blocks(rows.pair);
    });
  }

  /// Rows of `moved` of one pair in column j; its own D.
  void gather(const SaddleRows& rows, const Vector& row, Index pair, Index j) {
    const auto p = static_cast<std::size_t>(pair);
    for (int i = first_of_pair[p]; i < first_of_pair[p + 1]; ++i) {
      const double own = i == j ? rows.D[j] : 0.0;
      A.insertBack(i, j) = row[i] * (rows.L.col(i).dot(moved.col(pair)) + own);
    }
  }

  /// Rows of the balance, of the column of a force.
  void add_balance(const SaddleRows& rows, std::size_t pair, Index j) {
    const Index d = problem.dimension, from = d * static_cast<Index>(pair);
    motions.clear();
    for (Index k = 0; k < d; ++k)
      for (Rows::InnerIterator it(by_rows, from + k); it; ++it)
        motions.emplace_back(it.col(), it.value() * rows.C(k, j));
    std::sort(motions.begin(), motions.end());
    for (std::size_t k = 0; k < motions.size();) {
      double sum = 0.0;
      const Index motion = motions[k].first;
      for (; k < motions.size() && motions[k].first == motion; ++k) sum += motions[k].second;
      A.insertBack(rows.size() + motion, j) = sum;
    }
  }

  Vector solve(const Vector& b) const override {
    Vector x;
    lu.solve(b, x);
    return x;
  }
  Vector product(const Vector& x) const override { return A * x; }

  using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  const Problem& problem;
  Rows by_rows;                                    // G
  std::vector<std::size_t> first;                  // N + 1
  std::vector<int> beside;                         // pairs coupled with pair i: first[i] .. first[i + 1], ascending
  std::vector<int> first_of_pair;                  // N + 1, unknowns of the pairs
  Eigen::Matrix<double, 3, Eigen::Dynamic> moved;  // motions of the pairs
  std::vector<std::pair<Index, double>> motions;
  Eigen::SparseMatrix<double> A;
  linalg::SparseGeneralSolver lu;
  std::unique_ptr<JointOrder> order;
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
  row_.head(rows.size()) = (1.0 + rows.D.array()).inverse();
  return backend_->factorise(rows, row_);
}

Vector SaddleSystem::solve(const Vector& right) const {
  const Vector b = row_.cwiseProduct(right), x = backend_->solve(b);
  return x + backend_->solve(b - backend_->product(x));
}

}  // namespace scabo::contact
