// Validation of requested output.
#include <fmt/format.h>

#include "scabo/model/checking.hpp"

namespace scabo::model {

namespace {

/// -1 stands for every body.
void check_body_of(Checking& checking, const std::string& path, int body) {
  if (body != -1 && !checking.is_body(body))
    checking.error(path, "body",
                   fmt::format("there is no body number {}: the model has {}, counted from 0", body,
                               checking.model.bodies.size()));
}

void check_output_name(Checking& checking, const std::string& path, const std::string& name, const char* what,
                       std::unordered_set<std::string>& names) {
  if (!is_name(name))
    checking.error(path, "name",
                   fmt::format("'{}' is not a valid name: use letters, digits, _ and -, and begin with a "
                               "letter or _",
                               name));
  else if (!names.insert(name).second)
    checking.error(path, "name", fmt::format("another {} is already named '{}': rename one of them", what, name));
}

void check_points(Checking& checking) {
  std::unordered_set<std::string> names;
  const auto& points = checking.model.output.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string path = path_of("output.points", points[i].source, i);
    checking.enter(points[i].source);
    check_output_name(checking, path, points[i].name, "point", names);
    checking.vector(path, "at", points[i].at);
    check_body_of(checking, path, points[i].body);
  }
}

void check_lines(Checking& checking) {
  std::unordered_set<std::string> names;
  const auto& lines = checking.model.output.lines;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const OutputLine& line = lines[i];
    const std::string path = path_of("output.lines", line.source, i);
    checking.enter(line.source);
    check_output_name(checking, path, line.name, "line", names);
    const bool good = checking.vector(path, "from", line.from) && checking.vector(path, "to", line.to);
    checking.whole(path, "points", line.points, limits::line_points);
    check_body_of(checking, path, line.body);
    if (good && line.from == line.to)
      checking.error(path, "", "the line ends where it starts: give two different points, or use 'points'");
  }
}

void check_grid(Checking& checking) {
  const auto& grid = checking.model.output.grid;
  if (!grid) return;
  const std::string path = "output.grid";
  checking.enter(grid->source);
  check_body_of(checking, path, grid->body);
  if (grid->spacing) {
    checking.positive(path, "spacing", *grid->spacing);
    return;
  }
  if (!checking.vector(path, "x", grid->low) || !checking.vector(path, "y", grid->high)) return;
  bool good = true;
  for (const int k : {0, 1}) {
    const char* key = k == 0 ? "x" : "y";
    const int count = grid->counts[static_cast<std::size_t>(k)];
    good = checking.whole(path, std::string(key) + ".2", count, limits::grid_points) && good;
    if (count > 1 && grid->low[k] == grid->high[k])
      checking.error(path, key,
                     fmt::format("the {} points coincide: give different first and last coordinates", count));
    if (count == 1 && grid->low[k] != grid->high[k])
      checking.error(path, std::string(key) + ".2",
                     "a single point cannot have different first and last coordinates: give 2 points or more");
  }
  if (good && static_cast<double>(grid->counts[0]) * grid->counts[1] > static_cast<double>(limits::grid_points.most))
    checking.error(path, "",
                   fmt::format("has {} x {} points, more than the {} allowed", grid->counts[0], grid->counts[1],
                               limits::grid_points.most));
}

}  // namespace

void check_output(Checking& checking) {
  check_points(checking);
  check_lines(checking);
  check_grid(checking);
  checking.enter({});
  checking.whole("output", "every", checking.model.output.every, limits::every);
}

}  // namespace scabo::model
