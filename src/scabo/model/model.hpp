// A model as described by the user, checked and resolved: names have become indices, and shapes have become closed
// boundaries of lines and arcs. Plain structs; nothing is meshed or solved here.
//
// Units are those of the user and must be consistent; all examples use SI units (m, N, Pa, kg/m3).
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scabo/base/error.hpp"
#include "scabo/base/types.hpp"
#include "scabo/base/warning.hpp"
#include "scabo/files/image.hpp"
#include "scabo/files/imported_mesh.hpp"
#include "scabo/geometry/outline.hpp"
#include "scabo/model/curve.hpp"
#include "scabo/model/quantity.hpp"

namespace scabo::model {

enum class Plane { stress, strain };

/// Quasi-static, or the natural frequencies and modes of every elastic body.
enum class AnalysisType { static_, modal };

struct Analysis {
  AnalysisType type = AnalysisType::static_;
  int modes = 10;  ///< modal: number of modes, the lowest first, rigid-body modes included
  Plane plane = Plane::stress;
  double thickness = 1.0;  ///< length, > 0
};

/// Engineering constants along axes 1, 2 (in the plane) and 3. Axis 1 is turned by `angle` from x.
struct Orthotropic {
  double E1 = 0.0, E2 = 0.0, E3 = 0.0;        ///< force / length^2, > 0
  double nu12 = 0.0, nu13 = 0.0, nu23 = 0.0;  ///< minus strain along the second axis / strain along the first
  double G12 = 0.0;                           ///< force / length^2, > 0
  double angle = 0.0;                         ///< radians, counter-clockwise
};

/// Elastic law in the plane, stress = D [exx, eyy, gxy], for plane stress and plane strain alike.
struct Anisotropic {
  double D11 = 0.0, D12 = 0.0, D22 = 0.0, D16 = 0.0, D26 = 0.0, D66 = 0.0;  ///< force / length^2, positive definite
};

/// Linear elastic material: isotropic, orthotropic or anisotropic.
struct Material {
  std::string name;
  double young = 0.0;    ///< force / length^2, > 0
  double poisson = 0.0;  ///< -1 < poisson < 0.5 (plane strain), <= 0.5 (plane stress)
  std::optional<std::variant<Orthotropic, Anisotropic>> law;  ///< instead of young and poisson
  std::optional<double> density;  ///< mass / length^3, >= 0; needed for gravity and by a modal analysis
  /// Thermal strain along axes 1, 2 and 3 (anisotropic: exx, eyy, gxy) per unit of temperature; needed only where a
  /// temperature acts.
  std::optional<std::array<double, 3>> expansion;
  Source source;
};

using geometry::Arc;
using geometry::Corner;
using geometry::Edge;
using geometry::Outline;

/// One super-element; finite elements; many super-elements: polygons, or the squares of a quadtree; few super-elements,
/// for a shape that no point sees as a whole; a super-element for every cell of a file. Cells of a file may also be
/// finite elements.
enum class MeshKind { superelement, fem, polygons, quadtree, parts, imported };

/// Growth of the sizes of cells with the distance from where they are smaller, unless one is given.
constexpr double mesh_growth = 0.3;

/// Smaller cells near a point, or on an edge of the outline. Away from it sizes grow by `growth` of the distance.
struct LocalSize {
  std::optional<Vec2> near;
  int edge = -1;      ///< where `near` is not given
  double size = 0.0;  ///< > 0
  Source source = {};
  double growth = mesh_growth;  ///< 0.02 to 0.5
};

struct MeshOptions {
  MeshKind kind = MeshKind::superelement;
  double size = 0.0;      ///< longest boundary element; largest side of a cell, > 0
  double min_size = 0.0;  ///< quadtree: cells are not halved below it on account of lines; 0: 1/32 of their size
  std::vector<LocalSize> refine;
  int order = 2;               ///< polynomial order of a boundary element, 1 to 16; of cells of a file: at least
  Vec2 centre = Vec2::Zero();  ///< scaling centre: given by the user, a crack's tip, or the centroid
  int centre_corner = -1;      ///< corner of the outline at the scaling centre, or -1: its two edges are side faces
  /// Tolerance of the estimated error in the energy norm, relative to that of the whole model. `size` and `order` are
  /// then those of the first mesh.
  std::optional<double> tolerance;
  /// Sides of contacts are matched anew in every mesh that refinement makes, also where both bodies are one
  /// super-element, whose sides are otherwise refined alike.
  bool matched_anew = false;
  std::string file;  ///< that `Body::imported` comes from, for messages
  Source source;
};

/// A straight crack from its mouth, a point of an edge, to its tip, the scaling centre. Its two faces are side faces.
struct Crack {
  std::string name;
  Vec2 tip = Vec2::Zero(), mouth = Vec2::Zero();
  int edge = -1;    ///< edge with the mouth
  double at = 0.0;  ///< mouth = edge.at(at), 0 <= at < 1; 0 is the corner at the start of the edge
  Source source;
  /// Between cells and elements: its points from one end to the other, two or more; then `tip` and `mouth` are not
  /// used. An end on the boundary or on another crack is open, any other end is a tip.
  std::vector<Vec2> path;
};

/// A part of a body with a material of its own. What of it lies outside of the body does not count.
struct Region {
  std::string name;
  int material = -1;  ///< index into Model::materials
  Outline outline;
  Source source;
};

/// A body that an image shows: labels of pixels stand for materials.
struct ImageShape {
  std::shared_ptr<const files::Image> image;
  double pixel = 0.0;            ///< length of the side of a pixel, > 0
  std::map<int, int> materials;  ///< index into Model::materials of each label; other labels are empty
};

struct Body {
  std::string name;
  bool rigid = false;                 ///< an obstacle or a punch, without material and mesh
  int material = -1;                  ///< index into Model::materials; -1 for a rigid body
  Outline outline;                    ///< with the material on its left
  MeshOptions mesh;                   ///< unused for a rigid body
  std::vector<Crack> cracks;          ///< at most one of one super-element, and all with a path in others
  std::vector<Region> regions;        ///< beside each other, or one inside another: the smallest one counts
  std::vector<int> sector_materials;  ///< per edge: its sector's index into Model::materials; empty: `material`
  /// The mesh of the body, from a file (imported_body.hpp): facet_sets[i] has the sides along edge i of the outline, in
  /// their order.
  std::shared_ptr<const files::ImportedMesh> imported;
  std::vector<int> region_materials;  ///< of imported->regions, index into Model::materials
  std::optional<ImageShape> image;    ///< divided by a quadtree; the outline is its rectangle
  bool outside = false;               ///< unbounded: the material lies outside the shape; the outline runs clockwise
  std::optional<Vec2> reference;      ///< outside body: displacements are relative to this point
  /// Staged construction: index into Model::steps of the step in which the body is put in place (0: it is there from
  /// the start), and of the step in which it is taken away (-1: it stays).
  int added = 0, removed = -1;
  Source source;

