#include "scabo/mesh/space/shaped_solid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "scabo/base/cell_topology.hpp"
#include "scabo/base/error.hpp"
#include "scabo/geometry/frame.hpp"

namespace scabo::mesh {

namespace {

using Eigen::Vector3d;
using Lines = std::vector<double>;  // values of a parameter, ascending

double wanted_size(double at, double size, const std::vector<SizeAt>& near) {
  for (const SizeAt& of : near) size = std::min(size, of.size + of.growth * std::abs(at - of.at));
  return size;
}

}  // namespace

/// As many sizes lie between any two neighbours.
Lines divided(double first, double last, double size, const std::vector<SizeAt>& near, int least) {
  // The number of sizes up to a place, by the trapezoidal rule on steps that resolve the smallest size.
  double smallest = std::min(size, last - first);
  for (const SizeAt& of : near) smallest = std::min(smallest, of.size);
  const auto steps = static_cast<std::size_t>(std::clamp(8.0 * (last - first) / smallest, 64.0, 1e6));
  std::vector<double> passed(steps + 1, 0.0);
  const auto place = [&](std::size_t i) {
    return first + (last - first) * static_cast<double>(i) / static_cast<double>(steps);
  };
  for (std::size_t i = 1; i <= steps; ++i)
    passed[i] =
        passed[i - 1] + 0.5 * (place(i) - place(i - 1)) *
                            (1.0 / wanted_size(place(i), size, near) + 1.0 / wanted_size(place(i - 1), size, near));
  constexpr double most = 1e6;  // more nodes than any model may have
  const double count = std::clamp(std::ceil(passed.back() * (1.0 - 1e-9)), static_cast<double>(least), most);
  Lines lines{first};
  std::size_t i = 1;
  for (double k = 1.0; k < count; k += 1.0) {
    const double wanted = passed.back() * k / count;
    while (passed[i] < wanted) ++i;
    lines.push_back(place(i - 1) + (place(i) - place(i - 1)) * (wanted - passed[i - 1]) / (passed[i] - passed[i - 1]));
  }
  lines.push_back(last);
  return lines;
}

namespace {

/// Both halves of a parameter, or one of them.
Lines divided_halves(double half, int kept, double size, const std::vector<SizeAt>& near) {
  Lines lines;
  if (kept <= 0) lines = divided(-half, 0.0, size, near, 1);
  if (kept >= 0) {
    if (!lines.empty()) lines.pop_back();
    const Lines above = divided(0.0, half, size, near, 1);
    lines.insert(lines.end(), above.begin(), above.end());
  }
  return lines;
}

/// The bricks of a shape and how they lie in space.
struct Bricks {
  std::array<Lines, 3> lines;
  bool closed = false;                              // the first parameter is an angle: its last line is its first
  std::array<std::array<std::string, 2>, 3> names;  // of the faces at the first and last line of each parameter
  std::function<Vector3d(const Vector3d&)> point;   // of three parameters
  // Without this, middle nodes are mapped as all others; with it, they lie between two nodes, and those of edges of the
  // curved face, at the ends of parameters, are moved onto it. Parameters that end there begin at 0 in the middle.
  std::function<Vector3d(const Vector3d&)> onto_face;
  std::array<std::array<bool, 2>, 3> curved{};
};

std::vector<SizeAt> along(const model::SolidSizes& sizes, const std::function<double(const Vector3d&)>& parameter) {
  std::vector<SizeAt> near;
  for (const model::SolidSizes::Near& of : sizes.near) near.push_back({parameter(of.point), of.size, of.growth});
  return near;
}

Bricks bricks_of(const model::SolidBox& box, const model::SolidSizes& sizes) {
  Bricks bricks;
  for (int k = 0; k < 3; ++k) {
    const auto parameter = [&](const Vector3d& x) { return x[k]; };
    bricks.lines[static_cast<std::size_t>(k)] =
        divided(box.corner[k], box.corner[k] + box.size[k], sizes.size, along(sizes, parameter), 1);
  }
  bricks.names = {{{"left", "right"}, {"front", "back"}, {"bottom", "top"}}};
  bricks.point = [](const Vector3d& s) { return s; };
  return bricks;
}

/// A square of half width r as a disc of radius r; its inverse along rays.
Vec2 disc_point(const Vec2& s, double r) {
  const Vec2 t = s / r;
  return {s.x() * std::sqrt(1.0 - 0.5 * t.y() * t.y()), s.y() * std::sqrt(1.0 - 0.5 * t.x() * t.x())};
}
template <class Point>
Point into_square(const Point& x) {
  const double largest = x.cwiseAbs().maxCoeff();
  return largest > 0.0 ? Point(x * (x.norm() / largest)) : x;
}

Bricks bricks_of(const model::SolidCylinder& cylinder, const model::SolidSizes& sizes) {
  const Eigen::Matrix3d frame = geometry::frame_along(cylinder.to - cylinder.from);
  const double r = cylinder.radius;
  const Vector3d from = cylinder.from;
  const auto local = [=](const Vector3d& x) { return Vector3d(frame.transpose() * (x - from)); };
  Bricks bricks;
  for (int k = 0; k < 2; ++k)
    bricks.lines[static_cast<std::size_t>(k)] = divided_halves(
        r, 0, sizes.size, along(sizes, [&](const Vector3d& x) { return into_square(Vec2(local(x).head<2>()))[k]; }));
  bricks.lines[2] = divided(0.0, (cylinder.to - from).norm(), sizes.size,
                            along(sizes, [&](const Vector3d& x) { return local(x).z(); }), 1);
  bricks.names = {{{"side", "side"}, {"side", "side"}, {"bottom", "top"}}};
  bricks.curved = {{{true, true}, {true, true}, {false, false}}};
  bricks.point = [=](const Vector3d& s) {
    const Vec2 x = disc_point(s.head<2>(), r);
    return Vector3d(from + frame * Vector3d(x.x(), x.y(), s.z()));
  };
  bricks.onto_face = [=](const Vector3d& x) {
    Vector3d at = local(x);
    at.head<2>() *= r / at.head<2>().norm();
    return Vector3d(from + frame * at);
  };
  return bricks;
}

Bricks bricks_of(const model::SolidTube& tube, const model::SolidSizes& sizes) {
  constexpr int least_around = 12;
  const Eigen::Matrix3d frame = geometry::frame_along(tube.to - tube.from);
  const Vector3d from = tube.from;
  const double outer = tube.outer;
  const auto local = [=](const Vector3d& x) { return Vector3d(frame.transpose() * (x - from)); };
  const auto radius = [&](const Vector3d& x) { return local(x).head<2>().norm(); };
  const auto around = [&](const Vector3d& x) {
    const double angle = std::atan2(local(x).y(), local(x).x());
    return outer * (angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle);
  };
  std::vector<SizeAt> near_around = along(sizes, around);
  const double whole = 2.0 * std::numbers::pi * outer;
  for (std::size_t i = 0, count = near_around.size(); i < count; ++i)  // also seen over the start of the angle
    for (const double turn : {-whole, whole})
      near_around.push_back({near_around[i].at + turn, near_around[i].size, near_around[i].growth});
  Bricks bricks;
  bricks.closed = true;
  bricks.lines = {divided(0.0, whole, sizes.size, near_around, least_around),
                  divided(tube.inner, outer, sizes.size, along(sizes, radius), 1),
                  divided(0.0, (tube.to - from).norm(), sizes.size,
                          along(sizes, [&](const Vector3d& x) { return local(x).z(); }), 1)};
  bricks.names = {{{"", ""}, {"inside", "outside"}, {"bottom", "top"}}};
  bricks.point = [=](const Vector3d& s) {
    const double angle = s.x() / outer;
    return Vector3d(from + frame * Vector3d(s.y() * std::cos(angle), s.y() * std::sin(angle), s.z()));
  };
  return bricks;
}

Bricks bricks_of(const model::SolidSphere& sphere, const model::SolidSizes& sizes) {
  const Vector3d centre = sphere.centre;
  const double r = sphere.radius;
  Bricks bricks;
  for (int k = 0; k < 3; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const int kept = sphere.kept[at];
    bricks.lines[at] = divided_halves(
        r, kept, sizes.size, along(sizes, [&](const Vector3d& x) { return into_square(Vector3d(x - centre))[k]; }));
    const std::string cut = std::string("cut_") + "xyz"[k];
    bricks.names[at] = {kept > 0 ? cut : "surface", kept < 0 ? cut : "surface"};
    bricks.curved[at] = {kept <= 0, kept >= 0};
  }
  bricks.point = [=](const Vector3d& s) {
    const Vector3d t = (s / r).cwiseAbs2();
    Vector3d x;
    for (int k = 0; k < 3; ++k) {
      const double a = t[(k + 1) % 3], b = t[(k + 2) % 3];
      x[k] = s[k] * std::sqrt(1.0 - 0.5 * a - 0.5 * b + a * b / 3.0);
    }
    return Vector3d(centre + x);
  };
  bricks.onto_face = [=](const Vector3d& x) { return Vector3d(centre + r * (x - centre).normalized()); };
  return bricks;
}

Bricks bricks_of(const model::SolidExtrusion&, const model::SolidSizes&) {
  throw BrokenInvariant("an extrusion is no map of bricks");
}

Bricks bricks_of(const model::SolidShape& shape, const model::SolidSizes& sizes) {
  return std::visit([&](const auto& of) { return bricks_of(of, sizes); }, shape);
}

using Triple = std::array<int, 3>;

/// Tetrahedra or hexahedra, and faces, of bricks. A node is a triple of twice the numbers of lines; odd ones lie in the
/// middle.
class BrickDivision {
 public:
  BrickDivision(Bricks bricks, bool hexahedra) : bricks_(std::move(bricks)), hexahedra_(hexahedra) {
    for (std::size_t k = 0; k < 3; ++k) last_[k] = 2 * (static_cast<int>(bricks_.lines[k].size()) - 1);
  }
  ShapedSolid made();

