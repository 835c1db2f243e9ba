// `bodies` of models in space, and places on them.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "scabo/files/read_mesh_file.hpp"
#include "scabo/input/space/space_reader.hpp"
#include "scabo/input/suggestions.hpp"
#include "scabo/model/imported_body.hpp"
#include "scabo/model/nearest_face.hpp"
#include "scabo/model/solid_bodies.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::input {

using namespace model;

std::shared_ptr<const files::ImportedSolidMesh> SpaceReader::mesh_of_file(const Value& value, bool hexahedra) {
  const auto name = read_text(report_, value);
  if (!name) return nullptr;
  const std::string path = (std::filesystem::path(model_.file).parent_path() / *name).string();
  const auto [found, is_new] = meshes_.try_emplace({path, hexahedra});
  if (!is_new) {
    if (!found->second) report_.told_elsewhere(value);
    return found->second;
  }
  try {
    files::ImportedSolidMesh mesh =
        files::read_solid_mesh_file(path, hexahedra ? files::Bricks::kept : files::Bricks::divided);
    for (const std::string& remark : mesh.remarks)
      model_.warnings.push_back({WarningKind::input, path, as_given(remark, path, *name)});
    found->second = std::make_shared<const files::ImportedSolidMesh>(std::move(mesh));
    model_.files.push_back(path);
  } catch (const InputError& error) {
    report_.error(value, as_given(format_diagnostic(error.file(), error.diagnostics().front()), path, *name));
  }
  return found->second;
}

int SpaceReader::material_of(const Value& value) {
  std::vector<std::string> known;
  for (const SpaceMaterial& material : model_.materials) known.push_back(material.name);
  const auto text = read_text(report_, value);
  const auto found = text ? std::find(known.begin(), known.end(), *text) : known.end();
  if (found != known.end()) return static_cast<int>(found - known.begin());
  if (text)
    report_.error(value, fmt::format("there is no material named {}{}", quoted_name(*text), suggestion(*text, known)));
  return -1;
}

/// `{cut: {point: [0, 0, 1], normal: [0, 0, 1]}, force: 50e3}`.
std::optional<SpacePreload> SpaceReader::preload(const Value& value) {
  const MapReader map(report_, value, {"cut", "force", "shortening", "tightened"},
                      "{cut: {point: [0, 0, 1], normal: [0, 0, 1]}, force: 50e3}");
  if (!map.is_map()) return {};
  SpacePreload preload;
  preload.source = value.source();
  if (const auto given = map.need("cut")) {
    const MapReader cut(report_, *given, {"point", "normal"}, "{point: [0, 0, 1], normal: [0, 0, 1]}");
    if (const auto point = cut.need("point")) preload.point = vector(*point);
    const auto normal = cut.need("normal");
    if (normal) preload.normal = vector(*normal);
    if (normal && preload.normal.isZero(0.0)) report_.error(*normal, "has no direction: not all of it may be 0");
    preload.normal.stableNormalize();
  }
  const auto force = map.get("force"), shortening = map.get("shortening");
  if (force) preload.force = number(force);
  if (shortening) preload.shortening = number(shortening);
  if (force.has_value() == shortening.has_value() && map.all_known())
    report_.error(value, "needs either 'force' or 'shortening'");
  if (const auto step = map.get("tightened")) tightened_.emplace_back(model_.bodies.size(), *step);
  return preload;
}

