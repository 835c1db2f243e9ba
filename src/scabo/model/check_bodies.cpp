// Validation of bodies: material, regions, sectors, unbounded bodies. Cracks and meshes: check_cracks.cpp,
// check_mesh.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/geometry/plane/outline_checks.hpp"
#include "scabo/geometry/plane/pieces.hpp"
#include "scabo/model/body_check.hpp"

namespace scabo::model {

namespace {

bool check_material(Checking& checking, const std::string& path, std::string_view key, int index) {
  const std::size_t count = checking.model.materials.size();
  if (index >= 0 && static_cast<std::size_t>(index) < count) return true;
  if (!checking.gaps.materials)
    checking.error(path, key,
                   fmt::format("there is no material number {}: the model has {}, counted from 0", index, count));
  return false;
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
    if (!check_outline(of.checking, path + ".shape", region.outline, outline_size(of.outline))) continue;
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

/// Of plane stress alone: in plane strain all bodies fill the same length.
void check_thickness(Checking& checking, const std::string& path, const Body& body) {
  if (!body.thickness || !checking.positive(path, "thickness", *body.thickness)) return;
  if (checking.model.analysis.revolved())
    checking.error_of_key(path, "thickness",
                          "bodies of revolution go around the axis as a whole: leave 'thickness' out");
  else if (checking.model.analysis.plane == Plane::strain)
    checking.error_of_key(
        path, "thickness",
        "in plane strain all bodies have the length 'analysis.thickness': leave it out, and of a "
        "body that fills a part of this length, as piles do, give that part of 'young' and 'density'");
}

void check_body(Checking& checking, std::size_t index) {
  const Body& body = checking.model.bodies[index];
  const std::string path = path_of("bodies", body.name, index);
  check_thickness(checking, path, body);
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
  }
  std::unordered_set<std::string> names;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    checking.enter(bodies[i].source);
    check_name(checking, path_of("bodies", bodies[i].name, i), bodies[i].name, "body", names);
    check_body(checking, i);
  }
}

}  // namespace scabo::model
