#include "scabo/contact/files/global_problem.hpp"

#include <Eigen/SparseLU>
#include <algorithm>
#include <random>
#include <utility>
#include <vector>

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

/// Diagonal blocks from products with a few vectors (Bekas, Kokiopoulou, Saad, Appl. Numer. Math. 57 (2007) 1214): each
/// vector has random signs on every 64th pair, so that contributions of distant pairs average out.
Matrix probed_blocks(const FactorisedPairs& W, Index d) {
  constexpr Index colours = 64;
  const Index N = W.size() / d;
  Matrix blocks(d, W.size());
  std::minstd_rand random(1);
  Vector sign(N);
  for (double& s : sign) s = (random() >> 8) % 2 == 0 ? 1.0 : -1.0;
  for (Index colour = 0; colour < colours; ++colour)
    for (Index k = 0; k < d; ++k) {
      Vector probe = Vector::Zero(W.size());
      for (Index i = colour; i < N; i += colours) probe[d * i + k] = sign[i];
      const Vector image = W.times(probe);
      for (Index i = colour; i < N; i += colours) blocks.col(d * i + k) = sign[i] * image.segment(d * i, d);
    }
  return blocks;
}

}  // namespace

Matrix FactorisedPairs::diagonal_blocks() const {
  constexpr Index most_exact = 4000, at_a_time = 60;  // rows; a whole number of pairs
  const Index d = dimension_;
  if (size() > most_exact) return probed_blocks(*this, d);
  Matrix blocks(d, size());
  for (Index first = 0; first < size(); first += at_a_time) {
    const Index count = std::min(at_a_time, size() - first);
    const Sparse part = H_.middleCols(first, count);
    const Matrix W = part.transpose() * M_.solve(Matrix(part));
    for (Index i = 0; i < count; i += d) blocks.middleCols(first + i, d) = W.block(i, i, d, d);
  }
  return blocks;
}

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
      problem.W = Delassus(std::make_shared<const FactorisedPairs>(global_.M, global_.H, global_.dimension));
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