void SpaceReader::body(const Entry& entry) {
  const MapReader map(
      report_, entry.value, {"material", "shape", "mesh", "rigid", "density", "preload", "added", "removed"},
      "{material: steel, shape: {box: {corner: [0, 0, 0], size: [1, 1, 1]}}, mesh: {size: 0.1}}",
      only_in_the_plane({"thickness", "holes", "regions", "sectors", "materials", "outside", "reference", "cracks",
                         "crack", "copies", "repeat", "image", "join", "corners"}));
  stages_.push_back({model_.bodies.size(), map.get("added"), map.get("removed")});
  SpaceBody body;
  body.name = entry.key;
  body.source = entry.value.source();
  if (const auto rigid = map.get("rigid")) body.rigid = read_flag(report_, *rigid).value_or(false);
  if (body.rigid) {
    map.refuse("material", "a rigid body has no material: leave it out, or 'rigid'");
    map.refuse("preload", "is that of an elastic body: leave it out, or 'rigid'");
    body.density = number_from(map.get("density"), 0.0, true);
  } else {
    map.refuse("density", "is that of a rigid body: give it to the material");
    if (const auto name = map.need("material")) body.material = material_of(*name);
    if (const auto given = map.get("preload")) body.preload = preload(*given);
  }
  const auto shape = map.get("shape"), mesh = map.need("mesh");
  if (mesh && !shape) return add_bodies_of_file(*mesh, std::move(body));
  const std::string folder = std::filesystem::path(model_.file).parent_path().string();
  const auto of = shape ? read_solid_shape(report_, *shape, folder) : std::nullopt;
  const std::size_t before = report_.count();
  const auto* simple = of ? std::get_if<SolidShape>(&*of) : nullptr;
  if (simple) body.shape = *simple;
  if (mesh) body.sizes = read_solid_sizes(report_, *mesh, !of || (simple && has_hexahedra(*simple)));
  const auto* cad = of ? std::get_if<CadShape>(&*of) : nullptr;
  if (cad == nullptr || !mesh || report_.count() > before) return model_.bodies.push_back(body);
  add_bodies_of_cad(*shape, *cad, std::move(body));
}

/// Index of a set of cells.
std::optional<int> SpaceReader::region_of(const Value& value, const files::ImportedSolidMesh& mesh) const {
  const auto text = read_text(report_, value);
  if (!text) return {};
  std::vector<std::string> known;
  for (const files::CellSet& set : mesh.cell_sets) {
    if (set.name == *text || name_from(set.name) == *text) return static_cast<int>(known.size());
    known.push_back(set.name);
  }
  report_.error(value, fmt::format("the mesh file has no region or set of cells named {}{}", quoted_name(*text),
                                   suggestion(*text, known)));
  return {};
}

void SpaceReader::add_bodies_of_file(const Value& mesh, SpaceBody body) {
  Later later = only_in_the_plane({"order", "centre", "tolerance", "min_size", "elements"});
  for (const char* key : {"size", "refine"})
    later.emplace_back(key, "it divides a 'shape', and the body has none: give it one, or leave the key out");
  const MapReader keys(report_, mesh, {"file", "region", "kind"}, "{file: part.msh}", later);
  const auto name = keys.need("file"), region = keys.get("region"), kind = keys.get("kind");
  const bool hexahedra = read_solid_kind(report_, kind);
  const auto file = name ? mesh_of_file(*name, hexahedra) : nullptr;
  if (file && hexahedra &&
      std::none_of(file->cells.begin(), file->cells.end(),
                   [](const files::ImportedSolidCell& cell) { return files::sides_of(cell) > 4; }))
    report_.error(*kind, "the file has no hexahedra or wedges: leave 'kind' out");
  const auto choice = file && region ? region_of(*region, *file) : std::optional(-1);
  if (!file || !choice) return model_.bodies.push_back(body);
  add_parts(mesh, solid_bodies(*file, *choice), std::move(body));
}

/// Gmsh divides the shape now, so that the names of its faces are known.
void SpaceReader::add_bodies_of_cad(const Value& shape, const CadShape& cad, SpaceBody body) {
  body.made_of_shape = true;
  try {
    const files::ImportedSolidMesh mesh = divided_cad_shape(cad, body.sizes, model_.file);
    for (const std::string& remark : mesh.remarks) model_.warnings.push_back({WarningKind::input, body.name, remark});
    for (const std::string& path : files_of(cad))
      if (std::find(model_.files.begin(), model_.files.end(), path) == model_.files.end()) model_.files.push_back(path);
    return add_parts(shape, solid_bodies(mesh, -1), std::move(body));
  } catch (const InputError& error) {
    const std::string message = error.diagnostics().front().message;
    report_.error(shape, error.file() == model_.file
                             ? message
                             : fmt::format("{}: {}", std::filesystem::path(error.file()).filename().string(), message));
  }
  model_.bodies.push_back(body);
}

