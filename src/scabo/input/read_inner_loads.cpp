// Loads on side faces and inside bodies: tractions on side faces, body forces, temperature.
#include "scabo/input/read_inner_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "scabo/input/numbers.hpp"

namespace scabo::input {

namespace {

constexpr std::size_t most_points = 10;

/// A traction `[tx, ty]`, or a pressure.
std::optional<Vec2> read_value(Reading& reading, const Value& value, bool pressure) {
  if (!pressure) return read_vector(reading.report, value);
  const auto number = read_number(reading.report, value);
  if (!number) return {};
  return Vec2(*number, 0.0);
}

std::optional<std::vector<FaceTraction::Term>> read_powers(Reading& reading, const Value& value, bool pressure) {
  if (value.node->kind != Node::Kind::map || value.node->entries.empty()) {
    reading.report.error(value, fmt::format("must be powers of xi, as in {{0: {0}, 1: {0}}}, not {1}",
                                            pressure ? "1e3" : "[0, -1e3]", describe(*value.node)));
    return {};
  }
  std::vector<FaceTraction::Term> terms;
  for (const MapEntry& entry : value.node->entries) {
    const Value item{entry.value, value.path + "." + entry.key};
    const Source key{entry.line, entry.column, item.path};
    const auto power = parse_number(entry.key);
    if (const std::string* why = std::get_if<std::string>(&power)) {
      reading.report.error(key, "a power of xi " + *why);
      return {};
    }
    FaceTraction::Term term{std::get<double>(power), Vec2::Zero()};
    const auto read = read_value(reading, item, pressure);
    if (!read) return {};
    term.value = *read;
    terms.push_back(term);
  }
  return terms;
}

struct Sample {
  double xi = 0.0;
  Vec2 value = Vec2::Zero();
};

/// Coefficients of the polynomial through the points (Newton's divided differences, expanded).
std::vector<FaceTraction::Term> polynomial_through(const std::vector<Sample>& samples) {
  const std::size_t n = samples.size();
  std::vector<Vec2> differences;
  for (const Sample& sample : samples) differences.push_back(sample.value);
  for (std::size_t level = 1; level < n; ++level)
    for (std::size_t i = n - 1; i >= level; --i)
      differences[i] = (differences[i] - differences[i - 1]) / (samples[i].xi - samples[i - level].xi);
  std::vector<Vec2> coefficients(n, Vec2::Zero());  // Horner, from the last difference
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t i = n - 1; i > 0; --i) coefficients[i] = coefficients[i - 1] - samples[k].xi * coefficients[i];
    coefficients[0] = differences[k] - samples[k].xi * coefficients[0];
  }
  std::vector<FaceTraction::Term> terms;
  for (std::size_t i = 0; i < n; ++i)
    if (!coefficients[i].isZero(0.0)) terms.push_back({static_cast<double>(i), coefficients[i]});
  if (terms.empty()) terms.push_back({0.0, Vec2::Zero()});
  return terms;
}

std::optional<std::vector<FaceTraction::Term>> read_points(Reading& reading, const Value& value, bool pressure) {
  const std::size_t before = reading.report.count();
  const char* example = pressure ? "[[0, 0], [1, 1e3]]" : "[[0, 0, 0], [1, 0, -1e3]]";
  const auto items = read_list(reading.report, value, example);
  if (!items) return {};
  if (items->empty() || items->size() > most_points) {
    reading.report.error(
        value, fmt::format("must be 1 to {} points, not {}: a polynomial through more points oscillates; use powers",
                           most_points, items->size()));
    return {};
  }
  std::vector<Sample> samples;
  for (const Value& item : *items) {
    const std::size_t size = pressure ? 2 : 3;
    if (item.node->kind != Node::Kind::sequence || item.node->items.size() != size) {
      reading.report.error(item, fmt::format("must be {}, not {}", pressure ? "[xi, p]" : "[xi, tx, ty]",
                                             item.node->kind == Node::Kind::sequence
                                                 ? fmt::format("a list of {}", item.node->items.size())
                                                 : describe(*item.node)));
      continue;
    }
    Sample sample;
    const auto xi = read_number(reading.report, item.item(0));
    if (xi && !(*xi >= 0.0 && *xi <= 1.0))
      reading.report.error(
          item.item(0),
          fmt::format("xi must be from 0 (the scaling centre) to 1 (the boundary), not {}", item.item(0).node->text));
    sample.xi = xi.value_or(0.0);
    for (std::size_t c = 1; c < size; ++c)
      sample.value[static_cast<Eigen::Index>(c - 1)] = read_number(reading.report, item.item(c)).value_or(0.0);
    if (std::any_of(samples.begin(), samples.end(),
                    [&](const Sample& other) { return std::abs(other.xi - sample.xi) < 1e-6; }))
      reading.report.error(item, "two points have the same xi: remove one of them");
    samples.push_back(sample);
  }
  if (reading.report.count() > before) return {};
  return polynomial_through(samples);
}

}  // namespace

