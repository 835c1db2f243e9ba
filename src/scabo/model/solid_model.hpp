// A model in space (`analysis: {space: true}`): bodies of tetrahedra, from mesh files or of simple shapes, with
// contacts and ties between named faces. Plain values, checked by the reader but for what needs geometry
// (analysis/space/posed_solids.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scabo/base/error.hpp"
#include "scabo/base/warning.hpp"
#include "scabo/files/imported_solid_mesh.hpp"
#include "scabo/model/contact.hpp"
#include "scabo/model/curve.hpp"
#include "scabo/model/model.hpp"
#include "scabo/model/solid_shape.hpp"
#include "scabo/model/stay.hpp"
#include "scabo/model/step.hpp"

namespace scabo::model {

struct SpaceMaterial {
  std::string name;
  double young = 0.0, poisson = 0.0;  ///< force / length^2, > 0; -1 < poisson < 1/2
  double density = 0.0;               ///< mass / length^3, >= 0
  double expansion = 0.0;             ///< strain per change of temperature, >= 0
};

/// A bolt that is tightened: over its step the part of the body above a plane is pulled towards the part below it. From
/// then on their shortening stays.
struct SpacePreload {
  Eigen::Vector3d point, normal;  ///< of the plane; the latter of length 1, out of the part below
  std::optional<double> force;    ///< tension at the end of the step; none: `shortening` is given
  double shortening = 0.0;        ///< by which the parts are pulled together
  int step = 0;                   ///< index of the step over which it grows
  Source source;
};

struct SpaceBody {
  std::string name;
  std::shared_ptr<const files::ImportedSolidMesh> mesh;  ///< either this or `shape`
  bool made_of_shape = false;                            ///< `mesh` is that of a CAD shape, not of a file
  std::optional<SolidShape> shape;
  SolidSizes sizes;  ///< of a shape
  int material = -1;
  bool rigid = false;                   ///< then without a material
  double density = 0.0;                 ///< of a rigid body, mass / length^3, >= 0
  std::optional<SpacePreload> preload;  ///< of an elastic body
  Stay stay;
  Source source;
};

/// Where something acts. A surface of the mesh file of a body, the outer facets whose corners are in a set of nodes, or
/// a face of its shape; an edge or a point; none of them: the whole body.
struct SpaceFace {
  int body = -1;
  int side_set = -1, node_set = -1;  ///< one of them, of `body`'s mesh; or none
  std::string of_shape;              ///< the name of a face of `body`'s shape
  int line_set = -1;                 ///< a curve of `body`'s mesh
  std::vector<SpaceFace> meeting;    ///< two faces of the body: the edge where they meet; three: the point
  /// Of several such edges or points the nearest one; without `meeting` the nearest node.
  std::optional<Eigen::Vector3d> near;
  /// Only those facets of it, or of the whole boundary, whose outward normals are within 30 degrees of this unit
  /// vector.
  std::optional<Eigen::Vector3d> normal;
  std::string text;  ///< `block.bottom`
  Source source;

  bool is_edge() const { return line_set >= 0 || meeting.size() == 2; }
  bool is_point() const { return meeting.size() == 3 || (near && meeting.empty()); }
  bool is_set_of_nodes() const { return node_set >= 0 && !normal; }
  bool is_body() const {
    return side_set < 0 && node_set < 0 && of_shape.empty() && !normal && !is_edge() && !is_point();
  }
  bool is_same(const SpaceFace& other) const {
    return body == other.body && side_set == other.side_set && node_set == other.node_set &&
           of_shape == other.of_shape && normal == other.normal && line_set == other.line_set && near == other.near &&
           std::equal(meeting.begin(), meeting.end(), other.meeting.begin(), other.meeting.end(),
                      [](const SpaceFace& one, const SpaceFace& two) { return one.is_same(two); });
  }
};

/// A number at a point, or the reason why it has none, as a sentence without a subject.
using SpaceFormula = std::function<std::variant<double, std::string>(const Eigen::Vector3d&)>;

struct SpaceSupport {
  /// Along what it holds: the axes; or the outward normals of a face, or one direction, of which `displacement` has the
  /// first number.
  enum class Axes { xyz, normal, direction };
  std::string name;
  bool named = false;  ///< by the user, so that steps give it a factor
  SpaceFace on;        ///< a face, an edge, a point or a set of nodes of an elastic body; or a rigid body
  Axes axes = Axes::xyz;
  Eigen::Vector3d along = Eigen::Vector3d::Zero();    ///< the direction, of length 1
  std::array<std::optional<double>, 3> displacement;  ///< length, at factor 1; none: free
  std::array<SpaceFormula, 3> shape;  ///< of a face: the displacement at a point is that above times this
  // Of a rigid body; `displacement` is then that of the point `at`.
  std::array<std::optional<double>, 3> rotation;  ///< about the axes, radians, at factor 1; none: free
  std::optional<Eigen::Vector3d> at;              ///< none: its centroid
  Stay stay;
  bool placed = false;  ///< it has begun in the run of `restart`, so that it holds its place where that was then

