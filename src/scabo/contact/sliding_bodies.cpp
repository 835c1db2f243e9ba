#include "scabo/contact/sliding_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scabo::contact {

namespace {

using Index = Eigen::Index;

constexpr double no_entry = 1e-9;  // entries of a column of G, of its length
/// F below this part of the largest |H| is what the other equations still lack.
constexpr double indifferent = 1e-2;
/// The same for a group that stayed in the step before.
constexpr double still_indifferent = 0.3;
/// F below this part of what the next pair changes when it turns would make that pair stick at its friction bound. Such
/// a group balances too, as long as F is below this part of the largest |H|.
constexpr double hardly_turns = 1e-2, indifferent_where_hardly = 0.5;

bool asks_for_motion(const std::vector<PairState>& states, Index row) {
  const PairState& state = states[static_cast<std::size_t>(row / 2)];
  return row % 2 == 0 ? state.presses : state.sticks;
}

bool slips(const std::vector<PairState>& states, Index row) {
  const PairState& state = states[static_cast<std::size_t>(row / 2)];
  return row % 2 == 1 && state.presses && !state.sticks && state.slope != 0.0;
}

/// The slope of a pair that slips the other way.
double other_way(const Problem& problem, std::size_t pair, double slope) {
  const double side = slope > 0.0 ? -1.0 : 1.0;
  return side * problem.mu_against(static_cast<Index>(pair), side);
}

}  // namespace

SlidingBodies::SlidingBodies(const BDifferentiableEquations& equations)
    : equations_(equations), G_(equations.problem().G.sparse()), by_rows_(G_) {
  size_.resize(G_.cols());
  for (Index k = 0; k < G_.cols(); ++k) size_[k] = G_.col(k).norm();
  alike_.resize(static_cast<std::size_t>(G_.cols()));
  std::vector<Index> beside;
  for (Index k = 0; k < G_.cols(); ++k) {
    beside.clear();
    for (Eigen::SparseMatrix<double>::InnerIterator it(G_, k); it; ++it)
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator at(by_rows_, it.row()); at; ++at)
        if (at.col() != k) beside.push_back(at.col());
    std::sort(beside.begin(), beside.end());
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
    for (const Index other : beside)
      if (alike(k, other)) alike_[static_cast<std::size_t>(k)].push_back(static_cast<int>(other));
  }
}

/// Motions of two bodies that move all pairs between them alike.
bool SlidingBodies::alike(Index a, Index b) const {
  const double small = no_entry * (size_[a] + size_[b]);
  bool any = false;
  Eigen::SparseMatrix<double>::InnerIterator x(G_, a), y(G_, b);
  while (x && y) {
    const Index pair = std::min(x.row() / 2, y.row() / 2);
    double sum[2] = {0.0, 0.0};
    bool both[2] = {false, false};
    for (; x && x.row() / 2 == pair; ++x) sum[x.row() % 2] += x.value(), both[0] = true;
    for (; y && y.row() / 2 == pair; ++y) sum[y.row() % 2] += y.value(), both[1] = true;
    if (!both[0] || !both[1]) continue;
    if (std::abs(sum[0]) > small || std::abs(sum[1]) > small) return false;
    any = true;
  }
  return any;
}

/// Motions that rows of motion tie to each other and to nothing else, as groups; `group_of` is -1 for all others.
std::vector<std::vector<int>> SlidingBodies::loose_groups(const std::vector<PairState>& states,
                                                          std::vector<int>& group_of) const {
  const auto count = static_cast<std::size_t>(G_.cols());
  std::vector<int> root(count);
  std::iota(root.begin(), root.end(), 0);
  const auto top = [&](int k) {
    while (root[static_cast<std::size_t>(k)] != k)
      k = root[static_cast<std::size_t>(k)] = root[static_cast<std::size_t>(root[static_cast<std::size_t>(k)])];
    return k;
  };
  std::vector<char> tied(count, 0), slipping(count, 0);
  for (std::size_t k = 0; k < count; ++k) {
    const auto motion = static_cast<Index>(k);
    for (Eigen::SparseMatrix<double>::InnerIterator it(G_, motion); it; ++it) {
      if (std::abs(it.value()) <= no_entry * size_[motion]) continue;
      slipping[k] = slipping[k] || slips(states, it.row());
      if (!asks_for_motion(states, it.row())) continue;
      int other = -1;
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator at(by_rows_, it.row()); at; ++at)
        if (at.col() != motion && std::binary_search(alike_[k].begin(), alike_[k].end(), static_cast<int>(at.col())))
          other = static_cast<int>(at.col());
      if (other < 0)
        tied[k] = 1;
      else
        root[static_cast<std::size_t>(top(other))] = top(static_cast<int>(k));
    }
  }
  std::vector<char> held(count, 0), slides(count, 0);
  for (std::size_t k = 0; k < count; ++k) {
    const auto of = static_cast<std::size_t>(top(static_cast<int>(k)));
    held[of] = held[of] || tied[k];
    slides[of] = slides[of] || slipping[k];
  }
  std::vector<std::vector<int>> groups;
  std::vector<int> number(count, -1);
  group_of.assign(count, -1);
  for (std::size_t k = 0; k < count; ++k) {
    const auto of = static_cast<std::size_t>(top(static_cast<int>(k)));
    if (held[of] || !slides[of]) continue;
    if (number[of] < 0) number[of] = static_cast<int>(groups.size()), groups.emplace_back();
    groups[static_cast<std::size_t>(number[of])].push_back(static_cast<int>(k));
    group_of[k] = number[of];
  }
  return groups;
}

