#include "scabo/linalg/elimination_order.hpp"

#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <new>

#include "scabo/base/error.hpp"

namespace scabo::linalg {

namespace {

/// Operations of the factorisation by minimum degree for each vertex, from which on METIS pays. It takes 1e-5 s a
/// vertex, as long as 2e5 operations, and saves at most some ten per cent of them in plane meshes, where AMD
/// leaves 1.7e5 a vertex of a million degrees of freedom (docs/decisions/0008-sparse-factorisation.md).
constexpr double least_dissected = 1e6;

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

std::vector<std::int64_t> elimination_order(const SparseMatrix& A, Ordering method) {
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
  int done = cholmod_l_amd(&view, nullptr, 0, order_of_groups.data(), &common);
  const double vertices = static_cast<double>(view.nrow), unknowns = static_cast<double>(A.rows());
  // CHOLMOD states the operations for one unknown a vertex.
  const double operations = common.fl * std::pow(unknowns / std::max(1.0, vertices), 3);
  const bool dissect =
      method == Ordering::automatic ? operations > least_dissected * vertices : method == Ordering::nested_dissection;
  if (done != 0 && dissect) {
    static std::mutex one_at_a_time;  // METIS draws from rand(), which it sets at its start
    const std::lock_guard lock(one_at_a_time);
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
