#include "scabo/result/point_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>

#include "scabo/element/cell_locator.hpp"
#include "scabo/element/plane/point_operator.hpp"
#include "scabo/result/probe.hpp"
#include "scabo/result/stress.hpp"

namespace scabo::result {

namespace {

/// Number of exponentials for a field at many points with RadialTable: some hundred.
constexpr std::size_t of_table = 600;
/// Number of points above which values are interpolated along xi.
constexpr std::size_t many_points = 200;
constexpr double most_condensed_bytes = 2e9;
/// Relative to the size of a body: a point closer to the scaling centre counts as lying on it.
constexpr double on_centre = 1e-9;

/// Condensation of a point costs five exponentials, once.
bool worth_condensing(std::size_t points, int increments) {
  return 5 * points <= static_cast<std::size_t>(increments) * std::min(points, of_table);
}

bool singular_at_centre(const element::ModalSolution& modes) {
  return std::any_of(modes.exponents.begin(), modes.exponents.end(),
                     [](const auto& exponent) { return exponent.real() > 1e-9 && exponent.real() < 1.0 - 1e-6; });
}

/// What strain around the axis of a body of revolution adds to the energy density.
double hoop_energy(const PointResult& point, const model::Material& material, const model::Analysis& analysis,
                   double temperature) {
  if (!analysis.revolved()) return 0.0;
  const double free = material.expansion ? (*material.expansion)[2] * temperature : 0.0;
  return 0.5 * point.stress_zz * (point.values.strain_zz - free);
}

/// Stress across the plane and energy density where displacement, strain and stress are known. `super_element`: that of
/// the cell, null for a finite element.
void complete(const analysis::Discretisation& discretisation, const analysis::FieldState& fields, std::size_t body,
              const element::SolvedSuperElement* super_element, const CellPlace& place, const Vec2& x,
              PointResult& result) {
  const model::Analysis& analysis = discretisation.model.analysis;
  const double temperature = element::loads_in(fields.interior[body], place.cell).temperature_at(x);
  const auto element = static_cast<std::size_t>(place.scaled.element);
  const int number = super_element ? super_element->sectors.material_of(element)
                                   : discretisation.mesh.bodies[body].cells[place.cell].materials.front();
  const model::Material& material = discretisation.model.materials[static_cast<std::size_t>(number)];
  const element::Vec3 free = super_element ? super_element->sectors.unit_strain_of(element)
                                           : element::thermal_strain(material, analysis.plane);
  const element::Vec3 elastic = result.values.strain - free * temperature;
  const element::InitialStress& initial = fields.initial_of(body);
  const element::Vec3 change = result.values.stress - initial.at(x);
  result.stress_zz = element::stress_zz(change, material, analysis.plane, temperature, result.values.strain_zz) +
                     initial.zz_at(x, material, analysis.plane);
  result.energy_density = 0.5 * change.dot(elastic) + hoop_energy(result, material, analysis, temperature) +
                          0.5 * element::heat_across(material, analysis.plane) * temperature * temperature;
}

void append(fmt::memory_buffer& to, double value) { fmt::format_to(std::back_inserter(to), ",{}", value); }

}  // namespace

/// The points in one cell, in the finite elements of one body, or in a rigid body.
struct PointEvaluation::Group {
  int body = -1;
  std::size_t cell = 0;                           // where there is a super-element
  std::vector<std::size_t> rows;                  // in the list of all points
  std::vector<CellPlace> places;                  // of an elastic body
  std::vector<bool> infinite;                     // stress at the scaling centre of a super-element
  std::vector<element::PointOperator> operators;  // empty: not condensed
  std::vector<int> dofs;                          // of the cell, if condensed

