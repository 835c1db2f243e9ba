#include "scabo/input/space/read_solid_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

#include "scabo/files/read_mesh_file.hpp"
#include "scabo/input/parameters.hpp"
#include "scabo/input/space/solid_values.hpp"
#include "scabo/input/suggestions.hpp"
#include "scabo/model/imported_body.hpp"
#include "scabo/model/limits.hpp"
#include "scabo/model/solid_bodies.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::input {

using namespace model;

namespace {

constexpr std::array<const char*, 3> names_of_axes{"x", "y", "z"};

class SpaceReader {
 public:
  SpaceReader(Report& report, const std::string& file) : report_(report) { model_.file = file; }
  SpaceModel read(const Value& root);
  std::vector<Warning>& warnings() { return model_.warnings; }

 private:
  void analysis(const Value& value);
  void solver(const Value& value);
  void material(const Entry& entry);
  int material_of(const Value& value);
  void body(const Entry& entry);
  void support(const Value& value);
  void load(const Entry& entry);
  void pair_of_faces(const Entry& entry, bool tied);
  void steps(const std::optional<Value>& value);
  void step(const Value& value);
  void factor(const Entry& entry, SpaceStep& step);

  std::shared_ptr<const files::ImportedSolidMesh> mesh_of_file(const Value& value);
  void add_bodies_of_file(const Value& mesh, SpaceBody body);
  std::optional<int> region_of(const Value& value, const files::ImportedSolidMesh& mesh) const;
  std::optional<SpaceFace> face(const Value& value);
  std::array<std::optional<double>, 3> fixed(const Value& value);
  std::array<std::optional<double>, 3> prescribed(const Value& value);
  double number(const std::optional<Value>& value, double otherwise = 0.0) const {
    return value ? read_number(report_, *value).value_or(otherwise) : otherwise;
  }
  double number_from(const std::optional<Value>& value, double least, bool itself) const {
    return read_number_from(report_, value, least, itself);
  }
  Eigen::Vector3d vector(const Value& value) const { return read_vector_in_space(report_, value); }