/// Each part is a body: `wall_1`, `wall_2` and so on where there are several.
void SpaceReader::add_parts(const Value& value, std::vector<files::ImportedSolidMesh> parts, SpaceBody body) {
  std::vector<std::string> told;
  const std::string whole = body.name;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (parts.size() > 1) body.name = fmt::format("{}_{}", whole, k + 1);
    const Eigen::Vector3d centre = parts[k].nodes.rowwise().mean();
    constexpr std::size_t most_told = 8;
    if (k < most_told)
      told.push_back(fmt::format("{} at ({:.4g}, {:.4g}, {:.4g})", body.name, centre.x(), centre.y(), centre.z()));
    body.mesh = std::make_shared<const files::ImportedSolidMesh>(std::move(parts[k]));
    for (const SpaceBody& other : model_.bodies)
      if (other.name == body.name)
        report_.error(
            value,
            fmt::format("a part of this file is called '{0}', as is another body: give that another name", body.name));
    model_.bodies.push_back(body);
  }
  if (parts.size() > 1 && body.preload)
    report_.error(value, fmt::format("has {} parts that have no side in common, and a preload is that of one: give "
                                     "one of them to a body of its own",
                                     parts.size()));
  if (parts.size() > 1)
    model_.warnings.push_back(
        {WarningKind::input, whole + " parts",
         fmt::format("body '{}': its cells have {} parts that have no side in common, which "
                     "become bodies of their own: {}{}",
                     whole, parts.size(), fmt::join(told, ", "), parts.size() > told.size() ? ", ..." : "")});
}

/// `{body: block, near: [0, 0, 1]}`: the face that is nearest to the point. `{body: block, normal: [0, 0, 1]}`: the
/// part of the boundary, or of a `face`, that looks in a direction.
std::optional<SpaceFace> SpaceReader::face_found(const Value& value) {
  const MapReader map(report_, value, {"body", "near", "normal", "face", "edge", "point", "at"},  // edge_or_point()
                      "{body: block, near: [0, 0, 1]}");
  const auto name = map.need("body"), near = map.get("near"), normal = map.get("normal"), part = map.get("face");
  if (map.all_known() && near.has_value() == normal.has_value())
    report_.error(value, "needs either 'near', a point, or 'normal', a direction");
  if (near) map.refuse("face", "goes with 'normal': leave it out, or write body.face");
  const std::size_t before = report_.count();
  const auto text = name ? read_text(report_, *name) : std::nullopt;
  const Eigen::Vector3d given = near ? vector(*near) : normal ? vector(*normal) : Eigen::Vector3d::Zero();
  if (!text || near.has_value() == normal.has_value() || report_.count() > before) return {};
  std::vector<std::string> bodies;
  for (const SpaceBody& body : model_.bodies) bodies.push_back(body.name);
  SpaceFace face;
  face.body = static_cast<int>(std::find(bodies.begin(), bodies.end(), *text) - bodies.begin());
  face.source = value.source();
  if (face.body == static_cast<int>(bodies.size())) {
    report_.error(*name, fmt::format("there is no body named {}{}", quoted_name(*text), suggestion(*text, bodies)));
    return {};
  }
  const SpaceBody& of = body_at(face.body);
  if (!of.mesh && !of.shape) return {};  // told with the body
  if (normal) return face_along(*normal, given, part, std::move(face));
  return face_near(*near, given, std::move(face));
}

std::optional<SpaceFace> SpaceReader::face_near(const Value& near, const Eigen::Vector3d& point, SpaceFace face) {
  const SpaceBody& of = body_at(face.body);
  std::vector<std::string> names = of.mesh ? nearest_faces(*of.mesh, point) : nearest_faces(*of.shape, point);
  for (std::string& one : names) one = name_from(one);
  if (names.size() != 1) {
    report_.error(near, names.empty() ? "the body has no faces: name a set of nodes"
                                      : fmt::format("is as near to the faces {} of body '{}': give a point within one",
                                                    fmt::join(names, " and "), of.name));
    return {};
  }
  face.text = of.name + "." + names.front();
  find_face(near, names.front(), face);
  return face;
}