  bool of_super_element() const { return !infinite.empty(); }
};

PointEvaluation::~PointEvaluation() = default;
PointEvaluation::PointEvaluation(PointEvaluation&&) noexcept = default;

PointEvaluation::PointEvaluation(const analysis::Discretisation& discretisation, std::vector<mesh::OutputPoint> points,
                                 int increments)
    : points_(std::move(points)) {
  for (int b = 0; b < static_cast<int>(discretisation.model.bodies.size()); ++b) {
    std::map<std::size_t, Group> groups;  // by cell; all finite elements of a body are one group
    const auto index = static_cast<std::size_t>(b);
    const element::SolvedCells& cells = discretisation.cells[index];
    std::optional<CellLocator> locator;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (points_[i].body != b) continue;
      CellPlace place;
      if (!discretisation.model.bodies[index].rigid) {
        if (!locator) locator.emplace(discretisation.mesh.bodies[index], cells);
        place = locator->nearest(points_[i].at);
      }
      const bool super_element = !cells.empty() && cells[place.cell];
      Group& group = groups[super_element ? place.cell : cells.size()];
      group.body = b;
      group.cell = place.cell;
      group.rows.push_back(i);
      group.places.push_back(place);
    }
    for (auto& [cell, group] : groups) {
      if (cell < cells.size()) prepare(discretisation, group, increments);
      groups_.push_back(std::move(group));
    }
  }
}

void PointEvaluation::prepare(const analysis::Discretisation& discretisation, Group& group, int increments) {
  const auto b = static_cast<std::size_t>(group.body);
  const mesh::Cell& cell = discretisation.mesh.bodies[b].cells[group.cell];
  const element::SolvedSuperElement& super_element = *discretisation.cells[b][group.cell];
  double size = 0.0;
  for (const Vec2& x : super_element.ring.nodes) size = std::max(size, x.norm());
  for (const std::size_t row : group.rows) {
    const mesh::OutputPoint& point = points_[row];
    const bool infinite =
        (point.at - cell.centre).norm() <= on_centre * size && singular_at_centre(super_element.modes());
    group.infinite.push_back(infinite);
    if (infinite)
      warnings_.push_back(fmt::format(
          "stress of body '{}' is infinite at its scaling centre ({:.6g}, {:.6g}): '{}' has no stress there",
          discretisation.model.bodies[b].name, point.at.x(), point.at.y(), point.name));
  }
  const double bytes = 40.0 * static_cast<double>(super_element.K().rows()) * static_cast<double>(group.rows.size());
  if (super_element.domain.unbounded || !worth_condensing(group.rows.size(), increments) ||
      bytes > most_condensed_bytes)
    return;
  std::vector<element::ScaledPoint> places;
  for (const CellPlace& place : group.places) places.push_back(place.scaled);
  group.operators =
      element::PointCondensation(super_element.ring, super_element.solution()).at(places, super_element.threads);
  group.dofs = element::dofs_of(cell);
}

std::vector<element::PointValues> PointEvaluation::condensed_values(const analysis::Discretisation& discretisation,
                                                                    const analysis::FieldState& fields,
                                                                    const Group& group) const {
  const auto b = static_cast<std::size_t>(group.body);
  const element::SolvedSuperElement& super_element = *discretisation.cells[b][group.cell];
  const Vector u = fields.displacements[b](group.dofs);
  std::vector<element::PointValues> values(group.rows.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const element::PointOperator& rows = group.operators[i];
    values[i].displacement = rows.N * u - fields.reference_displacement(b);
    values[i].strain = rows.B * u;
    values[i].stress =
        super_element.sectors.D.of(static_cast<std::size_t>(group.places[i].scaled.element)) * values[i].strain +
        fields.initial_of(b).at(points_[group.rows[i]].at);
  }
  return values;
}

std::vector<element::PointValues> PointEvaluation::probed_values(const analysis::Discretisation& discretisation,
                                                                 const analysis::FieldState& fields,
                                                                 const Group& group) const {
  const bool rigid = discretisation.model.bodies[static_cast<std::size_t>(group.body)].rigid;
  Probe probe(discretisation, fields, group.body);
  if (group.of_super_element() && group.rows.size() > many_points) probe.expect_many();
  std::vector<element::PointValues> values;
  for (std::size_t i = 0; i < group.rows.size(); ++i) {
    const Vec2& x = points_[group.rows[i]].at;
    const auto at_point = rigid ? probe.at(x) : std::optional(probe.at(x, group.places[i]));
    ensure(at_point.has_value(), "a point of a body has no value");
    values.push_back(*at_point);
  }
  return values;
}

