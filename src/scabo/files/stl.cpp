#include "scabo/files/stl.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>
#include <vector>

#include "scabo/base/error.hpp"
#include "scabo/base/types.hpp"
#include "scabo/files/bytes_of_file.hpp"
#include "scabo/files/text_cursor.hpp"

namespace scabo::files {

namespace {

using Point = std::array<float, 3>;  // STL files have single precision
using Triangle = std::array<Point, 3>;

Eigen::Vector3d vector_of(const Point& p) { return Eigen::Vector3f(p[0], p[1], p[2]).cast<double>(); }

/// 80 bytes, a count, and 50 bytes for each triangle; empty if the file has another length.
std::vector<Triangle> binary_triangles(const std::string& bytes) {
  constexpr std::size_t head = 84, each = 50;
  if (bytes.size() < head) return {};
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, 4);
  if (bytes.size() != head + each * count) return {};
  std::vector<Triangle> triangles(count);
  for (std::size_t i = 0; i < count; ++i)
    std::memcpy(triangles[i].data(), bytes.data() + head + each * i + 12, sizeof(Triangle));
  return triangles;
}

std::vector<Triangle> text_triangles(const std::string& bytes, const std::string& path) {
  std::istringstream text(bytes);
  std::vector<Triangle> triangles;
  std::string word;
  std::size_t corners = 0;
  while (text >> word) {
    if (word == "loop") corners = 0;
    if (word != "vertex") continue;
    Point point{};
    if (!(text >> point[0] >> point[1] >> point[2]) || corners >= 3)
      fail_in_file(path, 0, 0,
                   fmt::format("triangle {} has not three corners of three numbers; write the file again",
                               triangles.size() + (corners == 0 ? 1 : 0)));
    if (corners == 0) triangles.emplace_back();
    triangles.back()[corners++] = point;
  }
  return triangles;
}

}  // namespace

double volume_of_stl(const std::string& path) {
  const auto bytes = bytes_of_file(path);
  if (!bytes) fail_in_file(path, 0, 0, why_unreadable(path));
  return volume_of_stl(*bytes, path);
}

double volume_of_stl(const std::string& bytes, const std::string& path) {
  std::vector<Triangle> triangles = binary_triangles(bytes);
  if (triangles.empty() && bytes.rfind("solid", 0) == 0) triangles = text_triangles(bytes, path);
  if (triangles.empty())
    fail_in_file(path, 0, 0, "the file has no triangles of an STL file, or is cut off; write it again");
  std::map<std::pair<Point, Point>, int> sides;  // in the direction of their triangle
  double volume = 0.0;
  for (const Triangle& t : triangles) {
    for (const Point& corner : t)
      for (const float x : corner)
        if (!std::isfinite(x)) fail_in_file(path, 0, 0, "a corner has a coordinate that is not finite");
    const Eigen::Vector3d a = vector_of(t[0]), b = vector_of(t[1]), c = vector_of(t[2]);
    volume += a.dot(b.cross(c)) / 6.0;
    for (std::size_t k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
  }
  for (const auto& [side, count] : sides) {
    const auto back = sides.find({side.second, side.first});
    if (count == 1 && back != sides.end() && back->second == 1) continue;
    fail_in_file(path, 0, 0,
                 fmt::format("its triangles do not close a solid: at ({:g}, {:g}, {:g}) there is a hole, an overlap or "
                             "a triangle that is turned over; repair it in the program that wrote it",
                             side.first[0], side.first[1], side.first[2]));
  }
  if (!(volume > 0.0))
    fail_in_file(path, 0, 0, "its triangles are turned inwards: turn them over in the program that wrote it");
  return volume;
}

}  // namespace scabo::files
