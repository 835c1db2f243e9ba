#include "scabo/linalg/supernodal_sweep.hpp"

#include <cblas.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "scabo/base/error.hpp"
#include "scabo/base/interruption.hpp"

namespace scabo::linalg {

namespace {

/// The columns of E, sorted, that have reached a supernode: [begin, end).
struct Reached {
  int begin = 0, end = 0;
  int count() const { return end - begin; }
};

/// What a supernode hands on to its parent.
struct HandedOn {
  std::int64_t from = 0, to = 0;  // supernodes
  Reached columns;
  Matrix values;  // rows below the supernode x columns
};

class Sweep {
 public:
  Sweep(const SupernodalFactor& L, const std::vector<std::int64_t>& positions)
      : L_(L), positions_(positions), result_(Matrix::Zero(count(), count())) {
    sorted_.resize(positions.size());
    std::iota(sorted_.begin(), sorted_.end(), 0);
    std::stable_sort(sorted_.begin(), sorted_.end(), [&](int a, int b) { return position(a) < position(b); });
    find_supernodes();
  }

  Matrix run() {
    for (std::int64_t s = 0; s < L_.supernodes; ++s) {
      if (reached_[index(s)].count() == 0) continue;
      interruption_point();
      visit(s);
    }
    fill_upper_triangle();
    put_in_place();
    return std::move(result_);
  }

 private:
  static std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }
  int count() const { return static_cast<int>(positions_.size()); }
  std::int64_t position(int column) const { return positions_[index(column)]; }
  std::int64_t supernode_of(std::int64_t column) const {
    return std::upper_bound(L_.first_column, L_.first_column + L_.supernodes + 1, column) - L_.first_column - 1;
  }
  std::int64_t parent(std::int64_t s) const {
    const std::int64_t columns = L_.columns_of(s);
    return L_.rows_of(s) > columns ? supernode_of(L_.rows[L_.first_row[s] + columns]) : L_.supernodes;
  }

  /// By tiles, which stay in the cache.
  void fill_upper_triangle() {
    constexpr int tile = 64;
    for (int first = 0; first < count(); first += tile)
      for (int below = first; below < count(); below += tile)
        for (int j = first; j < std::min(first + tile, count()); ++j)
          for (int i = std::max(below, j + 1); i < std::min(below + tile, count()); ++i) result_(j, i) = result_(i, j);
  }

  /// Rows and columns of the result in the order of `positions`, within its own memory: of a thousand contact points in
  /// space it has gigabytes.
  void put_in_place() {
    std::vector<double> column(index(count()));
    for (int j = 0; j < count(); ++j) {
      double* const values = result_.col(j).data();
      std::copy_n(values, count(), column.begin());
      for (int i = 0; i < count(); ++i) values[sorted_[index(i)]] = column[index(i)];
    }
    std::vector<int> to = sorted_;
    for (int j = 0; j < count(); ++j)
      while (to[index(j)] != j) {
        const int place = to[index(j)];
        result_.col(j).swap(result_.col(place));
        std::swap(to[index(j)], to[index(place)]);
      }
  }

  void find_supernodes() {
    reached_.resize(index(L_.supernodes));
    std::vector<int> sum(index(L_.supernodes), 0);  // of the columns, to check that they are consecutive
    const auto add = [&](std::int64_t s, Reached columns, int number) {
      Reached& all = reached_[index(s)];
      all = sum[index(s)] == 0 ? columns : Reached{std::min(all.begin, columns.begin), std::max(all.end, columns.end)};
      sum[index(s)] += number;
    };
    for (int j = 0; j < count(); ++j) add(supernode_of(position(sorted_[index(j)])), {j, j + 1}, 1);
    for (std::int64_t s = 0; s < L_.supernodes; ++s) {
      const Reached columns = reached_[index(s)];
      if (columns.count() == 0) continue;
      ensure(columns.count() == sum[index(s)], "supernodes are not in postorder");
      if (const std::int64_t above = parent(s); above < L_.supernodes) add(above, columns, columns.count());
    }
  }

  void visit(std::int64_t s) {
    const Reached columns = reached_[index(s)];
    const std::int64_t *const rows = L_.rows + L_.first_row[s], first = L_.first_column[s];
    const int stride = static_cast<int>(L_.rows_of(s)), own = static_cast<int>(L_.columns_of(s)), below = stride - own,
              active = columns.count();
    Matrix R1 = Matrix::Zero(own, active), R2 = Matrix::Zero(below, active);
    for (int j = columns.begin; j < columns.end; ++j)
      if (const std::int64_t at = position(sorted_[index(j)]) - first; at >= 0) R1(at, j - columns.begin) = 1.0;
    while (!waiting_.empty() && waiting_.back().to == s) {
      add(waiting_.back(), rows, own, columns, R1, R2);
      waiting_.pop_back();
    }

    const double* const L11 = L_.values + L_.first_value[s];
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, own, active, 1.0, L11, stride,
                R1.data(), own);
    if (below > 0) {
      cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, below, active, own, -1.0, L11 + own, stride, R1.data(),
                  own, 1.0, R2.data(), below);
      waiting_.push_back({s, parent(s), columns, std::move(R2)});
    }
    cblas_dsyrk(CblasColMajor, CblasLower, CblasTrans, active, own, 1.0, R1.data(), own, 1.0,
                &result_(columns.begin, columns.begin), count());
  }

  /// Adds what a child handed on to the right-hand sides of its parent.
  void add(const HandedOn& child, const std::int64_t* rows, int own, Reached columns, Matrix& R1, Matrix& R2) {
    const std::int64_t* const child_rows = L_.rows + L_.first_row[child.from] + L_.columns_of(child.from);
    places_.resize(index(child.values.rows()));
    int place = 0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      while (rows[place] != child_rows[i]) ++place;
      places_[i] = place;
    }
    const auto in_R1 = std::lower_bound(places_.begin(), places_.end(), own) - places_.begin();
    for (Eigen::Index j = 0; j < child.values.cols(); ++j) {
      const double* const from = child.values.col(j).data();
      double *const to1 = R1.col(j + child.columns.begin - columns.begin).data(),
                    *const to2 = R2.col(j + child.columns.begin - columns.begin).data();
      for (std::ptrdiff_t i = 0; i < in_R1; ++i) to1[places_[index(i)]] += from[i];
      for (std::ptrdiff_t i = in_R1; i < child.values.rows(); ++i) to2[places_[index(i)] - own] += from[i];
    }
  }

  const SupernodalFactor& L_;
  const std::vector<std::int64_t>& positions_;
  std::vector<int> sorted_;  // columns of E by their positions
  std::vector<Reached> reached_;
  std::vector<HandedOn> waiting_;  // a stack
  std::vector<int> places_;
  Matrix result_;  // in the order of sorted_, lower triangle
};

}  // namespace

