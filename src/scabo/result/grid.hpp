// Points, cells and fields of an output file, in the arrays that are written to it.
#pragma once

#include <cstdint>
#include <vector>

#include "scabo/element/plane/elasticity.hpp"

namespace scabo::result {

/// Numbers of VTK cell types.
enum class CellType : std::uint8_t {
  triangle = 5,
  polygon = 7,
  quad = 9,
  quadratic_triangle = 22,
  quadratic_quad = 23
};

/// Points and cells at which fields are given, the same for every increment. The points of a body are consecutive, and
/// so are its cells; the first points of an elastic body are its nodes, in their order.
struct Grid {
  std::vector<double> points;              // 3 per point, z = 0
  std::vector<std::int32_t> connectivity;  // point numbers of all cells in sequence
  std::vector<std::int32_t> offsets;       // one per cell: end of its points in `connectivity`
  std::vector<std::uint8_t> types;         // one per cell: CellType
  std::vector<std::int32_t> point_body;    // number of the body from 1, in the order of the model
  std::vector<std::int32_t> cell_body;
  std::vector<std::size_t> first_point;  // per body, and the number of all points at the end

  std::size_t point_count() const { return point_body.size(); }
  std::size_t cell_count() const { return types.size(); }

  void add_point(const Vec2& x, std::int32_t body);
  template <typename Points>
  void add_cell(CellType type, const Points& points_of_cell, std::int32_t body) {
    for (const auto point : points_of_cell) connectivity.push_back(static_cast<std::int32_t>(point));
    offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
    types.push_back(static_cast<std::uint8_t>(type));
    cell_body.push_back(body);
  }
};

/// Values at the points of a Grid after one increment. Displacements are in double precision because they are small
/// compared with coordinates; for the other fields seven digits are sufficient.
struct Fields {
  std::vector<double> displacement;  // 3 per point, z = 0
  std::vector<double> velocity;      // likewise; empty: the model has no steps in time
  std::vector<float> stress;         // 6 per point: xx, yy, zz, xy, yz, xz (ParaView's order)
  std::vector<float> stress_xx, stress_yy, stress_xy, stress_zz;
  std::vector<float> principal_1, principal_2, principal_3;
  std::vector<float> principal_angle;  // radians
  std::vector<float> von_mises;

  explicit Fields(std::size_t points = 0);
  void set_displacement(std::size_t point, const Vec2& u);
  void set(std::size_t point, const Vec2& u, const element::Vec3& in_plane, double zz);
};

/// A grid and its fields without the bodies that are absent, by their index in the model, ascending.
struct GridFields {
  Grid grid;
  Fields fields;
};
GridFields without_bodies(const Grid& grid, const Fields& fields, const std::vector<int>& absent);

}  // namespace scabo::result