  /// Whether it does not hold its place as it is drawn from beginning to end: it is then pairs with the ground.
  bool is_staged() const { return stay.is_staged() || placed; }
};

/// Springs between a body and the ground.
struct SpaceSpring {
  std::string name;  ///< given by the user, or that of the place, made unique
  SpaceFace on;      ///< a face, an edge, a point or a set of nodes; or a rigid body, at whose centroid they act
  bool along_face = true;
  double normal = 0.0, tangential = 0.0;  ///< of a face, force / length^3
  /// Of nodes, a point or a body, along the axes, force / length; of an edge, force / length^2.
  Eigen::Vector3d stiffness = Eigen::Vector3d::Zero();
  Eigen::Vector3d at_rest = Eigen::Vector3d::Zero();  ///< where they are without force; of a face [along n, 0, 0]
};

struct SpaceLoad {
  /// Force: the total over a face, as a constant traction, or along an edge, as a constant force per length; at a
  /// point; or on a rigid body at its centroid. Line load: force per length of an edge. Moment: on a face as the
  /// traction w x (point - centroid of the face), which has no resultant; about the centroid of a rigid body. Nodal
  /// force: at every node of a set.
  enum class Kind { pressure, traction, force, line_load, nodal_force, moment, gravity, temperature, at_rest };
  std::string name;
  Kind kind = Kind::pressure;
  SpaceFace on;           ///< of gravity and temperature a body; without one, all of them
  double pressure = 0.0;  ///< against the outward normal
  /// Traction, force, line load, moment or acceleration; gradient of a temperature.
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> at;  ///< of a force: the point through which it acts; none: the centroid
  double constant = 0.0;              ///< of a change of temperature: at the origin
  int spring = -1;                    ///< that is at rest elsewhere
  std::array<SpaceFormula, 3>
      formula;  ///< of a traction or line load, or the first one of a pressure, instead of the value

  bool varies() const { return formula[0] || formula[1] || formula[2]; }
};

/// A bar as of the plane (model/bar.hpp), along the line between its ends as they are drawn.
struct SpaceBar {
  /// A face, an edge or a set of nodes, whose mean displacement it has; a point of a body, its node nearest to `at` or
  /// the point itself if it is rigid; or a point of the ground.
  struct End {
    std::optional<SpaceFace> on;
    int body = -1;  ///< without `on`; -1: the ground
    Eigen::Vector3d at = Eigen::Vector3d::Zero();

    int of_body() const { return on ? on->body : body; }
  };
  std::string name;
  std::array<End, 2> between;
  std::optional<double> stiffness;  ///< force / length, > 0; none: that of area, young and length
  double area = 0.0, young = 0.0;   ///< length^2, force / length^2, > 0
  double preload = 0.0;  ///< tension at the end of the step in which it is tightened; 0: it acts from the start
  int tightened = 0;     ///< index of that step; negative: of the run from which this one starts
  Source source;

