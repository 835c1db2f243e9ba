// Validation of bodies: material, mesh, scaling centre, cracks, sectors, unbounded bodies.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "scabo/geometry/foot_points.hpp"
#include "scabo/geometry/outline_checks.hpp"
#include "scabo/geometry/pieces.hpp"
#include "scabo/model/checking.hpp"
#include "scabo/model/side_faces.hpp"

namespace scabo::model {

namespace {

/// One body under check; `outline` runs counter-clockwise, for unbounded bodies as well.
struct BodyCheck {
  Checking& checking;
  const Body& body;
  const std::string path;
  const Outline& outline;
  int centre_corner = -1;  // of `outline`

  int edges() const { return static_cast<int>(outline.edges.size()); }
  bool is_side_face(int edge) const { return model::is_side_face(outline, centre_corner, edge); }
  const Edge& edge(int index) const { return outline.edges[static_cast<std::size_t>(index)]; }
};

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

bool check_material(Checking& checking, const std::string& path, std::string_view key, int index) {
  const std::size_t count = checking.model.materials.size();
  if (index >= 0 && static_cast<std::size_t>(index) < count) return true;
  if (!checking.gaps.materials)
    checking.error(path, key,
                   fmt::format("there is no material number {}: the model has {}, counted from 0", index, count));
  return false;
}

bool check_crack(const BodyCheck& of) {
  const Crack& crack = of.body.cracks.front();
  Checking& checking = of.checking;
  const std::string path = of.path + ".cracks.0";
  const std::string& body = of.body.name;
  if (!is_name(crack.name)) {
    checking.error(path, "name",
                   fmt::format("'{}' is not a valid name: use letters, digits, _ and -, and begin with a "
                               "letter or _",
                               crack.name));
    return false;
  }
  bool good = true;
  if (!checking.vector(path, "tip", crack.tip)) {
    good = false;
  } else if (!encloses(of.outline, crack.tip)) {
    checking.error(path, "tip",
                   fmt::format("the tip {} is not inside body '{}': move the tip", point_text(crack.tip), body));
    good = false;
  }
  const double size = outline_size(of.outline);
  if (!checking.vector(path, "mouth", crack.mouth)) {
    good = false;
  } else if (crack.edge < 0 || crack.edge >= of.edges() || !(crack.at >= 0.0 && crack.at < 1.0) ||
             (of.edge(crack.edge).at(crack.at) - crack.mouth).norm() > 1e-9 * size) {
    checking.error(path, "mouth",
                   fmt::format("{} does not lie on the boundary of '{}': place the mouth of the crack on the boundary",
                               point_text(crack.mouth), body));
    good = false;
  } else if (crack.at > 0.0 && std::min((of.edge(crack.edge).start - crack.mouth).norm(),
                                        (of.edge(crack.edge).end - crack.mouth).norm()) < 1e-6 * size) {
    checking.error(path, "mouth",
                   fmt::format("{} is close to a corner of '{}' but not on it: place the mouth on the corner, or "
                               "farther from it",
                               point_text(crack.mouth), body));
    good = false;
  }
  const auto taken = [&](const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), crack.name) != names.end();
  };
  const auto& edges = of.outline.edges;
  const auto& corners = of.outline.corners;
  const bool edge = std::any_of(edges.begin(), edges.end(), [&](const Edge& e) { return taken(e.names); });
  if (edge || std::any_of(corners.begin(), corners.end(), [&](const Corner& c) { return taken(c.names); })) {
    checking.error(path, "",
                   fmt::format("{} of '{}' is also named '{}': give the crack another name",
                               edge ? "an edge" : "a corner", body, crack.name));
    good = false;
  }
  return good;
}

/// The segments of a path as edges.
std::vector<Edge> segments_of(const std::vector<Vec2>& path) {
  std::vector<Edge> segments;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    segments.emplace_back();
    segments.back().start = path[k];
    segments.back().end = path[k + 1];
  }
  return segments;
}

