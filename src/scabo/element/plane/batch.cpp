#include "scabo/element/plane/batch.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "scabo/element/plane/batch_kernel.hpp"
#include "scabo/element/plane/exact_riccati.hpp"
#include "scabo/element/plane/stiffness.hpp"
#include "scabo/geometry/line_basis.hpp"
#include "scabo/linalg/instruction_sets.hpp"
#include "scabo/linalg/parallel.hpp"

namespace scabo::element {

namespace batch_avx512 {
extern const BatchKernel kernel;
}
namespace batch_avx2 {
extern const BatchKernel kernel;
}
namespace batch_baseline {
extern const BatchKernel kernel;
}

const BatchKernel* batch_kernel(int rank) {
  static const auto kernels = linalg::runnable(batch_avx512::kernel, batch_avx2::kernel, batch_baseline::kernel);
  return rank < static_cast<int>(kernels.size()) ? kernels[static_cast<std::size_t>(rank)] : nullptr;
}

namespace {

constexpr int fewest_nodes = 3, most_nodes = 32;

/// Items of equal shape.
struct Group {
  BatchShape shape;
  std::vector<BatchElement> elements;
  std::vector<int> items;
};

bool fits(const BatchItem& item) {
  const auto nodes = static_cast<int>(item.ring.nodes.size());
  const auto in_range = [&](const mesh::LineElement& element) {
    return element.nodes.size() >= 2 &&
           std::all_of(element.nodes.begin(), element.nodes.end(), [&](int node) { return node >= 0 && node < nodes; });
  };
  return nodes >= fewest_nodes && nodes <= most_nodes && item.D.fits(item.ring) &&
         !(item.D.contrast() > great_contrast) &&
         std::all_of(item.ring.elements.begin(), item.ring.elements.end(), in_range);
}

std::size_t hash_of(const BatchItem& item) {
  std::size_t hash = item.ring.nodes.size() + (item.D.size() == 1 ? 0 : 1000);
  for (const mesh::LineElement& element : item.ring.elements)
    for (std::size_t i = 0; i + 1 < element.nodes.size(); ++i)
      hash = 31 * (hash + (i == 0 ? 7 : 0)) + static_cast<std::size_t>(element.nodes[i]);
  return hash;
}

bool same_shape(const BatchItem& a, const BatchItem& b) {
  return a.ring.nodes.size() == b.ring.nodes.size() && a.D.size() == b.D.size() &&
         std::equal(a.ring.elements.begin(), a.ring.elements.end(), b.ring.elements.begin(), b.ring.elements.end(),
                    [](const mesh::LineElement& x, const mesh::LineElement& y) { return x.nodes == y.nodes; });
}

Group group_of(const BatchItem& first) {
  Group group;
  for (const mesh::LineElement& element : first.ring.elements) {
    const geometry::LineBasis& basis = geometry::LineBasis::of_order(static_cast<int>(element.nodes.size()) - 1);
    group.elements.push_back({element.nodes.data(), basis.nodes(), static_cast<int>(basis.rule().points.size()),
                              basis.values_at_rule().data(), basis.derivatives_at_rule().data(),
                              basis.rule().weights.data()});
  }
  group.shape = {static_cast<int>(first.ring.nodes.size()), static_cast<int>(first.ring.elements.size()), nullptr,
                 static_cast<int>(first.D.size())};
  return group;
}

/// Suitable items, grouped by shape; the others are put into `alone`.
std::vector<Group> groups_of(std::span<const BatchItem> items, std::vector<int>& alone) {
  std::vector<Group> groups;
  std::unordered_multimap<std::size_t, std::size_t> by_hash;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!fits(items[i])) {
      alone.push_back(static_cast<int>(i));
      continue;
    }
    const std::size_t hash = hash_of(items[i]);
    auto [at, end] = by_hash.equal_range(hash);
    while (at != end && !same_shape(items[static_cast<std::size_t>(groups[at->second].items.front())], items[i])) ++at;
    if (at == end) {
      at = by_hash.emplace(hash, groups.size());
      groups.push_back(group_of(items[i]));
    }
    groups[at->second].items.push_back(static_cast<int>(i));
  }
  for (Group& group : groups) group.shape.element = group.elements.data();
  return groups;
}