  /// Whether it is there at the end of a step; step -1 is the start of the analysis.
  bool is_there(int step) const { return (added == 0 || step >= added) && (removed < 0 || step < removed); }
  bool is_staged() const { return added > 0 || removed >= 0; }

  /// Whether two side faces meet at the scaling centre.
  bool open() const { return (!cracks.empty() && cracks.front().path.empty()) || mesh.centre_corner >= 0; }
};

/// Whether bodies are added or removed in steps.
bool has_stages(const std::vector<Body>& bodies);

/// Whether the body is divided over its whole area, by its outline and regions: not one super-element, and not the grid
/// of finite elements in a rectangle.
inline bool is_divided_inside(const Body& body) {
  return body.image || (body.mesh.kind != MeshKind::superelement &&
                        !(body.mesh.kind == MeshKind::fem && body.outline.rectangle && body.regions.empty() &&
                          body.mesh.refine.empty() && body.cracks.empty() && !body.mesh.tolerance));
}

/// Whether the cracks of a body lie between its cells: both faces of each consist of boundary elements.
inline bool has_divided_faces(const Body& body) { return !body.cracks.empty() && !body.cracks.front().path.empty(); }

/// Where a support, load or contact acts.
struct Place {
  /// `face`: a side face, or a face of a crack between cells; `mouth`: the node of a side face at the boundary.
  enum class Kind { body, edge, corner, near, face, mouth };
  Kind kind = Kind::body;
  int body = -1;
  /// Edge or corner; side face, mouth: 0 at the start of the boundary, 1 at its end; face of Body::cracks[k] with a
  /// path: 2 k on its right, 2 k + 1 on its left, looking along the path.
  int index = -1;
  Vec2 near = Vec2::Zero();  ///< `near`: stands for the boundary node closest to this point
  std::string text;          ///< as given by the user, `upper.top_right`
  Source source;
};

/// Axes of the displacement that a support prescribes: x and y; the outward normal of its edge and the tangent a
/// quarter turn counter-clockwise from it, at every point; or a direction and the one a quarter turn from it.
enum class SupportAxes { xy, edge, direction };

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

struct Force {
  Vec2 value;
};  ///< force on a point, or total force on an edge
struct Traction {
  Vec2 value;
};  ///< force / length^2 on an edge
struct Pressure {
  double value;
};  ///< force / length^2 on an edge, positive against its outward normal
struct Gravity {
  Vec2 value;
};  ///< acceleration, length / time^2, of a body with a density

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
struct BodyForce {
  Linear x, y;
};  ///< force / length^3 on a body, absolute coordinates

/// Change of temperature by a table along a direction: linear between its points, constant before the first and beyond
/// the last, the same across the direction.
struct TemperatureTable {
  struct Point {
    double at = 0.0;      ///< along . x
    double change = 0.0;  ///< of temperature
  };
  Vec2 along = Vec2(1.0, 0.0);  ///< unit vector
  std::vector<Point> points;    ///< two or more, their places ascending, no two the same

