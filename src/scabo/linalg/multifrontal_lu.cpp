#include "scabo/linalg/multifrontal_lu.hpp"

#include <cblas.h>
#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "scabo/base/error.hpp"
#include "scabo/base/interruption.hpp"
#include "scabo/linalg/dense.hpp"

namespace scabo::linalg {

namespace {

/// Time of a front with k pivots and b neighbours, in operations of large products; what is left of it is added to
/// another front, which takes as long as so many operations an entry.
double cost_of(double k, double b) {
  constexpr double of_adding = 60.0;
  return k * k * (2.0 / 3.0 * k + 2.0 * b) + 2.0 * k * b * b + of_adding * b * b;
}

constexpr int least_halved = 32;  // triangular solves of fewer unknowns are left to BLAS, whose kernels are slow there

/// X <- L^-1 X, L lower with unit diagonal.
void solve_lower(const Eigen::Ref<const Matrix>& L, Eigen::Ref<Matrix> X) {
  const Eigen::Index n = L.rows(), half = n / 2;
  if (n <= least_halved) {
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasUnit, static_cast<int>(n),
                static_cast<int>(X.cols()), 1.0, L.data(), static_cast<int>(L.outerStride()), X.data(),
                static_cast<int>(X.outerStride()));
    return;
  }
  solve_lower(L.topLeftCorner(half, half), X.topRows(half));
  add_product(-1.0, L.bottomLeftCorner(n - half, half), X.topRows(half), X.bottomRows(n - half));
  solve_lower(L.bottomRightCorner(n - half, n - half), X.bottomRows(n - half));
}

/// X <- X U^-1.
void solve_upper_from_right(const Eigen::Ref<const Matrix>& U, Eigen::Ref<Matrix> X) {
  const Eigen::Index n = U.rows(), half = n / 2;
  if (n <= least_halved) {
    cblas_dtrsm(CblasColMajor, CblasRight, CblasUpper, CblasNoTrans, CblasNonUnit, static_cast<int>(X.rows()),
                static_cast<int>(n), 1.0, U.data(), static_cast<int>(U.outerStride()), X.data(),
                static_cast<int>(X.outerStride()));
    return;
  }
  solve_upper_from_right(U.topLeftCorner(half, half), X.leftCols(half));
  add_product(-1.0, X.leftCols(half), U.topRightCorner(half, n - half), X.rightCols(n - half));
  solve_upper_from_right(U.bottomRightCorner(n - half, n - half), X.rightCols(n - half));
}

/// X <- T^-1 X, T a triangle of F; of one column with the kernels for vectors, which are faster there.
void solve_triangular(CBLAS_UPLO part, CBLAS_DIAG diagonal, const Matrix& F, Matrix& X) {
  const auto n = static_cast<int>(F.rows()), columns = static_cast<int>(X.cols());
  if (columns == 1)
    cblas_dtrsv(CblasColMajor, part, CblasNoTrans, diagonal, n, F.data(), n, X.data(), 1);
  else
    cblas_dtrsm(CblasColMajor, CblasLeft, part, CblasNoTrans, diagonal, n, columns, 1.0, F.data(), n, X.data(), n);
}

/// Y <- Y - A X.
void subtract_product(const Matrix& A, const Matrix& X, Matrix& Y) {
  const auto rows = static_cast<int>(A.rows()), inner = static_cast<int>(A.cols()),
             columns = static_cast<int>(X.cols());
  if (columns == 1)
    cblas_dgemv(CblasColMajor, CblasNoTrans, rows, inner, -1.0, A.data(), rows, X.data(), 1, 1.0, Y.data(), 1);
  else
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, rows, columns, inner, -1.0, A.data(), rows, X.data(), inner,
                1.0, Y.data(), rows);
}

/// Blocks that are eliminated together: fronts, named by the last of them.
struct FrontTree {
  std::vector<std::vector<int>> left;              // of each block when it is eliminated: its neighbours then
  std::vector<std::vector<int>> merged, children;  // blocks of each front; fronts
  std::vector<int> roots;
};

/// What is left of each block, its later neighbours and those of the blocks below it, which are returned.
std::vector<std::vector<int>> eliminate_blocks(std::vector<std::vector<int>> later, FrontTree& tree) {
  tree.left = std::move(later);
  std::vector<std::vector<int>>& left = tree.left;
  std::vector<std::vector<int>> below(left.size());
  std::vector<int> both;
  for (std::size_t v = 0; v < left.size(); ++v) {
    for (const int child : below[v]) {
      const std::vector<int>& theirs = left[static_cast<std::size_t>(child)];
      both.clear();
      std::set_union(left[v].begin(), left[v].end(), theirs.begin() + 1, theirs.end(), std::back_inserter(both));
      left[v].swap(both);
    }
    if (left[v].empty())
      tree.roots.push_back(static_cast<int>(v));
    else
      below[static_cast<std::size_t>(left[v].front())].push_back(static_cast<int>(v));
  }
  return below;
}

