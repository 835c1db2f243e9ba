#include "scabo/result/point_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "scabo/element/point_operator.hpp"
#include "scabo/result/probe.hpp"
#include "scabo/result/stress.hpp"

namespace scabo::result {

namespace {

/// Number of exponentials for a field at many points with RadialTable: some hundred.
constexpr std::size_t of_table = 600;
/// Number of points above which values are interpolated along xi.
constexpr std::size_t many = 200;
constexpr double most_condensed_bytes = 2e9;
/// Relative to the size of a body: a point closer to the scaling centre counts as lying on it.
constexpr double on_centre = 1e-9;

/// Condensation of a point costs five exponentials, once.
bool worth_condensing(std::size_t points, int increments) {
  return 5 * points <= static_cast<std::size_t>(increments) * std::min(points, of_table);
}

bool loaded_inside(const analysis::IncrementResult& increment, std::size_t body) {
  return !increment.interior[body].loads.empty();
}

/// Position of the point in the mesh: arcs are divided into polynomials, which may pass slightly inside of it.
std::optional<element::ScaledPoint> located(const element::Ring& ring, const Vec2& x, bool unbounded) {
  if (const auto point = element::locate(ring, x, unbounded)) return point;
  auto point = element::locate(ring, unbounded ? 2.0 * x : 0.5 * x, unbounded);
  if (point) point->xi = 1.0;
  return point;
}

bool singular_at_centre(const element::ModalSolution& modes) {
  return std::any_of(modes.exponents.begin(), modes.exponents.end(),
                     [](const auto& exponent) { return exponent.real() > 1e-9 && exponent.real() < 1.0 - 1e-6; });
}

void append(fmt::memory_buffer& to, double value) { fmt::format_to(std::back_inserter(to), ",{}", value); }

}  // namespace

struct PointEvaluation::Body {
  int body = -1;
  std::vector<std::size_t> rows;                  // in the list of all points
  std::vector<element::ScaledPoint> places;       // of a super-element
  std::vector<bool> infinite;                     // stress at the scaling centre
  std::vector<element::PointOperator> operators;  // empty: not condensed
};

PointEvaluation::~PointEvaluation() = default;
PointEvaluation::PointEvaluation(PointEvaluation&&) noexcept = default;

PointEvaluation::PointEvaluation(const analysis::StaticSolution& solution, std::vector<mesh::OutputPoint> points,
                                 int increments)
    : points_(std::move(points)) {
  for (int b = 0; b < static_cast<int>(solution.model.bodies.size()); ++b) {
    Body body;
    body.body = b;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (points_[i].body == b) body.rows.push_back(i);
    if (body.rows.empty()) continue;
    const auto index = static_cast<std::size_t>(b);
    if (const auto& super_element = solution.super_elements[index]) {
      const Vec2& centre = solution.mesh.bodies[index].super_elements.front().centre;
      double size = 0.0;
      for (const Vec2& x : super_element->ring.nodes) size = std::max(size, x.norm());
      for (const std::size_t row : body.rows) {
        const Vec2 x = points_[row].at - centre;
        const auto place = located(super_element->ring, x, super_element->domain.unbounded);
        ensure(place.has_value(), "a point of a body has no place in its super-element");
        body.places.push_back(*place);
        const bool infinite = x.norm() <= on_centre * size && singular_at_centre(super_element->modes());
        body.infinite.push_back(infinite);
        if (infinite)
          warnings_.push_back(fmt::format(
              "stress of body '{}' is infinite at its scaling centre ({:.6g}, {:.6g}): '{}' has no stress there",
              solution.model.bodies[index].name, points_[row].at.x(), points_[row].at.y(), points_[row].name));
      }
      const double bytes =
          40.0 * static_cast<double>(super_element->solution.K.rows()) * static_cast<double>(body.rows.size());
      if (!super_element->domain.unbounded && worth_condensing(body.rows.size(), increments) &&
          bytes <= most_condensed_bytes)
        body.operators = element::PointCondensation(super_element->ring, super_element->solution)
                             .at(body.places, super_element->threads);
    }
    bodies_.push_back(std::move(body));
  }
}

std::vector<PointResult> PointEvaluation::at(const analysis::StaticSolution& solution,
                                             const analysis::IncrementResult& increment) const {
  std::vector<PointResult> results(points_.size());
  for (const Body& body : bodies_) {
    const auto b = static_cast<std::size_t>(body.body);
    const model::Body& named = solution.model.bodies[b];
    const auto& super_element = solution.super_elements[b];
    const bool condensed = !body.operators.empty() && !loaded_inside(increment, b);
    std::optional<Probe> probe;
    if (!condensed) probe.emplace(solution, increment, body.body);
    if (probe && body.rows.size() > many) probe->expect_many();
    for (std::size_t i = 0; i < body.rows.size(); ++i) {
      const Vec2& x = points_[body.rows[i]].at;
      PointResult& result = results[body.rows[i]];
      if (condensed) {
        const element::PointOperator& rows = body.operators[i];
        result.values.displacement = rows.N * increment.displacements[b] - increment.reference_displacement;
        result.values.strain = rows.B * increment.displacements[b];
        result.values.stress =
            super_element->sectors.D.of(static_cast<std::size_t>(body.places[i].element)) * result.values.strain;
      } else {
        const auto values = super_element ? std::optional(probe->at(x, body.places[i])) : probe->at(x);
        ensure(values.has_value(), "a point of a body has no value");
        result.values = *values;
      }
      result.has_stress = !named.rigid && !(super_element && body.infinite[i]);
      if (!result.has_stress) continue;
      const double temperature = increment.interior[b].temperature.at(x);
      int material = named.material;
      element::Vec3 elastic = result.values.strain;
      if (super_element) {
        const auto element = static_cast<std::size_t>(body.places[i].element);
        material = super_element->sectors.material_of(element);
        elastic -= super_element->sectors.unit_strain_of(element) * temperature;
      }
      result.stress_zz =
          element::stress_zz(result.values.stress, solution.model.materials[static_cast<std::size_t>(material)],
                             solution.model.analysis.plane, temperature);
      result.energy_density = 0.5 * result.values.stress.dot(elastic);
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
                             const analysis::StaticSolution& solution, const analysis::IncrementResult& increment) {
  const std::vector<PointResult> results = evaluation.at(solution, increment);
  fmt::memory_buffer rows;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const mesh::OutputPoint& point = evaluation.points()[i];
    const PointResult& result = results[i];
    fmt::format_to(std::back_inserter(rows), "{},{},{},{}", increment.step, increment.increment, point.name,
                   solution.model.bodies[static_cast<std::size_t>(point.body)].name);
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
