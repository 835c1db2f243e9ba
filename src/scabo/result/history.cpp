#include "scabo/result/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <utility>
#include <variant>

#include "scabo/analysis/state/quantities.hpp"
#include "scabo/result/contact_table.hpp"
#include "scabo/result/stress.hpp"

namespace scabo::result {

namespace {

/// `.force_x` and `.force_y`, `.force_1` and `.force_2`, `.normal` and `.tangential`.
std::pair<std::string, std::string> names_along(const model::ResultAxes& axes, const std::string& quantity) {
  switch (axes.kind) {
    case model::ResultAxes::Kind::xy:
      return {"." + quantity + "x", "." + quantity + "y"};
    case model::ResultAxes::Kind::angle:
      return {"." + quantity + "1", "." + quantity + "2"};
    case model::ResultAxes::Kind::edge:
      break;
  }
  return {".normal", ".tangential"};
}

/// The point whose displacement, velocity or stress is wanted, if one is.
const model::Quantity* point_of(const model::HistoryItem& item) {
  if (const auto* place = std::get_if<model::PlaceDisplacement>(&item.of)) return &place->of;
  const auto* quantity = std::get_if<model::Quantity>(&item.of);
  const bool moves = quantity && (quantity->kind == model::Quantity::Kind::displacement ||
                                  quantity->kind == model::Quantity::Kind::velocity ||
                                  quantity->kind == model::Quantity::Kind::stress);
  return moves ? quantity : nullptr;
}

/// What is wanted of a point.
std::optional<double> value_at(const PointResult& point, const model::Quantity& quantity) {
  if (point.absent) return std::nullopt;
  const auto component = static_cast<std::size_t>(quantity.component);
  if (quantity.kind != model::Quantity::Kind::stress) return point.values.displacement[quantity.component];
  if (!point.has_stress) return std::nullopt;
  const element::Vec3& stress = point.values.stress;
  const StressMeasures measures = stress_measures(stress, point.stress_zz);
  return std::array{stress[0],
                    stress[1],
                    stress[2],
                    point.stress_zz,
                    measures.principal[0],
                    measures.principal[1],
                    measures.principal[2],
                    measures.von_mises}[component];
}

std::vector<std::string> columns_of(const model::HistoryItem& item) {
  if (std::holds_alternative<model::Quantity>(item.of)) return {item.name};
  if (const auto* edge = std::get_if<model::EdgeResultant>(&item.of)) {
    const auto [first, second] = names_along(edge->axes, "force_");
    return {item.name + first, item.name + second, item.name + ".moment"};
  }
  if (const auto* place = std::get_if<model::PlaceDisplacement>(&item.of)) {
    const auto [first, second] = names_along(place->axes, "u");
    return {item.name + first, item.name + second};
  }
  return {item.name + ".normal", item.name + ".shear", item.name + ".moment"};
}

/// Body and position of a displacement, velocity or stress.
mesh::OutputPoint point_of(const model::Model& model, const model::Quantity& quantity) {
  mesh::OutputPoint point;
  point.at = quantity.at;
  point.body = quantity.index;
  for (std::size_t b = 0; point.body < 0 && b < model.bodies.size(); ++b)
    if (mesh::holds(model.bodies[b], quantity.at)) point.body = static_cast<int>(b);
  return point;
}

/// Fields of a line of numbers; empty ones are nothing.
std::vector<std::optional<double>> numbers_in(std::string_view line) {
  std::vector<std::optional<double>> numbers;
  while (true) {
    const auto comma = line.find(',');
    const std::string_view field = line.substr(0, comma);
    double value = 0.0;
    const auto [end, code] = std::from_chars(field.data(), field.data() + field.size(), value);
    const bool good = !field.empty() && code == std::errc() && end == field.data() + field.size();
    numbers.push_back(good ? std::optional(value) : std::nullopt);
    if (comma == std::string_view::npos) return numbers;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

History::History(const model::Model& model) : analysis_(model.analysis), items_(model.output.history) {
  for (const model::HistoryItem& item : items_)
    for (std::string& column : columns_of(item)) columns_.push_back({std::move(column), {}, {}, {}});
}

std::string History::header() const {
  std::string line(history_mark.substr(0, history_mark.size() - 1));
  for (const HistoryExtremes& column : columns_) line += "," + column.column;
  if (analysis_.revolved()) line += radians_column;
  return line + "\n";
}

void History::prepare(const analysis::StaticSolution& solution) {
  pairings_ = solution.pairings;
  std::vector<mesh::OutputPoint> points;
  place_.assign(items_.size(), 0);
  other_place_.assign(items_.size(), 0);
  sections_.assign(items_.size(), {});
  for (std::size_t i = 0; i < items_.size(); ++i) {
    if (const auto* quantity = point_of(items_[i])) {
      place_[i] = points.size();
      points.push_back(point_of(solution.model, *quantity));
      const auto* place = std::get_if<model::PlaceDisplacement>(&items_[i].of);
      if (!place || !place->relative_to) continue;
      other_place_[i] = points.size();
      points.push_back(point_of(solution.model, *place->relative_to));
      continue;
    }
    if (!std::holds_alternative<model::Section>(items_[i].of)) continue;
    sections_[i].points = points_of_section(solution, items_[i], std::get<model::Section>(items_[i].of));
    sections_[i].first = points.size();
    for (const SectionPoint& point : sections_[i].points) points.push_back(point.at);
  }
  int increments = 0;
  for (const model::Step& step : solution.model.steps) increments += model::expected_increments(step);
  evaluation_.emplace(solution, std::move(points), increments);
}

void History::take(std::size_t column, const HistoryExtremes::Value& here) {
  HistoryExtremes& of = columns_[column];
  of.last = here;
  if (!of.least || here.value < of.least->value) of.least = here;
  if (!of.greatest || here.value > of.greatest->value) of.greatest = here;
}

std::vector<PointResult> History::velocities(const analysis::StaticSolution& solution,
                                             const analysis::IncrementResult& increment) const {
  const bool asked = std::any_of(items_.begin(), items_.end(), [](const model::HistoryItem& item) {
    const auto* quantity = std::get_if<model::Quantity>(&item.of);
    return quantity && quantity->kind == model::Quantity::Kind::velocity;
  });
  return asked ? evaluation_->at(solution, analysis::with_velocities(increment)) : std::vector<PointResult>();
}

std::string History::row(const analysis::StaticSolution& solution, const analysis::IncrementResult& increment) {
  if (!evaluation_ || pairings_ != solution.pairings) prepare(solution);
  const std::vector<PointResult> values =
      evaluation_->points().empty() ? std::vector<PointResult>() : evaluation_->at(solution, increment);
  const std::vector<PointResult> moving = velocities(solution, increment);
  const double time = time_of(increment, model::is_dynamic(solution.model));
  fmt::memory_buffer line;
  fmt::format_to(std::back_inserter(line), "{},{},{}", increment.step, increment.increment, time);
  std::size_t column = 0;
  const auto add = [&](const std::optional<double>& value) {
    if (value && std::isfinite(*value)) {
      fmt::format_to(std::back_inserter(line), ",{}", *value);
      take(column, {*value, increment.step, increment.increment, time});
    } else {
      line.push_back(',');
      columns_[column].last.reset();
    }
    ++column;
  };
  std::size_t edge = 0;
  for (std::size_t i = 0; i < items_.size(); ++i) {
    if (const auto* of_edge = std::get_if<model::EdgeResultant>(&items_[i].of)) {
      const analysis::EdgeForces& forces = increment.edges[edge++];
      add(forces.force.dot(of_edge->axes.first));
      add(forces.force.dot(of_edge->axes.second()));
      add(forces.moment);
      continue;
    }
    if (const auto* place = std::get_if<model::PlaceDisplacement>(&items_[i].of)) {
      Vec2 u = values[place_[i]].values.displacement;
      if (place->relative_to) u -= values[other_place_[i]].values.displacement;
      add(u.dot(place->axes.first));
      add(u.dot(place->axes.second()));
      continue;
    }
    if (const auto* quantity = std::get_if<model::Quantity>(&items_[i].of)) {
      const bool by_velocity = quantity->kind == model::Quantity::Kind::velocity;
      const PointResult* at = point_of(items_[i]) ? &(by_velocity ? moving : values)[place_[i]] : nullptr;
      add(at ? value_at(*at, *quantity) : analysis::value_of(solution, increment, *quantity));
      continue;
    }
    const SectionPoints& section = sections_[i];
    Vec2 force = Vec2::Zero();
    double moment = 0.0;
    for (std::size_t k = 0; k < section.points.size(); ++k) {
      const SectionPoint& point = section.points[k];
      const Vec2 traction = element::traction_of(values[section.first + k].values.stress, point.normal);
      force += point.weight * traction;
      moment += point.weight * cross(point.arm, traction);
    }
    const Vec2 n = section.points.front().normal, along(n.y(), -n.x());
    add(force.dot(n));
    add(force.dot(along));
    add(moment);
  }
  return fmt::to_string(line) + radians_field(analysis_) + '\n';
}

void History::restore(std::string_view table) {
  table.remove_prefix(std::min(table.size(), table.find('\n') + 1));  // the header
  const std::size_t after = analysis_.revolved() ? 1 : 0;
  while (!table.empty()) {
    const auto end = table.find('\n');
    const std::vector<std::optional<double>> numbers = numbers_in(table.substr(0, end));
    table.remove_prefix(end == std::string_view::npos ? table.size() : end + 1);
    constexpr std::size_t before = 3;
    if (numbers.size() != before + columns_.size() + after || !numbers[0] || !numbers[1]) continue;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (numbers[c + before])
        take(c, {*numbers[c + before], static_cast<int>(*numbers[0]), static_cast<int>(*numbers[1]),
                 numbers[2].value_or(0.0)});
      else
        columns_[c].last.reset();
    }
  }
}

void check_sections(const model::Model& model, const mesh::Mesh& mesh) {
  analysis::Discretisation discretisation;
  discretisation.model = model;
  discretisation.mesh = mesh;
  std::vector<Diagnostic> mistakes;
  for (const model::HistoryItem& item : model.output.history)
    if (const auto* section = std::get_if<model::Section>(&item.of)) {
      try {
        points_of_section(discretisation, item, *section);
      } catch (const InputError& error) {
        mistakes.insert(mistakes.end(), error.diagnostics().begin(), error.diagnostics().end());
      }
    }
  if (!mistakes.empty()) throw InputError(model.file, std::move(mistakes));
}

}  // namespace scabo::result
