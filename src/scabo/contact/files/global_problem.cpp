#include "scabo/contact/files/global_problem.hpp"

#include <Eigen/SparseLU>
#include <vector>

#include "scabo/linalg/symmetric_positive_solver.hpp"

namespace scabo::contact {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Index = Eigen::Index;
using Triplets = std::vector<Eigen::Triplet<double>>;

// Beyond this many multiplications W is not formed: seconds.
constexpr double worth_forming = 2e9;

void add(Triplets& entries, const Sparse& block, Index row, Index column, double factor, bool transposed) {
  for (Index j = 0; j < block.outerSize(); ++j)
    for (Sparse::InnerIterator at(block, j); at; ++at)
      entries.emplace_back(static_cast<int>(row + (transposed ? at.col() : at.row())),
                           static_cast<int>(column + (transposed ? at.row() : at.col())), factor * at.value());
}

/// S = [M, -G; -G', 0].
Sparse with_constraints(const GlobalProblem& global) {
  const Index n = global.M.rows(), k = global.G.cols();
  Triplets entries;
  add(entries, global.M, 0, 0, 1.0, false);
  add(entries, global.G, 0, n, -1.0, false);
  add(entries, global.G, n, 0, -1.0, true);
  Sparse S(n + k, n + k);
  S.setFromTriplets(entries.begin(), entries.end());
  return S;
}

/// [top; 0] with `rows` rows.
Sparse padded(const Sparse& top, Index rows) {
  Triplets entries;
  add(entries, top, 0, 0, 1.0, false);
  Sparse result(rows, top.cols());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

bool is_symmetric(const Sparse& M) {
  const Sparse transposed = M.transpose();
  const Sparse difference = M - transposed;
  return difference.norm() == 0.0;
}

}  // namespace

struct GlobalReduction::Factor {
  Eigen::SparseLU<Sparse> lu;
};

GlobalReduction::GlobalReduction(GlobalProblem problem)
    : global_(std::move(problem)), factor_(std::make_unique<Factor>()) {
  factor_->lu.compute(with_constraints(global_));
  if (factor_->lu.info() != Eigen::Success) throw SingularProblem();
}

GlobalReduction::~GlobalReduction() = default;

Problem GlobalReduction::problem() const {
  const Index n = global_.M.rows(), k = global_.G.cols();
  Problem problem;
  problem.dimension = global_.dimension;
  problem.mu = global_.mu;
  problem.q = global_.w + global_.H.transpose() * motion(Vector::Zero(global_.H.cols())).head(n);
  if (!problem.q.allFinite()) throw SingularProblem();
  problem.G.resize(problem.q.size(), 0);
  problem.f = Vector::Zero(0);
  const double work =
      static_cast<double>(global_.H.cols()) * static_cast<double>(factor_->lu.nnzL() + factor_->lu.nnzU());
  if (k == 0 && work > worth_forming && is_symmetric(global_.M)) {
    try {
      problem.W = Delassus(std::make_shared<const linalg::SymmetricPositiveSolver>(global_.M), global_.H);
      return problem;
    } catch (const linalg::NotPositiveDefinite&) {  // W is formed after all
    }
  }
  const Sparse X = factor_->lu.solve(padded(global_.H, n + k));
  const Sparse top = X.topRows(n);
  Sparse W = global_.H.transpose() * top;
  W.makeCompressed();
  if (!Eigen::Map<const Vector>(W.valuePtr(), W.nonZeros()).allFinite()) throw SingularProblem();
  if (2 * W.nonZeros() >= W.rows() * W.cols())
    problem.W = Delassus(Matrix(W));
  else
    problem.W = Delassus(std::move(W));
  return problem;
}

Vector GlobalReduction::motion(const Vector& r) const {
  Vector load(global_.M.rows() + global_.G.cols());
  load << Vector(global_.f + global_.H * r), global_.b;
  return factor_->lu.solve(load);
}

}  // namespace scabo::contact
