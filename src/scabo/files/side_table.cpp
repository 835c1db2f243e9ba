#include "scabo/files/side_table.hpp"

#include <algorithm>
#include <tuple>

namespace scabo::files {

SideTable::SideTable(const std::vector<ImportedCell>& cells, int nodes) : cells_(cells) {
  start_.assign(static_cast<std::size_t>(nodes) + 1, 0);
  for (const ImportedCell& cell : cells) {
    for (int i = 0; i < cell.corners(); ++i) {
      const Facet side = side_of(cell, i);
      ++start_[static_cast<std::size_t>(std::min(side.start, side.end)) + 1];
    }
  }
  for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
  entries_.resize(start_.back());
  std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (int i = 0; i < cells[c].corners(); ++i) {
      const Facet side = side_of(cells[c], i);
      const auto low = static_cast<std::size_t>(std::min(side.start, side.end));
      entries_[next[low]++] = {
          std::max(side.start, side.end), side.middle, {static_cast<int>(c), i}, side.start < side.end};
    }
  }
  for (std::size_t n = 0; n + 1 < start_.size(); ++n) {
    std::sort(entries_.begin() + static_cast<std::ptrdiff_t>(start_[n]),
              entries_.begin() + static_cast<std::ptrdiff_t>(start_[n + 1]), [](const Entry& a, const Entry& b) {
                return std::tie(a.high, a.middle, a.side.cell, a.side.side) <
                       std::tie(b.high, b.middle, b.side.cell, b.side.side);
              });
  }
}

std::pair<std::size_t, std::size_t> SideTable::between(int a, int b) const {
  const auto low = static_cast<std::size_t>(std::min(a, b));
  const int high = std::max(a, b);
  std::size_t first = start_[low];
  while (first < start_[low + 1] && entries_[first].high < high) ++first;
  std::size_t last = first;
  while (last < start_[low + 1] && entries_[last].high == high) ++last;
  return {first, last};
}

std::vector<CellSide> SideTable::sides_at(const Facet& facet) const {
  std::vector<CellSide> found;
  const auto range = between(facet.start, facet.end);
  for (std::size_t i = range.first; i < range.second; ++i) {
    if (facet.middle < 0 || entries_[i].middle == facet.middle) found.push_back(entries_[i].side);
  }
  return found;
}

std::optional<CellSide> SideTable::neighbour(CellSide side) const {
  const Facet facet = side_of(cells_[static_cast<std::size_t>(side.cell)], side.side);
  const auto range = between(facet.start, facet.end);
  for (std::size_t i = range.first; i < range.second; ++i) {
    if (entries_[i].middle == facet.middle && entries_[i].forward != (facet.start < facet.end)) return entries_[i].side;
  }
  return std::nullopt;
}

std::optional<SideTable::Conflict> SideTable::conflict() const {
  for (std::size_t n = 0; n + 1 < start_.size(); ++n) {
    // Sides with the same ends are neighbours in the table; there are one or two unless something is wrong.
    for (std::size_t i = start_[n]; i + 1 < start_[n + 1]; ++i) {
      const Entry& a = entries_[i];
      for (std::size_t j = i + 1; j < std::min(start_[n + 1], i + 3) && entries_[j].high == a.high; ++j) {
        const Entry& b = entries_[j];
        if (a.middle == b.middle && a.forward == b.forward) return Conflict{a.side, b.side, Conflict::Kind::overlap};
        if (a.forward != b.forward && (a.middle < 0) != (b.middle < 0)) {
          return Conflict{a.side, b.side, Conflict::Kind::order};
        }
      }
    }
  }
  return std::nullopt;
}

}  // namespace scabo::files
