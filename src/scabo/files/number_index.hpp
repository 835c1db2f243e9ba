// Numbers of nodes and cells in a file, in any order and with gaps -> their position.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace scabo::files {

/// Memory is proportional to the count of numbers, however large they are.
class NumberIndex {
 public:
  explicit NumberIndex(const std::vector<std::int64_t>& numbers) {
    std::int64_t largest = 0;
    bool dense = true;
    for (const std::int64_t number : numbers) {
      largest = std::max(largest, number);
      dense = dense && number >= 0;
    }
    const auto count = static_cast<std::int64_t>(numbers.size());
    if (dense && largest <= 8 * count + 1000) {
      table_.assign(static_cast<std::size_t>(largest) + 1, -1);
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        int& place = table_[static_cast<std::size_t>(numbers[i])];
        if (place >= 0 && !repeated_) repeated_ = {place, static_cast<int>(i)};
        if (place < 0) place = static_cast<int>(i);
      }
      return;
    }
    sorted_.reserve(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) sorted_.emplace_back(numbers[i], static_cast<int>(i));
    std::sort(sorted_.begin(), sorted_.end());
    for (std::size_t i = 0; i + 1 < sorted_.size() && !repeated_; ++i) {
      if (sorted_[i].first == sorted_[i + 1].first) repeated_ = {sorted_[i].second, sorted_[i + 1].second};
    }
  }

  /// Position of a number; -1 if there is none.
  int find(std::int64_t number) const {
    if (!table_.empty()) {
      return number >= 0 && number < static_cast<std::int64_t>(table_.size()) ? table_[static_cast<std::size_t>(number)]
                                                                              : -1;
    }
    const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair<std::int64_t, int>(number, -1));
    return found != sorted_.end() && found->first == number ? found->second : -1;
  }

  /// Two positions with the same number, the smaller first.
  const std::optional<std::pair<int, int>>& repeated() const { return repeated_; }

 private:
  std::vector<int> table_;                            // by number
  std::vector<std::pair<std::int64_t, int>> sorted_;  // where numbers have large gaps
  std::optional<std::pair<int, int>> repeated_;
};

}  // namespace scabo::files
