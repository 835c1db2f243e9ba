// `output`: points, lines and a grid for results, the arrays of the .vtu files, and the error estimate.
#include <fmt/format.h>

#include <algorithm>

#include "scabo/input/reading.hpp"
#include "scabo/input/suggestions.hpp"

namespace scabo::input {

namespace {

constexpr const char* output_example = "{points: [[1, 0.5]], grid: {spacing: 0.1}}";
constexpr const char* point_example = "[1, 0.5] or {at: [1, 0.5], name: crest}";
constexpr const char* line_example = "{from: [0, 0], to: [1, 0], points: 101, name: axis}";
constexpr const char* grid_example = "{spacing: 0.1} or {x: [0, 1, 11], y: [0, 2, 21]}";

/// `name`, or `what_3`.
std::string read_name_of(Reading& reading, const MapReader& map, const char* what, std::size_t number) {
  if (const auto value = map.get("name")) {
    const auto text = read_text(reading.report, *value);
    if (text && check_name(reading.report, value->source(), *text)) return *text;
  }
  return fmt::format("{}_{}", what, number);
}

void read_points(Reading& reading, const Value& value) {
  const auto items = read_list(reading.report, value, fmt::format("[{}]", point_example));
  if (!items) return;
  for (std::size_t i = 0; i < items->size(); ++i) {
    const Value& item = (*items)[i];
    const std::size_t before = reading.report.count();
    OutputPoint point;
    point.source = item.source();
    if (item.node->kind == Node::Kind::sequence) {
      point.name = fmt::format("point_{}", i + 1);
      point.at = read_vector(reading.report, item).value_or(Vec2::Zero());
    } else {
      const MapReader map(reading.report, item, {"at", "name", "body"}, point_example);
      if (!map.is_map()) continue;
      if (const auto at = map.need("at")) point.at = read_vector(reading.report, *at).value_or(Vec2::Zero());
      point.name = read_name_of(reading, map, "point", i + 1);
      const auto body = read_body_of(reading, map);
      if (!body) continue;
      point.body = *body;
    }
    if (reading.report.count() == before) reading.model.output.points.push_back(std::move(point));
  }
}

void read_lines(Reading& reading, const Value& value) {
  const auto items = read_list(reading.report, value, fmt::format("[{}]", line_example));
  if (!items) return;
  for (std::size_t i = 0; i < items->size(); ++i) {
    const Value& item = (*items)[i];
    const std::size_t before = reading.report.count();
    const MapReader map(reading.report, item, {"from", "to", "points", "name", "body"}, line_example);
    if (!map.is_map()) continue;
    OutputLine line;
    line.source = item.source();
    if (const auto from = map.need("from")) line.from = read_vector(reading.report, *from).value_or(Vec2::Zero());
    if (const auto to = map.need("to")) line.to = read_vector(reading.report, *to).value_or(Vec2::Zero());
    if (const auto points = map.get("points"))
      line.points = static_cast<int>(read_integer(reading.report, *points, limits::line_points).value_or(101));
    line.name = read_name_of(reading, map, "line", i + 1);
    const auto body = read_body_of(reading, map);
    if (!body || reading.report.count() > before) continue;
    line.body = *body;
    reading.model.output.lines.push_back(std::move(line));
  }
}

/// `[first, last, count]`.
void read_range(Reading& reading, const Value& value, double& first, double& last, int& count) {
  const auto items = read_list(reading.report, value, "[0, 1, 11]");
  if (!items) return;
  if (items->size() != 3) {
    reading.report.error(value, "must be [first, last, number of points], as in [0, 1, 11]");
    return;
  }
  const auto low = read_number(reading.report, (*items)[0]);
  const auto high = read_number(reading.report, (*items)[1]);
  const auto points = read_integer(reading.report, (*items)[2], limits::grid_points);
  if (!low || !high || !points) return;
  first = *low, last = *high, count = static_cast<int>(*points);
}

void read_grid(Reading& reading, const Value& value) {
  Report& report = reading.report;
  const std::size_t before = report.count();
  const MapReader map(report, value, {"spacing", "x", "y", "body"}, grid_example);
  if (!map.is_map()) return;
  OutputGrid grid;
  grid.source = value.source();
  if (const auto spacing = map.get("spacing")) {
    grid.spacing = read_number(report, *spacing);
    for (const char* key : {"x", "y"})
      map.refuse(key, "'spacing' already determines the points: remove one of the two");
  } else {
    if (!map.has("x") && !map.has("y") && map.all_known())
      report.error(value, fmt::format("does not define any points: write {}", grid_example));
    else
      for (const int k : {0, 1})
        if (const auto range = map.need(k == 0 ? "x" : "y"))
          read_range(reading, *range, grid.low[k], grid.high[k], grid.counts[static_cast<std::size_t>(k)]);
  }
  const auto body = read_body_of(reading, map);
  if (!body || report.count() > before) return;
  grid.body = *body;
  reading.model.output.grid = grid;
}

/// `fields`: only those that are named.
void read_fields(Reading& reading, const Value& value) {
  const auto items = read_list(reading.report, value, "[displacement, stress]");
  if (!items) return;
  OutputFields& fields = reading.model.output.fields;
  const std::vector<std::pair<std::string, bool OutputFields::*>> groups = {
      {"displacement", &OutputFields::displacement},
      {"stress", &OutputFields::stress},
      {"principal", &OutputFields::principal},
      {"von_mises", &OutputFields::von_mises},
      {"contact", &OutputFields::contact}};
  std::vector<std::string> names;
  for (const auto& [name, member] : groups) {
    names.push_back(name);
    fields.*member = false;
  }
  for (const Value& item : *items) {
    const auto choice = read_choice(reading.report, item, names);
    if (!choice) continue;
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& of) { return of.first == *choice; });
    if (fields.*group->second)
      reading.report.error(item, fmt::format("'{}' is given twice: remove one of the two", *choice));
    fields.*group->second = true;
  }
}

}  // namespace

std::optional<int> read_body_of(Reading& reading, const MapReader& map) {
  const auto value = map.get("body");
  if (!value) return -1;
  const auto name = read_text(reading.report, *value);
  if (!name) return {};
  const int index = reading.body_index(*name);
  if (index >= 0) return index;
  if (!reading.bodies_known) return {};
  std::vector<std::string> names;
  if (!reading.report.full())
    for (const Body& body : reading.model.bodies) names.push_back(body.name);
  reading.report.error(*value,
                       fmt::format("there is no body named {}{}", quoted_name(*name), suggestion(*name, names)));
  return {};
}

void read_output(Reading& reading, const Value& value) {
  const MapReader map(
      reading.report, value,
      {"points", "lines", "grid", "history", "fields", "every", "error", "error_of", "discrete_problems"},
      output_example);
  if (const auto points = map.get("points")) read_points(reading, *points);
  if (const auto lines = map.get("lines")) read_lines(reading, *lines);
  if (const auto grid = map.get("grid")) read_grid(reading, *grid);
  if (const auto history = map.get("history")) read_history(reading, *history);
  if (const auto fields = map.get("fields")) read_fields(reading, *fields);
  if (const auto every = map.get("every"))
    reading.model.output.every = static_cast<int>(read_integer(reading.report, *every, limits::every).value_or(1));
  if (const auto error = map.get("error"))
    reading.model.output.error = read_flag(reading.report, *error).value_or(false);
  if (const auto quantities = map.get("error_of")) read_quantities(reading, *quantities, reading.model.output.error_of);
  if (const auto problems = map.get("discrete_problems"))
    reading.model.output.discrete_problems = read_flag(reading.report, *problems).value_or(false);
}

}  // namespace scabo::input
