#include "scabo/linalg/sparse_general_solver.hpp"

#include <umfpack.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>

#include "scabo/base/error.hpp"
#include "scabo/linalg/elimination_order.hpp"

namespace scabo::linalg {

namespace {

/// Entries of the fronts' factors above which UMFPACK, whose factors are larger, does not follow where they fail: it
/// runs out of memory. Who calls has a regular matrix to try next.
constexpr double most_after_fronts = 1e8;
/// Unknowns from which a saddle matrix is factorised by fronts of blocks instead of UMFPACK. The answers agree; of
/// fewer unknowns neither takes long.
constexpr int least_of_fronts = 4000;

/// A matrix of saddle type, [W G; G' 0], for its elimination. Unknowns without a diagonal entry, or with a small
/// negative one that only holds them, have none to be eliminated with: they are bare.
struct Saddle {
  SparseMatrix both;                     // with the pattern of A + A'
  std::vector<char> bare;                // of each unknown
  std::vector<int> groups;               // first unknown of each group with equal columns, and n
  std::vector<int> group_of;             // of each unknown; of a bare one the group that it is put behind
  std::vector<std::vector<int>> behind;  // bare unknowns of each group
  std::vector<std::int64_t> order;       // of the groups
  bool is_own(int group, int j) const {
    return group_of[static_cast<std::size_t>(j)] == group && j >= groups[static_cast<std::size_t>(group)] &&
           j < groups[static_cast<std::size_t>(group) + 1];
  }
};

/// Whether each unknown has no diagonal entry to be eliminated with.
std::vector<char> bare_unknowns(const Eigen::SparseMatrix<double>& A) {
  constexpr double small = 1e-3;  // of the largest entry of its column
  std::vector<char> bare(static_cast<std::size_t>(A.rows()), 1);
  for (int j = 0; j < static_cast<int>(A.rows()); ++j) {
    double own = 0.0, largest = 0.0;
    for (SparseMatrix::InnerIterator it(A, j); it; ++it) {
      largest = std::max(largest, std::abs(it.value()));
      if (it.row() == j) own = it.value();
    }
    if (own > 0.0 || own < -small * largest) bare[static_cast<std::size_t>(j)] = 0;
  }
  return bare;
}

/// Each bare unknown is put behind a group of its neighbours with equal columns, whose elimination fills it, at most
/// half as many as the group has members.
void put_behind(Saddle& saddle) {
  const auto n = static_cast<int>(saddle.bare.size()), count = static_cast<int>(saddle.groups.size()) - 1;
  saddle.group_of.resize(saddle.bare.size());
  std::vector<int> room(static_cast<std::size_t>(count), 0);
  for (int g = 0; g < count; ++g)
    for (int j = saddle.groups[static_cast<std::size_t>(g)]; j < saddle.groups[static_cast<std::size_t>(g) + 1]; ++j) {
      saddle.group_of[static_cast<std::size_t>(j)] = g;
      room[static_cast<std::size_t>(g)] += saddle.bare[static_cast<std::size_t>(j)] ? 0 : 1;
    }
  for (int& of_group : room) of_group = (of_group + 1) / 2;
  saddle.behind.resize(static_cast<std::size_t>(count));
  for (int j = 0; j < n; ++j) {
    if (!saddle.bare[static_cast<std::size_t>(j)]) continue;
    int most = 0, best = -1;
    for (SparseMatrix::InnerIterator it(saddle.both, j); it; ++it) {
      const int g = saddle.group_of[static_cast<std::size_t>(it.row())];
      if (room[static_cast<std::size_t>(g)] > most) most = room[static_cast<std::size_t>(g)], best = g;
    }
    if (best < 0) continue;
    --room[static_cast<std::size_t>(best)];
    saddle.behind[static_cast<std::size_t>(best)].push_back(j);
    saddle.group_of[static_cast<std::size_t>(j)] = best;
  }
}

/// The pattern of the groups, with what was put behind them.
SparseMatrix pattern_of_groups(const Saddle& saddle) {
  const auto n = static_cast<int>(saddle.bare.size()), count = static_cast<int>(saddle.groups.size()) - 1;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(saddle.both.nonZeros()) / 4);
  for (int j = 0; j < n; ++j) {
    const int g = saddle.group_of[static_cast<std::size_t>(j)];
    const bool first = j == saddle.groups[static_cast<std::size_t>(g)] || saddle.bare[static_cast<std::size_t>(j)];
    if (!first) continue;  // the others of the group have the same column
    int before = -1;
    for (SparseMatrix::InnerIterator it(saddle.both, j); it; ++it) {
      const int h = saddle.group_of[static_cast<std::size_t>(it.row())];
      if (h == before) continue;
      before = h;
      entries.emplace_back(h, g, 1.0);
      entries.emplace_back(g, h, 1.0);
    }
  }
  for (int g = 0; g < count; ++g) entries.emplace_back(g, g, 1.0);
  SparseMatrix pattern(count, count);
  pattern.setFromTriplets(entries.begin(), entries.end());
  return pattern;
}

/// Dissected by groups. Nothing where no unknown is bare.
std::optional<Saddle> saddle_of(const Eigen::SparseMatrix<double>& A) {
  Saddle saddle;
  saddle.bare = bare_unknowns(A);
  if (std::find(saddle.bare.begin(), saddle.bare.end(), 1) == saddle.bare.end()) return std::nullopt;
  saddle.both = A + SparseMatrix(A.transpose());
  saddle.groups = equal_columns(saddle.both);
  put_behind(saddle);
  saddle.order = elimination_order(pattern_of_groups(saddle), Ordering::nested_dissection);
  return saddle;
}

/// Pivots that stay on the diagonal: each group, then what is behind it.
std::vector<int> order_of(const Saddle& saddle) {
  std::vector<int> order;
  order.reserve(saddle.bare.size());
  for (const std::int64_t g : saddle.order) {
    const auto group = static_cast<std::size_t>(g);
    for (int j = saddle.groups[group]; j < saddle.groups[group + 1]; ++j)
      if (saddle.is_own(static_cast<int>(g), j)) order.push_back(j);
    order.insert(order.end(), saddle.behind[group].begin(), saddle.behind[group].end());
  }
  return order;
}

/// For each group, in their order, the bare unknowns of which it is the last neighbour.
std::vector<std::vector<int>> bare_after(const Saddle& saddle) {
  const std::size_t n = saddle.bare.size();
  std::vector<int> place(n, -1);  // of the group of each unknown that is not bare, in the order of groups
  for (std::size_t k = 0; k < saddle.order.size(); ++k) {
    const auto g = static_cast<std::size_t>(saddle.order[k]);
    for (int j = saddle.groups[g]; j < saddle.groups[g + 1]; ++j)
      if (!saddle.bare[static_cast<std::size_t>(j)]) place[static_cast<std::size_t>(j)] = static_cast<int>(k);
  }
  std::vector<std::vector<int>> after(saddle.order.size());
  for (std::size_t j = 0; j < n; ++j) {
    if (!saddle.bare[j]) continue;
    int last = -1;
    for (SparseMatrix::InnerIterator it(saddle.both, static_cast<Eigen::Index>(j)); it; ++it)
      last = std::max(last, place[static_cast<std::size_t>(it.row())]);
    (last < 0 ? after.back() : after[static_cast<std::size_t>(last)]).push_back(static_cast<int>(j));
  }
  return after;
}

/// What is eliminated before a bare unknown adds its row to all neighbours: they are neighbours of each other.
void couple_around_bare(const Saddle& saddle, const std::vector<int>& block_of, OrderedBlocks& blocks) {
  std::vector<int> beside;
  for (const std::vector<int>& members : blocks.members) {
    const int first = members.front();
    if (!saddle.bare[static_cast<std::size_t>(first)]) continue;
    blocks.bare.push_back(first);
    beside.clear();
    for (SparseMatrix::InnerIterator it(saddle.both, first); it; ++it)
      if (const int other = block_of[static_cast<std::size_t>(it.row())]; beside.empty() || beside.back() != other)
        beside.push_back(other);
    std::sort(beside.begin(), beside.end());
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
    for (std::size_t k = 0; k < beside.size(); ++k) {
      std::vector<int>& later = blocks.later[static_cast<std::size_t>(beside[k])];
      later.insert(later.end(), beside.begin() + static_cast<std::ptrdiff_t>(k) + 1, beside.end());
    }
  }
}

/// Each group, then the bare unknowns of which it is the last neighbour: what all neighbours together leave them as
/// pivots is largest there.
OrderedBlocks blocks_of(const Saddle& saddle) {
  const std::vector<std::vector<int>> after = bare_after(saddle);
  OrderedBlocks blocks;
  std::vector<int> block_of(saddle.bare.size(), -1);
  const auto add = [&](std::vector<int> members) {
    for (const int j : members) block_of[static_cast<std::size_t>(j)] = static_cast<int>(blocks.members.size());
    blocks.members.push_back(std::move(members));
  };
  for (std::size_t k = 0; k < saddle.order.size(); ++k) {
    const auto g = static_cast<std::size_t>(saddle.order[k]);
    std::vector<int> members;
    for (int j = saddle.groups[g]; j < saddle.groups[g + 1]; ++j)
      if (!saddle.bare[static_cast<std::size_t>(j)]) members.push_back(j);
    if (!members.empty()) add(std::move(members));
    for (const int j : after[k]) add({j});
  }
  blocks.later.resize(blocks.members.size());
  couple_around_bare(saddle, block_of, blocks);
  for (std::size_t v = 0; v < blocks.members.size(); ++v) {
    std::vector<int>& later = blocks.later[v];
    for (SparseMatrix::InnerIterator it(saddle.both, blocks.members[v].front()); it; ++it)
      if (const int other = block_of[static_cast<std::size_t>(it.row())]; other > static_cast<int>(v))
        later.push_back(other);
    std::sort(later.begin(), later.end());
    later.erase(std::unique(later.begin(), later.end()), later.end());
  }
  return blocks;
}

}  // namespace

