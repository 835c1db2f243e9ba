// `bodies`.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/input/numbers.hpp"
#include "scabo/geometry/outline_checks.hpp"
#include "scabo/input/reading.hpp"
#include "scabo/input/suggestions.hpp"

namespace scabo::input {

namespace {

constexpr double most_superelement_dofs = 20'000;  // dense matrices: 3 GB each at this number
constexpr double most_fem_dofs = 1e6;

constexpr const char* body_example = "{material: concrete, shape: {...}, mesh: {size: 0.1}}";

/// Number of pieces of at most `size` on `length`, without an additional piece due to rounding of their quotient.
double pieces(double length, double size) { return std::max(1.0, std::ceil(length / size * (1.0 - 1e-12))); }

/// Number of degrees of freedom for a mesh size; in floating point, since it may be as large as 1e30.
double estimated_dofs(const Outline& outline, MeshKind kind, double size, int order) {
  if (kind == MeshKind::fem) {
    const double nx = pieces(outline.edges[0].length(), size);
    const double ny = pieces(outline.edges[1].length(), size);
    return 2.0 * ((nx + 1.0) * (ny + 1.0) + nx * (ny + 1.0) + ny * (nx + 1.0));
  }
  double elements = 0.0;
  for (const Edge& edge : outline.edges) elements += pieces(edge.length(), size);
  return 2.0 * order * elements;
}

std::string edge_names(const Outline& outline, const std::vector<int>& indices) {
  std::vector<std::string> names;
  names.reserve(indices.size());
  for (const int i : indices) names.push_back(shown_name(outline.edges[static_cast<std::size_t>(i)]));
  return name_list(names);
}

/// Reports a scaling centre from which the boundary is not entirely visible, with a better one if there is one.
void check_centre(Reading& reading, const Source& at, const Outline& outline, const Vec2& centre, bool given,
                  int corner, const Crack* crack) {
  std::vector<int> unseen = unseen_edges(outline, centre);
  const int count = static_cast<int>(outline.edges.size());
  if (corner >= 0)  // side faces are not divided
    std::erase_if(unseen, [&](int e) { return e == corner || e == (corner + count - 1) % count; });
  if (unseen.empty()) return;
  if (crack != nullptr) {
    reading.report.error(crack->source,
                         fmt::format("from the tip {} of crack '{}', which is the scaling centre, not every point of "
                                     "{} is visible: move the tip, or divide the body into several bodies",
                                     point_text(centre), crack->name, edge_names(outline, unseen)));
    return;
  }
  const auto better = seeing_point(outline);
  const std::string remedy =
      better ? fmt::format("{} mesh.centre: [{:.9g}, {:.9g}], from where the whole boundary is visible",
                           given ? "use" : "give", better->x(), better->y())
             : "the whole boundary is visible from no point: divide the body into several bodies";
  const std::string who = fmt::format("the scaling centre {}{}", point_text(centre), given ? "" : " (the centroid)");
  if (corner < 0 && !is_inside(outline, centre)) {
    reading.report.error(at, fmt::format("{} is not inside the body: {}", who, remedy));
  } else {
    reading.report.error(
        at, fmt::format("not every point of {} is visible from {}: {}", edge_names(outline, unseen), who, remedy));
  }
}

/// Corner of the outline at a point; -1 if there is none.
int corner_at(const Outline& outline, const Vec2& point) {
  for (std::size_t i = 0; i < outline.corners.size(); ++i)
    if ((outline.corners[i].position - point).norm() <= 1e-9 * outline_size(outline)) return static_cast<int>(i);
  return -1;
}

/// The two edges at the scaling centre must be straight.
void check_side_faces(Reading& reading, const Value& at, const Outline& outline, int corner) {
  const auto count = outline.edges.size();
  const auto c = static_cast<std::size_t>(corner);
  for (const std::size_t edge : {c, (c + count - 1) % count})
    if (outline.edges[edge].arc)
      reading.report.error(at, fmt::format("{} is an arc that ends at the scaling centre, where side faces must be "
                                           "straight: use a line there, or move the scaling centre",
                                           shown_name(outline.edges[edge])));
}

}  // namespace

/// `refine: [{near: [0, 0], size: 0.01}, {on: bore, size: 0.02}]`.
std::vector<LocalSize> read_refine(Reading& reading, const Value& value, const Outline* outline) {
  std::vector<LocalSize> sizes;
  const auto items = read_list(reading.report, value, "[{near: [0, 0], size: 0.01}]");
  if (!items) return sizes;
  for (const Value& item : *items) {
    const MapReader map(reading.report, item, {"near", "on", "size"}, "{near: [0, 0], size: 0.01}");
    if (!map.is_map()) continue;
    LocalSize local;
    local.source = item.source();
    if (const auto size = map.need("size")) local.size = read_positive(reading.report, *size).value_or(0.0);
    if (map.has("near") == map.has("on")) {
      reading.report.error(item, "needs either 'near', a point, or 'on', an edge of the body");
      continue;
    }
    if (const auto near = map.get("near")) local.near = read_vector(reading.report, *near);
    if (const auto on = map.get("on"); on && outline != nullptr) {
      const auto name = read_text(reading.report, *on);
      std::vector<std::string> known;
      for (std::size_t e = 0; name && e < outline->edges.size(); ++e) {
        const auto& names = outline->edges[e].names;
        if (std::find(names.begin(), names.end(), *name) != names.end()) local.edge = static_cast<int>(e);
        known.insert(known.end(), names.rbegin(), names.rend());
      }
      if (name && local.edge < 0)
        reading.report.error(*on, fmt::format("the body has no edge named {}{}", quoted_name(*name),
                                              suggestion(*name, known)));
    }
    sizes.push_back(std::move(local));
  }
  return sizes;
}

std::optional<MeshOptions> read_mesh(Reading& reading, const Value& value, const Outline* outline, const Crack* crack,
                                     bool many_parts) {
  Report& report = reading.report;
  const std::size_t before = report.count();
  const MapReader map(report, value, {"size", "order", "kind", "centre", "tolerance", "refine"}, "{size: 0.1, order: 2}");
  MeshOptions mesh;
  mesh.source = value.source();
  if (const auto kind = map.get("kind")) {
    const auto choice = read_choice(report, *kind, {"superelement", "polygons", "quadtree", "fem"});
    if (choice && *choice == "fem") mesh.kind = MeshKind::fem;
    if (choice && *choice == "polygons") mesh.kind = MeshKind::polygons;
    if (choice && *choice == "quadtree") mesh.kind = MeshKind::quadtree;
    if (mesh.kind == MeshKind::fem && outline != nullptr && !outline->rectangle) {
      report.error(*kind, "fem is available only for a shape given as rectangle: use superelement");
    }
  }
  const bool fem = mesh.kind == MeshKind::fem;
  const bool many = mesh.kind == MeshKind::polygons || mesh.kind == MeshKind::quadtree;
  if (many_parts && !many && report.count() == before)
    report.error(value, "a body with holes or regions needs many cells: write kind: polygons or kind: quadtree");
  if (const auto refine = map.get("refine")) {
    if (many)
      mesh.refine = read_refine(reading, *refine, outline);
    else
      map.refuse("refine", "is available for kind: polygons and kind: quadtree only");
  }
  if (many) {
    map.refuse("tolerance", "is not available for many cells in this version: leave it out, and use 'refine'");
    map.refuse("centre", "every cell has a scaling centre of its own: leave 'centre' out");
    if (crack != nullptr)
      report.error(crack->source, "cracks are available only in a body that is one super-element in this version");
  }
  if (fem) map.refuse("tolerance", "only super-elements are refined: leave 'tolerance' out for fem");
  if (const auto tolerance = fem || many ? std::nullopt : map.get("tolerance")) {
    const auto number = read_number(report, *tolerance);
    if (number && *number >= 1e-5 && *number <= 0.5) mesh.tolerance = *number;
    if (number && !mesh.tolerance) {
      report.error(*tolerance, fmt::format("must be from 1e-5 to 0.5, not {}", tolerance->node->text));
    }
  }
  const auto size = map.has("tolerance") && !fem ? map.get("size") : map.need("size");
  if (size) {
    mesh.size = read_positive(report, *size).value_or(0.0);
  } else if (mesh.tolerance && outline != nullptr) {
    for (const Edge& edge : outline->edges) mesh.size = std::max(mesh.size, 0.25 * edge.length());
  }
  if (const auto order = map.get("order")) {
    mesh.order = static_cast<int>(read_integer(report, *order, 1, 16).value_or(2));
    if (fem && mesh.order != 2) {
      report.error(*order, "fem uses 8-node elements of order 2: leave 'order' out");
    }
  }
  if (fem) map.refuse("centre", "only a super-element has a scaling centre: leave 'centre' out for fem");
  if (fem && crack != nullptr)
    report.error(crack->source, "only a super-element can have a crack: leave the crack out, or use superelement");
  if (outline != nullptr) mesh.centre = crack != nullptr ? crack->tip : outline->centroid();
  if (crack != nullptr)
    map.refuse("centre", "the scaling centre of a body with a crack is the tip of the crack: leave 'centre' out");
  const auto centre = fem || many ? std::nullopt : map.get("centre");
  if (centre) {
    const auto point = read_vector(report, *centre);
    if (point) mesh.centre = *point;
  }
  if (report.count() > before || outline == nullptr) return {};
  if (many) return mesh;  // the mesher counts its nodes

  const double dofs = estimated_dofs(*outline, mesh.kind, mesh.size, mesh.order);
  const double most = fem ? most_fem_dofs : most_superelement_dofs;
  if (dofs > most) {
    report.error(size ? *size : value,
                 fmt::format("gives {:.6g} degrees of freedom, but {} at most {:.6g}: use a larger size{}", dofs,
                             fem ? "finite elements may have" : "one super-element may have", most,
                             fem ? "" : " or divide the body"));
    return {};
  }
  if (centre) {
    mesh.centre_corner = corner_at(*outline, mesh.centre);
    if (mesh.centre_corner >= 0) {
      mesh.centre = outline->corners[static_cast<std::size_t>(mesh.centre_corner)].position;
      check_side_faces(reading, *centre, *outline, mesh.centre_corner);
    }
  }
  if (!fem) {
    // Without mesh.centre the remedy is to give one; the position is that of the mesh of the body.
    check_centre(reading, centre ? centre->source() : mesh.source, *outline, mesh.centre, centre.has_value(),
                 mesh.centre_corner, crack);
    if (report.count() > before) return {};
  }
  return mesh;
}

namespace {}  // namespace

std::optional<int> read_material_name(Reading& reading, const Value& value) {
  const auto name = read_text(reading.report, value);
  if (!name || !reading.materials_known) return {};
  const auto found = reading.index_of_material.find(*name);
  if (found == reading.index_of_material.end()) {
    const std::string hint = reading.report.full() ? "" : suggestion(*name, reading.material_names);
    reading.report.error(value, fmt::format("there is no material named {}{}", quoted_name(*name), hint));
    return {};
  }
  return reading.material_index[static_cast<std::size_t>(found->second)];
}

namespace {

/// Reads whether the super-element of a body is unbounded, after its shape and mesh.
void read_outside(Reading& reading, const MapReader& map, Body& body, bool shape_known) {
  const auto outside = map.get("outside");
  if (outside) body.outside = read_flag(reading.report, *outside).value_or(false);
  const auto reference = map.get("reference");
  if (reference && !body.outside) {
    map.refuse("reference", "only a body with outside: true has a reference point: leave it out");
  } else if (reference) {
    body.reference = read_vector(reading.report, *reference);
    if (body.reference && shape_known && is_inside(body.outline, *body.reference)) {
      reading.report.error(*reference, fmt::format("{} lies in the hole, not in the body: choose a point of the body",
                                                   point_text(*body.reference)));
      body.reference.reset();
    }
  }
  if (!body.outside) return;
  map.refuse("cracks", "cracks in a body with outside: true are not available in this version: leave them out");
  if (body.mesh.kind == MeshKind::polygons || body.mesh.kind == MeshKind::quadtree)
    map.refuse("outside", "an unbounded body is one super-element in this version: leave 'kind' out");
  if (body.mesh.kind == MeshKind::fem)
    map.refuse("outside", "finite elements cannot model an unbounded body: use superelement");
}

/// Reverses the outline of an unbounded body, so that its material is again on the left.
void turn_outside(Body& body) {
  const int count = static_cast<int>(body.outline.edges.size());
  turn_round(body.outline);
  std::reverse(body.sector_materials.begin(), body.sector_materials.end());
  if (body.mesh.centre_corner >= 0) body.mesh.centre_corner = (count - body.mesh.centre_corner) % count;
}

void read_body(Reading& reading, const Entry& entry) {
  Report& report = reading.report;
  const MapReader map(
      report, entry.value,
      {"material", "shape", "holes", "regions", "mesh", "rigid", "cracks", "sectors", "outside", "reference"},
      body_example, {{"file", "describe the body with shape"}});
  Body body;
  BodyState state;
  body.name = entry.key;
  body.source = entry.key_source;
  state.held = !map.is_map();  // reported already; supports are then not checked
  const auto rigid_value = map.get("rigid");
  const auto rigid = rigid_value ? read_flag(report, *rigid_value) : std::optional(false);
  body.rigid = rigid.value_or(false);
  const auto shape = map.need("shape");
  if (shape) {
    if (auto outline = read_shape(reading, *shape)) {
      body.outline = std::move(*outline);
      state.shape = true;
    }
  }
  if (const auto holes = map.get("holes"); holes && state.shape) state.shape = read_holes(reading, *holes, body.outline);
  if (body.rigid) {
    for (const char* key : {"material", "mesh", "cracks", "sectors", "outside", "reference", "regions"}) {
      map.refuse(key, "does not apply to a rigid body: leave it out");
    }
  } else if (rigid) {  // otherwise the required keys are not known
    if (const auto material = map.need("material")) body.material = read_material_name(reading, *material).value_or(-1);
    state.material = body.material >= 0;
    if (const auto regions = map.get("regions")) read_regions(reading, *regions, body, state.shape);
    if (const auto cracks = map.get("cracks"); cracks && state.shape) {
      auto read = read_cracks(reading, *cracks, body);
      if (read)
        body.cracks = std::move(*read);
      else
        state.shape = false;
    }
    if (const auto mesh = map.need("mesh")) {
      const auto options = read_mesh(reading, *mesh, state.shape ? &body.outline : nullptr,
                                     body.cracks.empty() ? nullptr : &body.cracks.front(),
                                     map.has("holes") || map.has("regions"));
      if (options)
        body.mesh = *options;
      else if (mesh->node->kind == Node::Kind::map && mesh->node->find("centre"))
        state.shape = false;  // side faces are not known
    }
    if (const auto sectors = map.get("sectors"); sectors && state.shape) {
      if (body.mesh.kind != MeshKind::superelement)
        map.refuse("sectors", "only a body that is one super-element has sectors: use 'regions' instead");
      else
        body.sector_materials = read_sectors(reading, *sectors, body).value_or(std::vector<int>{});
    }
    read_outside(reading, map, body, state.shape);
    if (body.outside) {
      state.held = true;
      if (state.shape) turn_outside(body);
    }
  }
  reading.index_of_body.emplace(body.name, static_cast<int>(reading.model.bodies.size()));
  reading.model.bodies.push_back(std::move(body));
  reading.bodies.push_back(state);
}

}  // namespace

int Reading::body_index(std::string_view name) const {
  const auto found = index_of_body.find(std::string(name));
  return found == index_of_body.end() ? -1 : found->second;
}

void read_bodies(Reading& reading, const Value& value) {
  const std::size_t before = reading.report.count();
  const auto entries = read_named(reading.report, value, "bodies", fmt::format("{{beam: {}}}", body_example));
  // A body with an invalid name is not in the list, but others may refer to it.
  if (reading.report.count() > before) reading.bodies_known = false;
  if (value.node->kind == Node::Kind::map && value.node->entries.empty()) {
    reading.report.error(value, "contains no body: define at least one");
  }
  for (const Entry& entry : entries) read_body(reading, entry);
  const bool all_rigid = std::all_of(reading.model.bodies.begin(), reading.model.bodies.end(),
                                     [](const Body& body) { return body.rigid; });
  if (!reading.model.bodies.empty() && all_rigid && reading.bodies_known) {
    reading.report.error(value, "all bodies are rigid: at least one must be elastic");
  }
}

}  // namespace scabo::input