/// The sum of columns of G, without the pairs between the bodies.
std::vector<SlidingBodies::Entry> SlidingBodies::together(const std::vector<int>& motions) const {
  std::vector<Entry> entries, sums;
  double size = 0.0;
  for (const int motion : motions) {
    size = std::max(size, size_[motion]);
    for (Eigen::SparseMatrix<double>::InnerIterator it(G_, motion); it; ++it) entries.push_back({it.row(), it.value()});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.row < b.row; });
  for (std::size_t k = 0; k < entries.size();) {
    Entry sum{entries[k].row, 0.0};
    for (; k < entries.size() && entries[k].row == sum.row; ++k) sum.value += entries[k].value;
    if (std::abs(sum.value) > no_entry * size) sums.push_back(sum);
  }
  return sums;
}

/// What pulls at a group that slides, F(0), and the pairs whose slip turns when it moves on, in their order.
SlidingBodies::Slide SlidingBodies::slide_of(const std::vector<int>& motions, const Vector& p, const Residual& at,
                                             const std::vector<PairState>& states) const {
  const Vector &r = equations_.r(), &f = equations_.problem().f;
  Slide slide;
  for (const int motion : motions) slide.force += f[motion];
  for (const Entry& entry : together(motions)) {
    // Pairs with cohesion would jump by more than friction.
    if (asks_for_motion(states, entry.row) || equations_.problem().cohesion_of(entry.row / 2) > 0.0) slide.held = true;
    if (!slips(states, entry.row)) continue;
    const auto pair = static_cast<std::size_t>(entry.row / 2);
    const double slope = states[pair].slope, turned = other_way(equations_.problem(), pair, slope),
                 p_n = std::max(p[entry.row - 1], 0.0), bound = std::abs(slope) * p_n;
    const double trial = p[entry.row] - r[entry.row] * at.motion[entry.row];
    const double slip = std::copysign(std::max(std::abs(trial) - bound, 0.0) / r[entry.row], -slope);
    slide.force += entry.value * slope * p_n;
    const double fall = (std::abs(slope) + std::abs(turned)) * p_n;
    slide.turns.push_back({-slip / entry.value, std::abs(entry.value) * fall, pair});
  }
  slide.held = slide.held || slide.turns.empty();
  const double side = slide.force > 0.0 ? 1.0 : -1.0;
  std::erase_if(slide.turns, [&](const Slip& turn) { return side * turn.at < 0.0; });
  std::sort(slide.turns.begin(), slide.turns.end(),
            [&](const Slip& a, const Slip& b) { return side * a.at < side * b.at; });
  return slide;
}

std::vector<int> SlidingBodies::hold(const Vector& p, const Residual& at, std::vector<PairState>& states, Vector& H,
                                     const std::vector<int>& stayed) const {
  const Vector& r = equations_.r();
  const double largest = at.largest();
  std::vector<int> group_of, staying;
  std::vector<std::vector<int>> groups = loose_groups(states, group_of);
  for (std::size_t first = 0; first < groups.size(); ++first) {
    std::vector<int> motions = std::move(groups[first]);
    for (const int motion : motions) group_of[static_cast<std::size_t>(motion)] = -1;
    for (bool held = false; !held;) {
      held = true;
      const Slide slide = slide_of(motions, p, at, states);
      if (slide.held) break;
      double left = std::abs(slide.force);
      const bool stays_on =
          std::find_first_of(motions.begin(), motions.end(), stayed.begin(), stayed.end()) != motions.end();
      const double next_fall = slide.turns.empty() ? 0.0 : slide.turns.front().fall;
      if (left <= (stays_on ? still_indifferent : indifferent) * largest ||
          left <= std::min(indifferent_where_hardly * largest, hardly_turns * next_fall)) {
        // One of them for all: the others may move towards it, as the pairs between them ask.
        staying.push_back(motions.front());
        break;
      }
      for (const Slip& turn : slide.turns) {
        left -= turn.fall;
        const Index row = 2 * static_cast<Index>(turn.pair) + 1;
        PairState& state = states[turn.pair];
        if (left > 0.0) {
          state.slope = other_way(equations_.problem(), turn.pair, state.slope);
          H[row] = p[row] - state.slope * p[row - 1];
          continue;
        }
        state.sticks = true;
        state.slope = 0.0;
        H[row] = r[row] * at.motion[row];
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(by_rows_, row); it; ++it) {
          const int other = group_of[static_cast<std::size_t>(it.col())];
          if (other < 0 || std::abs(it.value()) <= no_entry * size_[it.col()]) continue;
          for (const int motion : groups[static_cast<std::size_t>(other)]) {
            group_of[static_cast<std::size_t>(motion)] = -1;
            motions.push_back(motion);
          }
          groups[static_cast<std::size_t>(other)].clear();
          held = false;
        }
        break;
      }
    }
  }
  return staying;
}

}  // namespace scabo::contact
