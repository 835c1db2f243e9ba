// Models that several tests use, as text for `run`; a mesh is what stands in the braces of `mesh:`.
#pragma once

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "scabo/analysis/static_analysis.hpp"

namespace scabo::verification {

// ---- double cantilever beam ----------------------------------------------------------------------------

/// The beams of example 01, one on the other, built in at the left, with a force of 100 kN at the tip of the upper
/// one.
inline std::string double_cantilever(const std::string& lower, const std::string& upper, double friction = 0.2) {
  return fmt::format(R"(scabo: 1
materials: {{concrete: {{young: 10e9, poisson: 0.3}}}}
bodies:
  lower: {{material: concrete, shape: {{rectangle: {{corner: [0, 0], size: [6.0, 1.5]}}}}, mesh: {{{}}}}}
  upper: {{material: concrete, shape: {{rectangle: {{corner: [0, 1.5], size: [6.0, 1.5]}}}}, mesh: {{{}}}}}
supports: [{{on: lower.left, fix: [x, y]}}, {{on: upper.left, fix: [x, y]}}]
loads: {{tip: {{on: upper.top_right, force: [0, -100e3]}}}}
contacts: {{joint: {{between: [lower.top, upper.bottom], friction: {}}}}}
)",
                     lower, upper, friction);
}

/// Its normal force, N, for every coefficient of friction (docs/verification.md).
inline constexpr double double_cantilever_force = 53669.36;

// ---- Raous, Chabrand, Lebon (1988), code_aster SSNV128 ---------------------------------------------------

/// Half a block, pressed down and aside on a rigid floor. `body`: of the block besides its material; `sides`: the names
/// of its sides, from the bottom counter-clockwise.
inline std::string block_of_raous(const std::string& body, const std::array<const char*, 4>& sides, double friction) {
  return fmt::format(R"(scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: 130e9, poisson: 0.2}}}}
bodies:
  block: {{material: steel, {}}}
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-0.02, -0.02], size: [0.08, 0.02]}}}}}}
supports: [{{on: floor, fix: [x, y]}}, {{on: block.{}, fix: [x]}}]
loads: {{down: {{on: block.{}, pressure: 50e6}}, aside: {{on: block.{}, pressure: 150e6}}}}
contacts: {{joint: {{between: [floor.top, block.{}], friction: {}}}}}
)",
                     body, sides[1], sides[2], sides[3], sides[0], friction);
}
inline std::string block_of_raous(const std::string& mesh, double friction = 1.0) {
  return block_of_raous("shape: {rectangle: {corner: [0, 0], size: [0.04, 0.04]}}, mesh: {" + mesh + "}",
                        {"bottom", "right", "top", "left"}, friction);
}
/// From a mesh file.
inline std::string block_of_raous_from_file(const std::string& mesh) {
  return block_of_raous("mesh: {" + mesh + "}", {"edge_1", "edge_2", "edge_3", "edge_4"}, 1.0);
}

/// x and the displacement along x there with friction 1, m: the slip of the block, since the floor stands still.
inline constexpr std::array<std::array<double, 2>, 5> displacements_of_raous{
    {{0.0, 28.60e-6}, {1.25e-3, 27.23e-6}, {5e-3, 22.87e-6}, {7.5e-3, 19.81e-6}, {11.25e-3, 15.41e-6}}};

// ---- plates with cracks --------------------------------------------------------------------------------

/// `[[x, y], ...]`, all digits.
inline std::string text_of(const std::vector<Vec2>& points) {
  std::string text;
  for (const Vec2& x : points) text += fmt::format("{}[{:.17g}, {:.17g}]", text.empty() ? "" : ", ", x.x(), x.y());
  return "[" + text + "]";
}

/// A square plate about the origin under uniform stress, held without force. Plane stress, E = 200, nu = 0.3.
struct CrackedPlate {
  std::string kind = "polygons";
  double half_width = 100, size = 20;  // of the plate, of its cells far from the cracks
  int order = 4;
  double xx = 0, yy = 1, xy = 0;                     // stress
  std::string cracks = {}, refine = {};              // items of the lists
  std::string body = {}, loads = {}, contacts = {};  // more items of the body (one line), of the loads; contacts

  CrackedPlate& crack(const std::string& name, const std::vector<Vec2>& path) {
    cracks += fmt::format("{}{{name: {}, path: {}}}", cracks.empty() ? "" : ", ", name, text_of(path));
    return *this;
  }
  /// Cells of this size at points.
  CrackedPlate& refine_at(const std::vector<Vec2>& points, double to) {
    for (const Vec2& x : points)
      refine += fmt::format("{}{{near: [{:.17g}, {:.17g}], size: {}}}", refine.empty() ? "" : ", ", x.x(), x.y(), to);
    return *this;
  }

  std::string text() const {
    return fmt::format(R"(scabo: 1
materials: {{steel: {{young: 200, poisson: 0.3}}}}
bodies:
  plate:
    material: steel
    shape: {{rectangle: {{corner: [-{0}, -{0}], size: [{1}, {1}]}}}}
    {2}
    cracks: [{3}]
    mesh: {{kind: {4}, size: {5}, order: {6}, refine: [{7}]}}
supports: [{{on: plate.bottom_left, fix: [x, y]}}, {{on: plate.bottom_right, fix: [y]}}]
loads:
  up: {{on: plate.top, traction: [{8}, {9}]}}
  down: {{on: plate.bottom, traction: [{10}, {11}]}}
  right: {{on: plate.right, traction: [{12}, {8}]}}
  left: {{on: plate.left, traction: [{13}, {10}]}}
  {14}
contacts: {{{15}}}
)",
                       half_width, 2.0 * half_width, body, cracks, kind, size, order, refine, xy, yy, -xy, -yy, xx, -xx,
                       loads, contacts);
  }
};

/// Stress intensity factors at a tip, `plate.flaw.end`.
inline const element::StressIntensity& factors_at(const analysis::IncrementResult& increment, const std::string& name) {
  for (const analysis::CrackResult& crack : increment.cracks)
    if (crack.name == name) return crack.factors;
  throw std::runtime_error("there is no crack tip " + name);
}

}  // namespace scabo::verification
