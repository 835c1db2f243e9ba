// `materials` and `bodies`.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/model/numbers.hpp"
#include "scabo/model/outline_checks.hpp"
#include "scabo/model/reading.hpp"
#include "scabo/model/suggestions.hpp"

namespace scabo::model {

namespace {

constexpr double most_superelement_dofs = 20'000;  // dense matrices: 3 GB each at this number
constexpr double most_fem_dofs = 1e6;

constexpr const char* material_example = "{young: 10e9, poisson: 0.3}";
constexpr const char* body_example = "{material: concrete, shape: {...}, mesh: {size: 0.1}}";

std::optional<double> read_poisson(Reading& reading, const Value& value) {
  const auto poisson = read_number(reading.report, value);
  if (!poisson) return {};
  const bool strain = reading.model.analysis.plane == Plane::strain;
  if (*poisson > -1.0 && (*poisson < 0.5 || (!strain && *poisson == 0.5))) return poisson;
  const char* range = strain ? "greater than -1 and less than 0.5 (plane strain)"
                             : "greater than -1 and at most 0.5 (plane stress)";
  reading.report.error(value, fmt::format("must be {}, not {}{}", range, value.node->text,
                                          *poisson == 0.5 ? ": use 0.4999 for incompressible material" : ""));
  return {};
}

std::optional<Material> read_material(Reading& reading, const Entry& entry) {
  const std::size_t before = reading.report.count();
  const MapReader map(reading.report, entry.value, {"young", "poisson", "density"}, material_example);
  Material material;
  material.name = entry.key;
  material.source = entry.key_source;
  if (const auto value = map.need("young"))
    material.young = read_positive(reading.report, *value).value_or(1.0);
  if (const auto value = map.need("poisson")) material.poisson = read_poisson(reading, *value).value_or(0.0);
  if (const auto value = map.get("density")) material.density = read_not_negative(reading.report, *value);
  if (reading.report.count() > before) return {};
  return material;
}

/// Pieces of at most `size` on `length`, without a piece more for the rounding of their quotient.
double pieces(double length, double size) { return std::max(1.0, std::ceil(length / size * (1.0 - 1e-12))); }

/// Degrees of freedom that a mesh size leads to; in floating point, since 1e30 is a possible answer.
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

/// Reports a scaling centre that does not see the whole boundary, with a better one where there is one.
void check_centre(Reading& reading, const Source& at, const Outline& outline, const Vec2& centre,
                  bool given) {
  const std::vector<int> unseen = unseen_edges(outline, centre);
  if (unseen.empty()) return;
  const auto better = seeing_point(outline);
  const std::string remedy =
      better ? fmt::format("{} mesh.centre: [{:.9g}, {:.9g}], from where the whole boundary is visible",
                           given ? "use" : "give", better->x(), better->y())
             : "no point sees the whole boundary: divide the body into several bodies";
  const std::string who =
      fmt::format("the scaling centre {}{}", point_text(centre), given ? "" : " (the centroid)");
  if (!is_inside(outline, centre)) {
    reading.report.error(at, fmt::format("{} is not inside the body: {}", who, remedy));
  } else {
    reading.report.error(at, fmt::format("{} does not see {}: {}", who, edge_names(outline, unseen), remedy));
  }
}

}  // namespace

void read_materials(Reading& reading, const Value& value) {
  const std::size_t before = reading.report.count();
  const auto entries =
      read_named(reading.report, value, "materials", "{concrete: {young: 10e9, poisson: 0.3}}");
  // A material whose name is no name is not in the list, but bodies may speak of it.
  if (reading.report.count() > before) reading.materials_known = false;
  for (const Entry& entry : entries) {
    const auto material = read_material(reading, entry);
    reading.material_names.push_back(entry.key);
    reading.material_index.push_back(material ? static_cast<int>(reading.model.materials.size()) : -1);
    if (material) reading.model.materials.push_back(*material);
  }
}

std::optional<MeshOptions> read_mesh(Reading& reading, const Value& value, const Outline* outline) {
  Report& report = reading.report;
  const std::size_t before = report.count();
  const MapReader map(report, value, {"size", "order", "kind", "centre", "tolerance"},
                      "{size: 0.1, order: 2}");
  MeshOptions mesh;
  mesh.source = value.source();
  if (const auto kind = map.get("kind")) {
    const Later later{{"polygons", "use superelement, one for the whole body"},
                      {"quadtree", "use superelement, one for the whole body"}};
    const auto choice = read_choice(report, *kind, {"superelement", "fem"}, later);
    if (choice && *choice == "fem") mesh.kind = MeshKind::fem;
    if (mesh.kind == MeshKind::fem && outline != nullptr && !outline->rectangle) {
      report.error(*kind, "fem divides only a shape given as rectangle: use superelement");
    }
  }
  const bool fem = mesh.kind == MeshKind::fem;
  if (fem) map.refuse("tolerance", "only a superelement is refined: leave it out for fem");
  if (const auto tolerance = fem ? std::nullopt : map.get("tolerance")) {
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
      report.error(*order, "fem has 8-node elements, of order 2: leave order out");
    }
  }
  if (fem) map.refuse("centre", "a scaling centre belongs to a superelement: leave it out for fem");
  if (outline != nullptr) mesh.centre = outline->centroid();
  const auto centre = fem ? std::nullopt : map.get("centre");
  if (centre) {
    const auto point = read_vector(report, *centre);
    if (point) mesh.centre = *point;
  }
  if (report.count() > before || outline == nullptr) return {};