/// The points of a path: inside, and none twice in a row.
bool check_points_of_path(const BodyCheck& of, const std::string& path, const Crack& crack, double tolerance) {
  if (crack.path.size() < 2) {
    of.checking.error(path, "path", "needs two points or more: the ends of the crack");
    return false;
  }
  for (std::size_t k = 0; k < crack.path.size(); ++k) {
    const Vec2& point = crack.path[k];
    if (!of.checking.vector(path, fmt::format("path.{}", k), point)) return false;
    if (!encloses(of.outline, point) && distance_to(of.outline, point) > tolerance) {
      of.checking.error(path, "path",
                        fmt::format("{} lies outside of body '{}': cracks lie inside or end on the boundary",
                                    point_text(point), of.body.name));
      return false;
    }
    if (k > 0 && (point - crack.path[k - 1]).norm() <= 10.0 * tolerance) {
      of.checking.error(path, "path",
                        fmt::format("{} and {} are too close to each other: leave one out",
                                    point_text(crack.path[k - 1]), point_text(point)));
      return false;
    }
  }
  return true;
}

/// A crack meets the boundary with its ends only.
bool check_boundary_of_path(const BodyCheck& of, const std::string& path, const Crack& crack, double tolerance) {
  for (const Edge& segment : segments_of(crack.path))
    for (const Edge& edge : of.outline.edges) {
      const std::vector<Vec2> shared = shared_points(segment, edge, tolerance);
      const bool along = !edge.arc && shared.size() > 1;
      if (along && of.body.imported) continue;  // the file was slit there when it was made
      for (const Vec2& point : shared) {
        const double to_ends = std::min((point - crack.path.front()).norm(), (point - crack.path.back()).norm());
        if (!along && to_ends <= 3.0 * tolerance) continue;
        of.checking.error(path, "path",
                          fmt::format("meets {} at {}, between its ends: cracks lie inside the body, and only their "
                                      "ends may lie on the boundary",
                                      shown_name(edge), point_text(point)));
        return false;
      }
    }
  return true;
}

/// Cracks in a body of many cells.
bool check_paths(const BodyCheck& of) {
  const double tolerance = 1e-9 * outline_size(of.outline);
  std::unordered_set<std::string> names;
  std::vector<std::pair<Edge, std::string>> before;  // segments, and the names of their cracks
  bool good = true;
  for (std::size_t c = 0; c < of.body.cracks.size(); ++c) {
    const Crack& crack = of.body.cracks[c];
    const std::string path = fmt::format("{}.cracks.{}", of.path, c);
    if (!is_name(crack.name)) {
      of.checking.error(path, "name",
                        fmt::format("'{}' is not a valid name: use letters, digits, _ and -, and begin "
                                    "with a letter or _",
                                    crack.name));
      good = false;
    } else if (!names.insert(crack.name).second) {
      of.checking.error(path, "name",
                        fmt::format("there is already a crack named '{}': give every crack a name of its "
                                    "own",
                                    crack.name));
      good = false;
    }
    if (!check_points_of_path(of, path, crack, tolerance) || !check_boundary_of_path(of, path, crack, tolerance)) {
      good = false;
      continue;
    }
    for (const Edge& segment : segments_of(crack.path)) {
      const auto lies_on = [&](const Edge& other) { return shared_points(segment, other, tolerance).size() > 1; };
      const auto other = std::find_if(before.begin(), before.end(), [&](const auto& b) { return lies_on(b.first); });
      if (other != before.end() && good) {
        of.checking.error(path, "path",
                          fmt::format("lies on {} near {}: cracks may cross, but not lie on each other",
                                      other->second == crack.name ? "itself" : "crack '" + other->second + "'",
                                      point_text(segment.start)));
        good = false;
      }
      before.emplace_back(segment, crack.name);
      for (const Region& region : of.body.regions)
        for (const Edge& edge : region.outline.edges)
          if (good && !edge.arc && lies_on(edge)) {
            of.checking.error(path, "path",
                              fmt::format("lies on the border of region '{}' near {}: cracks may cross "
                                          "borders of regions, but not lie on them",
                                          region.name, point_text(segment.start)));
            good = false;
          }
    }
  }
  return good;
}