/// A front for each block, merged with those below where that is worth it.
FrontTree front_tree(const std::vector<std::vector<int>>& members, std::vector<std::vector<int>> later) {
  FrontTree tree;
  std::vector<std::vector<int>> below = eliminate_blocks(std::move(later), tree);
  const std::size_t count = members.size();
  std::vector<double> pivots(count), border(count, 0.0);
  tree.merged.resize(count), tree.children.resize(count);
  for (std::size_t v = 0; v < count; ++v) {
    pivots[v] = static_cast<double>(members[v].size());
    for (const int w : tree.left[v]) border[v] += static_cast<double>(members[static_cast<std::size_t>(w)].size());
    tree.merged[v] = {static_cast<int>(v)};
    std::sort(below[v].begin(), below[v].end(),
              [&](int c, int d) { return border[static_cast<std::size_t>(c)] > border[static_cast<std::size_t>(d)]; });
    for (const int c : below[v]) {
      const auto child = static_cast<std::size_t>(c);
      const double apart = cost_of(pivots[child], border[child]) + cost_of(pivots[v], border[v]);
      if (cost_of(pivots[child] + pivots[v], border[v]) > apart) {
        tree.children[v].push_back(c);
        continue;
      }
      pivots[v] += pivots[child];
      const std::vector<int>&theirs = tree.merged[child], &fronts = tree.children[child];
      tree.merged[v].insert(tree.merged[v].end(), theirs.begin(), theirs.end());
      tree.children[v].insert(tree.children[v].end(), fronts.begin(), fronts.end());
      tree.merged[child].clear();
    }
  }
  return tree;
}

/// Fronts, each after its children: these one after the other, so that few rests wait.
std::vector<std::size_t> children_first(const FrontTree& tree) {
  std::vector<std::size_t> order;
  std::vector<std::pair<std::size_t, std::size_t>> path;
  for (const int root : tree.roots) {
    path.emplace_back(root, 0);
    while (!path.empty()) {
      auto& [at, next] = path.back();
      if (next < tree.children[at].size()) {
        path.emplace_back(tree.children[at][next++], 0);
      } else {
        order.push_back(at);
        path.pop_back();
      }
    }
  }
  return order;
}

}  // namespace

MultifrontalLU::MultifrontalLU(OrderedBlocks blocks) : bare_(std::move(blocks.bare)) {
  FrontTree tree = front_tree(blocks.members, std::move(blocks.later));
  std::vector<int> number(blocks.members.size(), -1);
  for (const std::size_t v : children_first(tree)) {
    Front front;
    const auto add = [&](const std::vector<int>& more) {
      for (const int w : more) {
        const std::vector<int>& members = blocks.members[static_cast<std::size_t>(w)];
        front.unknowns.insert(front.unknowns.end(), members.begin(), members.end());
      }
    };
    std::sort(tree.merged[v].begin(), tree.merged[v].end());
    add(tree.merged[v]);
    front.pivots = static_cast<int>(front.unknowns.size());
    add(tree.left[v]);
    for (const int c : tree.children[v]) front.children.push_back(number[static_cast<std::size_t>(c)]);
    number[v] = static_cast<int>(fronts_.size());
    n_ += front.pivots;
    const double k = front.pivots, b = front.border();
    operations_ += k * k * (2.0 / 3.0 * k + 2.0 * b) + 2.0 * k * b * b;
    entries_ += k * (k + 2.0 * b);
    fronts_.push_back(std::move(front));
  }
  place_.resize(static_cast<std::size_t>(n_));
  is_bare_.assign(static_cast<std::size_t>(n_), 0);
  for (const int unknown : bare_) is_bare_[static_cast<std::size_t>(unknown)] = 1;
}