  double at(double place) const;
};
/// Whether a table is linear over the outline of a body: it bends nowhere inside.
bool is_linear_over(const TemperatureTable& table, const Outline& outline);

/// Change of temperature of a body, absolute coordinates.
struct Temperature {
  Linear change;                          ///< without a table
  std::optional<TemperatureTable> table;  ///< instead
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

/// Pressure of a fluid in contacts, on both sides of open and closed pairs. Forces of the pairs are then effective
/// ones.
struct PorePressure {
  std::vector<int> contacts;  ///< indices into Model::contacts
  /// The same everywhere; a table over x or y; or that of still water.
  std::variant<double, EdgeTable, Water> value = 0.0;
};

/// The ground end of springs moves by their Spring::at_rest: the force of their stiffness times it acts on the body. A
/// load of its own for every such spring, so that steps give it a factor.
struct AtRest {
  int spring = -1;  ///< index into Model::springs; the load acts on its place and has its name
};

struct Load {
  std::string name;
  std::optional<Place> on;  ///< empty: gravity, temperature or stress of every elastic body, or in contacts
  std::variant<Force, Traction, Pressure, Gravity, FaceTraction, BodyForce, Temperature, EdgeTable, Water,
               UniformStress, GroundStress, Moment, PorePressure, AtRest>
      kind;
  Source source;
};

/// Coefficient of friction at a position from 0 to 1 along a contact.
struct FrictionPoint {
  double position = 0.0, friction = 0.0;
};

/// Unilateral contact between two edges, or the two faces of a crack, A (named first) and B. Either friction, cohesion
/// and tension, or `bond`, or a shear strength.
struct Contact {
  std::string name;
  Place a, b;
  double friction = 0.0;  ///< coefficient, >= 0; the static one if a dynamic one is given
  /// Coefficient against backward slip (slip < 0), where it differs; `friction` is then that against forward slip.
  std::optional<double> backward_friction;
  std::optional<double> dynamic_friction;     ///< coefficient, <= friction
  /// The same against backward slip, <= backward_friction; given if both a dynamic and a backward one are.
  std::optional<double> backward_dynamic_friction;
  double slip_distance = 0.0;                 ///< slip over which friction falls to the dynamic value; 0: at once
  std::vector<FrictionPoint> friction_along;  ///< instead of one coefficient; in ascending order of position
  double cohesion = 0.0;                      ///< force / length^2, until first failure
  double tension = 0.0;                       ///< tensile strength, force / length^2, until first failure
  bool bond = false;                          ///< neither opens nor slips
  std::optional<double> shear_strength;       ///< prescribed friction bound (Tresca), force / length^2
  double gap = 0.0;                           ///< length, added to the geometric gap; negative: an interference fit
  /// Index into Model::steps of the step over which interferences, negative gaps, grow from 0 to their values; -1: they
  /// are there from the start.
  int fit_in = -1;
  bool large_slip = false;    ///< its pairs are found anew as its sides pass each other
  Vec2 about = Vec2::Zero();  ///< point to which the moment of the contact forces refers
  Source source;
};

/// Two edges of different bodies that do not separate.
struct Tie {
  std::string name;
  Place a, b;
  Source source;
};

/// Limits of increments whose size follows from what changes (analysis/increment_size.hpp). All are parts of the step,
/// 0 < smallest <= first <= largest <= 1. The last increment of a step may be smaller than `smallest`.
struct AutomaticIncrements {
  double first = 0.1;
  double largest = 0.25;
  double smallest = 1e-4;
};

/// Factors change linearly, or along curves, over `increments` increments, from those at the end of the previous step
/// (zero before the first) to these. Coefficients of friction change linearly.
struct Step {
  std::string name;
  int increments = 1;                            ///< equal parts; without meaning if `automatic`
  std::optional<AutomaticIncrements> automatic;  ///< instead of equal parts
  /// Instead of equal parts: where each increment ends, ascending, the last one 1. As many as `increments`.
  std::vector<double> ends;
  std::vector<double> load_factors;     ///< at the end of the step, one for each load
  std::vector<double> support_factors;  ///< at the end of the step, one for each support
  /// Index into Model::curves of what a factor follows within the step, for each load and support; -1: it changes
  /// linearly. Empty if no factor follows a curve. The factor above is that of the curve at its end.
  std::vector<int> load_curves, support_curves;
  std::vector<double> friction;  ///< coefficient of every contact at the end of the step; empty if no step changes one
  std::vector<double> backward_friction;  ///< the same against backward slip; as many as `friction`
  Source source;
};

/// Library that factorises sparse stiffness matrices.
enum class Factorisation { cholmod, mumps };

/// Curve that the factor of load or support `index` follows in a step; -1: none.
inline int load_curve(const Step& step, std::size_t index) {
  return step.load_curves.empty() ? -1 : step.load_curves[index];
}
inline int support_curve(const Step& step, std::size_t index) {
  return step.support_curves.empty() ? -1 : step.support_curves[index];
}
/// Whether the contact has one coefficient of friction, or one for each direction of slip, which a step may change.
bool has_one_coefficient(const Contact& contact);
/// Coefficients at the end of a step: against forward slip of every contact, then against backward slip; empty if no
/// step changes one.
std::vector<double> coefficients_of(const Step& step);

/// Parts of a step, between 0 and 1, at which an increment ends so that no corner of a curve is passed over, ascending.
std::vector<double> corners_of(const Step& step, const std::vector<Curve>& curves);

/// Number of increments of a step; if it is not known before, what it may be.
int expected_increments(const Step& step);

struct SolverOptions {
  double tolerance = 1e-10;  ///< bound of every scaled figure of the certificate
  int iterations = 50;       ///< Newton iterations in one attempt, at most
  int halvings = 6;          ///< of an increment that does not converge, at most
  bool uniqueness = false;   ///< search for other solutions of every increment
  Factorisation factorisation = Factorisation::cholmod;
};

/// A point at which results are requested. `body`: -1 for every body that contains it.
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

/// Points of a rectangular grid, as far as they lie in bodies: `spacing` apart within the bounding box of the bodies,
/// or counts[0] x counts[1] points from `low` to `high`.
struct OutputGrid {
  std::optional<double> spacing;  ///< > 0
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
  std::array<int, 2> counts{};  ///< without spacing: 1 or more each
  int body = -1;
  Source source;
};

/// Resultant of the stress over a line that cuts bodies, on its length s from the middle towards `to`:
///
///     n = t turned by +90 degrees, t = (to - from) / |to - from|
///     normal = int n . sigma n ds,  shear = int t . sigma n ds,  moment = int s (n . sigma n) ds
///
/// times the thickness: the force of the side that n points to on the other side, tension positive, and its moment
/// about the middle of the line, counter-clockwise.
struct Section {
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();
  int body = -1;  ///< only this body; -1: all elastic ones
};

/// Two directions at right angles along which results are given: x and y; turned by an angle; or the outward normal of
/// a straight edge and the tangent a quarter turn counter-clockwise from it.
struct ResultAxes {
  enum class Kind { xy, angle, edge };
  Kind kind = Kind::xy;
  Vec2 first = Vec2(1.0, 0.0);  ///< unit vector; the second is a quarter turn counter-clockwise from it