/// Solves items of a group in the registers, several at a time.
class Lanes {
 public:
  Lanes(const Group& group, const BatchKernel& kernel)
      : shape_(group.shape), kernel_(kernel), n_(2 * group.shape.nodes) {
    const long vectors = n_ + 6 * shape_.elasticities + 3 + n_ * (n_ + 1) / 2 + batch_workspace(shape_);
    room_.resize(static_cast<std::size_t>(vectors * kernel.lanes / 8 + 1));
    x_ = room_.front().values;
    D_ = x_ + n_ * kernel.lanes;
    thickness_ = D_ + 6 * shape_.elasticities * kernel.lanes;
    residual_ = thickness_ + kernel.lanes;
    cancellation_ = residual_ + kernel.lanes;
    K_ = cancellation_ + kernel.lanes;
    workspace_ = K_ + n_ * (n_ + 1) / 2 * kernel.lanes;
  }

  /// Solves the items `which`[0 .. count - 1], at most one per lane; appends those that failed to `failed`.
  void solve(std::span<const BatchItem> items, const int* which, int count, double largest_residual,
             BatchSolution& solution, std::vector<int>& failed) {
    const int lanes = kernel_.lanes;
    for (int l = 0; l < lanes; ++l) load(items[static_cast<std::size_t>(which[std::min(l, count - 1)])], l);
    kernel_.solve(shape_, {x_, D_, thickness_, K_, residual_, cancellation_}, workspace_);
    for (int l = 0; l < count; ++l) {
      if (!(residual_[l] <= largest_residual)) {
        failed.push_back(which[l]);
        continue;
      }
      const auto at = static_cast<std::size_t>(which[l]);
      Matrix& out = solution.K[at];
      out.resize(n_, n_);
      const double* value = K_ + l;
      for (long i = 0; i < n_; ++i)
        for (long j = 0; j <= i; ++j, value += lanes) out(i, j) = *value;
      take_rotation_out(items[at].ring, out);
      solution.rounding[at] = std::numeric_limits<double>::epsilon() * std::max(1.0, cancellation_[l]);
    }
  }

 private:
  struct alignas(64) Line {
    double values[8];
  };

  void load(const BatchItem& item, int lane) {
    const int lanes = kernel_.lanes;
    double* x = x_ + lane;
    for (const Vec2& node : item.ring.nodes) {
      x[0] = node.x(), x[lanes] = node.y();
      x += 2 * lanes;
    }
    double* D = D_ + lane;
    for (int e = 0; e < shape_.elasticities; ++e) {
      const Mat3& elasticity = item.D.of(static_cast<std::size_t>(e));
      for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j, D += lanes) *D = elasticity(i, j);
    }
    thickness_[lane] = item.thickness;
  }

  const BatchShape& shape_;
  const BatchKernel& kernel_;
  long n_;
  std::vector<Line> room_;
  double *x_, *D_, *thickness_, *residual_, *cancellation_, *K_, *workspace_;
};

/// Part of a group, as one task.
struct Task {
  const Group* group;
  std::size_t first, last;
};

std::vector<Task> tasks_of(const std::vector<Group>& groups, int lanes) {
  const auto at_once = static_cast<std::size_t>(32 * lanes);  // so that allocation costs little
  std::vector<Task> tasks;
  for (const Group& group : groups)
    for (std::size_t first = 0; first < group.items.size(); first += at_once)
      tasks.push_back({&group, first, std::min(first + at_once, group.items.size())});
  return tasks;
}

}  // namespace

BatchSolution solve_batch(std::span<const BatchItem> items, const BatchOptions& options) {
  const BatchKernel& kernel = options.kernel ? *options.kernel : *batch_kernel(0);
  BatchSolution solution;
  solution.K.resize(items.size());
  solution.rounding.resize(items.size());
  const std::vector<Group> groups = groups_of(items, solution.alone);
  const std::vector<Task> tasks = tasks_of(groups, kernel.lanes);
  std::vector<std::vector<int>> failed(tasks.size());
  linalg::parallel_for(static_cast<int>(tasks.size()), options.threads, [&](int k) {
    const Task& task = tasks[static_cast<std::size_t>(k)];
    Lanes lanes(*task.group, kernel);
    for (std::size_t i = task.first; i < task.last; i += static_cast<std::size_t>(kernel.lanes))
      lanes.solve(items, task.group->items.data() + i,
                  static_cast<int>(std::min(i + static_cast<std::size_t>(kernel.lanes), task.last) - i),
                  options.largest_residual, solution, failed[static_cast<std::size_t>(k)]);
  });
  for (const std::vector<int>& some : failed) solution.alone.insert(solution.alone.end(), some.begin(), some.end());
  std::sort(solution.alone.begin(), solution.alone.end());
  return solution;
}

}  // namespace scabo::element