std::optional<FaceTraction> read_face_traction(Reading& reading, const Value& value, bool pressure) {
  FaceTraction traction;
  traction.pressure = pressure;
  if (value.node->kind != Node::Kind::map) {
    const auto constant = read_value(reading, value, pressure);
    if (!constant) return {};
    traction.terms = {{0.0, *constant}};
    return traction;
  }
  const MapReader map(reading.report, value, {"powers", "points"}, "{powers: {0: 1e3, 1: -1e3}}");
  const auto powers = map.get("powers"), points = map.get("points");
  if (powers.has_value() == points.has_value()) {
    if (map.all_known()) reading.report.error(value, "needs exactly one of powers and points");
    return {};
  }
  auto terms = powers ? read_powers(reading, *powers, pressure) : read_points(reading, *points, pressure);
  if (!terms) return {};
  traction.terms = std::move(*terms);
  return traction;
}

std::optional<BodyForce> read_body_force(Reading& reading, const Value& value) {
  BodyForce force;
  if (value.node->kind != Node::Kind::map) {
    const auto constant = read_vector(reading.report, value);
    if (!constant) return {};
    force.x.constant = constant->x();
    force.y.constant = constant->y();
    return force;
  }
  const std::size_t before = reading.report.count();
  const MapReader map(reading.report, value, {"constant", "x", "y"}, "{constant: [0, -1e3], x: [0, 0], y: [0, 10]}");
  const auto part = [&](const char* key) {
    const auto at = map.get(key);
    return at ? read_vector(reading.report, *at).value_or(Vec2::Zero()) : Vec2(Vec2::Zero());
  };
  const Vec2 constant = part("constant"), per_x = part("x"), per_y = part("y");
  if (map.is_map() && value.node->entries.empty()) reading.report.error(value, "needs constant, x or y");
  if (reading.report.count() > before) return {};
  return BodyForce{{constant.x(), per_x.x(), per_y.x()}, {constant.y(), per_x.y(), per_y.y()}};
}

namespace {

std::optional<UniformStress> read_uniform_stress(Reading& reading, const MapReader& map) {
  const Value value = *map.get("stress");
  if (value.node->kind != Node::Kind::sequence || value.node->items.size() != 3) {
    reading.report.error(value, fmt::format("must be [sxx, syy, sxy], tension positive, not {}",
                                            value.node->kind == Node::Kind::sequence
                                                ? fmt::format("a list of {}", value.node->items.size())
                                                : describe(*value.node)));
    return {};
  }
  UniformStress stress;
  for (std::size_t i = 0; i < 3; ++i) stress.value[i] = number_or_unread(reading, value.item(i));
  if (const auto zz = map.get("szz")) stress.zz = number_or_unread(reading, zz);
  return stress;
}

std::optional<GroundStress> read_ground_stress(Reading& reading, const MapReader& map) {
  GroundStress ground;
  ground.K0 = number_or_unread(reading, map.need("K0"));
  const MapReader vertical(reading.report, *map.get("vertical"), {"unit_weight", "surface", "surcharge", "up"},
                           "{unit_weight: 20e3, surface: 0}",
                           {{"density", "give unit_weight, density times the acceleration of gravity"},
                            {"level", "write surface"},
                            {"depth", "give surface, a coordinate"}});
  if (!vertical.is_map()) return {};
  ground.unit_weight = number_or_unread(reading, vertical.need("unit_weight"));
  ground.surface = number_or_unread(reading, vertical.need("surface"));
  if (const auto surcharge = vertical.get("surcharge")) ground.surcharge = number_or_unread(reading, surcharge);
  if (const auto up = vertical.get("up"))
    if (const auto direction = read_vector(reading.report, *up))
      ground.up = direction->norm() > 0.0 ? Vec2(direction->stableNormalized()) : Vec2(Vec2::Zero());
  return ground;
}

}  // namespace

std::optional<decltype(Load::kind)> read_field(Reading& reading, const Value& value) {
  const std::size_t before = reading.report.count();
  const MapReader map(reading.report, value, {"stress", "szz", "vertical", "K0"}, "{stress: [-5e6, -10e6, 0]}");
  if (!map.is_map()) return {};
  if (map.has("stress") == map.has("vertical")) {
    if (map.all_known())
      reading.report.error(value,
                           "needs stress: [sxx, syy, sxy], the same everywhere, or vertical: {unit_weight, "
                           "surface} and K0, of ground under its weight");
    return {};
  }
  for (const char* key : {"szz", "K0"})
    if (map.has(key) && map.has("stress") == (std::string_view(key) == "K0"))
      map.refuse(key, map.has("stress") ? "belongs to vertical: leave it out" : "belongs to stress: leave it out");
  std::optional<decltype(Load::kind)> kind;
  if (map.has("stress")) {
    if (const auto stress = read_uniform_stress(reading, map)) kind = *stress;
  } else if (const auto ground = read_ground_stress(reading, map)) {
    kind = *ground;
  }
  if (reading.report.count() > before) return {};
  return kind;
}

