// `bodies`.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/plane/outline_checks.hpp"
#include "scabo/input/reading.hpp"
#include "scabo/input/suggestions.hpp"

namespace scabo::input {

namespace {

constexpr const char* body_example = "{material: concrete, shape: {...}, mesh: {size: 0.1}}";

/// Corner of the outline at a point; -1 if there is none.
int corner_at(const Outline& outline, const Vec2& point) {
  for (std::size_t i = 0; i < outline.corners.size(); ++i)
    if ((outline.corners[i].position - point).norm() <= 1e-9 * outline_size(outline)) return static_cast<int>(i);
  return -1;
}

/// `size: auto`.
bool is_automatic(const Value& value) { return value.node->kind == Node::Kind::scalar && value.node->text == "auto"; }

/// Of the first mesh of a body whose size follows from a wanted error.
double first_size(const Outline* outline) {
  constexpr double cells_along_body = 8.0;
  return outline == nullptr ? unread : outline_size(*outline) / cells_along_body;
}

}  // namespace

void check_automatic_sizes(Reading& reading) {
  for (const Value& size : reading.automatic_sizes)
    reading.report.error(size,
                         "follows from a wanted error, and none is given: add 'tolerance' to this mesh, as in "
                         "tolerance: 0.01, or a tolerance of one number to the model");
}

/// `refine: [{near: [0, 0], size: 0.01}, {on: bore, size: 0.02, growth: 0.1}]`.
std::vector<LocalSize> read_refine(Reading& reading, const Value& value, const Outline* outline) {
  std::vector<LocalSize> sizes;
  const auto items = read_list(reading.report, value, "[{near: [0, 0], size: 0.01}]");
  if (!items) return sizes;
  for (const Value& item : *items) {
    const MapReader map(reading.report, item, {"near", "on", "size", "growth"}, "{near: [0, 0], size: 0.01}");
    if (!map.is_map()) continue;
    LocalSize local;
    local.source = item.source();
    local.size = number_or_unread(reading, map.need("size"));
    if (const auto growth = map.get("growth")) local.growth = number_or_unread(reading, growth);
    if (map.has("near") == map.has("on")) {
      reading.report.error(item, "needs either 'near', a point, or 'on', an edge of the body");
      continue;
    }
    if (const auto near = map.get("near"))
      local.near = read_vector(reading.report, *near).value_or(Vec2::Constant(unread));
    if (const auto on = map.get("on")) {
      const auto name = read_text(reading.report, *on);
      if (!name || outline == nullptr) continue;
      std::vector<std::string> known;
      for (std::size_t e = 0; e < outline->edges.size(); ++e) {
        const auto& names = outline->edges[e].names;
        if (std::find(names.begin(), names.end(), *name) != names.end()) local.edge = static_cast<int>(e);
        known.insert(known.end(), names.rbegin(), names.rend());
      }
      if (local.edge < 0)
        reading.report.error(
            *on, fmt::format("the body has no edge named {}{}", quoted_name(*name), suggestion(*name, known)));
    }
    sizes.push_back(std::move(local));
  }
  return sizes;
}

MeshOptions read_mesh(Reading& reading, const Value& value, const Outline* outline, const Crack* crack) {
  Report& report = reading.report;
  const MapReader map(report, value, {"size", "min_size", "order", "kind", "centre", "tolerance", "refine"},
                      "{size: 0.1, order: 2}");
  MeshOptions mesh;
  mesh.source = value.source();
  if (reading.model.analysis.revolved()) mesh.kind = MeshKind::fem;
  if (const auto kind = map.get("kind")) {
    const auto choice = read_choice(report, *kind, {"superelement", "polygons", "quadtree", "fem"});
    if (choice && *choice == "superelement") mesh.kind = MeshKind::superelement;
    if (choice && *choice == "fem") mesh.kind = MeshKind::fem;
    if (choice && *choice == "polygons") mesh.kind = MeshKind::polygons;
    if (choice && *choice == "quadtree") mesh.kind = MeshKind::quadtree;
  }
  const bool fem = mesh.kind == MeshKind::fem;
  const bool many = mesh.kind == MeshKind::polygons || mesh.kind == MeshKind::quadtree;
  if (const auto refine = map.get("refine")) mesh.refine = read_refine(reading, *refine, outline);
  if (many) map.refuse("centre", "every cell has a scaling centre of its own: leave 'centre' out");
  if (const auto tolerance = map.get("tolerance")) mesh.tolerance = number_or_unread(reading, tolerance);
  const auto size = map.has("tolerance") && !fem && !many ? map.get("size") : map.need("size");
  const bool automatic = size && is_automatic(*size);
  mesh.size = automatic ? first_size(outline) : number_or_unread(reading, size);
  if (automatic && !mesh.tolerance) reading.automatic_sizes.push_back(*size);
  if (const auto least = map.get("min_size")) mesh.min_size = number_or_unread(reading, least);
  if (!size && mesh.tolerance && outline != nullptr) {
    mesh.size = 0.0;
    for (const Edge& edge : outline->edges) mesh.size = std::max(mesh.size, 0.25 * edge.length());
  }
  if (const auto order = map.get("order"))
    mesh.order = static_cast<int>(read_integer(report, *order, limits::order).value_or(2));

  if (fem) map.refuse("centre", "only a super-element has a scaling centre: leave 'centre' out for fem");
  if (crack != nullptr)
    map.refuse("centre", "the scaling centre of a body with a crack is the tip of the crack: leave 'centre' out");
  if (outline == nullptr) return mesh;
  mesh.centre = crack != nullptr ? crack->tip : outline->centroid();
  const auto centre = fem || many || crack != nullptr ? std::nullopt : map.get("centre");
  if (!centre) return mesh;
  mesh.centre = read_vector(report, *centre).value_or(Vec2::Constant(unread));
  mesh.centre_corner = corner_at(*outline, mesh.centre);
  if (mesh.centre_corner >= 0) mesh.centre = outline->corners[static_cast<std::size_t>(mesh.centre_corner)].position;
  return mesh;
}

std::optional<int> read_material_name(Reading& reading, const Value& value) {
  const auto name = read_text(reading.report, value);
  if (!name || !reading.materials_known) return {};
  const auto found = reading.index_of_material.find(*name);
  if (found == reading.index_of_material.end()) {
    std::vector<std::string> names;
    if (!reading.report.full())
      for (const Material& material : reading.model.materials) names.push_back(material.name);
    const std::string hint = suggestion(*name, names);
    reading.report.error(value, fmt::format("there is no material named {}{}", quoted_name(*name), hint));
    return {};
  }
  return found->second;
}

namespace {

/// Reads whether the super-element of a body is unbounded.
void read_outside(Reading& reading, const MapReader& map, Body& body) {
  if (const auto outside = map.get("outside")) body.outside = read_flag(reading.report, *outside).value_or(false);
  if (const auto reference = map.get("reference"))
    body.reference = read_vector(reading.report, *reference).value_or(Vec2::Constant(unread));
}

/// Reverses the outline of an unbounded body, so that its material is again on the left.
void turn_outside(Body& body) {
  const int count = static_cast<int>(body.outline.edges.size());
  turn_round(body.outline);
  std::reverse(body.sector_materials.begin(), body.sector_materials.end());
  if (body.mesh.centre_corner >= 0) body.mesh.centre_corner = (count - body.mesh.centre_corner) % count;
}

/// A body without its own scaling centre whose centroid does not see its boundary: another centre, or several parts.
void choose_centre(Body& body) {
  const bool parts = !body.outline.holes.empty() || !body.regions.empty();
  if (!parts && geometry::unseen_edges(body.outline, body.mesh.centre).empty()) return;
  const auto seeing = parts ? std::nullopt : geometry::seeing_point(body.outline);
  if (seeing)
    body.mesh.centre = *seeing;
  else
    body.mesh.kind = body.mesh.tolerance ? MeshKind::polygons : MeshKind::parts;  // parts are too large to refine
}

/// One super-element has one straight crack, and neither holes nor regions.
bool needs_cells_for_cracks(const Body& body) {
  if (body.cracks.empty() || body.outside || !body.sector_materials.empty()) return false;
  return body.cracks.size() > 1 || !body.cracks.front().path.empty() || !body.outline.holes.empty() ||
         !body.regions.empty();
}

void add_body(Reading& reading, Body body, const BodyState& state) {
  if (!reading.index_of_body.emplace(body.name, static_cast<int>(reading.model.bodies.size())).second) {
    reading.report.error(body.source,
                         fmt::format("there is already a body named '{}': choose another name", body.name));
    return;
  }
  reading.model.bodies.push_back(std::move(body));
  reading.bodies.push_back(state);
}

/// How a copy lies: moved, or turned about a centre.
struct Motion {
  Vec2 by = Vec2::Zero();
  double degrees = 0.0;
  Vec2 centre = Vec2::Zero();

