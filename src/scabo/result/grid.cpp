#include "scabo/result/grid.hpp"

#include "scabo/result/stress.hpp"

namespace scabo::result {

void Grid::add_point(const Vec2& x, std::int32_t body) {
  points.insert(points.end(), {x.x(), x.y(), 0.0});
  point_body.push_back(body);
}

Fields::Fields(std::size_t points)
    : displacement(3 * points),
      stress(6 * points),
      stress_xx(points),
      stress_yy(points),
      stress_xy(points),
      stress_zz(points),
      principal_1(points),
      principal_2(points),
      principal_3(points),
      principal_angle(points),
      von_mises(points) {}

void Fields::set_displacement(std::size_t point, const Vec2& u) {
  displacement[3 * point] = u.x();
  displacement[3 * point + 1] = u.y();
}

void Fields::set(std::size_t point, const Vec2& u, const element::Vec3& in_plane, double zz) {
  const auto single = [](double value) { return static_cast<float>(value); };
  const StressMeasures measures = stress_measures(in_plane, zz);
  set_displacement(point, u);
  stress_xx[point] = stress[6 * point] = single(in_plane[0]);
  stress_yy[point] = stress[6 * point + 1] = single(in_plane[1]);
  stress_zz[point] = stress[6 * point + 2] = single(zz);
  stress_xy[point] = stress[6 * point + 3] = single(in_plane[2]);
  principal_1[point] = single(measures.principal[0]);
  principal_2[point] = single(measures.principal[1]);
  principal_3[point] = single(measures.principal[2]);
  principal_angle[point] = single(measures.angle);
  von_mises[point] = single(measures.von_mises);
}

}  // namespace scabo::result