  Report& report_;
  SpaceModel model_;
  std::map<std::string, std::shared_ptr<const files::ImportedSolidMesh>> meshes_;
};

void SpaceReader::analysis(const Value& value) {
  const MapReader map(report_, value, {"space", "type"}, "{space: true}",
                      only_in_the_plane({"plane", "thickness", "modes"}));
  if (const auto type = map.get("type"))
    read_choice(report_, *type, {"static"},
                {{"dynamic", "a model in space is static"}, {"modal", "a model in space is static"}});
}

void SpaceReader::solver(const Value& value) {
  const MapReader map(report_, value, {"tolerance"}, "{tolerance: 1e-10}",
                      only_in_the_plane({"iterations", "halvings", "uniqueness", "factorisation"}));
  const auto tolerance = map.get("tolerance");
  if (!tolerance) return;
  model_.tolerance = read_number(report_, *tolerance).value_or(model_.tolerance);
  if (!(model_.tolerance >= 1e-14 && model_.tolerance <= 1e-3))
    report_.error(*tolerance, fmt::format("must be from 1e-14 to 1e-3, not {}", tolerance->node->text));
}

void SpaceReader::material(const Entry& entry) {
  const MapReader map(report_, entry.value, {"young", "poisson", "density"},
                      "{young: 210e9, poisson: 0.3, density: 7850}",
                      only_in_the_plane({"expansion", "orthotropic", "anisotropic", "damping"}));
  SpaceMaterial material;
  material.name = entry.key;
  if (!map.is_map()) return model_.materials.push_back(material);
  material.young = number_from(map.need("young"), 0.0, false);
  if (const auto poisson = map.need("poisson")) {
    material.poisson = number(poisson);
    if (!(material.poisson > -1.0 && material.poisson < 0.5))
      report_.error(*poisson, fmt::format("must be above -1 and below 0.5, not {}", poisson->node->text));
  }
  material.density = number_from(map.get("density"), 0.0, true);
  model_.materials.push_back(material);
}

std::shared_ptr<const files::ImportedSolidMesh> SpaceReader::mesh_of_file(const Value& value) {
  const auto name = read_text(report_, value);
  if (!name) return nullptr;
  const std::string path = (std::filesystem::path(model_.file).parent_path() / *name).string();
  const auto [found, is_new] = meshes_.try_emplace(path);
  if (!is_new) {
    if (!found->second) report_.told_elsewhere(value);
    return found->second;
  }
  try {
    files::ImportedSolidMesh mesh = files::read_solid_mesh_file(path);
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

void SpaceReader::body(const Entry& entry) {
  const MapReader map(
      report_, entry.value, {"material", "shape", "mesh"},
      "{material: steel, shape: {box: {corner: [0, 0, 0], size: [1, 1, 1]}}, mesh: {size: 0.1}}",
      only_in_the_plane({"holes", "regions", "sectors", "materials", "outside", "reference", "rigid", "cracks", "crack",
                         "copies", "repeat", "image", "added", "removed", "join", "corners"}));
  SpaceBody body;
  body.name = entry.key;
  body.source = entry.value.source();
  if (const auto name = map.need("material")) body.material = material_of(*name);
  const auto shape = map.get("shape"), mesh = map.need("mesh");
  if (shape) body.shape = read_solid_shape(report_, *shape);
  if (mesh && !shape) return add_bodies_of_file(*mesh, std::move(body));
  if (mesh) body.sizes = read_solid_sizes(report_, *mesh);
  model_.bodies.push_back(body);
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
  Later later = only_in_the_plane({"kind", "order", "centre", "tolerance", "min_size", "elements"});
  for (const char* key : {"size", "refine"})
    later.emplace_back(key, "it divides a 'shape', and the body has none: give it one, or leave the key out");
  const MapReader keys(report_, mesh, {"file", "region"}, "{file: part.msh}", later);
  const auto name = keys.need("file"), region = keys.get("region");
  const auto file = name ? mesh_of_file(*name) : nullptr;
  const auto choice = file && region ? region_of(*region, *file) : std::optional(-1);
  if (!file || !choice) return model_.bodies.push_back(body);
  std::vector<files::ImportedSolidMesh> parts = solid_bodies(*file, *choice);
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
            mesh,
            fmt::format("a part of this file is called '{0}', as is another body: give that another name", body.name));
    model_.bodies.push_back(body);
  }
  if (parts.size() > 1)
    model_.warnings.push_back(
        {WarningKind::input, whole + " parts",
         fmt::format("body '{}': its cells have {} parts that have no side in common, which "
                     "become bodies of their own: {}{}",
                     whole, parts.size(), fmt::join(told, ", "), parts.size() > told.size() ? ", ..." : "")});
}

std::optional<SpaceFace> SpaceReader::face(const Value& value) {
  const auto text = read_text(report_, value);
  if (!text) return {};
  const std::size_t dot = text->find('.');
  const std::string name = text->substr(0, dot), part = dot == std::string::npos ? "" : text->substr(dot + 1);
  std::vector<std::string> bodies;
  for (const SpaceBody& body : model_.bodies) bodies.push_back(body.name);
  const auto found = std::find(bodies.begin(), bodies.end(), name);
  if (part.empty() || found == bodies.end()) {
    report_.error(value, part.empty()
                             ? fmt::format("must be a face of a body, as in block.bottom, not {}", quoted_name(*text))
                             : fmt::format("there is no body named {}{}", quoted_name(name), suggestion(name, bodies)));
    return {};
  }
  SpaceFace face;
  face.body = static_cast<int>(found - bodies.begin());
  face.text = *text;
  face.source = value.source();
  const SpaceBody& of = model_.bodies[static_cast<std::size_t>(face.body)];
  std::vector<std::string> known;
  if (of.shape) {
    known = face_names(*of.shape);
    face.of_shape = part;
    if (std::find(known.begin(), known.end(), part) != known.end()) return face;
    report_.error(value, fmt::format("the shape of body '{}' has no face named {}{}", name, quoted_name(part),
                                     suggestion(part, known)));
  }
  if (!of.mesh) return {};
  for (std::size_t i = 0; i < of.mesh->side_sets.size(); ++i) {
    known.push_back(name_from(of.mesh->side_sets[i].name));
    if (known.back() == part) face.side_set = static_cast<int>(i);
  }
  for (std::size_t i = 0; face.side_set < 0 && i < of.mesh->node_sets.size(); ++i) {
    known.push_back(name_from(of.mesh->node_sets[i].name));
    if (known.back() == part) face.node_set = static_cast<int>(i);
  }
  if (face.side_set >= 0 || face.node_set >= 0) return face;
  report_.error(value, fmt::format("the mesh of body '{}' has no face or set of nodes named {}{}", name,
                                   quoted_name(part), suggestion(part, known)));
  return {};
}

std::array<std::optional<double>, 3> SpaceReader::fixed(const Value& value) {
  std::array<std::optional<double>, 3> fixed;
  std::vector<Value> items{value};
  if (value.node->kind == Node::Kind::sequence) items = *read_list(report_, value, "[x, y, z]");
  if (items.empty()) report_.error(value, "must be x, y, z or a list of them, not an empty list");
  for (const Value& item : items) {
    const auto name = std::find(names_of_axes.begin(), names_of_axes.end(), item.node->text);
    if (item.node->kind != Node::Kind::scalar || name == names_of_axes.end())
      report_.error(item, fmt::format("must be x, y, z or a list of them, not {}", describe(*item.node)));
    else if (auto& component = fixed[static_cast<std::size_t>(name - names_of_axes.begin())]; component)
      report_.error(item, fmt::format("{} is given twice: remove one of the two", *name));
    else
      component = 0.0;
  }
  return fixed;
}

std::array<std::optional<double>, 3> SpaceReader::prescribed(const Value& value) {
  std::array<std::optional<double>, 3> prescribed;
  const Node& node = *value.node;
  if (node.kind != Node::Kind::sequence || node.items.size() != 3) {
    report_.error(value, fmt::format("must be [ux, uy, uz], with null for a free component, not {}",
                                     node.kind == Node::Kind::sequence ? fmt::format("a list of {}", node.items.size())
                                                                       : describe(node)));
    return prescribed;
  }
  for (std::size_t k = 0; k < 3; ++k)
    if (node.items[k]->kind != Node::Kind::null) prescribed[k] = read_number(report_, value.item(k));
  return prescribed;
}

void SpaceReader::support(const Value& value) {
  const MapReader map(report_, value, {"on", "fix", "displacement", "name"}, "{on: block.bottom, fix: [x, y, z]}",
                      only_in_the_plane({"rotation", "at", "symmetry"}));
  if (!map.is_map()) return;
  SpaceSupport support;
  support.name = fmt::format("support_{}", model_.supports.size() + 1);
  if (const auto name = map.get("name")) {
    const auto text = read_text(report_, *name);
    if (text && check_name(report_, name->source(), *text)) {
      support.named = true;
      support.name = *text;
      for (const SpaceSupport& other : model_.supports)
        if (other.name == *text) report_.error(*name, fmt::format("two supports are called '{}'", *text));
    }
  }
  const auto fix = map.get("fix"), displacement = map.get("displacement");
  if (fix && displacement)
    map.refuse("displacement", "does not go together with 'fix': write 0 for the components that are fixed");
  else if (fix)
    support.displacement = fixed(*fix);
  else if (displacement)
    support.displacement = prescribed(*displacement);
  else if (map.all_known())
    report_.error(value, "needs 'fix' or 'displacement'");
  const auto on = map.need("on");
  const auto place = on ? face(*on) : std::nullopt;
  if (place) support.on = *place;
  model_.supports.push_back(support);
}

void SpaceReader::load(const Entry& entry) {
  const MapReader map(report_, entry.value, {"on", "pressure", "traction", "gravity"}, "{on: block.top, pressure: 1e6}",
                      only_in_the_plane({"force", "moment", "water", "in", "field", "body_force", "temperature",
                                         "rotation", "level", "weight", "at"}));
  if (!map.is_map()) return;
  SpaceLoad load;
  load.name = entry.key;
  const auto pressure = map.get("pressure"), traction = map.get("traction"), gravity = map.get("gravity");
  if (pressure.has_value() + traction.has_value() + gravity.has_value() != 1) {
    if (map.all_known()) report_.error(entry.value, "needs one of 'pressure', 'traction' and 'gravity'");
    return model_.loads.push_back(load);
  }
  if (pressure) load.pressure = number(pressure);
  if (traction) load.kind = SpaceLoad::Kind::traction, load.vector = vector(*traction);
  if (gravity) {
    load.kind = SpaceLoad::Kind::gravity;
    load.vector = vector(*gravity);
    if (map.has("on")) map.refuse("on", "gravity acts on all bodies of a model in space: leave 'on' out");
    for (const SpaceBody& body : model_.bodies)
      if (body.material >= 0 && model_.materials[static_cast<std::size_t>(body.material)].density == 0.0)
        report_.error(entry.value, fmt::format("the material of body '{}' has no 'density', so that gravity has no "
                                               "effect on it: give it one",
                                               body.name));
  } else if (const auto on = map.need("on")) {
    if (const auto place = face(*on)) load.on = *place;
  }
  model_.loads.push_back(load);
}

void SpaceReader::pair_of_faces(const Entry& entry, bool tied) {
  const Later later =
      only_in_the_plane({"property", "cohesion", "tension", "bond", "shear_strength", "slip", "interference", "fit",
                         "fit_in", "reach", "matching", "residual_friction", "slip_distance", "dynamic_friction"});
  const MapReader map(
      report_, entry.value,
      tied ? std::vector<std::string>{"between"} : std::vector<std::string>{"between", "friction", "gap"},
      tied ? "{between: [base.top, block.bottom]}" : "{between: [base.top, block.bottom], friction: 0.3}", later);
  if (!map.is_map()) return;
  SpaceContact contact;
  contact.name = entry.key;
  if (!tied) {
    contact.friction = number_from(map.need("friction"), 0.0, true);
    contact.gap = number(map.get("gap"));
  }
  for (const SpaceContact& other : model_.contacts)
    if (other.name == entry.key)
      report_.error(entry.key_source,
                    fmt::format("a contact is called '{}' already: give the tie another name", entry.key));
  if (const auto between = map.need("between")) {
    const auto items = read_list(report_, *between, "[base.top, block.bottom]");
    if (items && items->size() != 2)
      report_.error(*between,
                    fmt::format("must be two faces, as in [base.top, block.bottom], not a list of {}", items->size()));
    else if (items) {
      const auto a = face((*items)[0]), b = face((*items)[1]);
      if (a && b && a->body == b->body)
        report_.error(*between, "both faces belong to the same body: name faces of two bodies");
      if (a && b) contact.a = *a, contact.b = *b;
    }
  }
  model_.contacts.push_back(contact);
}

void SpaceReader::factor(const Entry& entry, SpaceStep& step) {
  const auto read = read_number(report_, entry.value);
  std::vector<std::string> known;
  for (std::size_t i = 0; i < model_.loads.size(); ++i) {
    known.push_back(model_.loads[i].name);
    if (known.back() == entry.key) return void(step.load_factors[i] = read.value_or(0.0));
  }
  for (std::size_t i = 0; i < model_.supports.size(); ++i) {
    if (!model_.supports[i].named) continue;
    known.push_back(model_.supports[i].name);
    if (known.back() == entry.key) return void(step.support_factors[i] = read.value_or(0.0));
  }
  report_.error(entry.key_source, fmt::format("there is no load or named support called {}{}", quoted_name(entry.key),
                                              suggestion(entry.key, known)));
}

void SpaceReader::step(const Value& value) {
  const MapReader map(report_, value, {"name", "increments", "loads"}, "{name: press, increments: 10}",
                      only_in_the_plane({"dynamic", "friction", "cycles"}));
  if (!map.is_map()) return;
  SpaceStep step;
  step.load_factors.assign(model_.loads.size(), 0.0);
  step.support_factors.assign(model_.supports.size(), 0.0);
  if (!model_.steps.empty()) step = model_.steps.back();
  step.name = fmt::format("step_{}", model_.steps.size() + 1);
  step.increments = 1;
  if (const auto name = map.get("name")) {
    const auto text = read_text(report_, *name);
    if (text && check_name(report_, name->source(), *text)) step.name = *text;
  }
  for (const SpaceStep& other : model_.steps)
    if (other.name == step.name) report_.error(value, fmt::format("two steps are called '{}'", step.name));
  if (const auto increments = map.get("increments"))
    step.increments = static_cast<int>(read_integer(report_, *increments, limits::increments).value_or(1));
  if (const auto loads = map.get("loads")) {
    for (std::size_t i = 0; i < model_.supports.size(); ++i)
      if (!model_.supports[i].named) step.support_factors[i] = 1.0;
    for (const Entry& entry : read_named(report_, *loads, "factors", "{tip: 1.0}")) factor(entry, step);
  } else {
    std::fill(step.load_factors.begin(), step.load_factors.end(), 1.0);
    std::fill(step.support_factors.begin(), step.support_factors.end(), 1.0);
  }
  model_.steps.push_back(step);
}

void SpaceReader::steps(const std::optional<Value>& value) {
  const auto items =
      value ? read_list(report_, *value, "[{name: press, increments: 10}]") : std::optional(std::vector<Value>{});
  for (const Value& item : items.value_or(std::vector<Value>{})) step(item);
  if (!model_.steps.empty() || !items) return;
  model_.steps.push_back(
      {"step_1", 1, std::vector<double>(model_.loads.size(), 1.0), std::vector<double>(model_.supports.size(), 1.0)});
}

SpaceModel SpaceReader::read(const Value& root) {
  const MapReader map(
      report_, root,
      {"scabo", "title", "parameters", "analysis", "materials", "bodies", "supports", "loads", "contacts", "ties",
       "steps", "solver"},
      "'scabo: 1' and sections",
      only_in_the_plane({"springs", "contact_properties", "curves", "output", "tolerance", "restart", "initial"}));
  if (const auto version = map.need("scabo"); version && number(version, 1.0) != 1.0)
    report_.error(*version, fmt::format("this program reads format version 1, not {}", version->node->text));
  if (const auto title = map.get("title")) model_.title = read_text(report_, *title).value_or("");
  if (const auto value = map.get("analysis")) analysis(*value);
  if (const auto value = map.get("solver")) solver(*value);
  if (const auto value = map.need("materials"))
    for (const Entry& entry : read_named(report_, *value, "materials", "{steel: {young: 210e9, poisson: 0.3}}"))
      material(entry);
  if (const auto value = map.need("bodies"))
    for (const Entry& entry :
         read_named(report_, *value, "bodies", "{block: {material: steel, mesh: {file: block.inp}}}"))
      body(entry);
  if (const auto value = map.get("supports"))
    for (const Value& item :
         read_list(report_, *value, "[{on: block.bottom, fix: [x, y, z]}]").value_or(std::vector<Value>{}))
      support(item);
  if (const auto value = map.get("loads"))
    for (const Entry& entry : read_named(report_, *value, "loads", "{press: {on: block.top, pressure: 1e6}}"))
      load(entry);
  for (const bool tied : {false, true})
    if (const auto value = map.get(tied ? "ties" : "contacts"))
      for (const Entry& entry :
           read_named(report_, *value, tied ? "ties" : "contacts", "{joint: {between: [base.top, block.bottom]}}"))
        pair_of_faces(entry, tied);
  steps(map.get("steps"));
  return std::move(model_);
}

}  // namespace

bool is_in_space(const Node& root) {
  if (root.kind != Node::Kind::map) return false;
  const MapEntry* analysis = root.find("analysis");
  if (analysis == nullptr || analysis->value->kind != Node::Kind::map) return false;
  const MapEntry* space = analysis->value->find("space");
  return space != nullptr && space->value->text == "true";
}

SpaceModel solid_model_of_tree(const NodePtr& root, Report& report, const std::string& file) {
  SpaceReader reader(report, file);
  const NodePtr tree = apply_parameters(root, report, reader.warnings());
  SpaceModel model = reader.read({tree, ""});
  report.throw_if_any(file);
  return model;
}

}  // namespace scabo::input
