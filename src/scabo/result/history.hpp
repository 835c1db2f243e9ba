// history.csv: one row for each increment, with the quantities for which `output: {history: ...}` asks, and their
// extremes over the run (docs/results.md).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scabo/analysis/state/solution.hpp"
#include "scabo/result/point_tables.hpp"
#include "scabo/result/section.hpp"

namespace scabo::result {

/// Steps and parts of steps; `in_time`, where the model has steps in time: time since the begin of the first of these,
/// 0 before it.
inline double time_of(const analysis::IncrementResult& increment, bool in_time) {
  return in_time ? increment.time.value_or(0.0) : increment.step - 1 + increment.reached;
}

/// First columns of the table.
constexpr std::string_view history_mark = "step,increment,time,";

/// The last value of a column, and the extremes over the increments that have one.
struct HistoryExtremes {
  std::string column;
  struct Value {
    double value = 0.0;
    int step = 0, increment = 0;
    double time = 0.0;  ///< time_of()
  };
  std::optional<Value> last, least, greatest;  ///< without any value: empty
};

class History {
 public:
  explicit History(const model::Model& model);

  bool wanted() const { return !columns_.empty(); }
  /// First line of the table.
  std::string header() const;
  /// One line, and its values taken into the extremes. Throws InputError for a section that cuts no body.
  std::string row(const analysis::StaticSolution& solution, const analysis::IncrementResult& increment);
  /// Takes the values of rows that were written before into the extremes.
  void restore(std::string_view table);
  const std::vector<HistoryExtremes>& extremes() const { return columns_; }
  /// Returns to extremes that it had before: rows after them do not count.
  void take_back(std::vector<HistoryExtremes> extremes) { columns_ = std::move(extremes); }

 private:
  struct SectionPoints {
    std::vector<SectionPoint> points;
    std::size_t first = 0;  // in the points of the evaluation
  };
  void prepare(const analysis::StaticSolution& solution);
  /// Of all places; empty where no velocity is asked for.
  std::vector<PointResult> velocities(const analysis::StaticSolution& solution,
                                      const analysis::IncrementResult& increment) const;
  void take(std::size_t column, const HistoryExtremes::Value& here);

  model::Analysis analysis_;
  std::vector<model::HistoryItem> items_;
  std::vector<HistoryExtremes> columns_;
  std::optional<PointEvaluation> evaluation_;  // of all places and sections; empty before the first increment
  int pairings_ = 0;                           // StaticSolution::pairings of the mesh of the evaluation
  std::vector<std::size_t> place_;             // [item]: its point in the evaluation, of a displacement or velocity
  std::vector<std::size_t> other_place_;       // [item]: that of PlaceDisplacement::relative_to
  std::vector<SectionPoints> sections_;        // [item]; empty for numbers
};

/// Throws InputError for sections that cannot be evaluated, before the solve.
void check_sections(const model::Model& model, const mesh::Mesh& mesh);

}  // namespace scabo::result
