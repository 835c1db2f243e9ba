// Bodies: shape, materials, cracks, and how they are divided into elements and cells.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scabo/base/error.hpp"
#include "scabo/base/types.hpp"
#include "scabo/files/imported_mesh.hpp"
#include "scabo/geometry/plane/outline.hpp"
#include "scabo/model/image_shape.hpp"

namespace scabo::model {

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

struct Body {
  std::string name;
  bool rigid = false;                 ///< an obstacle or a punch, without material and mesh
  int material = -1;                  ///< index into Model::materials; -1 for a rigid body
  std::optional<double> density;      ///< of a rigid body, mass / length^3, >= 0: needed in time and for its weight
  std::optional<double> thickness;    ///< plane stress: length, > 0; empty: that of the analysis
  Outline outline;                    ///< with the material on its left
  MeshOptions mesh;                   ///< unused for a rigid body
  std::vector<Crack> cracks;          ///< at most one of one super-element, and all with a path in others
  std::vector<Region> regions;        ///< beside each other, or one inside another: the smallest one counts
  std::vector<int> sector_materials;  ///< per edge: its sector's index into Model::materials; empty: `material`
  /// The mesh of the body, from a file (imported_body.hpp): facet_sets[i] has the sides along edge i of the outline, in
  /// their order.
  std::shared_ptr<const files::ImportedMesh> imported;
  std::vector<int> region_materials;  ///< of imported->regions, index into Model::materials
  std::optional<ImageShape> image;    ///< divided by a quadtree; the outline is its rectangle_of()
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

}  // namespace scabo::model
