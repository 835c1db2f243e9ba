// `record` of a curve: a record of ground motion as an acceleration.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "scabo/files/record.hpp"
#include "scabo/input/numbers.hpp"
#include "scabo/input/reading.hpp"

namespace scabo::input {

namespace {

using files::MotionKind;

constexpr double standard_gravity = 9.80665;

struct UnitOfRecord {
  const char* name;
  MotionKind kind;
  double factor;  ///< to metres and seconds
};
constexpr UnitOfRecord units[] = {{"g", MotionKind::acceleration, standard_gravity},
                                  {"m/s2", MotionKind::acceleration, 1.0},
                                  {"cm/s2", MotionKind::acceleration, 0.01},
                                  {"gal", MotionKind::acceleration, 0.01},
                                  {"m/s", MotionKind::velocity, 1.0},
                                  {"cm/s", MotionKind::velocity, 0.01},
                                  {"m", MotionKind::displacement, 1.0},
                                  {"cm", MotionKind::displacement, 0.01},
                                  {"mm", MotionKind::displacement, 0.001}};
constexpr const char* kinds[] = {"acceleration", "velocity", "displacement"};

/// What the values of a record are, and by what they are multiplied.
struct Meaning {
  std::string unit;  ///< empty: the user gives a factor
  MotionKind kind = MotionKind::acceleration;
  double factor = 1.0;
};

const UnitOfRecord* unit_named(const std::string& name) {
  const auto* found =
      std::find_if(std::begin(units), std::end(units), [&](const auto& unit) { return unit.name == name; });
  return found == std::end(units) ? nullptr : found;
}

/// Nothing if it is broken. `unit_of_file`: what the format says.
std::optional<Meaning> read_meaning(Reading& reading, const MapReader& map, const Value& value,
                                    const std::optional<std::string>& unit_of_file) {
  const auto given = map.get("unit"), of = map.get("of");
  std::optional<MotionKind> kind;
  if (of) {
    const auto choice = read_choice(reading.report, *of, {kinds[0], kinds[1], kinds[2]}, {});
    if (!choice) return {};
    kind = static_cast<MotionKind>(std::find(std::begin(kinds), std::end(kinds), *choice) - std::begin(kinds));
  }
  if (!given && !unit_of_file) {
    reading.report.error(value,
                         "needs 'unit': g, m/s2, cm/s2, m/s, cm/s, m, cm, mm, or the number by which values are "
                         "multiplied");
    return {};
  }
  const std::string name = given && given->node->kind == Node::Kind::scalar ? given->node->text
                           : given                                          ? std::string()
                                                                            : *unit_of_file;
  if (const UnitOfRecord* unit = unit_named(name)) {
    if (!kind || *kind == unit->kind) return Meaning{unit->name, unit->kind, unit->factor};
    reading.report.error(*of, fmt::format("does not fit {}, which is the unit of {}", name,
                                          unit->kind == MotionKind::acceleration ? "an acceleration"
                                          : unit->kind == MotionKind::velocity   ? "a velocity"
                                                                                 : "a displacement"));
    return {};
  }
  if (given->node->kind == Node::Kind::scalar && std::holds_alternative<double>(parse_number(name))) {
    const auto factor = read_number(reading.report, *given);
    return factor ? std::optional(Meaning{"", kind.value_or(MotionKind::acceleration), *factor}) : std::nullopt;
  }
  reading.report.error(*given,
                       "must be g, m/s2, cm/s2, m/s, cm/s, m, cm, mm, or the number by which values are "
                       "multiplied");
  return {};
}

/// Whether the acceleration can be that of an earthquake; else it is reported. What may be another unit is a warning.
bool is_plausible(Reading& reading, const Value& value, const files::Acceleration& acceleration, const Meaning& meaning,
                  bool stated, const std::string& curve) {
  constexpr double most = 30.0, weak = 0.5, least = 1e-3;  // 3 g, a twentieth and a ten-thousandth of g
  if (meaning.unit.empty()) return true;
  const double peak = acceleration.largest(), in_g = peak / standard_gravity;
  if (!(peak < most && peak > least)) {
    reading.report.error(
        value, fmt::format("the largest acceleration of the record, if its values are in {}, is {:.3g} times that of "
                           "gravity: the record has another unit, or its times have; if it is right, give 'of: {}' and "
                           "'unit' as the number {:g}",
                           meaning.unit, in_g, kinds[static_cast<int>(meaning.kind)], meaning.factor));
    return false;
  }
  if (stated && peak < weak && (meaning.unit == "m/s2" || meaning.unit == "cm/s2" || meaning.unit == "gal"))
    reading.model.warnings.push_back(
        {WarningKind::input, "curves." + curve,
         fmt::format("the largest acceleration of record '{}' is {:.3g} g, which is little for an earthquake: are its "
                     "values in {} and not in {}?",
                     curve, in_g, meaning.unit, meaning.unit == "m/s2" ? "g" : "m/s2 or g")});
  return true;
}

/// `baseline: line`. False if it is broken.
bool correct(Reading& reading, const MapReader& map, files::Acceleration& acceleration, RecordOfGround& record) {
  const auto given = map.get("baseline");
  if (!given) return true;
  const auto choice = read_choice(reading.report, *given, {"none", "mean", "line"}, {});
  if (!choice) return false;
  if (*choice == "none") return true;
  const files::Baseline baseline = files::baseline_of(acceleration, *choice == "line");
  files::subtract(baseline, acceleration);
  record.baseline = {baseline.constant, baseline.slope};
  return true;
}

/// `from`: time of the record at which it begins in a step.
CurveTable table_of(const files::Acceleration& acceleration, double from) {
  CurveTable table;
  const double first = acceleration.times.front(), last = acceleration.times.back();
  table.points.push_back({0.0, 0.0});
  for (std::size_t i = 0; i < acceleration.times.size(); ++i)
    table.points.push_back({(acceleration.times[i] - first) / (last - first), acceleration.values[i]});
  table.points.push_back({1.0, 0.0});
  table.first = first - from, table.last = last - from;
  return table;
}

/// `from: 5`. Nothing if it is broken.
std::optional<double> read_from(Reading& reading, const MapReader& map, const files::Acceleration& acceleration) {
  const auto given = map.get("from");
  if (!given) return 0.0;
  const auto from = read_number(reading.report, *given);
  if (!from) return {};
  if (*from >= 0.0 && *from < acceleration.times.back()) return from;
  reading.report.error(*given, fmt::format("must be a time of the record, from 0 to its end at {}, not {}",
                                           number_text(acceleration.times.back()), number_text(*from)));
  return {};
}

}  // namespace

std::optional<CurveTable> read_record_of(Reading& reading, const Value& value, Curve& curve) {
  const std::size_t before = reading.report.count();
  const MapReader map(reading.report, value, {"file", "unit", "of", "column", "baseline", "from"},
                      "{file: koyna.AT2, unit: g}");
  const auto name = map.need("file");
  const auto column = map.get("column");
  const auto file = name ? read_text(reading.report, *name) : std::nullopt;
  const auto number = column ? read_integer(reading.report, *column, {2, 1000}) : std::optional<long>(2);
  if (!file || !number) return {};
  const std::string path = (std::filesystem::path(reading.model.file).parent_path() / *file).string();
  reading.model.files.push_back(path);
  files::Record record;
  try {
    record = files::read_record(path, static_cast<int>(*number));
  } catch (const InputError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics())
      reading.report.error(*name, diagnostic.at.line > 0
                                      ? fmt::format("{}:{}: {}", *file, diagnostic.at.line, diagnostic.message)
                                      : fmt::format("{}: {}", *file, diagnostic.message));
    return {};
  }
  const auto meaning = read_meaning(reading, map, value, record.unit);
  if (!meaning || reading.report.count() > before) return {};
  files::Acceleration acceleration = files::acceleration_of(record, meaning->kind, meaning->factor);
  if (!is_plausible(reading, value, acceleration, *meaning, map.has("unit"), curve.name)) return {};
  RecordOfGround made{*file, kinds[static_cast<int>(meaning->kind)], {}, {}, {}};
  const auto from = read_from(reading, map, acceleration);
  if (!correct(reading, map, acceleration, made) || !from) return {};
  curve.record = std::move(made);
  return table_of(acceleration, *from);
}

}  // namespace scabo::input
