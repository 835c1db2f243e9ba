// points.csv, lines.csv and grid.csv: values at points inside bodies after every increment (docs/results.md).
//
// Values are those of the semi-analytical solution (finite elements: of their shape functions). If there are many
// increments, the points of a super-element are first condensed to its boundary (element/plane/point_operator.hpp).
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "scabo/analysis/state/discretisation.hpp"
#include "scabo/analysis/state/results.hpp"
#include "scabo/element/plane/interior_field.hpp"
#include "scabo/mesh/plane/output_points.hpp"

namespace scabo::result {

enum class PointTable { points, lines, grid };
inline constexpr PointTable point_tables[] = {PointTable::points, PointTable::lines, PointTable::grid};

std::string_view file_of(PointTable table);
std::string_view header_of(PointTable table);  ///< first line, with the names of the columns
bool wanted(const model::Output& output, PointTable table);

/// Results at a point; the stress is that of its body there.
struct PointResult {
  element::PointValues values;
  double stress_zz = 0.0;
  double energy_density = 0.0;  ///< strain energy per volume, force / length^2
  bool has_stress = true;       ///< false in rigid bodies and where stress is infinite
  bool absent = false;          ///< the body is not there; the values are 0
};

/// Evaluation of results at given points, for every increment of the analysis.
class PointEvaluation {
 public:
  /// `increments`: expected number of increments. Keeps references to the discretisation.
  PointEvaluation(const analysis::Discretisation& discretisation, std::vector<mesh::OutputPoint> points,
                  int increments);
  ~PointEvaluation();
  PointEvaluation(PointEvaluation&&) noexcept;

  const std::vector<mesh::OutputPoint>& points() const { return points_; }
  std::vector<PointResult> at(const analysis::Discretisation& discretisation,
                              const analysis::IncrementResult& increment) const;
  /// Warnings about points without stress because it is infinite there.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  struct Group;  // the points in one cell
  void prepare(const analysis::Discretisation& discretisation, Group& group, int increments);
  /// Displacement, strain and stress at the points of a group, by its operators or by the fields inside the cell.
  std::vector<element::PointValues> condensed_values(const analysis::Discretisation& discretisation,
                                                     const analysis::FieldState& fields, const Group& group) const;
  std::vector<element::PointValues> probed_values(const analysis::Discretisation& discretisation,
                                                  const analysis::FieldState& fields, const Group& group) const;
  std::vector<mesh::OutputPoint> points_;
  std::vector<Group> groups_;
  std::vector<std::string> warnings_;
};

/// Lines of a table, with the shortest numbers that read back exactly; a field without a value is empty.
std::string point_table_rows(PointTable table, const PointEvaluation& evaluation,
                             const analysis::Discretisation& discretisation,
                             const analysis::IncrementResult& increment);

}  // namespace scabo::result
