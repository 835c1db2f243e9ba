// Values of tables of temperature.
#include <algorithm>
#include <cmath>

#include "scabo/model/model.hpp"

namespace scabo::model {

double TemperatureTable::at(double place) const {
  const auto after = std::upper_bound(points.begin(), points.end(), place,
                                      [](double value, const Point& point) { return value < point.at; });
  if (after == points.begin()) return points.front().change;
  const Point& before = *(after - 1);
  if (after == points.end()) return before.change;
  return before.change + (place - before.at) / (after->at - before.at) * (after->change - before.change);
}

bool TemperatureTable::is_constant() const {
  return std::all_of(points.begin(), points.end(),
                     [&](const Point& point) { return point.change == points.front().change; });
}

bool is_linear_over(const TemperatureTable& table, const Outline& outline) {
  if (table.centre) return table.is_constant();
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const Edge& edge : outline.edges) {
    constexpr int parts = 16;  // of arcs and chains
    for (int i = 0; i < parts; ++i) {
      const double place = table.along.dot(edge.at(static_cast<double>(i) / parts));
      low = std::min(low, place);
      high = std::max(high, place);
    }
  }
  const double width = high - low, margin = 1e-9 * width;
  double largest = 0.0;
  for (const TemperatureTable::Point& point : table.points) largest = std::max(largest, std::abs(point.change));
  const auto slope = [&](std::size_t after) {  // before the point of this number, or beyond the last one
    if (after == 0 || after == table.points.size()) return 0.0;
    const TemperatureTable::Point &a = table.points[after - 1], &b = table.points[after];
    return (b.change - a.change) / (b.at - a.at);
  };
  for (std::size_t i = 0; i < table.points.size(); ++i)
    if (table.points[i].at > low + margin && table.points[i].at < high - margin &&
        std::abs(slope(i + 1) - slope(i)) * width > 1e-9 * largest)
      return false;
  return true;
}

}  // namespace scabo::model