bool check_cracks(const BodyCheck& of) {
  const auto& cracks = of.body.cracks;
  if (cracks.empty()) return true;
  if (of.body.outside) {
    of.checking.error_of_key(of.path, "cracks",
                             "cracks in a body with outside: true are not available in this version: leave them out");
    return false;
  }
  if (of.body.mesh.kind != MeshKind::superelement) return check_paths(of);
  if (!cracks.front().path.empty()) {
    of.checking.error(
        of.path, "cracks.0",
        "a crack with a 'path' needs many cells: write kind: polygons or kind: quadtree, or give 'tip' and "
        "'mouth' of a straight crack");
    return false;
  }
  if (cracks.size() > 1) {
    of.checking.error(of.path, "cracks.1",
                      "a body that is one super-element has at most one crack: write kind: polygons or kind: quadtree");
    return false;
  }
  return check_crack(of);
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

/// The two edges at a scaling centre on a corner are its side faces, which must be straight.
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

/// What bodies of many cells cannot have, and the sizes of their cells.
bool check_many_cells(Checking& checking, const std::string& path, const Body& body) {
  bool good = true;
  const auto refuse = [&](bool given, const char* key, const char* why) {
    if (given) checking.error_of_key(path, key, why), good = false;
  };
  refuse(body.mesh.tolerance.has_value() && body.image, "mesh.tolerance",
         "is not available for a body that an image shows, whose cells are its pixels: leave it out");
  refuse(body.mesh.tolerance.has_value() && body.mesh.kind == MeshKind::parts, "mesh.tolerance",
         "a body of a few parts is not refined: write kind: polygons");
  refuse(body.outside && body.mesh.kind != MeshKind::fem, "outside",
         "an unbounded body is one super-element in this version: leave 'kind' out");
  if (!body.cracks.empty() && body.mesh.kind == MeshKind::parts)
    checking.error(path, "cracks.0", "a crack in a body of several parts needs kind: polygons or kind: quadtree"),
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

/// Values of the mesh that do not depend on the shape.
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
    if (body.outside)
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

void check_sectors(const BodyCheck& of) {
  const auto& materials = of.body.sector_materials;
  if (materials.empty() || of.body.mesh.kind != MeshKind::superelement) return;
  if (materials.size() != of.body.outline.edges.size()) {
    of.checking.error(of.path, "sectors",
                      fmt::format("gives {} materials for {} edges: one for each edge is needed", materials.size(),
                                  of.body.outline.edges.size()));
    return;
  }
  for (std::size_t i = 0; i < materials.size(); ++i)
    if (materials[i] != of.body.material &&
        !check_material(of.checking, of.path, "sectors." + of.body.outline.edges[i].names.front(), materials[i]))
      return;
}

void check_reference(const BodyCheck& of) {
  if (!of.body.reference) return;
  if (!of.body.outside) {
    of.checking.error_of_key(of.path, "reference",
                             "only a body with outside: true has a reference point: leave it out");
  } else if (of.checking.vector(of.path, "reference", *of.body.reference) && encloses(of.outline, *of.body.reference)) {
    of.checking.error(of.path, "reference",
                      fmt::format("{} lies in the hole, not in the body: choose a point of the "
                                  "body",
                                  point_text(*of.body.reference)));
  }
}

/// Regions lie in the body, at least in part. One may lie inside another, or beside it with a common border.
void check_regions(const BodyCheck& of) {
  const double tolerance = 1e-9 * outline_size(of.outline);
  std::unordered_set<std::string> names;
  std::vector<const Region*> sound;
  for (std::size_t i = 0; i < of.body.regions.size(); ++i) {
    const Region& region = of.body.regions[i];
    const std::string path = path_of(of.path + ".regions", region.name, i);
    check_name(of.checking, path, region.name, "region", names);
    check_material(of.checking, path, "material", region.material);
    if (!check_outline(of.checking, path + ".shape", region.outline)) continue;
    if (!geometry::overlap_of(of.outline, region.outline, tolerance).share_area) {
      of.checking.error(path, "shape",
                        fmt::format("region '{}' lies outside of the body: move it inside", region.name));
      continue;
    }
    bool good = true;
    for (const Region* other : sound) {
      const geometry::Overlap overlap = geometry::overlap_of(other->outline, region.outline, tolerance);
      if (!overlap.share_area || overlap.first_beyond != overlap.second_beyond) continue;
      of.checking.error(
          path, "shape",
          overlap.first_beyond
              ? fmt::format("regions '{}' and '{}' overlap in part, from {} on: a region lies inside another one, or "
                            "beside it, also with a common border",
                            other->name, region.name, point_text(overlap.crossing))
              : fmt::format("regions '{}' and '{}' have the same shape: leave one out", other->name, region.name));
      good = false;
      break;
    }
    if (good) sound.push_back(&region);
  }
}

bool check_region_materials(Checking& checking, const std::string& path, const Body& body) {
  const auto& regions = body.imported->regions;
  if (body.region_materials.size() != regions.size()) {
    checking.error(path, "materials",
                   fmt::format("gives {} materials for {} regions of the mesh: one for each is needed",
                               body.region_materials.size(), regions.size()));
    return false;
  }
  for (std::size_t i = 0; i < regions.size(); ++i)
    if (body.region_materials[i] != body.material &&
        !check_material(checking, path, "materials." + regions[i], body.region_materials[i]))
      return false;
  return true;
}

void check_rigid(Checking& checking, const std::string& path, const Body& body) {
  const auto refuse = [&](const char* key, bool given) {
    if (given) checking.error_of_key(path, key, not_for_rigid);
  };
  refuse("material", body.material != -1);
  refuse("cracks", !body.cracks.empty());
  refuse("sectors", !body.sector_materials.empty());
  refuse("outside", body.outside);
  refuse("reference", body.reference.has_value());
  refuse("regions", !body.regions.empty());
}

void check_body(Checking& checking, std::size_t index) {
  const Body& body = checking.model.bodies[index];
  const std::string path = path_of("bodies", body.name, index);
  Outline turned;
  if (body.outside && body.outline.holes.empty() && body.outline.corners.size() == body.outline.edges.size()) {
    turned = body.outline;
    turn_round(turned);
  }
  const Outline& outline = turned.edges.empty() ? body.outline : turned;
  checking.shape[index] = body.imported ? check_imported(checking, path + ".mesh", body)
                                        : check_outline(checking, path + ".shape", outline);
  if (body.rigid) {
    check_rigid(checking, path, body);
    checking.faces[index] = checking.shape[index];
    return;
  }
  check_material(checking, path, "material", body.material);
  if (body.imported && !check_region_materials(checking, path, body)) checking.shape[index] = false;
  const bool good = check_mesh_options(checking, path, body);
  if (!checking.shape[index]) return;
  BodyCheck of{checking, body, path, outline, body.mesh.centre_corner};
  if (!turned.edges.empty() && of.centre_corner > 0) of.centre_corner = of.edges() - of.centre_corner;
  check_regions(of);
  const bool whole = body.mesh.kind != MeshKind::superelement;  // without side faces
  checking.faces[index] = check_cracks(of) && (whole || check_side_faces(of));
  if (checking.faces[index]) check_mesh(of, good);
  check_sectors(of);
  check_reference(of);
}

}  // namespace

void check_bodies(Checking& checking) {
  const auto& bodies = checking.model.bodies;
  if (checking.gaps.bodies) {
  } else if (bodies.empty()) {
    checking.enter({});
    checking.error("bodies", "", "contains no body: define at least one");
  } else if (std::all_of(bodies.begin(), bodies.end(), [](const Body& body) { return body.rigid; })) {
    checking.enter({});
    checking.error("bodies", "", "all bodies are rigid: at least one must be elastic");
    checking.of_whole();
  }
  std::unordered_set<std::string> names;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    checking.enter(bodies[i].source);
    check_name(checking, path_of("bodies", bodies[i].name, i), bodies[i].name, "body", names);
    check_body(checking, i);
  }
}

}  // namespace scabo::model