  /// Its name at the end of a run, where bolts are by the names of their bodies.
  std::string name_at_end() const { return "bar " + name; }
};

/// Coefficients of friction that differ along two directions of the faces.
struct SpaceFrictionAxes {
  Eigen::Vector3d direction;  ///< of length 1; along its projection on the faces the coefficient is that of the law
  double across = 0.0;        ///< at right angles to it
};

/// Also a tie: its law is a bond.
struct SpaceContact {
  std::string name;
  SpaceFace a, b;
  bool tied = false;
  Contact law;  ///< as of a contact of the plane; its sides, gap, step and point have no meaning
  std::optional<SpaceFrictionAxes> friction_axes;
  double gap = 0.0;  ///< added to that of the meshes; negative: an interference
  /// Index of the step over which interferences, negative gaps of pairs, grow from 0 to their values; -1: they are
  /// there from the start.
  int fit_in = -1;
  Eigen::Vector3d about = Eigen::Vector3d::Zero();  ///< point to which the moment of the contact forces refers
};

/// A point of `output: {points: ...}`.
struct SpacePoint {
  std::string name;
  Eigen::Vector3d at;
  int body = -1;  ///< the one that is meant; -1: every body in which it lies
  Source source;
};

/// `points` equally spaced points from `from` to `to`, both included.
struct SpaceLine {
  std::string name;
  Eigen::Vector3d from, to;
  int points = 101;  ///< 2 or more
  int body = -1;     ///< the one that is meant; -1: every body in which a point lies
  Source source;

  double part_at(int k) const { return static_cast<double>(k) / (points - 1); }
  Eigen::Vector3d at(int k) const { return k + 1 == points ? to : Eigen::Vector3d(from + part_at(k) * (to - from)); }
};

/// A plane section of `output: {history: ...}`, whose resultants are wanted.
struct SpaceSection {
  std::string name;
  Eigen::Vector3d point, normal;         ///< of the plane; the latter of length 1
  std::optional<Eigen::Vector3d> about;  ///< of the moment; none: the centroid of the section
  int body = -1;                         ///< -1: every elastic body that the plane cuts
  Source source;
};

/// A face of `output: {history: ...}`: the resultant of all that acts on its body through it is wanted.
struct SpaceFaceResultant {
  std::string name;
  SpaceFace on;
  Eigen::Vector3d about = Eigen::Vector3d::Zero();  ///< point of the moment
};

/// A displacement of `output: {history: ...}`, of a point or of one relative to another one; indices of points.
struct SpaceDisplacement {
  std::string name;
  int point = -1, relative_to = -1;
};

/// A number of `output: {history: ...}`.
struct SpaceQuantity {
  /// Of a contact: its force on b and the parts of it, moment, largest pressure and gap, numbers of pairs; of a
  /// support; of springs; of a bolt; of a point; of the model.
  enum class Kind {
    force,
    normal_force,
    tangential_force,
    contact_moment,
    max_pressure,
    max_gap,
    open,
    stick,
    slip,
    broken,
    reaction,
    support_moment,
    spring_force,
    tension,
    shortening,
    bar_tension,
    displacement,
    stress,
    principal,
    von_mises,
    elastic_energy,
    external_energy,
    friction_energy
  };
  std::string name;
  Kind kind = Kind::elastic_energy;
  int of = -1;        ///< index of the contact, support, springs, body, bar or point
  int component = 0;  ///< of a vector; of a stress xx, yy, zz, xy, yz, xz
};

struct SpaceModel {
  std::string file, title;
  std::vector<std::string> files;           ///< that it names
  std::shared_ptr<const std::string> text;  ///< of the model file
  std::vector<SpaceMaterial> materials;
  std::vector<SpaceBody> bodies;
  std::vector<SpaceSupport> supports;
  std::vector<SpaceSpring> springs;
  std::vector<SpaceLoad> loads;
  std::vector<SpaceBar> bars;
  std::vector<SpaceContact> contacts;
  std::vector<Curve> curves;
  std::vector<Step> steps;         ///< counted ones
  std::optional<Restart> restart;  ///< of a run at rest
  std::vector<SpacePoint> points;
  std::vector<SpaceLine> lines;
  std::vector<SpaceSection> sections;
  std::vector<SpaceFaceResultant> resultants;
  std::vector<SpaceDisplacement> displacements;
  std::vector<SpaceQuantity> quantities;
  double tolerance = 1e-10;  ///< of the certificate
  bool uniqueness = false;   ///< whether other solutions are searched for
  std::vector<Warning> warnings;
};

}  // namespace scabo::model
