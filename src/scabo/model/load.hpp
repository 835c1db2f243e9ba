// Loads, each at factor 1; steps say how much of each acts (step.hpp).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scabo/geometry/plane/outline.hpp"
#include "scabo/model/place.hpp"

namespace scabo::model {

/// Force on a point, or total force on an edge.
struct Force {
  Vec2 value;
};
/// Force / length^2 on an edge.
struct Traction {
  Vec2 value;
};
/// Force / length^2 on an edge, positive against its outward normal.
struct Pressure {
  double value;
};
/// Acceleration, length / time^2, of a body with a density.
struct Gravity {
  Vec2 value;
};

/// Rotation of a body with a density about the axis of revolution: its centrifugal force at this angular velocity.
struct Spin {
  double value;  ///< radians / time
};

/// A quantity linear in x and y.
struct Linear {
  double constant = 0.0, per_x = 0.0, per_y = 0.0;
};

/// Traction on a side face as a sum of powers of xi, which is 0 at the scaling centre and 1 at the boundary.
struct FaceTraction {
  struct Term {
    double power = 0.0;         ///< > -1
    Vec2 value = Vec2::Zero();  ///< force / length^2; pressure: x, against the outward normal (y is unused)
  };
  bool pressure = false;
  std::vector<Term> terms;
};

/// Force / length^3 on a body, absolute coordinates.
struct BodyForce {
  Linear x, y;
};

/// Change of temperature by a table along a direction or about a centre: linear between its points, constant before the
/// first and beyond the last, the same across the direction or around the centre.
struct TemperatureTable {
  struct Point {
    double at = 0.0;      ///< along . x, or the distance from the centre
    double change = 0.0;  ///< of temperature
  };
  Vec2 along = Vec2(1.0, 0.0);      ///< unit vector
  std::vector<Point> points;        ///< two or more, their places ascending, no two the same
  std::optional<Vec2> centre = {};  ///< instead of a direction

  double at(double place) const;
  bool is_constant() const;
};
/// Whether a table is linear over the outline of a body: it bends nowhere inside. One about a centre bends everywhere.
bool is_linear_over(const TemperatureTable& table, const geometry::Outline& outline);

/// Change of temperature of a body, absolute coordinates.
struct Temperature {
  Linear change;                               ///< without a table
  std::optional<TemperatureTable> table = {};  ///< instead
};

/// A traction or pressure on an edge: linear between the points of a table, zero before the first and after the last.
struct EdgeTable {
  enum class Over { length, x, y };  ///< length: from the start of the edge, along it
  struct Point {
    double at = 0.0;
    Vec2 value = Vec2::Zero();  ///< force / length^2; pressure: x, against the outward normal (y is unused)
  };
  bool pressure = false;
  Over over = Over::length;
  std::vector<Point> points;  ///< two or more, their positions ascending; two at one position are a jump
};

/// Pressure of still water on an edge: unit_weight times the depth below the level, zero above it.
struct Water {
  double level = 0.0;        ///< up . x of the surface
  double unit_weight = 0.0;  ///< force / length^3, > 0
  Vec2 up = Vec2(0.0, 1.0);  ///< unit vector
};

/// Stress of a body before anything is done to it, the same everywhere; of an unbounded body that far from it.
struct UniformStress {
  std::array<double, 3> value{};  ///< [xx, yy, xy], force / length^2, tension positive
  std::optional<double> zz;       ///< plane strain; otherwise by the law of the material
};
/// Stress of ground under its own weight: linear in depth, with its surface at right angles to `up`.
struct GroundStress {
  double unit_weight = 0.0;  ///< force / length^3, > 0
  double surface = 0.0;      ///< up . x of the surface, below which the bodies lie
  double K0 = 0.0;           ///< horizontal stress over vertical stress, >= 0
  double surcharge = 0.0;    ///< force / length^2, pressure on the surface, >= 0
  Vec2 up = Vec2(0.0, 1.0);  ///< unit vector
};

/// A moment, force times length, counter-clockwise: on an edge as a traction along its normal that is linear along it
/// and has no resultant, on a rigid body.
struct Moment {
  double value = 0.0;
};

/// Pressure of a fluid in contacts, on both sides of open and closed pairs, or of open ones alone. Forces of the pairs
/// are then effective ones.
struct PorePressure {
  std::vector<int> contacts;  ///< indices into Model::contacts
  /// The same everywhere; a table over x or y; or that of still water.
  std::variant<double, EdgeTable, Water> value = 0.0;
  bool enters = false;  ///< the fluid enters the joint where it opens: not on closed pairs
};

/// The ground end of springs moves by their Spring::at_rest: the force of their stiffness times it acts on the body. A
/// load of its own for every such spring, so that steps give it a factor.
struct AtRest {
  int spring = -1;  ///< index into Model::springs; the load acts on its place and has its name
};

/// Water that moves with an edge of an elastic body (Westergaard 1933): at the depth y below the level, the mass
/// 7/8 density sqrt(H y) per area moves with the motion along the normal, H being the depth of the reservoir. It has
/// inertia and neither weight nor pressure: that is Water.
struct AddedMass {
  std::optional<Place> on;
  double level = 0.0;            ///< up . x of the surface
  std::optional<double> bottom;  ///< up . x of the bottom of the reservoir; empty: of the lowest node of the edge
  double density = 0.0;          ///< mass / length^3, > 0
  Vec2 up = Vec2(0.0, 1.0);      ///< unit vector
  Source source;
};

/// A machine, a bell, a deck: a mass at a corner of a body, without extent. It moves with the corner, and gravity acts
/// on it as on its body.
struct PointMass {
  std::optional<Place> on;
  double mass = 0.0;  ///< > 0; in a plane model of the thickness of the body
  Source source;
};

/// A load that travels along an edge: it acts at `from` + `velocity` t from the start of the edge, t being the time
/// since the begin of the first step in time.
struct Moving {
  double velocity = 0.0;  ///< length / time, not 0; below 0: towards the start of the edge
  double from = 0.0;      ///< length

  double place_at(double time) const { return from + velocity * time; }
};

struct Load {
  std::string name;
  std::optional<Place> on;  ///< empty: gravity, temperature or stress of every elastic body, or in contacts
  std::variant<Force, Traction, Pressure, Gravity, Spin, FaceTraction, BodyForce, Temperature, EdgeTable, Water,
               UniformStress, GroundStress, Moment, PorePressure, AtRest>
      kind;
  Source source;
  /// Of a force, which acts at one point of its edge, or of a table over its length, whose places count from there.
  std::optional<Moving> moving = {};
};

}  // namespace scabo::model
