// Models of towers and walls of blocks that contact alone holds, on a rigid floor, pushed from the left.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace scabo::verification {

inline constexpr double weight_per_volume = 2000.0 * 9.81;

struct Blocks {
  int columns, courses;
  double friction;
  double unit = 1.0;      ///< length of a block in the model's unit of length; forces stay in N
  double angle = 0.0;     ///< degrees by which the whole model is turned, counter-clockwise
  bool mirrored = false;  ///< before that: the push comes from the right
  bool reversed = false;  ///< bodies and contacts stand in the opposite order, and contacts are between B and A
  double shake = 0.0;     ///< acceleration of every block along the wall, over gravity
  double mesh = 0.25;     ///< size of elements, m
  /// The law of joint number `joint` between these places, as keys of the model file; empty: the friction above.
  std::string (*law)(int joint, const std::string& a, const std::string& b) = nullptr;

  double height() const { return columns == 1 ? 1.0 : 0.5; }  // of a block
  double width() const { return columns; }
  double whole_height() const { return courses * height(); }
  double weight() const { return weight_per_volume * width() * whole_height(); }
  double collapse_push() const {
    return std::min(friction * weight_per_volume * width(), weight_per_volume * width() * width() / whole_height());
  }
};

inline std::vector<std::pair<double, double>> spans_of_course(const Blocks& blocks, int course) {
  std::vector<std::pair<double, double>> spans;
  const bool shifted = blocks.columns > 1 && course % 2 == 1;  // running bond: half blocks at the ends
  for (double left = 0.0; left < blocks.columns;) {
    const double size = shifted && (left == 0.0 || left == blocks.columns - 0.5) ? 0.5 : 1.0;
    spans.emplace_back(left, left + size);
    left += size;
  }
  return spans;
}

/// A vector of the wall that stands upright, as it is in the model.
inline std::string turned(const Blocks& blocks, double x, double y) {
  if (blocks.mirrored) x = -x;
  if (blocks.angle == 0.0) return fmt::format("[{}, {}]", x, y);
  const double angle = blocks.angle * std::acos(-1.0) / 180.0, c = std::cos(angle), s = std::sin(angle);
  return fmt::format("[{}, {}]", c * x - s * y, s * x + c * y);
}

/// The shape of a block, metres in the model's unit of length; what is turned or mirrored is a polygon.
inline std::string shape_of(const Blocks& blocks, double left, double bottom, double width, double height) {
  const double s = blocks.unit;
  if (blocks.angle == 0.0 && !blocks.mirrored)
    return fmt::format("{{rectangle: {{corner: [{}, {}], size: [{}, {}]}}}}", left * s, bottom * s, width * s,
                       height * s);
  const auto vertex = [&](double x, double y) { return turned(blocks, x * s, y * s); };
  if (blocks.mirrored)
    return fmt::format(
        "{{polygon: {{vertices: [{}, {}, {}, {}], names: {{bottom: edge_1, left: edge_2, top: edge_3, right: "
        "edge_4}}}}}}",
        vertex(left + width, bottom), vertex(left, bottom), vertex(left, bottom + height),
        vertex(left + width, bottom + height));
  return fmt::format(
      "{{polygon: {{vertices: [{}, {}, {}, {}], names: {{bottom: edge_1, right: edge_2, top: edge_3, left: "
      "edge_4}}}}}}",
      vertex(left, bottom), vertex(left + width, bottom), vertex(left + width, bottom + height),
      vertex(left, bottom + height));
}

/// In a model whose unit of length is `unit` times smaller than the metre.
inline std::string model_of(const Blocks& blocks, double push, int increments) {
  const double s = blocks.unit, area = s * s;
  const auto listed = [&](std::string& list, const std::string& line) {
    list = blocks.reversed ? line + list : list + line;
  };
  std::string bodies = fmt::format("  floor: {{rigid: true, shape: {}}}\n",
                                   shape_of(blocks, -1.0, -1.0, blocks.columns + 2, 1.0)),
              contacts, loads, factors;
  std::vector<std::pair<double, double>> below;
  int count = 0;
  const auto touch = [&](const std::string& a, const std::string& b) {
    std::string law = blocks.law ? blocks.law(++count, a, b) : (++count, "");
    if (law.empty()) law = fmt::format("friction: {}", blocks.friction);
    listed(contacts, fmt::format("  c{}: {{between: [{}, {}], {}}}\n", count, blocks.reversed ? b : a,
                                 blocks.reversed ? a : b, law));
  };
  for (int z = 0; z < blocks.courses; ++z) {
    const auto spans = spans_of_course(blocks, z);
    for (std::size_t k = 0; k < spans.size(); ++k) {
      const auto [left, right] = spans[k];
      listed(bodies,
             fmt::format("  b{}_{}: {{material: stone, shape: {}, mesh: {{size: {}, order: 1}}}}\n", z, k,
                         shape_of(blocks, left, z * blocks.height(), right - left, blocks.height()), blocks.mesh * s));
      if (k > 0) touch(fmt::format("b{}_{}.right", z, k - 1), fmt::format("b{}_{}.left", z, k));
      if (z == 0) touch("floor.top", fmt::format("b0_{}.bottom", k));
      for (std::size_t j = 0; j < below.size(); ++j)
        if (std::min(below[j].second, right) - std::max(below[j].first, left) > 0.1)
          touch(fmt::format("b{}_{}.top", z - 1, j), fmt::format("b{}_{}.bottom", z, k));
    }
    below = spans;
    loads += fmt::format("  push_{}: {{on: b{}_0.left, traction: {}}}\n", z, z, turned(blocks, push / area, 0.0));
    factors += fmt::format(", push_{}: 1", z);
  }
  const std::string steps = increments == 1
                                ? fmt::format("  - {{name: push, loads: {{weight: 1{}}}}}\n", factors)
                                : fmt::format(
                                      "  - {{name: weight, loads: {{weight: 1}}}}\n  - {{name: push, increments: {}, "
                                      "loads: {{weight: 1{}}}}}\n",
                                      increments, factors);
  return fmt::format(
      "scabo: 1\nanalysis: {{type: static, plane: stress, thickness: {}}}\n"
      "materials: {{stone: {{young: {}, poisson: 0.2, density: {}}}}}\nbodies:\n{}supports: [{{on: floor, fix: "
      "[x, y]}}]\nloads:\n  weight: {{gravity: {}}}\n{}contacts:\n{}steps:\n{}",
      s, 5e9 / area, 2000.0 / (area * s), bodies, turned(blocks, 9.81 * blocks.shake, -9.81), loads, contacts, steps);
}

}  // namespace scabo::verification
