#include "scabo/element/facet/temperature_table.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "scabo/base/error.hpp"
#include "scabo/geometry/simplex_basis.hpp"

namespace scabo::element {

namespace {

using LineStrain = Eigen::Matrix<double, 3, 2>;

/// L of eq. (1).
LineStrain line_strain(const Vec2& d) {
  LineStrain L;
  L << d.x(), 0.0, 0.0, d.y(), d.y(), d.x();
  return L;
}

/// Places of one cell, relative to `origin`, and the temperatures there; linear between them.
struct Pieces {
  std::vector<double> s, T;

  double at(std::size_t piece, double position) const {
    const double part = (position - s[piece]) / (s[piece + 1] - s[piece]);
    return (1.0 - part) * T[piece] + part * T[piece + 1];
  }
};

/// Integrals of T and T s from the first place: G0' = T, G1' = T s.
class Integrals {
 public:
  explicit Integrals(const Pieces& pieces) : pieces_(pieces) {
    sums_.push_back({0.0, 0.0});
    for (std::size_t i = 0; i + 1 < pieces.s.size(); ++i) sums_.push_back(to(i, pieces.s[i + 1]));
  }

  /// At a position within a piece.
  std::array<double, 2> to(std::size_t piece, double position) const {
    const double from = pieces_.s[piece], width = position - from, middle = 0.5 * (from + position);
    const double first = pieces_.T[piece], last = pieces_.at(piece, position), mean = 0.5 * (first + last);
    return {sums_[piece][0] + width * mean,
            sums_[piece][1] + width / 6.0 * (first * from + 4.0 * mean * middle + last * position)};  // Simpson's rule
  }

 private:
  const Pieces& pieces_;
  std::vector<std::array<double, 2>> sums_;
};

/// Integrals over a polygon, in the coordinate s of `pieces`.
struct Moments {
  double area = 0.0, s = 0.0, ss = 0.0;  // of 1, s and s^2
  double T = 0.0, Ts = 0.0;
};

/// By the theorem of Gauss, int g(s) dA = boundary integral of G(s) d.n, with G' = g.
Moments moments_over(const std::vector<Vec2>& polygon, const Vec2& d, double origin, const Pieces& pieces) {
  static constexpr std::array<double, 2> gauss{-0.57735026918962576, 0.57735026918962576};  // cubic polynomials
  const Integrals integrals(pieces);
  Moments sum;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double flux = cross(d, Vec2(b - a));  // of d through the side
    if (flux == 0.0) continue;
    const double from = d.dot(a) - origin, to = d.dot(b) - origin, low = std::min(from, to), high = std::max(from, to);
    const auto add = [&](std::size_t piece, double begin, double end, double share) {
      for (const double point : gauss) {
        const double s =
            std::clamp(0.5 * (begin + end) + 0.5 * (end - begin) * point, pieces.s[piece], pieces.s[piece + 1]);
        const double weight = 0.5 * share * flux;
        const auto [G0, G1] = integrals.to(piece, s);
        sum.area += weight * s;
        sum.s += weight * s * s / 2.0;
        sum.ss += weight * s * s * s / 3.0;
        sum.T += weight * G0;
        sum.Ts += weight * G1;
      }
    };
    const auto after = std::upper_bound(pieces.s.begin() + 1, pieces.s.end() - 1, low);
    auto piece = static_cast<std::size_t>(after - pieces.s.begin()) - 1;
    if (!(high > low)) {
      add(piece, low, low, 1.0);
      continue;
    }
    for (double begin = low; begin < high; ++piece) {
      const bool is_last = piece + 2 >= pieces.s.size();
      const double end = is_last ? high : std::min(high, pieces.s[piece + 1]);
      add(piece, begin, end, (end - begin) / (high - low));
      begin = end;
    }
  }
  return sum;
}

/// Calls add(x, weight) at the points of a rule over the triangle, in parts half as long.
template <typename Add>
void over_triangle(const std::array<Vec2, 3>& corner, const Add& add) {
  const geometry::SimplexRule& rule = geometry::SimplexBasis::of(2, 3).rule();
  std::array<Vec2, 3> middle;
  for (std::size_t i = 0; i < 3; ++i) middle[i] = 0.5 * (corner[i] + corner[(i + 1) % 3]);
  const std::array<std::array<Vec2, 3>, 4> parts = {{{corner[0], middle[0], middle[2]},
                                                     {corner[1], middle[1], middle[0]},
                                                     {corner[2], middle[2], middle[1]},
                                                     {middle[0], middle[1], middle[2]}}};
  for (const auto& part : parts) {
    const double area = 0.5 * cross(part[1] - part[0], part[2] - part[0]);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
      add(Vec2(rule.points(0, q) * part[0] + rule.points(1, q) * part[1] + rule.points(2, q) * part[2]),
          rule.weights[q] * area);
  }
}

/// The linear field that comes nearest, in the mean over a polygon, to a table about a centre.
LinearField nearest_linear(const model::TemperatureTable& table, const std::vector<Vec2>& polygon) {
  Vec2 origin = Vec2::Zero();
  for (const Vec2& x : polygon) origin += x / static_cast<double>(polygon.size());
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < polygon.size(); ++i)
    over_triangle({origin, polygon[i], polygon[(i + 1) % polygon.size()]}, [&](const Vec2& x, double weight) {
      const Eigen::Vector3d basis(1.0, x.x() - origin.x(), x.y() - origin.y());
      A += weight * basis * basis.transpose();
      b += weight * table.at((x - *table.centre).norm()) * basis;
    });
  // Coordinates of the size of the cell: the rows become comparable.
  const double size = std::sqrt(A(0, 0));
  const Eigen::Vector3d scale(1.0, 1.0 / size, 1.0 / size);
  const Eigen::Vector3d field =
      scale.asDiagonal() *
      Eigen::Vector3d((scale.asDiagonal() * A * scale.asDiagonal()).eval().inverse() * (scale.asDiagonal() * b));
  return {field[0] - field[1] * origin.x() - field[2] * origin.y(), field[1], field[2]};
}

}  // namespace

