#include "scabo/contact/sweeps/gauss_seidel.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "scabo/contact/sweeps/joint_sweeps.hpp"
#include "scabo/contact/sweeps/pair_problem.hpp"

namespace scabo::contact {

namespace {

using Index = Eigen::Index;

template <int d>
class PairSweeps final : public GaussSeidel {
 public:
  explicit PairSweeps(const Problem& problem)
      : problem_(problem), pairs_(pair_problems<d>(problem)), order_(pairs_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
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

  [[gnu::hot]] void start(const Vector& p) override {
    motion_ = problem_.q;
    for (Index i = 0; i < problem_.pairs(); ++i) add(i, p.data() + d * i);
  }

  void reorder(std::minstd_rand& random) override { std::shuffle(order_.begin(), order_.end(), random); }

  [[gnu::hot]] double sweep(Vector& p) override {
    double largest = 0.0;
    for (const Index i : order_) {
      double change[d];
      if (pairs_[static_cast<std::size_t>(i)].step(motion_.data() + d * i, p.data() + d * i, change, largest))
        add(i, change);
    }
    return largest;
  }

 private:
  /// The motion grows by W (columns of pair i) change.
  [[gnu::hot]] void add(Index i, const double* change) {
    double* const motion = motion_.data();
    const Index size = problem_.q.size(), first = d * i;
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

  const Problem& problem_;
  std::vector<PairProblem<d>> pairs_;
  std::vector<int> order_;
  Vector motion_;
  const double* values_ = nullptr;
  double factor_ = 1.0;                             // of the values
  const int *columns_ = nullptr, *rows_ = nullptr;  // of a sparse W
};

template <int d>
std::unique_ptr<GaussSeidel> sweeps_of(const Problem& problem, bool by_joints) {
  if (auto joints = by_joints ? find_joints<d>(problem) : std::nullopt)
    return std::make_unique<JointSweeps<d>>(problem, std::move(*joints));
  return std::make_unique<PairSweeps<d>>(problem);
}

}  // namespace

std::unique_ptr<GaussSeidel> gauss_seidel(const Problem& problem, bool joints) {
  return problem.dimension == 2 ? sweeps_of<2>(problem, joints) : sweeps_of<3>(problem, joints);
}

}  // namespace scabo::contact
