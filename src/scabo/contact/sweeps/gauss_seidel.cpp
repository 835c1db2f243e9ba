#include "scabo/contact/sweeps/gauss_seidel.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace scabo::contact {

namespace {

using Index = Eigen::Index;

}  // namespace

template <int d>
PairSweeps<d>::PairSweeps(const Problem& problem) : problem_(&problem) {
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
  pairs_.reserve(static_cast<std::size_t>(problem.pairs()));
  for (Index i = 0; i < problem.pairs(); ++i) {
    double block[d * d];
    read_block(i, block);
    const typename PairProblem<d>::Friction mu{problem.mu_against(i, -1.0), problem.mu_against(i, 1.0)};
    pairs_.emplace_back(block, mu, problem.cohesion_of(i), problem.tension_of(i));
  }
}

template <int d>
void PairSweeps<d>::read_block(Index i, double* block) const {
  const Index size = problem_->q.size(), first = d * i;
  for (int k = 0; k < d; ++k) {
    double* const column = block + d * k;
    if (columns_ == nullptr) {
      for (int j = 0; j < d; ++j) column[j] = factor_ * values_[(first + k) * size + first + j];
      continue;
    }
    for (int j = 0; j < d; ++j) column[j] = 0.0;
    for (int t = columns_[first + k]; t < columns_[first + k + 1]; ++t) {
      const Index row = rows_[t] - first;
      if (row >= 0 && row < d) column[row] += values_[t];
    }
  }
}

/// motion += W (columns of pair i) change.
template <int d>
void PairSweeps<d>::add(Index i, const double* change, double* motion) const {
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
void PairSweeps<d>::start(const Vector& p, Vector& motion) const {
  motion = problem_->q;
  for (Index i = 0; i < problem_->pairs(); ++i) add(i, p.data() + d * i, motion.data());
}

template <int d>
double PairSweeps<d>::sweep(Vector& p, Vector& motion) {
  double largest = 0.0;
  for (Index i = 0; i < problem_->pairs(); ++i) {
    double change[d];
    if (pairs_[static_cast<std::size_t>(i)].step(motion.data() + d * i, p.data() + d * i, change, largest))
      add(i, change, motion.data());
  }
  return largest;
}

template class PairSweeps<2>;
template class PairSweeps<3>;

namespace {

template <int d>
constexpr bool of_pairs(const PairSweeps<d>*) {
  return true;
}
template <int d>
constexpr bool of_pairs(const JointSweeps<d>*) {
  return false;
}

}  // namespace

GaussSeidel::Sweeps GaussSeidel::sweeps_of(const Problem& problem, Form form) {
  if (form == Form::of_joints) {
    if (problem.dimension == 2) {
      if (auto joints = find_joints<2>(problem)) return JointSweeps<2>(problem, std::move(*joints));
    } else if (auto joints = find_joints<3>(problem)) {
      return JointSweeps<3>(problem, std::move(*joints));
    }
  }
  if (problem.dimension == 2) return PairSweeps<2>(problem);
  return PairSweeps<3>(problem);
}

GaussSeidel::GaussSeidel(const Problem& problem, Form form) : sweeps_(sweeps_of(problem, form)) {}

void GaussSeidel::start(const Vector& p) {
  std::visit(
      [&](auto& sweeps) {
        if constexpr (of_pairs(static_cast<std::decay_t<decltype(sweeps)>*>(nullptr)))
          sweeps.start(p, motion_);
        else
          sweeps.start(p);
      },
      sweeps_);
}

double GaussSeidel::sweep(Vector& p) {
  return std::visit(
      [&](auto& sweeps) {
        if constexpr (of_pairs(static_cast<std::decay_t<decltype(sweeps)>*>(nullptr)))
          return sweeps.sweep(p, motion_);
        else
          return sweeps.sweep(p);
      },
      sweeps_);
}

const Vector& GaussSeidel::motion() {
  std::visit(
      [&](auto& sweeps) {
        if constexpr (!of_pairs(static_cast<std::decay_t<decltype(sweeps)>*>(nullptr))) sweeps.read_motion(motion_);
      },
      sweeps_);
  return motion_;
}

Vector gauss_seidel(const Problem& problem, Vector p, int sweeps) {
  GaussSeidel iteration(problem);
  iteration.start(p);
  for (int sweep = 0; sweep < sweeps; ++sweep)
    if (iteration.sweep(p) <= 1e-12 * p.lpNorm<Eigen::Infinity>()) break;
  return p;
}

}  // namespace scabo::contact