namespace {

std::int64_t supernode_of(const SupernodalFactor& L, std::int64_t row) {
  return std::upper_bound(L.first_column, L.first_column + L.supernodes + 1, row) - L.first_column - 1;
}

/// The first of the rows below a supernode; the size of L where there are none.
std::int64_t row_above(const SupernodalFactor& L, std::int64_t s) {
  const std::int64_t columns = L.columns_of(s);
  return L.rows_of(s) > columns ? L.rows[L.first_row[s] + columns] : L.size;
}

std::int64_t most_rows(const SupernodalFactor& L) {
  std::int64_t most = 0;
  for (std::int64_t s = 0; s < L.supernodes; ++s) most = std::max(most, L.rows_of(s));
  return most;
}

/// L'x = y in the columns of one supernode, those above it being known. `below`: room.
void solve_transposed(const SupernodalFactor& L, std::int64_t s, Vector& y, Vector& below) {
  const std::int64_t first = L.first_column[s];
  const int own = static_cast<int>(L.columns_of(s)), stride = static_cast<int>(L.rows_of(s)), under = stride - own;
  const double* const L11 = L.values + L.first_value[s];
  if (under > 0) {
    const std::int64_t* const rows = L.rows + L.first_row[s] + own;
    for (int i = 0; i < under; ++i) below[i] = y[rows[i]];
    cblas_dgemv(CblasColMajor, CblasTrans, under, own, -1.0, L11 + own, stride, below.data(), 1, 1.0, y.data() + first,
                1);
  }
  cblas_dtrsv(CblasColMajor, CblasLower, CblasTrans, CblasNonUnit, own, L11, stride, y.data() + first, 1);
}

}  // namespace

Vector forward(const SupernodalFactor& L, Vector b) {
  std::vector<char> reached(static_cast<std::size_t>(L.supernodes), 0);
  Vector below(most_rows(L));  // entries of b in the rows below a supernode
  for (std::int64_t s = 0; s < L.supernodes; ++s) {
    const std::int64_t first = L.first_column[s];
    const int own = static_cast<int>(L.columns_of(s)), stride = static_cast<int>(L.rows_of(s)), under = stride - own;
    if (!reached[static_cast<std::size_t>(s)] && b.segment(first, own).isZero(0.0)) continue;
    const double* const L11 = L.values + L.first_value[s];
    cblas_dtrsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, own, L11, stride, b.data() + first, 1);
    if (under == 0) continue;
    reached[static_cast<std::size_t>(supernode_of(L, row_above(L, s)))] = 1;
    cblas_dgemv(CblasColMajor, CblasNoTrans, under, own, 1.0, L11 + own, stride, b.data() + first, 1, 0.0, below.data(),
                1);
    const std::int64_t* const rows = L.rows + L.first_row[s] + own;
    for (int i = 0; i < under; ++i) b[rows[i]] -= below[i];
  }
  return b;
}

Vector backward(const SupernodalFactor& L, Vector y) {
  Vector below(most_rows(L));
  for (std::int64_t s = L.supernodes - 1; s >= 0; --s) solve_transposed(L, s, y, below);
  return y;
}

Vector backward_at(const SupernodalFactor& L, Vector y, const std::vector<std::int64_t>& wanted) {
  std::vector<char> needed(static_cast<std::size_t>(L.supernodes), 0);
  for (const std::int64_t row : wanted)
    for (std::int64_t s = supernode_of(L, row); !needed[static_cast<std::size_t>(s)];) {
      needed[static_cast<std::size_t>(s)] = 1;
      const std::int64_t above = row_above(L, s);
      if (above == L.size) break;
      s = supernode_of(L, above);
    }
  Vector below(most_rows(L));
  for (std::int64_t s = L.supernodes - 1; s >= 0; --s)
    if (needed[static_cast<std::size_t>(s)]) solve_transposed(L, s, y, below);
  Vector x(static_cast<Eigen::Index>(wanted.size()));
  for (std::size_t i = 0; i < wanted.size(); ++i) x[static_cast<Eigen::Index>(i)] = y[wanted[i]];
  return x;
}

Matrix inverse_block(const SupernodalFactor& L, const std::vector<std::int64_t>& positions) {
  if (positions.empty()) return {};
  return Sweep(L, positions).run();
}

}  // namespace scabo::linalg
