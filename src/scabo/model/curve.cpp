#include "scabo/model/curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scabo::model {

namespace {

/// Whole quarters without the rounding of their sum.
double near_quarter(double turns) {
  const double quarter = 0.25 * std::round(4.0 * turns);
  return std::abs(turns - quarter) <= 1e-14 * (1.0 + turns) ? quarter : turns;
}

}  // namespace

double value_of(const Curve& curve, double s) {
  if (const auto* sine = std::get_if<CurveSine>(&curve.kind)) {
    // The sine of whole and half turns is exact: a cycle ends where it begins.
    const double turns = near_quarter(sine->turns + sine->periods * s), rest = turns - std::floor(turns);
    const double quarter = 4.0 * rest;
    const double value = quarter == 0.0 || quarter == 2.0 ? 0.0 : std::sin(2.0 * std::numbers::pi * rest);
    return sine->mean + sine->amplitude * value;
  }
  const std::vector<CurveTable::Point>& points = std::get<CurveTable>(curve.kind).points;
  if (s <= points.front().at) return points.front().value;
  const auto next = std::partition_point(points.begin(), points.end(), [&](const auto& point) { return point.at < s; });
  if (next == points.end()) return points.back().value;
  if (s == next->at) return next->value;
  const CurveTable::Point& before = *(next - 1);
  const double part = (s - before.at) / (next->at - before.at);
  return before.value + part * (next->value - before.value);
}

double value_at(const Curve& curve, double time, double duration) {
  const auto* table = std::get_if<CurveTable>(&curve.kind);
  return table ? value_of(curve, (time - table->first) / (table->last - table->first))
               : value_of(curve, time / duration);
}

double mean_between(const Curve& curve, double from, double to, double duration) {
  const double length = to - from;
  if (!(length > 0.0)) return value_at(curve, to, duration);
  if (const auto* sine = std::get_if<CurveSine>(&curve.kind)) {
    const double turn = 2.0 * std::numbers::pi;
    const double begin = turn * (sine->turns + sine->periods * from / duration),
                 part = turn * sine->periods * length / duration;
    // (cos begin - cos(begin + part)) / part without cancellation
    const double half = 0.5 * part;
    return sine->mean + sine->amplitude * std::sin(begin + half) * (half == 0.0 ? 1.0 : std::sin(half) / half);
  }
  const auto& table = std::get<CurveTable>(curve.kind);
  const auto position = [&](double time) { return (time - table.first) / (table.last - table.first); };
  const double a = position(from), b = position(to);
  double sum = 0.0;
  double at = a, value = value_of(curve, a);
  auto point = std::partition_point(table.points.begin(), table.points.end(),
                                    [&](const CurveTable::Point& one) { return one.at < a; });
  for (; point != table.points.end() && point->at <= b; ++point) {
    sum += 0.5 * (value + point->value) * (point->at - at);
    at = point->at, value = point->value;
  }
  if (at < b) sum += 0.5 * (value + value_of(curve, b)) * (b - at);
  return sum / (b - a);
}

void integrate_record(Curve& curve) {
  const auto& table = std::get<CurveTable>(curve.kind);
  RecordOfGround& record = *curve.record;
  record.velocity.assign(table.points.size(), 0.0);
  record.displacement = record.velocity;
  for (std::size_t i = 1; i < table.points.size(); ++i) {
    const double h = (table.points[i].at - table.points[i - 1].at) * (table.last - table.first);
    const double a = table.points[i - 1].value, b = table.points[i].value, v = record.velocity[i - 1];
    record.velocity[i] = v + 0.5 * h * (a + b);
    record.displacement[i] = record.displacement[i - 1] + h * v + h * h * (2.0 * a + b) / 6.0;
  }
}

