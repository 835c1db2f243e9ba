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

/// Quasi-static, or the natural frequencies and modes of every elastic body.
enum class AnalysisType { static_, modal };

struct Analysis {
  AnalysisType type = AnalysisType::static_;
  int modes = 10;  ///< modal: how many of the lowest, rigid-body modes among them
  Plane plane = Plane::stress;
  double thickness = 1.0;  ///< length, > 0
};

/// Engineering constants along axes 1, 2 (in the plane) and 3, the plane's axis 1 turned by `angle` from x.
struct Orthotropic {
  double E1 = 0.0, E2 = 0.0, E3 = 0.0;        ///< force / length^2, > 0
  double nu12 = 0.0, nu13 = 0.0, nu23 = 0.0;  ///< strain along the second axis per strain along the first, negative
  double G12 = 0.0;                           ///< force / length^2, > 0
  double angle = 0.0;                         ///< radians, counter-clockwise
};

/// The law of the plane itself, stress = D [exx, eyy, gxy], whatever the kind of plane.
struct Anisotropic {
  double D11 = 0.0, D12 = 0.0, D22 = 0.0, D16 = 0.0, D26 = 0.0, D66 = 0.0;  ///< force / length^2, positive definite
};

/// Linear elastic: isotropic, or of a law of its own.
struct Material {
  std::string name;
  double young = 0.0;    ///< force / length^2, > 0
  double poisson = 0.0;  ///< -1 < poisson < 0.5 (plane strain), <= 0.5 (plane stress)
  std::optional<std::variant<Orthotropic, Anisotropic>> law;  ///< instead of young and poisson
  std::optional<double> density;  ///< mass / length^3, >= 0; needed for gravity and by a modal analysis
  /// Free strain along axes 1, 2 and 3 (anisotropic: exx, eyy, gxy) per unit of temperature; only where a temperature
  /// acts.
  std::optional<std::array<double, 3>> expansion;
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
  Vec2 centre = Vec2::Zero();  ///< scaling centre: given by the user, a crack's tip, or the centroid
  int centre_corner = -1;      ///< corner of the outline at the scaling centre, or -1: its two edges are side faces
  /// Wanted of the estimated error in the energy norm, relative to the whole model's; `size` and `order` are then those
  /// to begin with.
  std::optional<double> tolerance;
  Source source;
};

/// A straight crack from a point of an edge, its mouth, to the scaling centre, its tip. Its two faces are side faces.
struct Crack {
  std::string name;
  Vec2 tip = Vec2::Zero(), mouth = Vec2::Zero();
  int edge = -1;    ///< of the mouth
  double at = 0.0;  ///< mouth = edge.at(at), 0 <= at < 1; 0: the corner where the edge begins
  Source source;
};

struct Body {
  std::string name;
  bool rigid = false;                 ///< an obstacle or a punch: no material, no mesh
  int material = -1;                  ///< index into Model::materials; -1 for a rigid body
  Outline outline;                    ///< material on its left
  MeshOptions mesh;                   ///< unused for a rigid body
  std::vector<Crack> cracks;          ///< one at most
  std::vector<int> sector_materials;  ///< of the sector over every edge, index into Model::materials; empty: `material`
  bool outside = false;               ///< the material lies outside the shape, to infinity; the outline runs clockwise
  std::optional<Vec2> reference;      ///< of an outside body: displacement is given relative to this point
  Source source;

  /// Whether two side faces meet at the scaling centre.
  bool open() const { return !cracks.empty() || mesh.centre_corner >= 0; }
};

/// Where a support, load or contact acts.
struct Place {
  /// `face`: a side face; `mouth`: the node of a side face at the boundary.
  enum class Kind { body, edge, corner, near, face, mouth };
  Kind kind = Kind::body;
  int body = -1;
  int index = -1;            ///< of the edge or corner; face, mouth: 0 at the beginning of the boundary, 1 at its end
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

/// A quantity linear in x and y.
struct Linear {
  double constant = 0.0, per_x = 0.0, per_y = 0.0;
};

/// Traction on a side face, in powers of xi: 0 at the scaling centre, 1 at the boundary.
struct FaceTraction {
  struct Term {
    double power = 0.0;         ///< > -1
    Vec2 value = Vec2::Zero();  ///< force / length^2; pressure: x against the outward normal, y unused
  };
  bool pressure = false;
  std::vector<Term> terms;
};
struct BodyForce {
  Linear x, y;
};  ///< force / length^3 on a body, absolute coordinates
struct Temperature {
  Linear change;
};  ///< change of temperature of a body, absolute coordinates

struct Load {
  std::string name;
  std::optional<Place> on;  ///< nothing: gravity or temperature on every elastic body
  std::variant<Force, Traction, Pressure, Gravity, FaceTraction, BodyForce, Temperature> kind;
  Source source;
};

/// Coefficient of friction at a position from 0 to 1 along a contact.
struct FrictionPoint {
  double position = 0.0, friction = 0.0;
};

/// Unilateral contact between two edges; A is named first. Friction beside cohesion and tension, or one of bond and
/// shear strength instead of all of them.
struct Contact {
  std::string name;
  Place a, b;
  double friction = 0.0;                      ///< coefficient, >= 0; static where there is a dynamic one
  std::optional<double> dynamic_friction;     ///< coefficient, <= friction
  double slip_distance = 0.0;                 ///< length over which friction falls to the dynamic one; 0: at once
  std::vector<FrictionPoint> friction_along;  ///< instead of one coefficient; positions ascend
  double cohesion = 0.0;                      ///< force / length^2, until first failure
  double tension = 0.0;                       ///< tensile strength, force / length^2, until first failure
  bool bond = false;                          ///< neither opens nor slips
  std::optional<double> shear_strength;       ///< prescribed bound of friction (Tresca), force / length^2
  double gap = 0.0;                           ///< length, added to the geometric gap; negative: an interference fit
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

/// A point whose values are wanted. `body`: -1 for every body that holds it.
struct OutputPoint {
  std::string name;
  Vec2 at = Vec2::Zero();
  int body = -1;
  Source source;
};

/// `points` equally spaced points from `from` to `to`, both included.
struct OutputLine {
  std::string name;
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();
  int points = 101;  ///< 2 or more
  int body = -1;
  Source source;
};

/// The points of a rectangular grid that lie in bodies: `spacing` apart within the bodies' box, or counts[0] x
/// counts[1] points from `low` to `high`.
struct OutputGrid {
  std::optional<double> spacing;  ///< > 0
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
  std::array<int, 2> counts{};  ///< without spacing: 1 or more each
  int body = -1;
  Source source;
};

/// Groups of arrays that the .vtu files hold.
struct OutputFields {
  bool displacement = true, stress = true;  ///< of every body
  bool principal = true, von_mises = true;  ///< of every body, measures of its stress
  bool contact = true;                      ///< a file of its own: state, pressure and slip along the contacts
  bool any_of_bodies() const { return displacement || stress || principal || von_mises; }
};

/// What is wanted besides the files that every run writes, and how much those hold.
struct Output {
  std::vector<OutputPoint> points;
  std::vector<OutputLine> lines;
  std::optional<OutputGrid> grid;
  bool error = false;              ///< estimate the error of every increment
  bool discrete_problems = false;  ///< the contact problem of every increment, as a file
  int every = 1;                   ///< .vtu files of every so many increments, and of the last
  OutputFields fields;
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
  std::vector<std::string> warnings;  ///< what was given and plays no part in this analysis, in sentences
  Output output;
};

}  // namespace scabo::model