/// A12 c, c for each row of A21: what it adds to the diagonal of A11 is as large as that.
void MultifrontalLU::add_rows_of_bare(const Eigen::SparseMatrix<double>& A,
                                      const Eigen::SparseMatrix<double, Eigen::RowMajor>& by_rows) {
  const Vector diagonal = A.diagonal();
  std::vector<Eigen::Triplet<double>> entries;
  factor_of_.assign(static_cast<std::size_t>(n_), 0.0);
  for (const int unknown : bare_) {
    double there = 0.0, added = 0.0;
    Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator row(by_rows, unknown);
    for (Eigen::SparseMatrix<double>::InnerIterator it(A, unknown); it; ++it) {
      while (row && row.col() < it.row()) ++row;
      if (is_bare_[static_cast<std::size_t>(it.row())]) continue;
      there += std::abs(diagonal[it.row()]);
      if (row && row.col() == it.row()) added += std::abs(it.value() * row.value());
    }
    if (!(added > 0.0) || !std::isfinite(there / added)) continue;
    factor_of_[static_cast<std::size_t>(unknown)] = there / added;
    for (Eigen::SparseMatrix<double>::InnerIterator it(A, unknown); it; ++it)
      if (!is_bare_[static_cast<std::size_t>(it.row())])
        entries.emplace_back(static_cast<int>(it.row()), unknown, there / added * it.value());
  }
  added_.resize(n_, n_);
  added_.setFromTriplets(entries.begin(), entries.end());
}

/// Entries of A in the rows and columns of the pivots, but for those of fronts that have been left.
void MultifrontalLU::gather(Front& front, const Eigen::SparseMatrix<double>& A,
                            const Eigen::SparseMatrix<double, Eigen::RowMajor>& by_rows) {
  const int k = front.pivots, b = front.border();
  front.F11.setZero(k, k);
  front.U12.setZero(k, b);
  front.L21.setZero(b, k);
  front.rest.setZero(b, b);
  for (std::size_t at = 0; at < front.unknowns.size(); ++at)
    place_[static_cast<std::size_t>(front.unknowns[at])] = static_cast<int>(at);
  for (int at = 0; at < k; ++at) {
    const int unknown = front.unknowns[static_cast<std::size_t>(at)];
    for (Eigen::SparseMatrix<double>::InnerIterator it(A, unknown); it; ++it) {
      if (done_[static_cast<std::size_t>(it.row())]) continue;
      const int row = place_[static_cast<std::size_t>(it.row())];
      const double value = row_scale_[it.row()] * it.value();
      if (row < k)
        front.F11(row, at) += value;
      else
        front.L21(row - k, at) += value;
      if (!is_bare_[static_cast<std::size_t>(it.row())]) continue;
      for (Eigen::SparseMatrix<double>::InnerIterator more(added_, it.row()); more; ++more) {
        if (done_[static_cast<std::size_t>(more.row())]) continue;
        const int to = place_[static_cast<std::size_t>(more.row())];
        const double product = row_scale_[more.row()] * more.value() * it.value();
        if (to < k)
          front.F11(to, at) += product;
        else
          front.L21(to - k, at) += product;
      }
    }
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(by_rows, unknown); it; ++it) {
      if (done_[static_cast<std::size_t>(it.col())]) continue;
      const int column = place_[static_cast<std::size_t>(it.col())];
      if (column >= k) front.U12(at, column - k) += row_scale_[unknown] * it.value();
    }
    if (is_bare_[static_cast<std::size_t>(unknown)]) continue;
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(by_rows, unknown); it; ++it) {
      if (!is_bare_[static_cast<std::size_t>(it.col())]) continue;
      const double factor = row_scale_[unknown] * factor_of_[static_cast<std::size_t>(it.col())] * it.value();
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator more(by_rows, it.col()); more; ++more) {
        if (done_[static_cast<std::size_t>(more.col())]) continue;
        const int column = place_[static_cast<std::size_t>(more.col())];
        if (column >= k) front.U12(at, column - k) += factor * more.value();
      }
    }
  }
}

/// Both have their unknowns in the order of elimination: pivots of the front come first in the child as well.
void MultifrontalLU::add_rest(Front& front, Front& child) {
  const int k = front.pivots, size = child.border();
  const int* const unknowns = child.unknowns.data() + child.pivots;
  int inner = 0;
  std::vector<int> place(static_cast<std::size_t>(size));
  for (int i = 0; i < size; ++i) {
    place[static_cast<std::size_t>(i)] = place_[static_cast<std::size_t>(unknowns[i])];
    if (place[static_cast<std::size_t>(i)] < k)
      ++inner;
    else
      place[static_cast<std::size_t>(i)] -= k;
  }
  for (int j = 0; j < size; ++j) {
    const double* const from = child.rest.col(j).data();
    const int column = place[static_cast<std::size_t>(j)];
    double* const above = (j < inner ? front.F11 : front.U12).col(column).data();
    double* const below = (j < inner ? front.L21 : front.rest).col(column).data();
    for (int i = 0; i < inner; ++i) above[place[static_cast<std::size_t>(i)]] += from[i];
    for (int i = inner; i < size; ++i) below[place[static_cast<std::size_t>(i)]] += from[i];
  }
  child.rest.resize(0, 0);
}

