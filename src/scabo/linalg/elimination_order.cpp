#include "scabo/linalg/elimination_order.hpp"

#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <new>
#include <numeric>

#include "scabo/base/error.hpp"
#include "scabo/base/interruption.hpp"
#include "scabo/linalg/held_termination.hpp"

namespace scabo::linalg {

namespace {

/// Operations of the factorisation by minimum degree for each vertex, from which on METIS pays. It takes 1e-5 s a
/// vertex, as long as 2e5 operations, and saves up to 60 % of them in meshes of polygons
/// (docs/decisions/0009-sparse-factorisation.md).
constexpr double least_dissected = 5e5;
constexpr double least_by_position = 3e5;  // the same for dissection by position, which takes a few 1e-6 s a vertex

/// The groups as a graph: pattern of the lower triangle, without the diagonal.
struct Graph {
  std::vector<SuiteSparse_long> starts, neighbours;
};

Graph graph_of(const SparseMatrix& A, const std::vector<int>& groups) {
  std::vector<int> group_of(static_cast<std::size_t>(A.rows()), -1);  // of the first unknown of each group
  for (std::size_t g = 0; g + 1 < groups.size(); ++g)
    group_of[static_cast<std::size_t>(groups[g])] = static_cast<int>(g);
  Graph graph;
  graph.starts.push_back(0);
  for (std::size_t g = 0; g + 1 < groups.size(); ++g) {
    for (SparseMatrix::InnerIterator it(A, groups[g]); it; ++it)
      if (const int other = group_of[static_cast<std::size_t>(it.row())]; other > static_cast<int>(g))
        graph.neighbours.push_back(other);
    graph.starts.push_back(static_cast<SuiteSparse_long>(graph.neighbours.size()));
  }
  return graph;
}

/// Nested dissection by coordinates: the vertices of a box are divided at the median of its longer side, and those that
/// have a neighbour on the other side separate the two. Where these are more than the side of a square of as many
/// vertices has, the other side is tried as well: of a mesh that is fine at an edge only, most vertices of a box lie in
/// a few rows along it, and a cut between two of the rows separates nothing. Gives every vertex the number of its leaf
/// or separator, in an order in which parts come before what separates them.
class DissectionByPosition {
 public:
  DissectionByPosition(const Graph& lower, std::vector<Vec2> positions)
      : positions_(std::move(positions)), side_(positions_.size(), 0), group_(positions_.size(), 0) {
    const std::size_t n = positions_.size();
    starts_.assign(n + 1, 0);
    for (std::size_t v = 0; v < n; ++v)
      for (auto k = lower.starts[v]; k < lower.starts[v + 1]; ++k) ++starts_[v + 1], ++starts_[neighbour(lower, k) + 1];
    for (std::size_t v = 0; v < n; ++v) starts_[v + 1] += starts_[v];
    neighbours_.resize(starts_[n]);
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    for (std::size_t v = 0; v < n; ++v)
      for (auto k = lower.starts[v]; k < lower.starts[v + 1]; ++k) {
        const std::size_t other = neighbour(lower, k);
        neighbours_[next[v]++] = static_cast<int>(other);
        neighbours_[next[other]++] = static_cast<int>(v);
      }
  }

  std::vector<SuiteSparse_long> groups() {
    std::vector<int> all(positions_.size());
    std::iota(all.begin(), all.end(), 0);
    divide(all.data(), all.data() + all.size());
    return group_;
  }

 private:
  static constexpr std::ptrdiff_t largest_leaf = 200;  // ordered by minimum degree

  static std::size_t neighbour(const Graph& graph, SuiteSparse_long k) {
    return static_cast<std::size_t>(graph.neighbours[static_cast<std::size_t>(k)]);
  }
  const Vec2& position(int v) const { return positions_[static_cast<std::size_t>(v)]; }
  int& side(int v) { return side_[static_cast<std::size_t>(v)]; }

  void divide(int* begin, int* end) {
    if (end - begin <= largest_leaf) return number(begin, end);
    interruption_point();
    Vec2 low = position(*begin), high = low;
    for (const int* v = begin; v != end; ++v) low = low.cwiseMin(position(*v)), high = high.cwiseMax(position(*v));
    const Eigen::Index axis = high.x() - low.x() >= high.y() - low.y() ? 0 : 1;
    Cut chosen = cut(begin, end, axis);
    const double large = 2.0 * std::sqrt(static_cast<double>(end - begin));
    if (chosen.middle == begin || static_cast<double>(chosen.separator()) > large) {
      const Cut other = cut(begin, end, 1 - axis);
      const bool better = other.middle != begin && (chosen.middle == begin || other.separator() < chosen.separator());
      chosen = better ? other : cut(begin, end, axis);
    }
    int* const middle = chosen.middle;
    if (middle == begin) return number(begin, end);  // all in one place
    // Either side of the cut separates; the smaller one is taken.
    if (chosen.of_left <= chosen.of_right) {
      int* const separator = std::partition(begin, middle, [&](int v) { return !touches(v, chosen.right); });
      std::rotate(separator, middle, end);  // parts first, then the separator
      int* const last = separator + (end - middle);
      divide(begin, separator);
      divide(separator, last);
      number(last, end);
    } else {
      int* const separator = std::partition(middle, end, [&](int v) { return !touches(v, chosen.left); });
      divide(begin, middle);
      divide(middle, separator);
      number(separator, end);
    }
  }

