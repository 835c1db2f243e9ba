#include "scabo/element/sbfem/radial_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace scabo::element {

namespace {

constexpr int points_of_interval = 28;
/// Below this xi there are few grid points, which are evaluated directly.
constexpr double smallest_xi = 1e-3;

struct Chebyshev {
  std::array<double, points_of_interval> points, weights;  // of the second kind on [-1, 1], barycentric
  Chebyshev() {
    for (int i = 0; i < points_of_interval; ++i) {
      const auto k = static_cast<std::size_t>(i);
      points[k] = std::cos(std::numbers::pi * i / (points_of_interval - 1));
      weights[k] = (i % 2 == 0 ? 1.0 : -1.0) * (i == 0 || i + 1 == points_of_interval ? 0.5 : 1.0);
    }
  }
};
const Chebyshev& chebyshev() {
  static const Chebyshev rule;
  return rule;
}

}  // namespace

double fastest_of(const ModalSolution& modal) {
  double fastest = 1.0;
  for (const std::complex<double>& exponent : modal.exponents) fastest = std::max(fastest, std::abs(exponent));
  return fastest;
}

RadialTable::RadialTable(const RadialField& field, double fastest) : field_(field) {
  for (double s = 0.0; s > std::log(smallest_xi);) {
    const double width = std::max(8.0 / fastest, -s / 5.0);
    intervals_.push_back({s - width, s, {}});
    s -= width;
  }
}

RadialField::Values RadialTable::at(double xi) const {
  if (xi >= 1.0 || xi <= smallest_xi) return field_.at(xi);
  const double s = std::log(xi);
  const auto found = std::find_if(intervals_.begin(), intervals_.end(), [&](const Interval& i) { return s >= i.from; });
  const Interval& interval = *found;
  const Chebyshev& rule = chebyshev();
  const double middle = 0.5 * (interval.from + interval.to), half = 0.5 * (interval.to - interval.from);
  if (interval.values.empty()) {
    std::vector<double> xis;
    for (const double point : rule.points) xis.push_back(std::exp(middle + half * point));
    interval.values = field_.at(xis);
  }
  const double t = (s - middle) / half;
  std::array<double, points_of_interval> weights;
  double sum = 0.0;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    if (t == rule.points[k]) return interval.values[k];
    sum += weights[k] = rule.weights[k] / (t - rule.points[k]);
  }
  RadialField::Values values = interval.values.front();
  const auto combine = [&](Vector RadialField::Values::*part) {
    Vector& to = values.*part;
    to *= weights[0] / sum;
    for (std::size_t k = 1; k < weights.size(); ++k) to += weights[k] / sum * (interval.values[k].*part);
  };
  combine(&RadialField::Values::u);
  combine(&RadialField::Values::u_xi);
  combine(&RadialField::Values::u_part);
  return values;
}

}  // namespace scabo::element
