#include "scabo/result/grid.hpp"

#include <algorithm>

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

namespace {

/// Values of the points that are kept, `components` each.
template <typename Value>
std::vector<Value> kept(const std::vector<Value>& values, std::size_t components,
                        const std::vector<std::size_t>& points) {
  std::vector<Value> rest;
  rest.reserve(components * points.size());
  for (const std::size_t point : points)
    rest.insert(rest.end(), values.begin() + static_cast<std::ptrdiff_t>(components * point),
                values.begin() + static_cast<std::ptrdiff_t>(components * (point + 1)));
  return rest;
}

}  // namespace

GridFields without_bodies(const Grid& grid, const Fields& fields, const std::vector<int>& absent) {
  const auto is_there = [&](std::int32_t body) { return !std::binary_search(absent.begin(), absent.end(), body - 1); };
  std::vector<std::size_t> points;
  std::vector<std::int32_t> place(grid.point_count(), -1);
  for (std::size_t i = 0; i < grid.point_count(); ++i) {
    if (!is_there(grid.point_body[i])) continue;
    place[i] = static_cast<std::int32_t>(points.size());
    points.push_back(i);
  }
  GridFields rest;
  rest.grid.points = kept(grid.points, 3, points);
  rest.grid.point_body = kept(grid.point_body, 1, points);
  std::vector<std::int32_t> of_cell;
  for (std::size_t c = 0; c < grid.cell_count(); ++c) {
    if (!is_there(grid.cell_body[c])) continue;
    of_cell.clear();
    for (std::int32_t k = c == 0 ? 0 : grid.offsets[c - 1]; k < grid.offsets[c]; ++k)
      of_cell.push_back(place[static_cast<std::size_t>(grid.connectivity[static_cast<std::size_t>(k)])]);
    rest.grid.add_cell(static_cast<CellType>(grid.types[c]), of_cell, grid.cell_body[c]);
  }
  rest.fields.displacement = kept(fields.displacement, 3, points);
  if (!fields.velocity.empty()) rest.fields.velocity = kept(fields.velocity, 3, points);
  rest.fields.stress = kept(fields.stress, 6, points);
  for (const auto member :
       {&Fields::stress_xx, &Fields::stress_yy, &Fields::stress_xy, &Fields::stress_zz, &Fields::principal_1,
        &Fields::principal_2, &Fields::principal_3, &Fields::principal_angle, &Fields::von_mises})
    rest.fields.*member = kept(fields.*member, 1, points);
  return rest;
}

}  // namespace scabo::result
