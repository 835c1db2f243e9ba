#include "scabo/result/solid/solid_outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "scabo/result/contact_table.hpp"
#include "scabo/result/solid/solid_figures.hpp"
#include "scabo/result/solid/solid_stress.hpp"

namespace scabo::result {

namespace {

using Kind = model::SpaceQuantity::Kind;

bool is_of_point(const model::SpaceQuantity& quantity) {
  return quantity.kind == Kind::displacement || quantity.kind == Kind::stress || quantity.kind == Kind::principal ||
         quantity.kind == Kind::von_mises;
}

/// Nothing for the stress in a rigid body.
std::optional<double> figure_of_point(const SolidPointValues& values, const model::SpaceQuantity& quantity) {
  if (quantity.kind == Kind::displacement) return values.displacement[quantity.component];
  if (!values.stress) return std::nullopt;
  if (quantity.kind == Kind::stress) return (*values.stress)[quantity.component];
  const StressInSpace measures(*values.stress);
  return quantity.kind == Kind::principal ? measures.principal[quantity.component] : measures.von_mises;
}

/// Where a point is that lies in none of the bodies that are meant.
std::string outside_of(const model::SpaceModel& model, int body) {
  return body < 0 ? "in no body"
                  : fmt::format("outside of body '{}'", model.bodies[static_cast<std::size_t>(body)].name);
}

constexpr const char* columns_at_points =
    "step,increment,name,body,x,y,z,ux,uy,uz,stress_xx,stress_yy,stress_zz,stress_xy,stress_yz,stress_xz,"
    "principal_1,principal_2,principal_3,von_mises";

/// From `x` on; no line end.
void add_values(const Eigen::Vector3d& at, const SolidPointValues& values, fmt::memory_buffer& rows) {
  const auto add = [&](const auto& numbers) {
    for (const double value : numbers) fmt::format_to(std::back_inserter(rows), ",{}", value);
  };
  add(at);
  add(values.displacement);
  if (!values.stress) {
    fmt::format_to(std::back_inserter(rows), ",,,,,,,,,,");
    return;
  }
  const StressInSpace measures(*values.stress);
  add(*values.stress);
  add(measures.principal);
  fmt::format_to(std::back_inserter(rows), ",{}", measures.von_mises);
}

}  // namespace

SolidOutputs::SolidOutputs(const model::SpaceModel& model, const analysis::PosedSolids& posed)
    : model_(model), posed_(posed) {
  std::vector<Diagnostic> mistakes;
  std::vector<Eigen::Vector3d> points;
  std::vector<int> only;
  for (const model::SpacePoint& point : model.points) {
    points.push_back(point.at);
    only.push_back(point.body);
  }
  const auto places = places_of(posed.model, points, only);
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (const SolidPlace& place : places[i]) {
      places_.push_back(place);
      point_of_.push_back(i);
    }
    if (places[i].empty())
      mistakes.push_back(
          {model.points[i].source, fmt::format("the point ({:.6g}, {:.6g}, {:.6g}) lies {}: move it", points[i].x(),
                                               points[i].y(), points[i].z(), outside_of(model, only[i]))});
  }
  place_lines(mistakes);
  for (const model::SpaceSection& section : model.sections) {
    sections_.push_back(section_of(posed.model, section));
    if (sections_.back().points.empty())
      mistakes.push_back(
          {section.source,
           fmt::format("the plane of section '{}' cuts no elastic body: move its 'point'", section.name)});
  }
  for (const model::SpaceDisplacement& displacement : model.displacements)
    for (const int point : {displacement.point, displacement.relative_to})
      if (point >= 0) find_place(point, displacement.name, mistakes);
  for (const model::SpaceQuantity& quantity : model.quantities)
    if (is_of_point(quantity)) find_place(quantity.of, quantity.name, mistakes);
  if (!mistakes.empty()) throw InputError(model.file, std::move(mistakes));
}

/// One message for a line.
void SolidOutputs::place_lines(std::vector<Diagnostic>& mistakes) {
  for (std::size_t l = 0; l < model_.lines.size(); ++l) {
    const model::SpaceLine& line = model_.lines[l];
    std::vector<Eigen::Vector3d> points;
    for (int k = 0; k < line.points; ++k) points.push_back(line.at(k));
    const auto places = places_of(posed_.model, points, std::vector<int>(points.size(), line.body));
    for (int k = 0; k < line.points; ++k)
      for (const SolidPlace& place : places[static_cast<std::size_t>(k)]) {
        places_of_lines_.push_back(place);
        of_lines_.push_back({l, k});
      }
    const auto outside = std::find_if(places.begin(), places.end(), [](const auto& in) { return in.empty(); });
    if (outside == places.end()) continue;
    const auto k = static_cast<int>(outside - places.begin());
    const Eigen::Vector3d at = line.at(k);
    mistakes.push_back(
        {line.source, fmt::format("point {} of '{}', ({:.6g}, {:.6g}, {:.6g}), lies {}: let the line end in a body",
                                  k + 1, line.name, at.x(), at.y(), at.z(), outside_of(model_, line.body))});
  }
}