bool MultifrontalLU::eliminate(Front& front) {
  const int k = front.pivots;
  front.exchanged.resize(static_cast<std::size_t>(k));
  if (LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, k, k, front.F11.data(), k, front.exchanged.data()) != 0) return false;
  if (front.border() == 0) return true;
  LAPACKE_dlaswp_work(LAPACK_COL_MAJOR, front.border(), front.U12.data(), k, 1, k, front.exchanged.data(), 1);
  solve_lower(front.F11, front.U12);
  solve_upper_from_right(front.F11, front.L21);
  add_product(-1.0, front.L21, front.U12, front.rest);
  return true;
}

bool MultifrontalLU::factorise(const Eigen::SparseMatrix<double>& A) {
  ensure(A.rows() == n_ && A.cols() == n_ && A.isCompressed(), "MultifrontalLU: a matrix of another size");
  constexpr double largest_error = 1e-6;
  reciprocal_condition_ = 0.0;
  if (n_ == 0) return true;
  row_scale_.setZero(n_);
  for (int j = 0; j < n_; ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(A, j); it; ++it) row_scale_[it.row()] += std::abs(it.value());
  if (!(row_scale_.minCoeff() > 0.0) || !row_scale_.allFinite()) return false;
  row_scale_ = row_scale_.cwiseInverse();
  done_.assign(static_cast<std::size_t>(n_), 0);
  double least = HUGE_VAL, largest = 0.0;
  {
    const Eigen::SparseMatrix<double, Eigen::RowMajor> by_rows = A;
    add_rows_of_bare(A, by_rows);
    for (Front& front : fronts_) {
      interruption_point();
      gather(front, A, by_rows);
      for (const int child : front.children) add_rest(front, fronts_[static_cast<std::size_t>(child)]);
      if (!eliminate(front)) return false;
      const auto pivots = front.F11.diagonal().cwiseAbs();
      least = std::min(least, pivots.minCoeff());
      largest = std::max(largest, pivots.maxCoeff());
      for (int at = 0; at < front.pivots; ++at)
        done_[static_cast<std::size_t>(front.unknowns[static_cast<std::size_t>(at)])] = 1;
    }
  }
  if (!(least > 0.0) || !std::isfinite(largest)) return false;
  reciprocal_condition_ = least / largest;
  const Matrix b = A * Vector::Ones(n_);
  Matrix x;
  solve(b, x);
  const Vector left = row_scale_.cwiseProduct(b - A * x);  // of rows whose entries add up to 1
  return left.lpNorm<Eigen::Infinity>() <= largest_error * x.lpNorm<Eigen::Infinity>();
}

void MultifrontalLU::solve(const Matrix& B, Matrix& X) const {
  ensure(B.rows() == n_, "MultifrontalLU: matrix and right-hand side differ in size");
  X = B;
  if (!bare_.empty()) X.noalias() += added_ * B;
  X.array().colwise() *= row_scale_.array();
  Matrix of_front, of_border;
  const auto pivots_of = [](const Front& front) {
    return Eigen::Map<const Eigen::VectorXi>(front.unknowns.data(), front.pivots);
  };
  const auto border_of = [](const Front& front) {
    return Eigen::Map<const Eigen::VectorXi>(front.unknowns.data() + front.pivots, front.border());
  };
  for (const Front& front : fronts_) {
    of_front = X(pivots_of(front), Eigen::all);
    if (of_front.isZero(0.0)) continue;  // most fronts where B has unit vectors
    for (int at = 0; at < front.pivots; ++at)
      if (const int other = front.exchanged[static_cast<std::size_t>(at)] - 1; other != at)
        of_front.row(at).swap(of_front.row(other));
    solve_triangular(CblasLower, CblasUnit, front.F11, of_front);
    X(pivots_of(front), Eigen::all) = of_front;
    if (front.border() == 0) continue;
    of_border.setZero(front.border(), X.cols());
    subtract_product(front.L21, of_front, of_border);
    X(border_of(front), Eigen::all) += of_border;
  }
  for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front) {
    of_front = X(pivots_of(*front), Eigen::all);
    if (front->border() > 0) {
      of_border = X(border_of(*front), Eigen::all);
      subtract_product(front->U12, of_border, of_front);
    }
    solve_triangular(CblasUpper, CblasNonUnit, front->F11, of_front);
    X(pivots_of(*front), Eigen::all) = of_front;
  }
}

}  // namespace scabo::linalg