double displacement_at(const Curve& curve, double time, double duration) {
  if (!curve.record) return value_at(curve, time, duration);
  const auto& table = std::get<CurveTable>(curve.kind);
  const RecordOfGround& record = *curve.record;
  const double length = table.last - table.first, s = (time - table.first) / length;
  const auto next = std::upper_bound(table.points.begin(), table.points.end(), s,
                                     [](double at, const CurveTable::Point& point) { return at < point.at; });
  if (next == table.points.begin()) return 0.0;
  const auto i = static_cast<std::size_t>(next - table.points.begin()) - 1;
  const double t = (s - table.points[i].at) * length, before = record.displacement[i] + t * record.velocity[i];
  if (next == table.points.end()) return before;
  const double a = table.points[i].value, rise = (next->value - a) / ((next->at - table.points[i].at) * length);
  return before + t * t * (0.5 * a + rise * t / 6.0);
}

GroundMotion ground_motion(const Curve& acceleration, double duration, double time) {
  GroundMotion motion;
  // Between these times the acceleration is linear, or they are 1/256 of a sine's period.
  std::vector<double> times{0.0, time};
  if (const auto* table = std::get_if<CurveTable>(&acceleration.kind)) {
    for (const CurveTable::Point& point : table->points)
      times.push_back(std::clamp(table->first + point.at * (table->last - table->first), 0.0, time));
  } else {
    const double parts =
        std::ceil(256.0 * std::max(1.0, std::get<CurveSine>(acceleration.kind).periods * time / duration));
    for (double k = 1.0; k < parts; k += 1.0) times.push_back(k / parts * time);
  }
  std::sort(times.begin(), times.end());
  constexpr double rounding = 1e-12;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double h = times[i] - times[i - 1];
    if (!(h > rounding * time)) continue;  // two points of a jump
    // The means of both halves, with which a line is integrated exactly, and without a jump at its ends.
    const double middle = 0.5 * (times[i - 1] + times[i]);
    const double first = mean_between(acceleration, times[i - 1], middle, duration),
                 second = mean_between(acceleration, middle, times[i], duration);
    const double mean = 0.5 * (first + second), rise = 2.0 * (second - first);
    motion.largest = std::max({motion.largest, std::abs(mean - 0.5 * rise), std::abs(mean + 0.5 * rise)});
    motion.displacement += h * motion.velocity + h * h * (0.5 * mean - rise / 12.0);
    motion.velocity += h * mean;
  }
  return motion;
}

Curve piece_of(const Curve& curve, double from, double to) {
  Curve piece = curve;
  if (auto* sine = std::get_if<CurveSine>(&piece.kind)) {
    sine->turns += sine->periods * from;
    sine->periods *= to - from;
    return piece;
  }
  CurveTable table;
  table.points.push_back({0.0, value_of(curve, from)});
  constexpr double rounding = 1e-12;
  for (const CurveTable::Point& point : std::get<CurveTable>(curve.kind).points)
    if (point.at > from + rounding && point.at < to - rounding)
      table.points.push_back({(point.at - from) / (to - from), point.value});
  table.points.push_back({1.0, value_of(curve, to)});
  piece.kind = std::move(table);
  return piece;
}

std::vector<double> corners_of(const Curve& curve) {
  std::vector<double> corners;
  const auto add = [&](double s) {
    if (s > 0.0 && s < 1.0) corners.push_back(s);
  };
  const auto* sine = std::get_if<CurveSine>(&curve.kind);
  // More periods than validation allows would never be passed through; they are asked for before it.
  if (sine && !(sine->periods > 0.0 && sine->periods <= 10'000.0)) return corners;
  if (sine)
    for (double quarter = 2.0 * std::floor(2.0 * sine->turns) + 1.0; quarter < 4.0 * (sine->turns + sine->periods);
         quarter += 2.0)
      add((0.25 * quarter - sine->turns) / sine->periods);
  else
    for (const CurveTable::Point& point : std::get<CurveTable>(curve.kind).points) add(point.at);
  return corners;
}

}  // namespace scabo::model
