// What holds bodies: supports and springs.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <variant>

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

  bool varies() const { return shape[0] || shape[1]; }
};

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
