// A model as the user wrote it, checked and resolved: names have become indices, shapes have become closed
// boundaries of lines and arcs. Plain structs; nothing here is meshed or solved.
//
// Units are the user's own, as long as they are consistent; every example uses SI (m, N, Pa, kg/m3).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scabo/base/error.hpp"
#include "scabo/base/types.hpp"

namespace scabo::model {

enum class Plane { stress, strain };

struct Analysis {
  Plane plane = Plane::stress;
  double thickness = 1.0;  ///< length, > 0
};

/// Linear elastic, isotropic.
struct Material {
  std::string name;
  double young = 0.0;             ///< force / length^2, > 0
  double poisson = 0.0;           ///< -1 < poisson < 0.5 (plane strain), <= 0.5 (plane stress)
  std::optional<double> density;  ///< mass / length^3, >= 0; only where gravity needs it
  Source source;
};

/// An arc of a circle from `start_angle` through `sweep` (radians, counter-clockwise positive).
struct Arc {
  Vec2 centre = Vec2::Zero();
  double radius = 0.0;
  double start_angle = 0.0;
  double sweep = 0.0;
};

/// One edge of a body's boundary, a straight line or an arc, run counter-clockwise around the body
/// (material on the left).
struct Edge {
  std::vector<std::string> names;  ///< its own name first (`edge_3`), then those the user gave it
  Vec2 start = Vec2::Zero();
  Vec2 end = Vec2::Zero();
  std::optional<Arc> arc;  ///< nothing: a straight line
  Source source;

  Vec2 at(double t) const;  ///< point at 0 <= t <= 1 of the edge's length
  double length() const;
};

/// A corner is the start of the edge with the same index.
struct Corner {
  std::vector<std::string> names;
  Vec2 position = Vec2::Zero();
};

/// A simple closed boundary. edges[i] ends where edges[i + 1] starts.
struct Outline {
  std::vector<Edge> edges;
  std::vector<Corner> corners;
  bool rectangle = false;  ///< made from `rectangle`: `fem` meshes need it

  double area() const;    ///< arcs included exactly
  Vec2 centroid() const;  ///< arcs included exactly
};

enum class MeshKind { superelement, fem };

struct MeshOptions {
  MeshKind kind = MeshKind::superelement;
  double size = 0.0;           ///< longest boundary element, > 0
  int order = 2;               ///< polynomial order of a boundary element, 1 to 16
  Vec2 centre = Vec2::Zero();  ///< scaling centre: given by the user, or the centroid
  Source source;
};

struct Body {
  std::string name;
  bool rigid = false;  ///< an obstacle or a punch: no material, no mesh
  int material = -1;   ///< index into Model::materials; -1 for a rigid body
  Outline outline;
  MeshOptions mesh;  ///< unused for a rigid body
  Source source;
};

/// Where a support, load or contact acts.
struct Place {
  enum class Kind { body, edge, corner, near };
  Kind kind = Kind::body;
  int body = -1;
  int index = -1;            ///< of the edge or corner
  Vec2 near = Vec2::Zero();  ///< `near`: the boundary node closest to this point is meant
  std::string text;          ///< as the user wrote it, `upper.top_right`
  Source source;
};

/// Prescribed displacement of a place; a component without a value is free.
struct Support {
  std::string name;  ///< the user's, or the place's text (made unique)
  Place on;
  std::array<std::optional<double>, 2> displacement;  ///< length, at factor 1; `fix` gives 0
  Source source;
};

struct Force {
  Vec2 value;
};  ///< force: on a point, or in total over an edge
struct Traction {
  Vec2 value;
};  ///< force / length^2 on an edge
struct Pressure {
  double value;
};  ///< force / length^2 on an edge, against its outward normal
struct Gravity {
  Vec2 value;
};  ///< length / time^2 on a body with density

struct Load {
  std::string name;
  std::optional<Place> on;  ///< nothing: gravity on every elastic body
  std::variant<Force, Traction, Pressure, Gravity> kind;
  Source source;
};

/// Coefficient of friction at a position from 0 to 1 along a contact.
struct FrictionPoint {
  double position = 0.0, friction = 0.0;
};

/// Unilateral contact between two edges; A is named first. Friction beside cohesion and tension, or one of bond and shear
/// strength instead of all of them.
struct Contact {
  std::string name;
  Place a, b;
  double friction = 0.0;  ///< coefficient, >= 0; static where there is a dynamic one
  std::optional<double> dynamic_friction;     ///< coefficient, <= friction
  double slip_distance = 0.0;                 ///< length over which friction falls to the dynamic one; 0: at once
  std::vector<FrictionPoint> friction_along;  ///< instead of one coefficient; positions ascend
  double cohesion = 0.0;                 ///< force / length^2, until first failure
  double tension = 0.0;                  ///< tensile strength, force / length^2, until first failure
  bool bond = false;                     ///< neither opens nor slips
  std::optional<double> shear_strength;  ///< prescribed bound of friction (Tresca), force / length^2
  double gap = 0.0;       ///< length, added to the geometric gap; negative: an interference fit
  Source source;
};

/// Factors go linearly, over `increments`, from those of the step before (first: zero) to these.
struct Step {
  std::string name;
  int increments = 1;
  std::vector<double> load_factors;     ///< at the end of the step, one for each load
  std::vector<double> support_factors;  ///< at the end of the step, one for each support
  Source source;
};

struct SolverOptions {
  double tolerance = 1e-10;  ///< certificate: every scaled figure below this
  int iterations = 50;       ///< of Newton in one attempt
  int halvings = 6;          ///< of an increment that did not converge
  bool uniqueness = false;   ///< look for other solutions of every increment
};

/// What a run writes besides the files that it always writes.
struct Output {
  bool discrete_problems = false;  ///< the contact problem of every increment
};

struct Model {
  std::string file;  ///< as given to the reader, for messages
  std::string title;
  Analysis analysis;
  std::vector<Material> materials;
  std::vector<Body> bodies;
  std::vector<Support> supports;
  std::vector<Load> loads;
  std::vector<Contact> contacts;
  std::vector<Step> steps;
  SolverOptions solver;
  Output output;
};

}  // namespace scabo::model
