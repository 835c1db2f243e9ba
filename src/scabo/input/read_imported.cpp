// `mesh: {file: part.msh}`: a body whose shape and cells come from a mesh file, or from a CAD file that Gmsh's library
// meshes: `mesh: {file: part.geo, size: 0.1}`.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <variant>

#include "scabo/files/cad.hpp"
#include "scabo/files/read_mesh_file.hpp"
#include "scabo/files/text_cursor.hpp"
#include "scabo/input/reading.hpp"
#include "scabo/input/suggestions.hpp"
#include "scabo/model/imported_body.hpp"

namespace scabo::input {

namespace {

using Mesh = std::shared_ptr<const files::ImportedMesh>;

/// Elements of the plane in bodies of revolution, or the other way round: the type in the file says how they were
/// meant.
void compare_types(Reading& reading, const Value& value, const std::string& path, const std::string& name,
                   const std::vector<std::string>& types) {
  const bool revolved = reading.model.analysis.revolved();
  const auto other = std::find_if(types.begin(), types.end(), [&](const std::string& type) {
    return type.starts_with("CAX") != revolved && type.starts_with("C");
  });
  if (other == types.end()) return;
  const std::string type = files::printable(*other);
  if (revolved)
    reading.model.warnings.push_back(
        {WarningKind::input, path + " types",
         fmt::format("'{}' has elements of the plane (type {}), which are taken as the half section of a body of "
                     "revolution: write CAX{} there if that is meant",
                     name, type, type.substr(3))});
  else
    reading.report.error(value, fmt::format("'{}' has elements of bodies of revolution (type {}): write analysis: "
                                            "{{plane: axisymmetric}}, or CPS{} or CPE{} in the file",
                                            name, type, type.substr(3), type.substr(3)));
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
    std::vector<std::string> types;
    files::ImportedMesh mesh = cad ? files::mesh_cad_file(path, *cad) : files::read_mesh_file(path, &types);
    for (const std::string& remark : mesh.remarks)
      reading.model.warnings.push_back({WarningKind::input, path, as_given(remark, path, name)});
    compare_types(reading, value, path, name, types);
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
std::optional<CellChoice> read_region(Reading& reading, const Value& value, const files::ImportedMesh& mesh) {
  const auto name = read_text(reading.report, value);
  if (!name) return {};
  if (const int region = index_of_region(mesh.regions, *name); region >= 0) return CellChoice{region, -1};
  std::vector<std::string> names, known = mesh.regions;
  for (const files::CellSet& set : mesh.cell_sets) names.push_back(set.name);
  if (const int set = index_of_region(names, *name); set >= 0) return CellChoice{-1, set};
  for (std::string& set : names)
    if (std::find(known.begin(), known.end(), set) == known.end()) known.push_back(std::move(set));
  reading.report.error(value,
                       fmt::format("the file has no region named {}{}", quoted_name(*name), suggestion(*name, known)));
  return {};
}

/// Materials of regions by their names.
using MaterialsOfRegions = std::map<std::string, int>;

/// `materials: {core: steel}`; `regions`: of all parts.
MaterialsOfRegions read_region_materials(Reading& reading, const Value& value,
                                         const std::vector<std::string>& regions) {
  std::vector<std::string> known;
  for (const std::string& region : regions) known.push_back(name_from(region));
  MaterialsOfRegions materials;
  for (const Entry& entry : read_named(reading.report, value, "regions", "{core: steel}")) {
    const int region = index_of_region(regions, entry.key);
    const auto material = read_material_name(reading, entry.value);
    if (region < 0)
      reading.report.error(entry.key_source, fmt::format("the body has no region named {}{}", quoted_name(entry.key),
                                                         suggestion(entry.key, known)));
    else if (material)
      materials[regions[static_cast<std::size_t>(region)]] = *material;
  }
  return materials;
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

/// Whether a contact or tie, or a crack of the body, names it or a part of it, or all bodies: its parts then stay
/// apart, even where their nodes lie in the same places.
bool are_named_apart(const Reading& reading, const MapReader& of_body, const std::string& body) {
  return of_body.has("cracks") ||
         std::any_of(reading.texts_of_contacts.begin(), reading.texts_of_contacts.end(), [&](const std::string& text) {
           if (text == "all" || text == body) return true;
           if (!text.starts_with(body) || text.size() < body.size() + 2) return false;
           const char next = text[body.size()], after = text[body.size() + 1];
           return next == '.' || (next == '_' && after >= '0' && after <= '9');
         });
}

/// The parts that the cells are; empty if they are not known.
std::vector<ImportedBody> read_cells(Reading& reading, const MapReader& of_body, const MapReader& map, Body& body) {
  const auto file = map.need("file");
  const auto name = file ? read_text(reading.report, *file) : std::nullopt;
  if (!name) return {};
  std::optional<files::CadOptions> cad;
  if (files::is_cad_file(*name)) {
    cad = read_cad_options(reading.report, map, *name, body);
    if (!cad) return {};
  }
  const Mesh mesh = mesh_of_file(reading, *file, *name, cad);
  if (!mesh) return {};
  body.mesh.file = *name;
  const auto region = map.get("region");
  const auto choice = region ? read_region(reading, *region, *mesh) : std::optional(CellChoice{});
  if (!choice) return {};
  auto made = imported_bodies(*mesh, *choice, !are_named_apart(reading, of_body, body.name));
  if (const std::string* why = std::get_if<std::string>(&made)) {
    reading.report.error(region.value_or(*file), *why);
    return {};
  }
  ImportedBodies& bodies = std::get<ImportedBodies>(made);
  if (bodies.joined_nodes > 0)
    reading.model.warnings.push_back(
        {WarningKind::input, body.name,
         fmt::format(
             "body '{0}': {1} of '{2}' that {3} in the place of others {4} joined to them; where the body shall "
             "come apart, name its parts {0}_1, {0}_2, ... in a contact",
             body.name, counted(bodies.joined_nodes, "node"), *name, bodies.joined_nodes == 1 ? "lies" : "lie",
             bodies.joined_nodes == 1 ? "is" : "are")});
  for (ImportedBody& part : bodies.parts)
    for (Edge& edge : part.outline.edges) edge.source = file->source();
  return std::move(bodies.parts);
}

/// A part as a body of its own.
ReadBody of_part(const ReadBody& whole, ImportedBody part, const MaterialsOfRegions& materials) {
  ReadBody of = whole;
  of.body.imported = std::move(part.mesh);
  of.body.outline = std::move(part.outline);
  of.state.pieces = std::move(part.pieces);
  of.state.lost_points = std::move(part.lost_points);
  of.state.lines = std::move(part.lines);
  of.state.shape = true;
  for (const std::string& region : of.body.imported->regions) {
    const auto found = materials.find(region);
    of.body.region_materials.push_back(found == materials.end() ? whole.body.material : found->second);
  }
  return of;
}

/// `wall_1`, `wall_2`, ... for several parts, and a word about where each is.
void name_parts(Reading& reading, const std::string& name, std::vector<ReadBody>& parts) {
  constexpr std::size_t most_told = 8;
  std::vector<std::string> told;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    Body& body = parts[k].body;
    body.name = fmt::format("{}_{}", name, k + 1);
    const Vec2 centre = body.outline.centroid();
    if (k < most_told) told.push_back(fmt::format("{} at ({:.4g}, {:.4g})", body.name, centre.x(), centre.y()));
  }
  reading.model.warnings.push_back(
      {WarningKind::input, name + " parts",
       fmt::format("body '{}': its cells have {} parts that have no side in common, which become bodies of their own: "
                   "{}{}",
                   name, parts.size(), fmt::join(told, ", "), parts.size() > most_told ? ", ..." : "")});
}

bool is_of_cad(const Value& mesh) {
  const MapEntry* file = mesh.node->kind == Node::Kind::map ? mesh.node->find("file") : nullptr;
  return file != nullptr && file->value->kind == Node::Kind::scalar && files::is_cad_file(file->value->text);
}

/// What is of one body, and cannot be shared by several.
void refuse_for_parts(const MapReader& of_body, const MapReader& mesh, std::size_t count) {
  const std::string why = fmt::format(
      "the cells of this body have {} parts that have no side in common: give each part a region, and this to "
      "the body of one",
      count);
  for (const char* key : {"cracks", "repeat"}) of_body.refuse(key, why);
  mesh.refuse("refine", why);
}

std::vector<std::string> regions_of(const std::vector<ImportedBody>& parts) {
  std::vector<std::string> regions;
  for (const ImportedBody& part : parts)
    for (const std::string& region : part.mesh->regions)
      if (std::find(regions.begin(), regions.end(), region) == regions.end()) regions.push_back(region);
  return regions;
}

void tell_regions_without_material(Report& report, const Value& value, const MaterialsOfRegions& given,
                                   const std::vector<ImportedBody>& parts) {
  for (const std::string& region : regions_of(parts))
    if (!given.contains(region))
      report.error(value, fmt::format("region '{}' has no material: add it here, or give the body a 'material' for "
                                      "all regions that are not named here",
                                      region));
}

void read_cracks_of(Reading& reading, const Value& value, ReadBody& read) {
  const std::size_t errors = reading.report.count();
  read.body.cracks = read_cracks(reading, value, read.body, &read.state.lines);
  for (Crack& crack : read.body.cracks)
    if (crack.path.empty()) crack.path = {crack.mouth, crack.tip}, crack.edge = -1;
  if (reading.report.count() > errors) read.state.shape = false;
}

}  // namespace

bool is_from_file(const std::optional<Value>& mesh) {
  return mesh && mesh->node->kind == Node::Kind::map && mesh->node->find("file") != nullptr;
}

std::vector<ReadBody> read_imported_bodies(Reading& reading, const MapReader& of_body, const Value& value,
                                           ReadBody read) {
  Report& report = reading.report;
  Body& body = read.body;
  const MapReader map(
      report, value,
      {"file", "elements", "region", "order", "size", "min_size", "refine", "kind", "centre", "tolerance"},
      "{file: part.msh}");
  body.mesh.source = value.source();
  body.mesh.kind = reading.model.analysis.revolved() ? MeshKind::fem : MeshKind::imported;
  body.mesh.order = 1;
  if (const auto elements = map.get("elements")) {
    const auto choice = read_choice(report, *elements, {"superelement", "fem"});
    if (choice) body.mesh.kind = *choice == "fem" ? MeshKind::fem : MeshKind::imported;
  }
  const bool cad = is_of_cad(value);
  refuse_other_keys(of_body, map, body.mesh.kind == MeshKind::fem, cad);
  if (const auto order = map.get("order"); order && !cad && body.mesh.kind != MeshKind::fem)
    body.mesh.order = static_cast<int>(read_integer(report, *order, limits::order).value_or(1));
  std::vector<ImportedBody> parts = read_cells(reading, of_body, map, body);
  const auto materials = of_body.get("materials");
  const auto material = materials ? of_body.get("material") : of_body.need("material");
  if (material) body.material = read_material_name(reading, *material).value_or(-1);
  const Outline* outline = parts.size() == 1 ? &parts.front().outline : nullptr;
  if (const auto refine = map.get("refine")) body.mesh.refine = read_refine(reading, *refine, outline);
  if (const auto tolerance = map.get("tolerance")) body.mesh.tolerance = number_or_unread(reading, tolerance);
  if (parts.empty()) return {read};
  if (parts.size() > 1) refuse_for_parts(of_body, map, parts.size());
  const std::size_t before = report.count();
  const MaterialsOfRegions given =
      materials ? read_region_materials(reading, *materials, regions_of(parts)) : MaterialsOfRegions{};
  if (!material && materials && report.count() == before)
    tell_regions_without_material(report, *materials, given, parts);
  if (report.count() > before) reading.materials_known = false;
  std::vector<ReadBody> bodies;
  for (ImportedBody& part : parts) {
    bodies.push_back(of_part(read, std::move(part), given));
    if (!material) bodies.back().body.material = bodies.back().body.region_materials.front();
  }
  if (bodies.size() > 1) name_parts(reading, body.name, bodies);
  if (const auto cracks = of_body.get("cracks"); cracks && bodies.size() == 1)
    read_cracks_of(reading, *cracks, bodies.front());
  return bodies;
}

}  // namespace scabo::input
