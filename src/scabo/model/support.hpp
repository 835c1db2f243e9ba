// What holds bodies: supports and springs.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scabo/model/place.hpp"

namespace scabo::model {

/// Axes of the displacement that a support prescribes: x and y; the outward normal of its edge and the tangent a
/// quarter turn counter-clockwise from it, at every point; or a direction and the one a quarter turn from it.
enum class SupportAxes { xy, edge, direction };

/// A number at a point, or the reason why it has none, as a sentence without a subject.
using PointFormula = std::function<std::variant<double, std::string>(const Vec2&)>;

/// Prescribed displacement of a place; a component without a value is free.
struct Support {
  std::string name;  ///< given by the user, or the text of the place, made unique
  Place on;
  std::array<std::optional<double>, 2> displacement;  ///< length, at factor 1, along its axes; `fix` gives 0
  Source source;
  SupportAxes axes = SupportAxes::xy;
  Vec2 along = Vec2(1.0, 0.0);  ///< unit vector, of SupportAxes::direction
  /// Rigid body as a whole: its rotation, counter-clockwise at factor 1, radians. The displacement is then that of the
  /// point `at`, or of its centroid, and the moment of the support about this point is among the results.
  std::optional<double> rotation = {};
  std::optional<Vec2> at = {};
  /// Of an edge, along x and y: the displacement at a point is that above times this.
  std::array<PointFormula, 2> shape = {};
  /// Index into Model::steps of the step in which it begins (0: it is there from the start), and of the step in which
  /// it ends (-1: it stays).
  int added = 0, removed = -1;
  /// It has begun in the run of `restart`, so that it holds its place where that was then.
  bool placed = false;

  bool varies() const { return shape[0] || shape[1]; }
  /// Whether it is there at the end of a step; step -1 is the start of the analysis.
  bool is_there(int step) const { return (added == 0 || step >= added) && (removed < 0 || step < removed); }
  /// Whether it does not hold its place as it is drawn from beginning to end: it is then pairs with the ground
  /// (system/held_points.hpp).
  bool is_staged() const { return added > 0 || removed >= 0 || placed; }
  /// Whether it is there wherever `other` is.
  bool covers(const Support& other) const {
    return added <= other.added && (removed < 0 || (other.removed >= 0 && other.removed <= removed));
  }
  /// Whether both are there at some time.
  bool meets(const Support& other) const {
    return (removed < 0 || other.added < removed) && (other.removed < 0 || added < other.removed);
  }
};

/// Whether supports begin or end in steps.
bool has_stages(const std::vector<Support>& supports);

/// Springs between a place and the ground, which does not move. They push and pull from the start of the analysis on.
struct Spring {
  std::string name;  ///< given by the user, or the text of the place, made unique
  Place on;          ///< an edge or the face of a crack, or a corner or point
  /// Edge: along its outward normal and its tangent, force / length^3 (traction per displacement, over the thickness).
  /// Corner or point: along x and y, force / length. 0 or more, one of them more than 0.
  std::array<double, 2> stiffness{};
  /// Displacement along the same axes at which they are without force, at factor 1 (model::AtRest); [0, 0] without one.
  std::array<double, 2> at_rest{};
  Source source;
};

/// Whether the springs act along an edge or a face, with stiffnesses along its normal and tangent.
inline bool acts_along(const Spring& spring) {
  return spring.on.kind == Place::Kind::edge || spring.on.kind == Place::Kind::face;
}

}  // namespace scabo::model
