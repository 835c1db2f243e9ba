// A change of temperature T(s) that a table gives along one direction d, s = d . x: what it is in a cell.
//
// In a cell, T is the linear field that comes nearest to it in the mean over the area, and a remainder r(s). The linear
// field acts as powers of xi (radial_load.hpp). For the remainder, a body of one material has a particular solution in
// closed form,
//
//     u_p = v int r ds,   strain_p = L v r,   L = [[d_x, 0], [0, d_y], [d_y, d_x]]                               (1)
//     v = (L'D L)^-1 L'D a                                                                                       (2)
//
// with the free strain a per unit of temperature. Its stress sigma_p = D (L v - a) r has no traction on the lines
// s = const and does not change along them: it is in equilibrium. The rest of the displacement, u - u_p, is that of a
// super-element without loads inside,
//
//     q = K (u - u_p) + q_p,   q_p = t int N' sigma_p n ds,   f = K u_p - q_p                                    (3)
//
// with the equivalent nodal forces f. There is no remainder where T is linear over the cell.
#pragma once

#include <cstddef>
#include <vector>

#include "scabo/element/facet/strain_vectors.hpp"
#include "scabo/model/model.hpp"

namespace scabo::element {

/// A quantity that is linear in x and y.
struct LinearField {
  double constant = 0.0, per_x = 0.0, per_y = 0.0;
  double at(const Vec2& x) const { return constant + per_x * x.x() + per_y * x.y(); }
  bool is_zero() const { return constant == 0.0 && per_x == 0.0 && per_y == 0.0; }
};

/// The remainder in a super-element of one material, with its particular solution.
class TemperatureRemainder {
 public:
  /// `s`: places along `direction`, ascending, two or more; linear between them. `motion`: v of eq. (2).
  TemperatureRemainder(const Vec2& direction, const Vec2& motion, std::vector<double> s, std::vector<double> r);

  double at(const Vec2& x) const;          ///< r, absolute (x, y)
  Vec3 strain(const Vec2& x) const;        ///< of eq. (1): [xx, yy, gamma_xy]
  Vec2 displacement(const Vec2& x) const;  ///< of eq. (1), zero where the cell begins along the direction
  TemperatureRemainder times(double factor) const;

  const Vec2& direction() const { return direction_; }
  const Vec2& motion() const { return motion_; }
  const std::vector<double>& places() const { return s_; }
  const std::vector<double>& values() const { return r_; }

 private:
  std::size_t piece_of(double s) const;

  Vec2 direction_, motion_;
  std::vector<double> s_, r_, sum_;  // sum_: integral of r from s_.front()
};

/// A table in a cell: T = linear + remainder. Of one about a centre the remainder, which has no such solution, is left
/// out: an error of second order in the size of the cells.
struct TableInCell {
  LinearField linear;        ///< of absolute (x, y)
  std::vector<double> s, r;  ///< remainder, linear between the places; empty where there is none
};
/// `boundary`: the cell as a polygon, counter-clockwise, absolute. Of a curved side its nodes: the linear field is then
/// nearest over the polygon, and the remainder makes up for what is left everywhere.
TableInCell in_cell(const model::TemperatureTable& table, const std::vector<Vec2>& boundary);

/// v of eq. (2).
Vec2 particular_motion(const Mat3& D, const Vec3& unit_strain, const Vec2& direction);
/// D (L v - a): sigma_p per unit of temperature.
Vec3 particular_stress(const Mat3& D, const Vec3& unit_strain, const Vec2& direction, const Vec2& motion);

}  // namespace scabo::element
