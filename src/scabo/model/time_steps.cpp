#include "scabo/model/time_steps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scabo::model {

namespace {

constexpr double most_steps = 1e6;  // no record has as many values

/// Mean square of value_at() over a step in time.
double mean_square(const Curve& curve, double duration) {
  if (const auto* sine = std::get_if<CurveSine>(&curve.kind)) {
    // (mean + A sin x)^2 = mean^2 + 2 mean A sin x + A^2 (1 - cos 2x)/2
    const double turn = 2.0 * std::numbers::pi, begin = turn * sine->turns, end = begin + turn * sine->periods,
                 A = sine->amplitude, mean = sine->mean;
    const double of_sine = (std::cos(begin) - std::cos(end)) / (end - begin),
                 of_square = 0.5 - 0.25 * (std::sin(2.0 * end) - std::sin(2.0 * begin)) / (end - begin);
    return mean * mean + 2.0 * mean * A * of_sine + A * A * of_square;
  }
  const auto& table = std::get<CurveTable>(curve.kind);
  if (table.points.empty()) return 0.0;
  double sum = 0.0, at = 0.0, value = value_at(curve, 0.0, duration);
  const auto go_to = [&](double time, double there) {
    sum += (time - at) * (value * value + value * there + there * there) / 3.0;
    at = time, value = there;
  };
  for (const CurveTable::Point& point : table.points)
    if (const double time = table.first + point.at * (table.last - table.first); time >= 0.0 && time <= duration)
      go_to(time, point.value);
  go_to(duration, value_at(curve, duration, duration));
  return sum / duration;
}

}  // namespace

std::vector<std::size_t> curves_in_time(const Step& step) {
  std::vector<std::size_t> curves;
  const auto add = [&](int curve) {
    if (curve >= 0) curves.push_back(static_cast<std::size_t>(curve));
  };
  for (const int curve : step.dynamic->ground) add(curve);
  for (const int curve : step.load_curves) add(curve);
  for (const int curve : step.support_curves) add(curve);
  return curves;
}

double part_averaged_away(const Curve& curve, double duration, double size) {
  constexpr double rounding = 1e-9;
  const double whole = mean_square(curve, duration),
               steps = std::max(1.0, std::ceil(duration / size * (1.0 - rounding)));
  if (!(whole > 0.0) || steps > most_steps) return 0.0;
  double kept = 0.0;
  for (double k = 0.0; k < steps; k += 1.0) {
    const double mean = mean_between(curve, k / steps * duration, (k + 1.0) / steps * duration, duration);
    kept += mean * mean / steps;
  }
  return std::clamp(1.0 - kept / whole, 0.0, 1.0);
}

double resolving_step(const Curve& curve, double duration) {
  constexpr double most_lost = 0.01, close = 1.02;
  const auto loses = [&](double steps) { return part_averaged_away(curve, duration, duration / steps) > most_lost; };
  double steps = 1.0;
  while (loses(steps)) steps *= 2.0;
  double few = 0.5 * steps;  // steps that are too few
  while (steps > close * few && steps - few > 1.0) {
    const double middle = std::round(0.5 * (few + steps));
    (loses(middle) ? few : steps) = middle;
  }
  return duration / steps;
}

}  // namespace scabo::model