void SolidOutputs::find_place(int point, const std::string& of, std::vector<Diagnostic>& mistakes) {
  history_has_points_ = true;
  std::string bodies;
  int count = 0;
  for (std::size_t k = 0; k < places_.size(); ++k)
    if (static_cast<int>(point_of_[k]) == point) {
      const std::string& name = model_.bodies[static_cast<std::size_t>(places_[k].body)].name;
      bodies += (count++ > 0 ? "' and '" : "'") + name;
    }
  const model::SpacePoint& at = model_.points[static_cast<std::size_t>(point)];
  if (count > 1)
    mistakes.push_back({at.source, fmt::format("point '{}' lies in bodies {}', and '{}' of the history is that of one: "
                                               "give the point its 'body'",
                                               at.name, bodies, of)});
}

const SolidPointValues& SolidOutputs::values_of(int point, const std::vector<SolidPointValues>& values) const {
  const auto place = std::find(point_of_.begin(), point_of_.end(), static_cast<std::size_t>(point));
  return values[static_cast<std::size_t>(place - point_of_.begin())];
}

std::string SolidOutputs::header_of_points() const { return columns_at_points + std::string("\n"); }

std::string SolidOutputs::header_of_lines() const { return columns_at_points + std::string(",distance\n"); }

std::string SolidOutputs::rows_of_points(const analysis::SolidIncrement& increment, std::size_t number) const {
  const auto& [step, of_step] = posed_.step_and_number[number];
  const std::vector<SolidPointValues> values = values_at(posed_.model, increment, places_);
  fmt::memory_buffer rows;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i].absent) continue;
    const model::SpacePoint& point = model_.points[point_of_[i]];
    fmt::format_to(std::back_inserter(rows), "{},{},{},{}", step + 1, of_step, csv_quoted(point.name),
                   csv_quoted(model_.bodies[static_cast<std::size_t>(places_[i].body)].name));
    add_values(point.at, values[i], rows);
    rows.push_back('\n');
  }
  return fmt::to_string(rows);
}

std::string SolidOutputs::rows_of_lines(const analysis::SolidIncrement& increment, std::size_t number) const {
  const auto& [step, of_step] = posed_.step_and_number[number];
  const std::vector<SolidPointValues> values = values_at(posed_.model, increment, places_of_lines_);
  fmt::memory_buffer rows;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i].absent) continue;
    const model::SpaceLine& line = model_.lines[of_lines_[i].line];
    const int k = of_lines_[i].number;
    fmt::format_to(std::back_inserter(rows), "{},{},{},{}", step + 1, of_step, csv_quoted(line.name),
                   csv_quoted(model_.bodies[static_cast<std::size_t>(places_of_lines_[i].body)].name));
    add_values(line.at(k), values[i], rows);
    fmt::format_to(std::back_inserter(rows), ",{}\n", line.part_at(k) * (line.to - line.from).norm());
  }
  return fmt::to_string(rows);
}

std::string SolidOutputs::header_of_history() const {
  std::string header = "step,increment,time";
  for (const model::SpaceSection& section : model_.sections)
    for (const char* column : {"normal", "force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z"})
      header += fmt::format(",{}.{}", section.name, column);
  for (const model::SpaceFaceResultant& of : model_.resultants)
    for (const char* column : {"force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z"})
      header += fmt::format(",{}.{}", of.name, column);
  for (const model::SpaceDisplacement& of : model_.displacements)
    for (const char axis : {'x', 'y', 'z'}) header += fmt::format(",{}.u{}", of.name, axis);
  for (const model::SpaceQuantity& quantity : model_.quantities) header += "," + csv_quoted(quantity.name);
  return header + '\n';
}

std::string SolidOutputs::row_of_history(const analysis::SolidIncrement& increment, std::size_t number) const {
  const auto& [step, of_step] = posed_.step_and_number[number];
  std::string row =
      fmt::format("{},{},{}", step + 1, of_step, static_cast<double>(step) + reached_by(model_, posed_, number));
  for (const SolidSection& section : sections_) {
    const SolidResultant resultant = resultant_of(posed_.model, increment, section);
    row += fmt::format(",{}", resultant.force.dot(section.normal));
    for (const double value : resultant.force) row += fmt::format(",{}", value);
    for (const double value : resultant.moment) row += fmt::format(",{}", value);
  }
  for (const analysis::FaceActions& of : posed_.resultants) {
    const analysis::FaceResultant resultant = of.resultant(posed_.model, increment);
    for (const Eigen::Vector3d& vector : {resultant.force, resultant.moment})
      for (const double value : vector) row += fmt::format(",{}", value);
  }
  std::vector<SolidPointValues> at_points;
  if (history_has_points_) at_points = values_at(posed_.model, increment, places_);
  for (const model::SpaceDisplacement& of : model_.displacements) {
    Eigen::Vector3d u = values_of(of.point, at_points).displacement;
    if (of.relative_to >= 0) u -= values_of(of.relative_to, at_points).displacement;
    for (const double value : u) row += fmt::format(",{}", value);
  }
  for (const model::SpaceQuantity& quantity : model_.quantities) {
    if (!is_of_point(quantity)) {
      row += fmt::format(",{}", value_of(model_, posed_, increment, quantity));
    } else {
      const std::optional<double> value = figure_of_point(values_of(quantity.of, at_points), quantity);
      row += value ? fmt::format(",{}", *value) : ",";
    }
  }
  return row + '\n';
}

double reached_by(const model::SpaceModel& model, const analysis::PosedSolids& posed, std::size_t number) {
  const auto& [step, of_step] = posed.step_and_number[number];
  const model::Step& of = model.steps[step];
  return of.ends.empty() ? static_cast<double>(of_step) / of.increments
                         : of.ends[static_cast<std::size_t>(of_step - 1)];
}

}  // namespace scabo::result