struct SparseGeneralSolver::Factor {
  const Eigen::SparseMatrix<double>* A = nullptr;
  void *symbolic = nullptr, *numeric = nullptr;
  std::vector<int> outer, inner;  // pattern that `symbolic` is of
  double control[UMFPACK_CONTROL];
  std::vector<int> indices;
  std::vector<double> room;
  std::optional<MultifrontalLU> fronts;
  bool by_fronts = false;  // the matrix at hand is factorised by them
  double entries = 0.0;    // of UMFPACK's factors

  Factor() { of_any(); }
  void of_any() {
    umfpack_di_defaults(control);
    control[UMFPACK_ORDERING] = UMFPACK_ORDERING_AMD;
    control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;  // the pattern is, whatever the entries are
    control[UMFPACK_IRSTEP] = 0;                             // who calls refines with the matrix that he means
  }
  /// Pivots on the diagonal wherever elimination has filled it; with the usual tolerance of 1e-3 a hundredth of them
  /// lie elsewhere and cost a fifth more operations.
  void of_saddle() {
    of_any();
    control[UMFPACK_ORDERING] = UMFPACK_ORDERING_GIVEN;
    control[UMFPACK_SYM_PIVOT_TOLERANCE] = 1e-6;
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;
  ~Factor() {
    forget_pattern();
    forget();
  }
  void forget() {
    if (numeric != nullptr) umfpack_di_free_numeric(&numeric);
    numeric = nullptr;
  }
  void forget_pattern() {
    if (symbolic != nullptr) umfpack_di_free_symbolic(&symbolic);
    symbolic = nullptr;
    fronts.reset();
  }
  bool same_pattern(const Eigen::SparseMatrix<double>& other) const {
    return (symbolic != nullptr || fronts) && static_cast<Eigen::Index>(outer.size()) == other.outerSize() + 1 &&
           static_cast<Eigen::Index>(inner.size()) == other.nonZeros() &&
           std::equal(outer.begin(), outer.end(), other.outerIndexPtr(),
                      other.outerIndexPtr() + other.outerSize() + 1) &&
           std::equal(inner.begin(), inner.end(), other.innerIndexPtr(), other.innerIndexPtr() + other.nonZeros());
  }
};

SparseGeneralSolver::SparseGeneralSolver() : factor_(std::make_unique<Factor>()) {}
SparseGeneralSolver::~SparseGeneralSolver() = default;
SparseGeneralSolver::SparseGeneralSolver(SparseGeneralSolver&&) noexcept = default;
SparseGeneralSolver& SparseGeneralSolver::operator=(SparseGeneralSolver&&) noexcept = default;

bool SparseGeneralSolver::factorise(const Eigen::SparseMatrix<double>& A,
                                    const std::function<OrderedBlocks()>& blocks) {
  ensure(A.rows() == A.cols() && A.isCompressed(),
         "SparseGeneralSolver: a square matrix in compressed columns is wanted");
  factor_->forget();
  factor_->A = &A;
  reciprocal_condition_ = 1.0;
  if (A.rows() == 0) return true;
  const auto n = static_cast<int>(A.rows());
  if (!factor_->same_pattern(A)) {
    factor_->forget_pattern();
    factor_->outer.assign(A.outerIndexPtr(), A.outerIndexPtr() + n + 1);
    factor_->inner.assign(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros());
    if (n >= least_of_fronts && blocks)
      factor_->fronts.emplace(blocks());
    else if (n >= least_of_fronts)
      if (const std::optional<Saddle> saddle = saddle_of(A)) factor_->fronts.emplace(blocks_of(*saddle));
  }
  factor_->by_fronts = factor_->fronts && factor_->fronts->factorise(A);
  if (factor_->by_fronts) {
    reciprocal_condition_ = factor_->fronts->reciprocal_condition();
    return true;
  }
  if (factor_->fronts && factor_->fronts->entries() > most_after_fronts) {
    reciprocal_condition_ = 0.0;
    return false;
  }
  double info[UMFPACK_INFO];
  int status = UMFPACK_OK;
  if (factor_->symbolic == nullptr) {
    if (const std::optional<Saddle> saddle = saddle_of(A)) {
      factor_->of_saddle();
      const std::vector<int> order = order_of(*saddle);
      status = umfpack_di_qsymbolic(n, n, A.outerIndexPtr(), A.innerIndexPtr(), nullptr, order.data(),
                                    &factor_->symbolic, factor_->control, info);
    } else {
      factor_->of_any();
      status = umfpack_di_symbolic(n, n, A.outerIndexPtr(), A.innerIndexPtr(), nullptr, &factor_->symbolic,
                                   factor_->control, info);
    }
  }
  if (status == UMFPACK_OK)
    status = umfpack_di_numeric(A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr(), factor_->symbolic,
                                &factor_->numeric, factor_->control, info);
  if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
  reciprocal_condition_ = status == UMFPACK_OK ? info[UMFPACK_RCOND] : 0.0;
  factor_->entries = status == UMFPACK_OK ? info[UMFPACK_LNZ] + info[UMFPACK_UNZ] : 0.0;
  return status == UMFPACK_OK;
}

double SparseGeneralSolver::entries() const {
  return factor_->by_fronts ? factor_->fronts->entries() : factor_->entries;
}

void SparseGeneralSolver::solve(const Vector& b, Vector& x) const {
  Matrix X;
  solve(Matrix(b), X);
  x = X.col(0);
}

void SparseGeneralSolver::solve(const Matrix& B, Matrix& X) const {
  const Eigen::SparseMatrix<double>& A = *factor_->A;
  ensure(B.rows() == A.rows(), "SparseGeneralSolver: matrix and right-hand side differ in size");
  X.resize(B.rows(), B.cols());
  if (B.size() == 0) return;
  if (factor_->by_fronts) return factor_->fronts->solve(B, X);
  factor_->indices.resize(static_cast<std::size_t>(B.rows()));
  factor_->room.resize(static_cast<std::size_t>(B.rows()));
  for (Eigen::Index j = 0; j < B.cols(); ++j)
    umfpack_di_wsolve(UMFPACK_A, A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr(), X.col(j).data(), B.col(j).data(),
                      factor_->numeric, factor_->control, nullptr, factor_->indices.data(), factor_->room.data());
}

}  // namespace scabo::linalg