  const double dofs = estimated_dofs(*outline, mesh.kind, mesh.size, mesh.order);
  const double most = fem ? most_fem_dofs : most_superelement_dofs;
  if (dofs > most) {
    report.error(size ? *size : value,
                 fmt::format("gives {:.6g} degrees of freedom, {} take at most {:.6g}: use a larger size{}",
                             dofs, fem ? "finite elements" : "one super-element can", most,
                             fem ? "" : " or divide the body"));
    return {};
  }
  if (!fem) {
    // Without mesh.centre the remedy is to give one: the body's mesh is where it goes.
    check_centre(reading, centre ? centre->source() : mesh.source, *outline, mesh.centre, centre.has_value());
    if (report.count() > before) return {};
  }
  return mesh;
}

namespace {

void read_material_of(Reading& reading, const Value& value, Body& body, BodyState& state) {
  const auto name = read_text(reading.report, value);
  if (!name || !reading.materials_known) return;
  const auto found = std::find(reading.material_names.begin(), reading.material_names.end(), *name);
  if (found == reading.material_names.end()) {
    reading.report.error(value, fmt::format("no material named {}{}", quoted_name(*name),
                                            suggestion(*name, reading.material_names)));
    return;
  }
  body.material = reading.material_index[static_cast<std::size_t>(found - reading.material_names.begin())];
  state.material = body.material >= 0;
}

void read_body(Reading& reading, const Entry& entry) {
  Report& report = reading.report;
  const MapReader map(
      report, entry.value, {"material", "shape", "mesh", "rigid"}, body_example,
      {{"file", "describe the body with shape"}, {"holes", "divide the body into bodies without holes"}});
  Body body;
  BodyState state;
  body.name = entry.key;
  body.source = entry.key_source;
  state.held = !map.is_map();  // said already; whether it is held is not the question then
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
  if (body.rigid) {
    for (const char* key : {"material", "mesh"}) {
      map.refuse(key, "a rigid body has neither material nor mesh: leave it out");
    }
  } else if (rigid) {  // otherwise nobody knows what it needs
    if (const auto material = map.need("material")) read_material_of(reading, *material, body, state);
    if (const auto mesh = map.need("mesh")) {
      body.mesh = read_mesh(reading, *mesh, state.shape ? &body.outline : nullptr).value_or(MeshOptions{});
    }
  }
  reading.model.bodies.push_back(std::move(body));
  reading.bodies.push_back(state);
}

}  // namespace

int Reading::body_index(std::string_view name) const {
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    if (model.bodies[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

void read_bodies(Reading& reading, const Value& value) {
  const std::size_t before = reading.report.count();
  const auto entries = read_named(reading.report, value, "bodies", fmt::format("{{beam: {}}}", body_example));
  // A body whose name is no name is not in the list, but others may speak of it.
  if (reading.report.count() > before) reading.bodies_known = false;
  if (value.node->kind == Node::Kind::map && value.node->entries.empty()) {
    reading.report.error(value, "holds no body");
  }
  for (const Entry& entry : entries) read_body(reading, entry);
  const bool all_rigid = std::all_of(reading.model.bodies.begin(), reading.model.bodies.end(),
                                     [](const Body& body) { return body.rigid; });
  if (!reading.model.bodies.empty() && all_rigid && reading.bodies_known) {
    reading.report.error(value, "all bodies are rigid: at least one must be elastic");
  }
}

}  // namespace scabo::model