TemperatureRemainder::TemperatureRemainder(const Vec2& direction, const Vec2& motion, std::vector<double> s,
                                           std::vector<double> r)
    : direction_(direction), motion_(motion), s_(std::move(s)), r_(std::move(r)) {
  ensure(s_.size() >= 2 && s_.size() == r_.size(), "a remainder has a value at every place, and two or more places");
  sum_.push_back(0.0);
  for (std::size_t i = 0; i + 1 < s_.size(); ++i)
    sum_.push_back(sum_.back() + 0.5 * (s_[i + 1] - s_[i]) * (r_[i] + r_[i + 1]));
}

std::size_t TemperatureRemainder::piece_of(double s) const {
  return static_cast<std::size_t>(std::upper_bound(s_.begin() + 1, s_.end() - 1, s) - s_.begin()) - 1;
}

double TemperatureRemainder::at(const Vec2& x) const {
  const double s = direction_.dot(x);
  const std::size_t i = piece_of(s);
  return r_[i] + (s - s_[i]) / (s_[i + 1] - s_[i]) * (r_[i + 1] - r_[i]);
}

Vec3 TemperatureRemainder::strain(const Vec2& x) const { return line_strain(direction_) * motion_ * at(x); }

Vec2 TemperatureRemainder::displacement(const Vec2& x) const {
  const double s = direction_.dot(x);
  const std::size_t i = piece_of(s);
  return motion_ * (sum_[i] + 0.5 * (s - s_[i]) * (r_[i] + at(x)));
}

TemperatureRemainder TemperatureRemainder::times(double factor) const {
  std::vector<double> r = r_;
  for (double& value : r) value *= factor;
  return {direction_, motion_, s_, std::move(r)};
}

TableInCell in_cell(const model::TemperatureTable& table, const std::vector<Vec2>& boundary) {
  if (table.centre) return {nearest_linear(table, boundary), {}, {}};
  const Vec2& d = table.along;
  double low = d.dot(boundary.front()), high = low;
  for (const Vec2& x : boundary) {
    low = std::min(low, d.dot(x));
    high = std::max(high, d.dot(x));
  }
  const double origin = 0.5 * (low + high), half = 0.5 * (high - low);
  constexpr double rounding = 1e-9;  // of the width of a cell: a place so near to its end does not divide it
  Pieces pieces;
  pieces.s.push_back(-half);
  const double margin = rounding * half;
  for (auto point = std::upper_bound(table.points.begin(), table.points.end(), low + margin,
                                     [](double s, const auto&of) { return s < of.at; });
       point != table.points.end() && point->at < high - margin; ++point)
    pieces.s.push_back(point->at - origin);
  pieces.s.push_back(half);
  for (const double s : pieces.s) pieces.T.push_back(table.at(origin + s));
  TableInCell made;
  const auto linear = [&](double middle, double slope) {
    made.linear = {middle - slope * origin, slope * d.x(), slope * d.y()};
  };
  const double slope = (pieces.T.back() - pieces.T.front()) / (2.0 * half);
  if (pieces.s.size() == 2) {
    linear(0.5 * (pieces.T.front() + pieces.T.back()), slope);
    return made;
  }
  const Moments of = moments_over(boundary, d, origin, pieces);
  const double determinant = of.area * of.ss - of.s * of.s;
  const double nearest = (of.area * of.Ts - of.s * of.T) / determinant,
               middle = (of.ss * of.T - of.s * of.Ts) / determinant;
  linear(middle, nearest);
  for (std::size_t i = 0; i < pieces.s.size(); ++i) {
    made.s.push_back(origin + pieces.s[i]);
    made.r.push_back(pieces.T[i] - middle - nearest * pieces.s[i]);
  }
  return made;
}

Vec2 particular_motion(const Mat3& D, const Vec3& unit_strain, const Vec2& direction) {
  const LineStrain L = line_strain(direction);
  const Eigen::Matrix2d of_line = L.transpose() * D * L;
  return of_line.inverse() * (L.transpose() * D * unit_strain);  // eq. (2)
}

Vec3 particular_stress(const Mat3& D, const Vec3& unit_strain, const Vec2& direction, const Vec2& motion) {
  return D * (line_strain(direction) * motion - unit_strain);
}

}  // namespace scabo::element