 private:
  void divide(const Triple& brick);
  void add_hexahedron(const Triple& brick);
  void add_cell(std::vector<Triple> corners);
  int node(const Triple& at);
  Vector3d parameters(const Triple& at) const;
  Vector3d position(const Triple& at) const;
  bool is_turned(std::size_t axis, int interval) const;
  const std::string* face_of(const std::vector<Triple>& corners) const;

  Bricks bricks_;
  bool hexahedra_;
  Triple last_{};
  std::map<Triple, int> numbers_;
  std::vector<Vector3d> positions_;
  ShapedSolid made_;
};

Vector3d BrickDivision::parameters(const Triple& at) const {
  Vector3d s;
  for (std::size_t k = 0; k < 3; ++k) {
    const Lines& lines = bricks_.lines[k];
    const auto below = static_cast<std::size_t>(at[k] / 2);
    s[static_cast<Eigen::Index>(k)] = at[k] % 2 == 0 ? lines[below] : 0.5 * (lines[below] + lines[below + 1]);
  }
  return s;
}

/// Of a corner, or of the middle of an edge: between the two corners, whose coordinates differ where `at` is odd.
Vector3d BrickDivision::position(const Triple& at) const {
  const bool is_corner = at[0] % 2 == 0 && at[1] % 2 == 0 && at[2] % 2 == 0;
  if (is_corner || !bricks_.onto_face) return bricks_.point(parameters(at));
  Triple from = at, to = at;
  bool on_curved = false;
  for (std::size_t k = 0; k < 3; ++k) {
    if (at[k] % 2 != 0) {
      const int step = is_turned(k, at[k] / 2) ? -1 : 1;
      from[k] -= step;
      to[k] += step;
    }
    on_curved = on_curved || (bricks_.curved[k][0] && at[k] == 0) || (bricks_.curved[k][1] && at[k] == last_[k]);
  }
  const Vector3d middle = 0.5 * (bricks_.point(parameters(from)) + bricks_.point(parameters(to)));
  return on_curved ? bricks_.onto_face(middle) : middle;
}

int BrickDivision::node(const Triple& at) {
  const auto [found, is_new] = numbers_.try_emplace(at, static_cast<int>(positions_.size()));
  if (is_new) positions_.push_back(position(at));
  return found->second;
}

const std::string* BrickDivision::face_of(const std::vector<Triple>& corners) const {
  for (std::size_t k = 0; k < 3; ++k)
    for (const std::size_t end : {0, 1}) {
      const int at = end == 0 ? 0 : last_[k];
      const std::string& name = bricks_.names[k][end];
      if (!name.empty() && std::all_of(corners.begin(), corners.end(), [&](const Triple& c) { return c[k] == at; }))
        return &name;
    }
  return nullptr;
}

/// Corners as in CellTopology, or turned over.
void BrickDivision::add_cell(std::vector<Triple> corners) {
  const bool is_brick = corners.size() == 8;
  const auto& topology = CellTopology::of(corners.size());
  const Vector3d x0 = bricks_.point(parameters(corners[0]));
  Eigen::Matrix3d sides;
  for (int k = 0; k < 3; ++k) {
    const std::size_t corner = k < 2 || !is_brick ? static_cast<std::size_t>(is_brick ? 2 * k + 1 : k + 1) : 4;
    sides.col(k) = bricks_.point(parameters(corners[corner])) - x0;
  }
  if (sides.determinant() < 0.0) {
    if (is_brick)
      std::swap_ranges(corners.begin(), corners.begin() + 4, corners.begin() + 4);
    else
      std::swap(corners[2], corners[3]);
  }
  const auto closed = [&](Triple at) {
    if (bricks_.closed && at[0] == last_[0]) at[0] = 0;
    return at;
  };
  std::vector<int> cell;
  for (const Triple& corner : corners) cell.push_back(node(closed(corner)));
  for (const auto& [a, b] : topology.edges) {
    const Triple &from = corners[a], &to = corners[b];
    cell.push_back(node(closed({(from[0] + to[0]) / 2, (from[1] + to[1]) / 2, (from[2] + to[2]) / 2})));
  }
  for (std::size_t side = 0; side < topology.sides.size(); ++side) {
    std::vector<Triple> of_side;
    for (const std::size_t corner : topology.sides[side]) of_side.push_back(corners[corner]);
    if (const std::string* name = face_of(of_side))
      made_.faces[*name].push_back(facet_of(cell, static_cast<int>(side)));
  }
  made_.mesh.cells.push_back(std::move(cell));
}

void BrickDivision::add_hexahedron(const Triple& brick) {
  const auto corner = [&](int i, int j, int k) {
    return Triple{2 * (brick[0] + i), 2 * (brick[1] + j), 2 * (brick[2] + k)};
  };
  add_cell({corner(0, 0, 0), corner(1, 0, 0), corner(1, 1, 0), corner(0, 1, 0), corner(0, 0, 1), corner(1, 0, 1),
            corner(1, 1, 1), corner(0, 1, 1)});
}

/// Whether the diagonals of bricks lead back along a parameter: away from the middle, where it has one.
bool BrickDivision::is_turned(std::size_t axis, int interval) const {
  const Lines& lines = bricks_.lines[axis];
  const auto at = static_cast<std::size_t>(interval);
  if (bricks_.closed && axis == 0) return at % 2 == 1;
  const bool ends_curved = bricks_.curved[axis][0] || bricks_.curved[axis][1];
  constexpr double rounding = 1e-9;  // the brick in the middle is not turned, in any unit
  return lines[at] + lines[at + 1] <
         (ends_curved ? 0.0 : lines.front() + lines.back()) - rounding * (lines.back() - lines.front());
}

void BrickDivision::divide(const Triple& brick) {
  if (hexahedra_) return add_hexahedron(brick);
  std::array<bool, 3> turned{};
  for (std::size_t k = 0; k < 3; ++k) turned[k] = is_turned(k, brick[k]);
  std::array<std::size_t, 3> order{0, 1, 2};
  do {
    Triple at{};
    for (std::size_t k = 0; k < 3; ++k) at[k] = 2 * (brick[k] + (turned[k] ? 1 : 0));
    std::vector<Triple> corners{at};
    for (const std::size_t axis : order) {
      at[axis] += turned[axis] ? -2 : 2;
      corners.push_back(at);
    }
    add_cell(std::move(corners));
  } while (std::next_permutation(order.begin(), order.end()));
}

ShapedSolid BrickDivision::made() {
  for (int k = 0; 2 * k < last_[2]; ++k)
    for (int j = 0; 2 * j < last_[1]; ++j)
      for (int i = 0; 2 * i < last_[0]; ++i) divide({i, j, k});
  made_.mesh.nodes.resize(3, static_cast<Eigen::Index>(positions_.size()));
  for (std::size_t i = 0; i < positions_.size(); ++i)
    made_.mesh.nodes.col(static_cast<Eigen::Index>(i)) = positions_[i];
  return std::move(made_);
}

}  // namespace

double count_nodes(const model::SolidShape& shape, const model::SolidSizes& sizes) {
  const Bricks bricks = bricks_of(shape, sizes);
  std::array<double, 3> cells{}, lines{};
  for (std::size_t k = 0; k < 3; ++k) {
    cells[k] = static_cast<double>(bricks.lines[k].size() - 1);
    lines[k] = cells[k] + (bricks.closed && k == 0 ? 0.0 : 1.0);
  }
  double count = 1.0;
  if (!sizes.hexahedra) {
    for (std::size_t k = 0; k < 3; ++k) count *= cells[k] + lines[k];
    return count;
  }
  count = lines[0] * lines[1] * lines[2];  // corners; then the middles of the edges along each axis
  for (std::size_t k = 0; k < 3; ++k) count += cells[k] * lines[(k + 1) % 3] * lines[(k + 2) % 3];
  return count;
}

ShapedSolid solid_of_shape(const model::SolidShape& shape, const model::SolidSizes& sizes) {
  return BrickDivision(bricks_of(shape, sizes), sizes.hexahedra).made();
}

}  // namespace scabo::mesh