std::optional<SpaceFace> SpaceReader::face_along(const Value& value, const Eigen::Vector3d& normal,
                                                 const std::optional<Value>& part, SpaceFace face) {
  if (normal.isZero(0.0)) {
    report_.error(value, "has no direction: not all of it may be 0");
    return {};
  }
  face.normal = normal.stableNormalized();
  face.text = body_at(face.body).name;
  const std::size_t before = report_.count();
  if (const auto name = part ? read_text(report_, *part) : std::nullopt) {
    face.text += "." + *name;
    find_face(*part, *name, face);
    if (face.line_set >= 0) report_.error(*part, "is a curve of the mesh file, which has no normal: name a face");
  }
  if (report_.count() > before) return {};
  face.text += fmt::format(" along ({:.4g}, {:.4g}, {:.4g})", normal.x(), normal.y(), normal.z());
  return face;
}

/// A curve of a mesh file too.
std::optional<SpaceFace> SpaceReader::face_or_curve(const Value& value, const char* or_body) {
  if (value.node->kind == Node::Kind::map) return face_found(value);
  const auto text = read_text(report_, value);
  if (!text) return {};
  const std::size_t dot = text->find('.');
  const std::string name = text->substr(0, dot), part = dot == std::string::npos ? "" : text->substr(dot + 1);
  std::vector<std::string> bodies;
  for (const SpaceBody& body : model_.bodies) bodies.push_back(body.name);
  const auto found = std::find(bodies.begin(), bodies.end(), name);
  const bool is_body = part.empty() && or_body != nullptr;
  if ((part.empty() && !is_body) || found == bodies.end()) {
    report_.error(value, part.empty() && !is_body
                             ? fmt::format("must be a face of a body, as in block.bottom, not {}", quoted_name(*text))
                             : fmt::format("there is no body named {}{}", quoted_name(name), suggestion(name, bodies)));
    return {};
  }
  SpaceFace face;
  face.body = static_cast<int>(found - bodies.begin());
  face.text = *text;
  face.source = value.source();
  const std::size_t before = report_.count();
  if (is_body && !body_at(face.body).rigid)
    report_.error(value,
                  fmt::format("{} acts on a face of an elastic body, as in {}.bottom: name a face", or_body, name));
  if (!part.empty()) find_face(value, part, face);
  if (report_.count() > before || (face.is_body() && !part.empty())) return {};
  return face;
}

void SpaceReader::find_face(const Value& value, const std::string& part, SpaceFace& face) {
  const SpaceBody& of = body_at(face.body);
  std::vector<std::string> known;
  if (of.shape) {
    known = face_names(*of.shape);
    if (std::find(known.begin(), known.end(), part) != known.end())
      face.of_shape = part;
    else
      report_.error(value, fmt::format("the shape of body '{}' has no face named {}{}", of.name, quoted_name(part),
                                       suggestion(part, known)));
  }
  if (!of.mesh) return;
  for (std::size_t i = 0; i < of.mesh->side_sets.size(); ++i) {
    known.push_back(name_from(of.mesh->side_sets[i].name));
    if (known.back() == part) face.side_set = static_cast<int>(i);
  }
  for (std::size_t i = 0; face.side_set < 0 && i < of.mesh->node_sets.size(); ++i) {
    known.push_back(name_from(of.mesh->node_sets[i].name));
    if (known.back() == part) face.node_set = static_cast<int>(i);
  }
  for (std::size_t i = 0; face.side_set < 0 && face.node_set < 0 && i < of.mesh->line_sets.size(); ++i) {
    known.push_back(name_from(of.mesh->line_sets[i].name));
    if (known.back() == part) face.line_set = static_cast<int>(i);
  }
  if (face.side_set < 0 && face.node_set < 0 && face.line_set < 0)
    report_.error(value, fmt::format("the mesh of body '{}' has no face, curve or set of nodes named {}{}", of.name,
                                     quoted_name(part), suggestion(part, known)));
}

}  // namespace scabo::input