  double radians() const { return degrees * std::numbers::pi / 180.0; }
  Vec2 operator()(const Vec2& x) const {
    if (degrees == 0.0) return x + by;
    const double quarters = std::round(degrees / 90.0);  // which are exact
    const double rest = (degrees - 90.0 * quarters) * std::numbers::pi / 180.0, c = std::cos(rest), s = std::sin(rest);
    Vec2 arm = x - centre;
    arm = Vec2(c * arm.x() - s * arm.y(), s * arm.x() + c * arm.y());
    for (int quarter = static_cast<int>(std::remainder(quarters, 4.0)); quarter != 0; quarter += quarter < 0 ? 1 : -1)
      arm = quarter > 0 ? Vec2(-arm.y(), arm.x()) : Vec2(arm.y(), -arm.x());
    return centre + arm;
  }
};

void move(Outline& outline, const Motion& motion) {
  for (Edge& edge : outline.edges) {
    edge.start = motion(edge.start);
    edge.end = motion(edge.end);
    if (edge.arc) {
      edge.arc->centre = motion(edge.arc->centre);
      if (motion.degrees != 0.0) edge.arc->start_angle += motion.radians();
    }
    for (Vec2& point : edge.points) point = motion(point);
  }
  for (Corner& corner : outline.corners) corner.position = motion(corner.position);
  outline.rectangle = outline.rectangle && motion.degrees == 0.0;
}

Body moved(Body body, const Motion& motion) {
  move(body.outline, motion);
  for (Region& region : body.regions) move(region.outline, motion);
  for (Crack& crack : body.cracks) {
    crack.tip = motion(crack.tip);
    crack.mouth = motion(crack.mouth);
    for (Vec2& point : crack.path) point = motion(point);
  }
  body.mesh.centre = motion(body.mesh.centre);
  if (body.imported) {
    auto mesh = std::make_shared<files::ImportedMesh>(*body.imported);
    for (Vec2& node : mesh->nodes) node = motion(node);
    body.imported = std::move(mesh);
  }
  for (LocalSize& local : body.mesh.refine)
    if (local.near) local.near = motion(*local.near);
  return body;
}

struct Copies {
  std::vector<Body> bodies;  ///< row by row
  std::size_t rows = 0;      ///< 0 with one count
};

/// `repeat: {count: 12, centre: [0, 0], angle: 30}`: copies around a centre.
Copies copies_around(Reading& reading, const MapReader& map, const Body& body) {
  const std::size_t before = reading.report.count();
  if (map.has("step")) map.refuse("step", "is that of copies along a line, without 'centre' and 'angle'");
  const auto count_value = map.need("count"), centre_value = map.need("centre"), angle_value = map.need("angle");
  const auto count = count_value ? read_integer(reading.report, *count_value, limits::copies) : std::nullopt;
  const auto centre = centre_value ? read_vector(reading.report, *centre_value) : std::nullopt;
  const auto angle = angle_value ? read_number(reading.report, *angle_value) : std::nullopt;
  if (angle && *angle == 0.0) reading.report.error(*angle_value, "must not be 0: the copies would lie on each other");
  if (body.image) reading.report.error(map.map(), "turns copies, and pixels of an image are not turned: give a 'step'");
  Copies copies;
  if (reading.report.count() > before || !count || !centre || !angle) {
    reading.bodies_known = false;
    return copies;
  }
  for (long i = 0; i < *count; ++i) {
    copies.bodies.push_back(moved(body, {Vec2::Zero(), static_cast<double>(i) * *angle, *centre}));
    copies.bodies.back().name += fmt::format("_{}", i + 1);
  }
  return copies;
}

/// `repeat: {count: 3, step: [1, 0]}` gives `block_1`, `block_2`, `block_3`; `{count: [2, 3], step: [[1, 0], [0, 1]]}`
/// gives `block_1_1` to `block_2_3`. Nothing if it is broken.
Copies copies_of(Reading& reading, const Value& value, const Body& body) {
  Report& report = reading.report;
  const std::size_t before = report.count();
  const MapReader map(report, value, {"count", "step", "centre", "angle"}, "{count: 3, step: [1, 0]}");
  if (map.has("centre") || map.has("angle")) return copies_around(reading, map, body);
  const auto count_value = map.need("count"), step_value = map.need("step");
  std::vector<long> counts;
  std::vector<Vec2> steps;
  if (count_value && count_value->node->kind == Node::Kind::sequence) {
    const auto items = read_list(report, *count_value, "[2, 3]");
    for (const Value& item : items.value_or(std::vector<Value>{}))
      counts.push_back(read_integer(report, item, limits::copies).value_or(1));
  } else if (count_value) {
    counts.push_back(read_integer(report, *count_value, limits::copies).value_or(1));
  }
  if (counts.size() == 2 && step_value) {
    const auto items = read_list(report, *step_value, "[[1, 0], [0, 1]]");
    for (const Value& item : items.value_or(std::vector<Value>{}))
      steps.push_back(read_vector(report, item).value_or(Vec2::Zero()));
  } else if (step_value) {
    steps.push_back(read_vector(report, *step_value).value_or(Vec2::Zero()));
  }
  if (report.count() == before && (counts.empty() || counts.size() > 2 || steps.size() != counts.size()))
    report.error(value,
                 "needs one count and one step, as in {count: 3, step: [1, 0]}, or two of each, as in {count: [2, "
                 "3], step: [[1, 0], [0, 1]]}");
  if (report.count() == before && counts.size() == 2 && counts[0] * counts[1] > limits::copies.most)
    report.error(*count_value,
                 fmt::format("gives {} bodies, more than the {} allowed", counts[0] * counts[1], limits::copies.most));
  Copies copies;
  if (report.count() > before) {
    reading.bodies_known = false;
    return copies;
  }
  const bool plane = counts.size() == 2;
  if (plane) copies.rows = static_cast<std::size_t>(counts[1]);
  for (long j = 0; j < (plane ? counts[1] : 1); ++j)
    for (long i = 0; i < counts[0]; ++i) {
      Body copy =
          moved(body, {static_cast<double>(i) * steps[0] + (plane ? static_cast<double>(j) * steps[1] : Vec2(0, 0))});
      copy.name += plane ? fmt::format("_{}_{}", i + 1, j + 1) : fmt::format("_{}", i + 1);
      copies.bodies.push_back(std::move(copy));
    }
  return copies;
}

/// The entry of a shape that names an image; null if it is an outline.
const MapEntry* image_of(const std::optional<Value>& shape) {
  return shape && shape->node->kind == Node::Kind::map ? shape->node->find("image") : nullptr;
}

void read_shape_of(Reading& reading, const Value& shape, ReadBody& read) {
  const MapEntry* image = image_of(shape);
  auto outline = image != nullptr ? read_image(reading, {image->value, shape.path + ".image"}, read.body)
                                  : read_shape(reading, shape);
  if (image != nullptr && shape.node->entries.size() > 1)
    reading.report.error(shape, "an image is the whole shape: leave the other keys out");
  if (!outline) return;
  read.body.outline = std::move(*outline);
  read.state.shape = true;
}

/// Whether a mesh says where the scaling centre is.
bool names_centre(const std::optional<Value>& mesh) {
  return mesh && mesh->node->kind == Node::Kind::map && mesh->node->find("centre");
}

/// The mesh of an elastic body that has a shape, and what follows from both.
void read_mesh_of_shape(Reading& reading, const MapReader& map, bool has_cracks, ReadBody& read) {
  Body& body = read.body;
  const auto mesh = map.need("mesh");
  body.mesh.size = unread;
  if (mesh)
    body.mesh = read_mesh(reading, *mesh, read.state.shape ? &body.outline : nullptr,
                          body.cracks.empty() || !body.cracks.front().path.empty() ? nullptr : &body.cracks.front());
  if (body.mesh.kind == MeshKind::superelement && needs_cells_for_cracks(body)) body.mesh.kind = MeshKind::polygons;
  if (body.mesh.kind != MeshKind::superelement)
    for (Crack& crack : body.cracks)
      if (crack.path.empty()) crack.path = {crack.mouth, crack.tip}, crack.edge = -1;
  if (body.mesh.kind == MeshKind::superelement && !has_cracks && !map.has("outside") && !map.has("sectors") &&
      !names_centre(mesh) && read.state.shape)
    choose_centre(body);
}

/// Materials, cracks, mesh, sectors and surroundings of an elastic body that has a shape.
void read_elastic(Reading& reading, const MapReader& map, bool from_image, ReadBody& read) {
  Body& body = read.body;
  // Also an image that could not be read names the materials.
  if (from_image) map.refuse("material", "the image names the materials: leave 'material' out");
  const auto material = from_image ? std::nullopt : map.need("material");
  if (material) body.material = read_material_name(reading, *material).value_or(-1);
  if (const auto regions = map.get("regions")) read_regions(reading, *regions, body);
  const std::size_t before = reading.report.count();
  const auto cracks = map.get("cracks");
  if (cracks && read.state.shape) body.cracks = read_cracks(reading, *cracks, body);
  read_mesh_of_shape(reading, map, cracks.has_value(), read);
  // Names of side faces, and of the crack, may not be known.
  const bool broken = reading.report.count() > before;
  if (broken && (cracks || names_centre(map.get("mesh")))) read.state.shape = false;
  if (const auto sectors = map.get("sectors"); sectors && read.state.shape)
    body.sector_materials = read_sectors(reading, *sectors, body).value_or(std::vector<int>{});
  read_outside(reading, map, body);
  if (body.outside && !body.outline.edges.empty() && body.outline.holes.empty()) turn_outside(body);
}

/// The copies of a body that `repeat` asks for, or the body alone.
void add_with_copies(Reading& reading, const MapReader& map, ReadBody read) {
  Copies copies;
  const auto repeat = map.get("repeat");
  if (repeat) copies = copies_of(reading, *repeat, read.body);
  const auto states = read_stages(reading, map, read.state, copies.bodies.size(), copies.rows);
  if (!repeat) copies.bodies.push_back(std::move(read.body));
  for (std::size_t i = 0; i < copies.bodies.size(); ++i)
    add_body(reading, std::move(copies.bodies[i]), states ? (*states)[i] : read.state);
}

/// The parts of a mesh file whose cells are not all joined by sides.
void add_parts(Reading& reading, const MapReader& map, std::vector<ReadBody> parts) {
  if (const auto states = read_stages(reading, map, parts.front().state, 0, 0))
    for (ReadBody& part : parts) {
      part.state.added = states->front().added;
      part.state.removed = states->front().removed;
    }
  for (ReadBody& part : parts) add_body(reading, std::move(part.body), part.state);
}

void read_body(Reading& reading, const Entry& entry) {
  Report& report = reading.report;
  const MapReader map(report, entry.value,
                      {"material", "materials", "shape", "holes", "regions", "mesh", "rigid", "cracks", "sectors",
                       "outside", "reference", "repeat", "added", "removed", "file", "density", "thickness"},
                      body_example);
  ReadBody read;
  read.body.name = entry.key;
  read.body.source = entry.key_source;
  read.state.held = !map.is_map();  // reported already; supports are then not checked
  if (const auto thickness = map.get("thickness")) read.body.thickness = number_or_unread(reading, thickness);
  const auto rigid_value = map.get("rigid");
  const auto rigid = rigid_value ? read_flag(report, *rigid_value) : std::optional(false);
  read.body.rigid = rigid.value_or(false);
  const bool from_file = rigid && !read.body.rigid && is_from_file(map.get("mesh"));
  map.refuse("file", "is a key of 'mesh': write mesh: {file: part.msh} instead of shape");
  const auto shape = from_file || map.has("file") ? std::nullopt : map.need("shape");
  if (shape) read_shape_of(reading, *shape, read);
  if (!from_file) map.refuse("materials", "only a body from a mesh file has materials of its regions: use 'material'");
  if (const auto holes = map.get("holes"); holes && read.state.shape)
    read.state.shape = read_holes(reading, *holes, read.body.outline);
  if (read.body.rigid) {
    if (const auto density = map.get("density")) read.body.density = number_or_unread(reading, density);
    for (const char* key : {"material", "mesh", "cracks", "sectors", "outside", "reference", "regions"})
      map.refuse(key, not_for_rigid);
  } else if (!rigid) {  // the required keys are not known
    read.body.rigid = true;
    reading.rigid_known = false;
    read.state.touched = true;
  } else if (from_file) {
    std::vector<ReadBody> parts = read_imported_bodies(reading, map, *map.get("mesh"), std::move(read));
    if (parts.size() > 1) return add_parts(reading, map, std::move(parts));
    read = std::move(parts.front());
  } else {
    read_elastic(reading, map, image_of(shape) != nullptr, read);
  }
  if (!read.body.rigid) map.refuse("density", "belongs to the material of an elastic body");
  add_with_copies(reading, map, std::move(read));
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
  for (const Entry& entry : entries) read_body(reading, entry);
}

}  // namespace scabo::input
