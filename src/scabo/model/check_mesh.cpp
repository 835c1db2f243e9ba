// Validation of the mesh of a body: its sizes, and from where its boundary is visible.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/geometry/plane/outline_checks.hpp"
#include "scabo/geometry/plane/pieces.hpp"
#include "scabo/model/body_check.hpp"

namespace scabo::model {

namespace {

/// Number of pieces of at most `size` on `length`, without an additional piece due to rounding of their quotient.
double pieces(double length, double size) { return std::max(1.0, std::ceil(length / size * (1.0 - 1e-12))); }

/// Number of degrees of freedom for a mesh size; in floating point, since it may be as large as 1e30.
double estimated_dofs(const Outline& outline, const MeshOptions& mesh) {
  if (mesh.kind == MeshKind::fem) {
    const double nx = pieces(outline.edges[0].length(), mesh.size);
    const double ny = pieces(outline.edges[1].length(), mesh.size);
    if (mesh.order == 1) return 2.0 * (nx + 1.0) * (ny + 1.0);
    return 2.0 * ((nx + 1.0) * (ny + 1.0) + nx * (ny + 1.0) + ny * (nx + 1.0));
  }
  double elements = 0.0;
  for (const Edge& edge : outline.edges) elements += pieces(edge.length(), mesh.size);
  return 2.0 * mesh.order * elements;
}

std::string edge_names(const Outline& outline, const std::vector<int>& indices) {
  std::vector<std::string> names;
  names.reserve(indices.size());
  for (const int i : indices) names.push_back(shown_name(outline.edges[static_cast<std::size_t>(i)]));
  return name_list(names);
}

/// What to do about a body that is no single super-element: it becomes several, unless some key requires one.
const char* remedy_for_unseen(const Body& body, bool centre_given) {
  if (body.outside || !body.sector_materials.empty()) return "divide the body into several bodies";
  return centre_given ? "leave 'centre' out, and the body is divided into several super-elements"
                      : "use kind: polygons, which divides the body into many super-elements";
}

/// The whole boundary is visible from the scaling centre; otherwise a better one is suggested if there is one.
void check_visibility(const BodyCheck& of) {
  const Vec2& centre = of.body.mesh.centre;
  std::vector<int> unseen = unseen_edges(of.outline, centre);
  std::erase_if(unseen, [&](int e) { return of.is_side_face(e); });  // side faces are not divided
  if (unseen.empty()) return;
  if (!of.body.cracks.empty()) {
    of.checking.error(of.path, "cracks.0",
                      fmt::format("from the tip {} of crack '{}', which is the scaling centre, not every point of {} "
                                  "is visible: move the tip, or divide the body into several bodies",
                                  point_text(centre), of.body.cracks.front().name, edge_names(of.outline, unseen)));
    return;
  }
  const bool given = (centre - of.outline.centroid()).norm() > 1e-12 * outline_size(of.outline);
  const auto better = seeing_point(of.outline);
  const std::string remedy =
      better ? fmt::format("{} mesh.centre: [{:.9g}, {:.9g}], from where the whole boundary is visible",
                           given ? "use" : "give", better->x(), better->y())
             : fmt::format("the whole boundary is visible from no point: {}", remedy_for_unseen(of.body, given));
  const std::string who = fmt::format("the scaling centre {}{}", point_text(centre), given ? "" : " (the centroid)");
  // Without mesh.centre the remedy is to give one; the mistake is then one of the mesh.
  const char* key = given ? "mesh.centre" : "mesh";
  if (of.centre_corner < 0 && !encloses(of.outline, centre))
    of.checking.error(of.path, key, fmt::format("{} is not inside the body: {}", who, remedy));
  else
    of.checking.error(
        of.path, key,
        fmt::format("not every point of {} is visible from {}: {}", edge_names(of.outline, unseen), who, remedy));
}

/// What bodies of many cells cannot have, and the sizes of their cells.
bool check_many_cells(Checking& checking, const std::string& path, const Body& body) {
  bool good = true;
  const auto refuse = [&](bool given, const char* key, const char* why) {
    if (given) checking.error_of_key(path, key, why), good = false;
  };
  refuse(body.mesh.tolerance.has_value() && body.image, "mesh.tolerance",
         "is not available for a body that an image shows, whose cells are its pixels: leave it out");
  refuse(body.mesh.tolerance.has_value() && body.mesh.kind == MeshKind::parts, "mesh.tolerance",
         "a body that is divided into a few super-elements cannot be refined: write kind: polygons");
  refuse(body.outside && body.mesh.kind != MeshKind::fem, "outside",
         "an unbounded body is one super-element in this version: leave 'kind' out");
  if (!body.cracks.empty() && body.mesh.kind == MeshKind::parts)
    checking.error(path, "cracks.0",
                   "a crack in a body that is divided into several super-elements needs kind: polygons or kind: "
                   "quadtree"),
        good = false;
  refuse(body.imported && !body.regions.empty(), "regions",
         "the regions of a mesh of a file are those of its cells: give them materials with 'materials'");
  refuse(body.image && body.mesh.kind != MeshKind::quadtree, "mesh.kind",
         "a body that an image shows is divided by a quadtree: write kind: quadtree");
  refuse(body.image &&
             !(body.cracks.empty() && body.regions.empty() && body.outline.holes.empty() && body.mesh.refine.empty()),
         "shape", "a body that an image shows has no holes, regions, cracks or 'refine' besides: leave them out");
  for (std::size_t i = 0; i < body.mesh.refine.size(); ++i) {
    const LocalSize& local = body.mesh.refine[i];
    const std::string at = fmt::format("mesh.refine.{}", i);
    good = checking.positive(path, at + ".size", local.size) && good;
    good = checking.within(path, at + ".growth", local.growth, "0.02", "0.5") && good;
    if (local.near) {
      good = checking.vector(path, at + ".near", *local.near) && good;
    } else if (local.edge < 0 || static_cast<std::size_t>(local.edge) >= body.outline.edges.size()) {
      checking.error(path, at + ".on",
                     fmt::format("body '{}' has no edge number {}: it has {}, counted from 0", body.name, local.edge,
                                 body.outline.edges.size()));
      good = false;
    }
  }
  return good;
}

/// `min_size`, of a quadtree; 0 is the default.
bool check_min_size(Checking& checking, const std::string& path, const MeshOptions& mesh) {
  if (mesh.min_size == 0.0) return true;
  if (mesh.kind != MeshKind::quadtree) {
    checking.error_of_key(path, "mesh.min_size",
                          "only a quadtree has a least size of its cells: leave 'min_size' out, or use kind: quadtree");
    return false;
  }
  if (!checking.positive(path, "mesh.min_size", mesh.min_size)) return false;
  if (!(mesh.min_size > mesh.size)) return true;
  checking.error(path, "mesh.min_size",
                 fmt::format("{} is larger than 'size', {}: it is the least size of a cell", number_text(mesh.min_size),
                             number_text(mesh.size)),
                 number_text(mesh.min_size));
  return false;
}

bool check_dofs(const BodyCheck& of) {
  const bool fem = of.body.mesh.kind == MeshKind::fem;
  const double dofs = estimated_dofs(of.outline, of.body.mesh);
  const double most = fem ? 2.0 * limits::model_nodes : limits::superelement_dofs;
  if (dofs <= most) return true;
  of.checking.error(of.path, "mesh.size",
                    fmt::format("gives {:.6g} degrees of freedom, but {} at most {:.6g}: use a larger size{}", dofs,
                                fem ? "finite elements may have" : "one super-element may have", most,
                                fem ? "" : ", or kind: polygons or quadtree"));
  return false;
}

}  // namespace

bool check_side_faces(const BodyCheck& of) {
  const int corner = of.centre_corner;
  if (of.body.mesh.centre_corner == -1) return true;
  if (corner < 0 || corner >= of.edges()) {
    of.checking.error(of.path, "mesh.centre",
                      fmt::format("there is no corner number {}: the outline has {}, counted "
                                  "from 0",
                                  of.body.mesh.centre_corner, of.edges()));
    return false;
  }
  if (!of.body.cracks.empty()) {
    of.checking.error(of.path, "mesh.centre",
                      "the scaling centre of a body with a crack is the tip of the crack: leave 'centre' out");
    return false;
  }
  const Vec2& position = of.outline.corners[static_cast<std::size_t>(corner)].position;
  if (!((position - of.body.mesh.centre).norm() <= 1e-9 * outline_size(of.outline))) {
    of.checking.error(
        of.path, "mesh.centre",
        fmt::format("the scaling centre {} is not at corner {}, which is at {}", point_text(of.body.mesh.centre),
                    of.outline.corners[static_cast<std::size_t>(corner)].names.front(), point_text(position)));
    return false;
  }
  bool good = true;
  for (const int face : {corner, (corner + of.edges() - 1) % of.edges()})
    if (of.edge(face).arc) {
      of.checking.error(of.path, "mesh.centre",
                        fmt::format("{} is an arc that ends at the scaling centre, where side faces must be straight: "
                                    "use a line there, or move the scaling centre",
                                    shown_name(of.edge(face))));
      good = false;
    }
  return good;
}

bool check_mesh_options(Checking& checking, const std::string& path, const Body& body) {
  const MeshOptions& mesh = body.mesh;
  bool good = body.imported || checking.positive(path, "mesh.size", mesh.size);
  if ((mesh.kind == MeshKind::imported) != (body.imported && mesh.kind != MeshKind::fem))
    checking.error(path, "mesh", "cells of a file are super-elements (kind: imported) or finite elements (kind: fem)"),
        good = false;
  good = (body.imported || check_min_size(checking, path, mesh)) && good;
  if (mesh.kind == MeshKind::superelement && (!body.outline.holes.empty() || !body.regions.empty())) {
    checking.error(path, "mesh",
                   "a body with holes or regions is not one super-element: write kind: polygons or kind: quadtree");
    good = false;
  }
  good = checking.whole(path, "mesh.order", mesh.order, limits::order) && good;
  if (mesh.kind == MeshKind::fem) {
    if (good && mesh.order > 2)
      checking.error(path, "mesh.order",
                     fmt::format("fem uses elements of order 1 or 2, not {}: leave 'order' out", mesh.order)),
          good = false;
    if (body.outside && !checking.model.analysis.revolved())
      checking.error_of_key(path, "outside", "finite elements cannot model an unbounded body: use superelement"),
          good = false;
  }
  if (is_divided_inside(body)) good = check_many_cells(checking, path, body) && good;
  if (mesh.tolerance) {
    good = checking.within(path, "mesh.tolerance", *mesh.tolerance, "1e-5", "0.5") && good;
  }
  if (mesh.kind != MeshKind::superelement && !body.sector_materials.empty())
    checking.error_of_key(path, "sectors", "only a body that is one super-element has sectors: use 'regions' instead");
  return good;
}

void check_mesh(const BodyCheck& of, bool values_good) {
  const MeshOptions& mesh = of.body.mesh;
  if (!values_good || is_divided_inside(of.body)) return;  // the mesher counts its nodes
  if (!check_dofs(of) || mesh.kind == MeshKind::fem) return;
  if (!of.checking.vector(of.path, "mesh.centre", mesh.centre)) return;
  if (!of.body.cracks.empty() && mesh.centre != of.body.cracks.front().tip) {
    of.checking.error(of.path, "mesh.centre",
                      "the scaling centre of a body with a crack is the tip of the crack: leave 'centre' out");
    return;
  }
  check_visibility(of);
}

}  // namespace scabo::model
