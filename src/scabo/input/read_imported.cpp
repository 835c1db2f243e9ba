// `mesh: {file: part.msh}`: a body whose shape and cells come from a mesh file, or from a CAD file that Gmsh's library
// meshes: `mesh: {file: part.geo, size: 0.1}`.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <variant>

#include "scabo/files/cad.hpp"
#include "scabo/files/read_mesh_file.hpp"
#include "scabo/input/reading.hpp"
#include "scabo/input/suggestions.hpp"
#include "scabo/model/imported_body.hpp"

namespace scabo::input {

namespace {

using Mesh = std::shared_ptr<const files::ImportedMesh>;

/// `text` with the name of a file as the model file spells it.
std::string as_given(std::string text, const std::string& path, const std::string& name) {
  if (text.compare(0, path.size(), path) == 0) text.replace(0, path.size(), name);
  return text;
}

/// The content of a file, which is read once, or meshed once for each choice of `cad`; null if it is broken.
Mesh mesh_of_file(Reading& reading, const Value& value, const std::string& name,
                  const std::optional<files::CadOptions>& cad) {
  const std::string path = (std::filesystem::path(reading.model.file).parent_path() / name).string();
  const auto [found, is_new] =
      reading.mesh_files.try_emplace(cad ? fmt::format("{}, {}, {}", path, cad->size, cad->order) : path);
  if (!is_new) {
    if (!found->second) reading.report.told_elsewhere(value);
    return found->second;
  }
  reading.model.files.push_back(path);
  try {
    files::ImportedMesh mesh = cad ? files::mesh_cad_file(path, *cad) : files::read_mesh_file(path);
    for (const std::string& remark : mesh.remarks)
      reading.model.warnings.push_back({WarningKind::input, path, as_given(remark, path, name)});
    found->second = std::make_shared<const files::ImportedMesh>(std::move(mesh));
  } catch (const InputError& error) {
    reading.report.error(value, as_given(format_diagnostic(error.file(), error.diagnostics().front()), path, name));
  }
  return found->second;
}

/// Index of a region by its name in the file, or by the name made from it; -1 if there is none.
int index_of_region(const std::vector<std::string>& regions, const std::string& name) {
  for (std::size_t i = 0; i < regions.size(); ++i)
    if (regions[i] == name) return static_cast<int>(i);
  for (std::size_t i = 0; i < regions.size(); ++i)
    if (name_from(regions[i]) == name) return static_cast<int>(i);
  return -1;
}

/// The cells of the region, or of the set of cells, of a name; nothing if there is none.
std::optional<std::variant<ImportedBody, std::string>> read_region(Reading& reading, const Value& value,
                                                                   const files::ImportedMesh& mesh) {
  const auto name = read_text(reading.report, value);
  if (!name) return {};
  if (const int region = index_of_region(mesh.regions, *name); region >= 0) return imported_body(mesh, region);
  std::vector<std::string> names, known = mesh.regions;
  for (const files::CellSet& set : mesh.cell_sets) names.push_back(set.name);
  if (const int set = index_of_region(names, *name); set >= 0) return imported_body_of_set(mesh, set);
  for (std::string& set : names)
    if (std::find(known.begin(), known.end(), set) == known.end()) known.push_back(std::move(set));
  reading.report.error(value,
                       fmt::format("the file has no region named {}{}", quoted_name(*name), suggestion(*name, known)));
  return {};
}

/// `materials: {core: steel}`; -1 for a region without an entry.
void read_region_materials(Reading& reading, const Value& value, Body& body) {
  std::vector<std::string> known;
  for (const std::string& region : body.imported->regions) known.push_back(name_from(region));
  for (const Entry& entry : read_named(reading.report, value, "regions", "{core: steel}")) {
    const int region = index_of_region(body.imported->regions, entry.key);
    const auto material = read_material_name(reading, entry.value);
    if (region < 0)
      reading.report.error(entry.key_source, fmt::format("the body has no region named {}{}", quoted_name(entry.key),
                                                         suggestion(entry.key, known)));
    else if (material)
      body.region_materials[static_cast<std::size_t>(region)] = *material;
  }
}

/// `size` and `order` of a body from a CAD file; nothing if they are wrong.
std::optional<files::CadOptions> read_cad_options(Report& report, const MapReader& mesh, const std::string& name,
                                                  Body& body) {
  const std::size_t before = report.count();
  files::CadOptions options;
  const auto size = files::has_own_sizes(name) ? mesh.get("size") : mesh.need("size");
  if (size) {
    body.mesh.size = options.size = read_number(report, *size).value_or(1.0);
    if (!(options.size > 0.0)) report.error(*size, fmt::format("must be greater than 0, not {:g}", options.size));
  }
  const auto order = mesh.get("order");
  long wanted = order ? read_integer(report, *order, limits::order).value_or(2) : 2;
  if (body.mesh.kind == MeshKind::fem && wanted > 2)
    report.error(*order, fmt::format("fem uses elements of order 1 or 2, not {}: leave 'order' out", wanted));
  options.order = static_cast<int>(std::min(wanted, 2l));
  // Finite elements have the nodes of the mesh; the sides of super-elements are raised from order 2.
  body.mesh.order = body.mesh.kind == MeshKind::fem ? 1 : static_cast<int>(wanted);
  if (report.count() > before) return {};
  return options;
}

void refuse_other_keys(const MapReader& body, const MapReader& mesh, bool fem, bool cad) {
  for (const char* key : {"shape", "holes"})
    body.refuse(key, "the mesh file gives the shape of this body: leave it out, or 'file' in 'mesh'");
  body.refuse("regions", "the regions of this body are those of its mesh file: give them materials with 'materials'");
  for (const char* key : {"sectors", "outside", "reference"})
    body.refuse(key, "is not available for a body from a mesh file: leave it out");
  const std::string why = cad ? "Gmsh's library meshes the file with one size, or the sizes that it has itself"
                              : "the mesh file has its cells already";
  if (!cad) mesh.refuse("size", why + ": leave 'size' out");
  mesh.refuse("min_size", why + ": leave 'min_size' out");
  mesh.refuse("kind", "cells of a mesh file are given by 'elements': superelement or fem");
  mesh.refuse("centre", "every cell has a scaling centre of its own: leave 'centre' out");
  if (fem && !cad) mesh.refuse("order", "finite elements keep the nodes of the mesh file: leave 'order' out");
}

/// The cells and the outline; false if they are not known.
bool read_cells(Reading& reading, const MapReader& map, Body& body, BodyState& state) {
  const auto file = map.need("file");
  const auto name = file ? read_text(reading.report, *file) : std::nullopt;
  if (!name) return false;
  std::optional<files::CadOptions> cad;
  if (files::is_cad_file(*name)) {
    cad = read_cad_options(reading.report, map, *name, body);
    if (!cad) return false;
  }
  const Mesh mesh = mesh_of_file(reading, *file, *name, cad);
  if (!mesh) return false;
  body.mesh.file = *name;
  const auto region = map.get("region");
  auto made = region ? read_region(reading, *region, *mesh) : imported_body(*mesh, -1);
  if (!made) return false;
  if (const std::string* why = std::get_if<std::string>(&*made)) {
    reading.report.error(region.value_or(*file), *why);
    return false;
  }
  ImportedBody& imported = std::get<ImportedBody>(*made);
  body.imported = std::move(imported.mesh);
  body.outline = std::move(imported.outline);
  for (Edge& edge : body.outline.edges) edge.source = file->source();
  state.pieces = std::move(imported.pieces);
  state.lost_points = std::move(imported.lost_points);
  state.lines = std::move(imported.lines);
  return true;
}

bool is_of_cad(const Value& mesh) {
  const MapEntry* file = mesh.node->kind == Node::Kind::map ? mesh.node->find("file") : nullptr;
  return file != nullptr && file->value->kind == Node::Kind::scalar && files::is_cad_file(file->value->text);
}

}  // namespace

bool is_from_file(const std::optional<Value>& mesh) {
  return mesh && mesh->node->kind == Node::Kind::map && mesh->node->find("file") != nullptr;
}

void read_imported_body(Reading& reading, const MapReader& of_body, const Value& value, Body& body, BodyState& state) {
  Report& report = reading.report;
  const MapReader map(
      report, value,
      {"file", "elements", "region", "order", "size", "min_size", "refine", "kind", "centre", "tolerance"},
      "{file: part.msh}");
  body.mesh.source = value.source();
  body.mesh.kind = MeshKind::imported;
  body.mesh.order = 1;
  if (const auto elements = map.get("elements")) {
    const auto choice = read_choice(report, *elements, {"superelement", "fem"});
    if (choice && *choice == "fem") body.mesh.kind = MeshKind::fem;
  }
  const bool cad = is_of_cad(value);
  refuse_other_keys(of_body, map, body.mesh.kind == MeshKind::fem, cad);
  if (const auto order = map.get("order"); order && !cad && body.mesh.kind != MeshKind::fem)
    body.mesh.order = static_cast<int>(read_integer(report, *order, limits::order).value_or(1));
  state.shape = read_cells(reading, map, body, state);
  const auto materials = of_body.get("materials");
  const auto material = materials ? of_body.get("material") : of_body.need("material");
  if (material) body.material = read_material_name(reading, *material).value_or(-1);
  if (const auto refine = map.get("refine"))
    body.mesh.refine = read_refine(reading, *refine, state.shape ? &body.outline : nullptr);
  if (const auto tolerance = map.get("tolerance")) body.mesh.tolerance = number_or_unread(reading, tolerance);
  if (!state.shape) return;
  if (const auto cracks = of_body.get("cracks")) {
    const std::size_t errors = report.count();
    body.cracks = read_cracks(reading, *cracks, body, &state.lines);
    for (Crack& crack : body.cracks)
      if (crack.path.empty()) crack.path = {crack.mouth, crack.tip}, crack.edge = -1;
    if (report.count() > errors) state.shape = false;
  }
  body.region_materials.assign(body.imported->regions.size(), -1);
  const std::size_t before = report.count();
  if (materials) read_region_materials(reading, *materials, body);
  for (std::size_t i = 0; i < body.region_materials.size(); ++i) {
    int& of_region = body.region_materials[i];
    if (of_region >= 0) continue;
    if (!material && materials && report.count() == before)
      report.error(*materials,
                   fmt::format("region '{}' has no material: add it here, or give the body a 'material' for "
                               "all regions that are not named here",
                               body.imported->regions[i]));
    of_region = body.material;
  }
  if (!material) body.material = body.region_materials.front();
  if (report.count() > before) reading.materials_known = false;
}

}  // namespace scabo::input