namespace {

/// Points `[x, y]` on a straight line, in order, become places along it.
void read_points_on_a_line(Reading& reading, const std::vector<Value>& items, TemperatureTable& table) {
  const std::size_t before = reading.report.count();
  std::vector<Vec2> points;
  for (const Value& item : items) {
    if (item.node->kind == Node::Kind::scalar) {
      reading.report.error(item, "must be a point [x, y]; for a table over a coordinate, add over: x or over: y");
      return;
    }
    points.push_back(read_vector(reading.report, item).value_or(Vec2::Zero()));
  }
  if (reading.report.count() > before || points.size() < 2) return;
  const Vec2 from = points.front(), line = points.back() - from;
  if (!(line.norm() > 0.0)) {
    reading.report.error(items.back(), "is the first place again, so that there is no line: end at another one");
    return;
  }
  table.along = line.stableNormalized();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double distance = std::abs(cross(table.along, Vec2(points[i] - from)));
    if (distance > 1e-6 * line.norm()) {
      reading.report.error(items[i], fmt::format("is {:.3g} away from the straight line from the first to the last "
                                                 "place, along which the temperature changes: move it there",
                                                 distance));
      return;
    }
    table.points[i].at = table.along.dot(points[i]);
    if (i == 0 || table.points[i].at > table.points[i - 1].at) continue;
    reading.report.error(items[i], "does not lie beyond the place before it: give places in their order on the line");
    return;
  }
}

/// `{at, values}` with points, or `{over, at, values}` with coordinates or distances from `centre`.
std::optional<TemperatureTable> read_temperature_table(Reading& reading, const MapReader& map) {
  Report& report = reading.report;
  const std::size_t before = report.count();
  for (const char* key : {"constant", "x", "y"})
    map.refuse(key, "does not go together with a table: leave it out, or give it as a load of its own");
  const auto over = map.get("over");
  TemperatureTable table;
  if (const auto choice = over ? read_choice(report, *over, {"x", "y", "radius"}) : std::nullopt) {
    if (*choice == "y") table.along = Vec2(0.0, 1.0);
    if (*choice == "radius")
      if (const auto centre = map.need("centre")) table.centre = read_vector(report, *centre);
  }
  if (!table.centre) map.refuse("centre", "belongs to a table over: radius: leave it out");
  const auto at = map.need("at"), values = map.need("values");
  const auto places = at ? read_list(report, *at, over ? "[0, 10, 40]" : "[[0, 0], [0, 40]]") : std::nullopt;
  const auto given = values ? read_list(report, *values, "[4, 12, 18.5]") : std::nullopt;
  if (report.count() > before || !places || !given) return {};
  if (places->size() != given->size()) {
    report.error(*values, fmt::format("has {} value{} for {} place{} of at: give one for each", given->size(),
                                      given->size() == 1 ? "" : "s", places->size(), places->size() == 1 ? "" : "s"));
    return {};
  }
  table.points.resize(places->size());
  for (std::size_t i = 0; i < places->size(); ++i) {
    table.points[i].change = read_number(report, (*given)[i]).value_or(0.0);
    if (over) table.points[i].at = read_number(report, (*places)[i]).value_or(0.0);
  }
  if (!over && report.count() == before) read_points_on_a_line(reading, *places, table);
  if (report.count() > before) return {};
  return table;
}

}  // namespace

std::optional<Temperature> read_temperature(Reading& reading, const Value& value) {
  Temperature temperature;
  if (value.node->kind != Node::Kind::map) {
    const auto constant = read_number(reading.report, value);
    if (!constant) return {};
    temperature.change.constant = *constant;
    return temperature;
  }
  const std::size_t before = reading.report.count();
  const MapReader map(reading.report, value, {"constant", "x", "y", "over", "centre", "at", "values"},
                      "{constant: 20, x: 0, y: -2.5} or {over: y, at: [0, 10], values: [4, 12]}",
                      {{"along", "write over: x or over: y, or give points [x, y] in at"},
                       {"length", "write over: x or over: y, or give points [x, y] in at"}});
  if (map.has("at") || map.has("values") || map.has("over") || map.has("centre")) {
    temperature.table = read_temperature_table(reading, map);
    if (!temperature.table || reading.report.count() > before) return {};
    return temperature;
  }
  const auto part = [&](const char* key) {
    const auto at = map.get(key);
    return at ? read_number(reading.report, *at).value_or(0.0) : 0.0;
  };
  temperature.change = {part("constant"), part("x"), part("y")};
  if (map.is_map() && value.node->entries.empty())
    reading.report.error(value, "needs constant, x or y, or a table: over, at and values");
  if (reading.report.count() > before) return {};
  return temperature;
}

}  // namespace scabo::input