  Vec2 second() const { return {-first.y(), first.x()}; }
};

/// Resultant of all that acts on an elastic body through one of its edges, and its moment (analysis/edge_forces.hpp).
struct EdgeResultant {
  Place on;                   ///< an edge, or a face on which supports, springs or a contact act
  Vec2 about = Vec2::Zero();  ///< point of the moment
  ResultAxes axes;
};

/// Displacement of a point or corner along axes of its own.
struct PlaceDisplacement {
  Quantity of;  ///< its point; the component is not used
  ResultAxes axes;
};

/// What is written to history.csv after every increment.
struct HistoryItem {
  std::string name;
  std::variant<Quantity, Section, EdgeResultant, PlaceDisplacement> of;
  Source source;
};

/// Groups of arrays written to the .vtu files.
struct OutputFields {
  bool displacement = true, stress = true;  ///< of every body
  bool principal = true, von_mises = true;  ///< of every body, derived from its stress
  bool contact = true;                      ///< in a separate file: state, pressure and slip along the contacts
  bool any_of_bodies() const { return displacement || stress || principal || von_mises; }
};

/// Output requested in addition to the files of every run, and the content of those files.
struct Output {
  std::vector<OutputPoint> points;
  std::vector<OutputLine> lines;
  std::optional<OutputGrid> grid;
  std::vector<HistoryItem> history;
  bool error = false;              ///< estimate the error of every increment
  std::vector<Quantity> error_of;  ///< numbers that get an error bar
  bool discrete_problems = false;  ///< write the contact problem of every increment to a file
  int every = 1;                   ///< .vtu files of every so many increments, and of the last
  OutputFields fields;
};

/// Results of another run, whose end is the start of this one (analysis/restart.hpp).
struct Restart {
  std::string directory;
  /// At its end, for the loads and supports of this model; 0 for one that it does not have. The first step starts from
  /// them.
  std::vector<double> load_factors, support_factors;
  Source source;
};

struct Model {
  std::string file;                ///< as given to the reader, for messages
  std::vector<std::string> files;  ///< paths of mesh files and images that were read for it
  std::string title;
  Analysis analysis;
  std::vector<Material> materials;
  std::vector<Body> bodies;
  std::vector<Support> supports;
  std::vector<Spring> springs;
  std::vector<Load> loads;
  std::vector<Contact> contacts;
  std::vector<Tie> ties;
  std::vector<Curve> curves;
  std::vector<Step> steps;
  std::optional<Restart> restart;
  SolverOptions solver;
  std::vector<Warning> warnings;  ///< about input that has no effect in this analysis, or is named otherwise
  Output output;
  std::optional<QuantityTolerance> tolerance;  ///< meshes are refined until the bar of a number is that small
};

}  // namespace scabo::model
