// What `output` of a model in space asks for besides the files of every run: points.csv, lines.csv and history.csv.
#pragma once

#include <string>
#include <vector>

#include "scabo/analysis/space/posed_solids.hpp"
#include "scabo/result/solid/solid_points.hpp"
#include "scabo/result/solid/solid_sections.hpp"

namespace scabo::result {

class SolidOutputs {
 public:
  /// `model` and `posed` must outlive it. Throws InputError with all mistakes: points in no body, planes that cut none.
  SolidOutputs(const model::SpaceModel& model, const analysis::PosedSolids& posed);

  bool has_points() const { return !places_.empty(); }
  bool has_lines() const { return !of_lines_.empty(); }
  bool has_history() const {
    return !sections_.empty() || !model_.quantities.empty() || !model_.resultants.empty() ||
           !model_.displacements.empty();
  }
  std::string header_of_points() const;
  std::string header_of_lines() const;
  std::string header_of_history() const;
  /// Rows of an increment; `number` of all, from 0.
  std::string rows_of_points(const analysis::SolidIncrement& increment, std::size_t number) const;
  std::string rows_of_lines(const analysis::SolidIncrement& increment, std::size_t number) const;
  std::string row_of_history(const analysis::SolidIncrement& increment, std::size_t number) const;

 private:
  /// A place of a point of a line.
  struct OnLine {
    std::size_t line;
    int number;  ///< of the point, from 0
  };
  void place_lines(std::vector<Diagnostic>& mistakes);
  /// The one place of a point of `points`; reports a point that has several.
  void find_place(int point, const std::string& of, std::vector<Diagnostic>& mistakes);
  const SolidPointValues& values_of(int point, const std::vector<SolidPointValues>& values) const;

  const model::SpaceModel& model_;
  const analysis::PosedSolids& posed_;
  std::vector<SolidPlace> places_;
  std::vector<std::size_t> point_of_;  // of each place
  std::vector<SolidPlace> places_of_lines_;
  std::vector<OnLine> of_lines_;  // of each of these places
  std::vector<SolidSection> sections_;
  bool history_has_points_ = false;
};

/// Part of its step at the end of an increment.
double reached_by(const model::SpaceModel& model, const analysis::PosedSolids& posed, std::size_t number);

}  // namespace scabo::result
