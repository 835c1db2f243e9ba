#include "scabo/contact/sweeps/gauss_seidel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scabo::contact {

using Index = Eigen::Index;

template <int d>
PairSweeps<d>::PairSweeps(const Problem& problem) : problem_(&problem), pairs_(pair_problems<d>(problem)) {
  if (problem.W.is_sparse()) {
    const Eigen::SparseMatrix<double>& W = problem.W.sparse();
    columns_ = W.outerIndexPtr();
    rows_ = W.innerIndexPtr();
    values_ = W.valuePtr();
  } else if (problem.W.is_dense()) {
    values_ = problem.W.matrix().data();
    factor_ = problem.W.factor();
  } else {
    values_ = problem.W.dense().data();
  }
}

/// The motion grows by W (columns of pair i) change.
template <int d>
void PairSweeps<d>::add(Index i, const double* change) {
  double* const motion = motion_.data();
  const Index size = problem_->q.size(), first = d * i;
  if (columns_ == nullptr) {
    const double *W_n = values_ + first * size, *W_t = W_n + size, *W_s = W_n + (d - 1) * size;
    const double n = factor_ * change[0], t = factor_ * change[1], s = factor_ * change[d - 1];
    if (d == 2)
      for (Index k = 0; k < size; ++k) motion[k] += W_n[k] * n + W_t[k] * t;
    else
      for (Index k = 0; k < size; ++k) motion[k] += W_n[k] * n + W_t[k] * t + W_s[k] * s;
    return;
  }
  for (int k = 0; k < d; ++k)
    if (const double step = change[k]; step != 0.0)
      for (int t = columns_[first + k]; t < columns_[first + k + 1]; ++t) motion[rows_[t]] += values_[t] * step;
}

template <int d>
void PairSweeps<d>::start(const Vector& p) {
  motion_ = problem_->q;
  for (Index i = 0; i < problem_->pairs(); ++i) add(i, p.data() + d * i);
}

template <int d>
double PairSweeps<d>::sweep(Vector& p) {
  double largest = 0.0;
  for (Index i = 0; i < problem_->pairs(); ++i) {
    double change[d];
    if (pairs_[static_cast<std::size_t>(i)].step(motion_.data() + d * i, p.data() + d * i, change, largest))
      add(i, change);
  }
  return largest;
}

template class PairSweeps<2>;
template class PairSweeps<3>;

GaussSeidel::Sweeps GaussSeidel::sweeps_of(const Problem& problem) {
  if (problem.dimension == 2) {
    if (auto joints = find_joints<2>(problem)) return JointSweeps<2>(problem, std::move(*joints));
    return PairSweeps<2>(problem);
  }
  if (auto joints = find_joints<3>(problem)) return JointSweeps<3>(problem, std::move(*joints));
  return PairSweeps<3>(problem);
}

GaussSeidel::GaussSeidel(const Problem& problem) : sweeps_(sweeps_of(problem)) {}

void GaussSeidel::start(const Vector& p) {
  std::visit([&](auto& sweeps) { sweeps.start(p); }, sweeps_);
}

double GaussSeidel::sweep(Vector& p) {
  return std::visit([&](auto& sweeps) { return sweeps.sweep(p); }, sweeps_);
}

Vector GaussSeidel::motion() const {
  return std::visit([](const auto& sweeps) { return sweeps.motion(); }, sweeps_);
}

}  // namespace scabo::contact