  /// Vertices from `middle` on lie on the right; how many of each side have a neighbour on the other.
  struct Cut {
    int* middle = nullptr;  // the first one: all are in one place
    int left = 0, right = 0;
    std::ptrdiff_t of_left = 0, of_right = 0;
    std::ptrdiff_t separator() const { return std::min(of_left, of_right); }
  };
  Cut cut(int* begin, int* end, Eigen::Index axis) {
    Cut made;
    int* const median = begin + (end - begin) / 2;
    std::nth_element(begin, median, end, [&](int a, int b) { return position(a)[axis] < position(b)[axis]; });
    const double at = position(*median)[axis];
    made.middle = std::partition(begin, end, [&](int v) { return position(v)[axis] < at; });
    if (made.middle == begin) return made;
    made.left = ++sides_, made.right = ++sides_;
    for (int* v = begin; v != made.middle; ++v) side(*v) = made.left;
    for (int* v = made.middle; v != end; ++v) side(*v) = made.right;
    made.of_left = std::count_if(begin, made.middle, [&](int v) { return touches(v, made.right); });
    made.of_right = std::count_if(made.middle, end, [&](int v) { return touches(v, made.left); });
    return made;
  }
  bool touches(int v, int other_side) {
    for (std::size_t k = starts_[static_cast<std::size_t>(v)]; k < starts_[static_cast<std::size_t>(v) + 1]; ++k)
      if (side(neighbours_[k]) == other_side) return true;
    return false;
  }
  void number(const int* begin, const int* end) {
    for (const int* v = begin; v != end; ++v) group_[static_cast<std::size_t>(*v)] = groups_;
    if (begin != end) ++groups_;
  }

  std::vector<Vec2> positions_;
  std::vector<std::size_t> starts_;
  std::vector<int> neighbours_, side_;
  std::vector<SuiteSparse_long> group_;
  SuiteSparse_long groups_ = 0;
  int sides_ = 0;
};

}  // namespace

std::vector<int> equal_columns(const SparseMatrix& A) {
  std::vector<int> groups;
  const int *const starts = A.outerIndexPtr(), *const rows = A.innerIndexPtr();
  for (int j = 0; j < A.cols(); ++j)
    if (j == 0 || !std::equal(rows + starts[j], rows + starts[j + 1], rows + starts[j - 1], rows + starts[j]))
      groups.push_back(j);
  groups.push_back(static_cast<int>(A.cols()));
  return groups;
}

std::vector<std::int64_t> elimination_order(const SparseMatrix& A, Ordering method,
                                            const std::vector<Vec2>& positions) {
  ensure(positions.empty() || positions.size() == static_cast<std::size_t>(A.rows()), "a position for each unknown");
  ensure(method != Ordering::dissection_by_position || A.rows() == 0 || !positions.empty(),
         "dissection_by_position needs positions");
  const std::vector<int> groups = equal_columns(A);
  Graph graph = graph_of(A, groups);
  cholmod_sparse view{};
  view.nrow = view.ncol = groups.size() - 1;
  view.nzmax = graph.neighbours.size();
  view.p = graph.starts.data();
  view.i = graph.neighbours.data();
  view.stype = -1;
  view.itype = CHOLMOD_LONG;
  view.xtype = CHOLMOD_PATTERN;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;

  std::vector<SuiteSparse_long> order_of_groups(groups.size());
  cholmod_common common{};
  cholmod_l_start(&common);
  common.print = 0;
  const bool by_degree = method == Ordering::automatic || method == Ordering::minimum_degree;
  int done = by_degree ? cholmod_l_amd(&view, nullptr, 0, order_of_groups.data(), &common) : 1;
  const double vertices = static_cast<double>(view.nrow), unknowns = static_cast<double>(A.rows());
  // CHOLMOD states the operations for one unknown a vertex.
  const double operations = common.fl * std::pow(unknowns / std::max(1.0, vertices), 3);
  if (method == Ordering::automatic) {
    if (!positions.empty() && operations > least_by_position * vertices)
      method = Ordering::dissection_by_position;
    else if (positions.empty() && operations > least_dissected * vertices)
      method = Ordering::nested_dissection;
  }
  if (done != 0 && method == Ordering::dissection_by_position) {
    std::vector<Vec2> of_groups;
    for (std::size_t g = 0; g + 1 < groups.size(); ++g)
      of_groups.push_back(positions[static_cast<std::size_t>(groups[g])]);
    std::vector<SuiteSparse_long> members = DissectionByPosition(graph, std::move(of_groups)).groups();
    done = cholmod_l_camd(&view, nullptr, 0, members.data(), order_of_groups.data(), &common);
  } else if (done != 0 && method == Ordering::nested_dissection) {
    const HeldTermination held;
    done = cholmod_l_metis(&view, nullptr, 0, 0, order_of_groups.data(), &common);
  }
  const bool out_of_memory = common.status == CHOLMOD_OUT_OF_MEMORY;
  cholmod_l_finish(&common);
  if (out_of_memory) throw std::bad_alloc();
  ensure(done != 0, "the order of elimination was not found");

  std::vector<std::int64_t> order;
  order.reserve(static_cast<std::size_t>(A.rows()));
  for (std::size_t k = 0; k + 1 < groups.size(); ++k) {
    const auto g = static_cast<std::size_t>(order_of_groups[k]);
    for (int unknown = groups[g]; unknown < groups[g + 1]; ++unknown) order.push_back(unknown);
  }
  return order;
}

}  // namespace scabo::linalg