std::vector<PointResult> PointEvaluation::at(const analysis::Discretisation& discretisation,
                                             const analysis::IncrementResult& increment) const {
  const analysis::FieldState& fields = increment.fields;
  std::vector<PointResult> results(points_.size());
  for (const Group& group : groups_) {
    if (increment.is_absent(group.body)) {
      for (const std::size_t row : group.rows) results[row].absent = true;
      continue;
    }
    const auto b = static_cast<std::size_t>(group.body);
    const element::SolvedSuperElement* super_element =
        group.of_super_element() ? discretisation.cells[b][group.cell].get() : nullptr;
    const bool condensed = !group.operators.empty() && !element::loads_in(fields.interior[b], group.cell).acts();
    const std::vector<element::PointValues> values =
        condensed ? condensed_values(discretisation, fields, group) : probed_values(discretisation, fields, group);
    for (std::size_t i = 0; i < group.rows.size(); ++i) {
      PointResult& result = results[group.rows[i]];
      result.values = values[i];
      result.has_stress = !discretisation.model.bodies[b].rigid && !(super_element && group.infinite[i]);
      if (result.has_stress)
        complete(discretisation, fields, b, super_element, group.places[i], points_[group.rows[i]].at, result);
    }
  }
  return results;
}

std::string_view file_of(PointTable table) {
  switch (table) {
    case PointTable::points:
      return "points.csv";
    case PointTable::lines:
      return "lines.csv";
    case PointTable::grid:
      return "grid.csv";
  }
  throw BrokenInvariant("a table of points without a name");
}

std::string_view header_of(PointTable table) {
#define SCABO_COLUMNS                                                                                               \
  "step,increment,name,body,x,y,ux,uy,stress_xx,stress_yy,stress_xy,stress_zz,principal_1,principal_2,principal_3," \
  "principal_angle,von_mises,energy_density"
  return table == PointTable::lines ? SCABO_COLUMNS ",distance\n" : SCABO_COLUMNS "\n";
#undef SCABO_COLUMNS
}

bool wanted(const model::Output& output, PointTable table) {
  return table == PointTable::points  ? !output.points.empty()
         : table == PointTable::lines ? !output.lines.empty()
                                      : output.grid.has_value();
}

std::string point_table_rows(PointTable table, const PointEvaluation& evaluation,
                             const analysis::Discretisation& discretisation,
                             const analysis::IncrementResult& increment) {
  const std::vector<PointResult> results = evaluation.at(discretisation, increment);
  fmt::memory_buffer rows;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const mesh::OutputPoint& point = evaluation.points()[i];
    const PointResult& result = results[i];
    if (result.absent) continue;
    fmt::format_to(std::back_inserter(rows), "{},{},{},{}", increment.step, increment.increment, point.name,
                   discretisation.model.bodies[static_cast<std::size_t>(point.body)].name);
    for (const double value :
         {point.at.x(), point.at.y(), result.values.displacement.x(), result.values.displacement.y()})
      append(rows, value);
    if (result.has_stress) {
      const element::Vec3& stress = result.values.stress;
      const StressMeasures measures = stress_measures(stress, result.stress_zz);
      for (const double value :
           {stress[0], stress[1], stress[2], result.stress_zz, measures.principal[0], measures.principal[1],
            measures.principal[2], measures.angle, measures.von_mises, result.energy_density})
        append(rows, value);
    } else {
      rows.append(std::string_view(",,,,,,,,,,"));
    }
    if (table == PointTable::lines) append(rows, point.distance);
    rows.push_back('\n');
  }
  return fmt::to_string(rows);
}

}  // namespace scabo::result
