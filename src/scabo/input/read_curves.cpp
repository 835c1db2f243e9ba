// `curves`: tables, ramps and sines that factors of loads and supports follow, within a step or over several.
#include <fmt/format.h>

#include "scabo/input/curves.hpp"
#include "scabo/input/numbers.hpp"
#include "scabo/input/reading.hpp"

namespace scabo::input {

namespace {

std::optional<CurveTable> read_curve_table(Report& report, const Value& value) {
  const auto items = read_list(report, value, "[[0, 0], [1, 1], [3, -1], [4, 0]]");
  if (!items) return {};
  if (items->size() < 2) {
    report.error(value, "needs two points or more, as in [[0, 0], [1, 1], [3, -1], [4, 0]]");
    return {};
  }
  CurveTable table;
  for (const Value& item : *items) {
    const auto point = read_vector(report, item);
    if (!point) return {};
    if (!table.points.empty() && !(point->x() >= table.points.back().at)) {
      report.error(item, "positions must be ascending: a factor cannot jump");
      return {};
    }
    table.points.push_back({point->x(), point->y()});
  }
  table.first = table.points.front().at, table.last = table.points.back().at;
  if (!(table.last > table.first)) {
    report.error(value, "must have points at different positions");
    return {};
  }
  for (CurveTable::Point& point : table.points) point.at = (point.at - table.first) / (table.last - table.first);
  return table;
}

std::optional<CurveTable> read_ramp(Report& report, const Value& value) {
  const std::size_t before = report.count();
  const MapReader map(report, value, {"from", "to", "begin", "end"}, "{from: 0, to: 1, begin: 0.2, end: 0.8}");
  const auto number = [&](const char* key, double otherwise) {
    const auto given = map.get(key);
    return given ? read_number(report, *given).value_or(otherwise) : otherwise;
  };
  map.need("to");
  const double from = number("from", 0.0), to = number("to", 1.0), begin = number("begin", 0.0),
               end = number("end", 1.0);
  if (report.count() > before) return {};
  if (!(begin >= 0.0 && begin < end && end <= 1.0)) {
    report.error(value, "'begin' and 'end' must be parts of the step, from 0 to 1, and ascending");
    return {};
  }
  return CurveTable{{{begin, from}, {end, to}}};
}

std::optional<CurveSine> read_sine(Report& report, const Value& value) {
  const std::size_t before = report.count();
  const MapReader map(report, value, {"amplitude", "periods", "mean"}, "{amplitude: 1, periods: 3}");
  CurveSine sine;
  if (const auto amplitude = map.need("amplitude")) sine.amplitude = read_number(report, *amplitude).value_or(unread);
  if (const auto periods = map.get("periods")) sine.periods = read_number(report, *periods).value_or(unread);
  if (const auto mean = map.get("mean")) sine.mean = read_number(report, *mean).value_or(unread);
  return report.count() > before ? std::nullopt : std::optional(sine);
}

/// `[press, shake]`, of equal length, or `{press: 1, shake: 3}`, with their lengths.
std::optional<CurveOver> read_over(Reading& reading, const Value& value) {
  constexpr const char* example = "[press, shake] or {press: 1, shake: 3}";
  CurveOver over;
  double reached = 0.0;
  const std::size_t before = reading.report.count();
  const auto add = [&](const std::string& step, double length, const Source& source) {
    if (!over.number.emplace(step, static_cast<int>(over.parts.size())).second)
      reading.report.error(source, fmt::format("step '{}' is named twice", step));
    over.parts.push_back({step, reached += length, -1, source});
  };
  if (value.node->kind == Node::Kind::map) {
    for (const Entry& entry : read_named(reading.report, value, "lengths of steps", example)) {
      const double length = read_number(reading.report, entry.value).value_or(1.0);
      if (!(length > 0.0)) reading.report.error(entry.value, "must be greater than 0: it is the length of a step");
      add(entry.key, length, entry.key_source);
    }
  } else {
    const auto items = read_list(reading.report, value, example);
    for (const Value& item : items.value_or(std::vector<Value>{}))
      if (const auto name = read_text(reading.report, item)) add(*name, 1.0, item.source());
  }
  if (reading.report.count() == before && over.parts.empty())
    reading.report.error(value, fmt::format("must name the steps that the curve runs over, as in {}", example));
  if (reading.report.count() > before) return {};
  for (CurveOver::Part& part : over.parts) part.end /= reached;
  over.parts.back().end = 1.0;
  return over;
}

}  // namespace

std::optional<CurveKind> read_curve_kind(Report& report, const MapReader& map) {
  const auto table = map.get("table"), ramp = map.get("ramp"), sine = map.get("sine");
  if (sine) {
    const auto read = read_sine(report, *sine);
    return read ? std::optional<CurveKind>(*read) : std::nullopt;
  }
  const auto read = table ? read_curve_table(report, *table) : read_ramp(report, *ramp);
  return read ? std::optional<CurveKind>(*read) : std::nullopt;
}

void read_curves(Reading& reading, const Value& value) {
  const std::size_t start = reading.report.count();
  for (const Entry& entry :
       read_named(reading.report, value, "curves", "{cycle: {table: [[0, 0], [1, 1], [3, -1], [4, 0]]}}")) {
    const MapReader map(reading.report, entry.value, {"table", "ramp", "sine", "record", "over"},
                        "{sine: {amplitude: 1, periods: 3}}");
    if (!map.is_map()) continue;
    const auto table = map.get("table"), ramp = map.get("ramp"), sine = map.get("sine"), record = map.get("record");
    if (int{table.has_value()} + int{ramp.has_value()} + int{sine.has_value()} + int{record.has_value()} != 1) {
      if (map.all_known()) reading.report.error(entry.value, "needs exactly one of table, ramp, sine and record");
      continue;
    }
    Curve curve;
    curve.name = entry.key;
    curve.source = entry.key_source;
    if (record) {
      const auto read = read_record_of(reading, *record, curve);
      if (!read) continue;
      curve.kind = *read;
      integrate_record(curve);
    } else {
      const auto read = read_curve_kind(reading.report, map);
      if (!read) continue;
      curve.kind = *read;
    }
    const auto index = static_cast<int>(reading.model.curves.size());
    if (const auto over = map.get("over"))
      if (auto read = read_over(reading, *over)) reading.curves_over.emplace(index, std::move(*read));
    reading.index_of_curve.emplace(curve.name, index);
    reading.model.curves.push_back(std::move(curve));
  }
  if (reading.report.count() > start) reading.curves_known = false;
}

}  // namespace scabo::input
