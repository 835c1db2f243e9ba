#include "scabo/input/space/read_solid_model.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/input/parameters.hpp"
#include "scabo/input/space/space_reader.hpp"

namespace scabo::input {

using namespace model;

void SpaceReader::analysis(const Value& value) {
  const MapReader map(report_, value, {"space", "type"}, "{space: true}",
                      only_in_the_plane({"plane", "thickness", "modes"}));
  if (const auto space = map.get("space"); space && read_flag(report_, *space) == false)
    report_.error(*space, "is false, but the shape of a body is one of a model in space: leave it out");
  if (const auto type = map.get("type"))
    read_choice(report_, *type, {"static"},
                {{"dynamic", "a model in space is static"}, {"modal", "a model in space is static"}});
}

void SpaceReader::solver(const Value& value) {
  const MapReader map(report_, value, {"tolerance", "uniqueness"}, "{tolerance: 1e-10}",
                      only_in_the_plane({"iterations", "halvings", "factorisation"}));
  if (const auto uniqueness = map.get("uniqueness"))
    model_.uniqueness = read_flag(report_, *uniqueness).value_or(false);
  const auto tolerance = map.get("tolerance");
  if (!tolerance) return;
  model_.tolerance = read_number(report_, *tolerance).value_or(model_.tolerance);
  if (!(model_.tolerance >= 1e-14 && model_.tolerance <= 1e-3))
    report_.error(*tolerance, fmt::format("must be from 1e-14 to 1e-3, not {}", tolerance->node->text));
}

void SpaceReader::material(const Entry& entry) {
  const MapReader map(report_, entry.value, {"young", "poisson", "density", "expansion"},
                      "{young: 210e9, poisson: 0.3, density: 7850}",
                      only_in_the_plane({"orthotropic", "anisotropic", "damping"}));
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
  material.expansion = number_from(map.get("expansion"), 0.0, true);
  model_.materials.push_back(material);
}

SpaceModel SpaceReader::read(const Value& root) {
  root_ = root;
  const MapReader map(
      report_, root,
      {"scabo", "title", "parameters", "analysis", "materials", "bodies", "supports", "springs", "bars", "loads",
       "contact_properties", "contacts", "ties", "curves", "restart", "steps", "solver", "output"},
      "'scabo: 1' and sections", only_in_the_plane({"tolerance", "initial"}));
  if (const auto version = map.need("scabo"); version && number(version, 1.0) != 1.0)
    report_.error(*version, fmt::format("this program reads format version 1, not {}", version->node->text));
  if (const auto title = map.get("title")) model_.title = read_text(report_, *title).value_or("");
  if (const auto value = map.get("analysis")) analysis(*value);
  if (const auto value = map.get("solver")) solver(*value);
  if (const auto value = map.get("materials"))
    for (const Entry& entry : read_named(report_, *value, "materials", "{steel: {young: 210e9, poisson: 0.3}}"))
      material(entry);
  if (const auto value = map.need("bodies"))
    for (const Entry& entry :
         read_named(report_, *value, "bodies", "{block: {material: steel, mesh: {file: block.inp}}}"))
      body(entry);
  if (const auto value = map.get("bodies");
      value &&
      (value->node->kind == Node::Kind::null || (value->node->kind == Node::Kind::map && value->node->entries.empty())))
    report_.error(*value, "contains no body: define at least one");
  if (const auto value = map.get("supports"))
    for (const Value& item :
         read_list(report_, *value, "[{on: block.bottom, fix: [x, y, z]}]").value_or(std::vector<Value>{}))
      support(item);
  if (const auto value = map.get("springs")) springs(*value);
  if (const auto value = map.get("bars"))
    for (const Entry& entry :
         read_named(report_, *value, "bars", "{hanger: {between: [deck.left, [0, 0, 9]], k: 2e6}}"))
      bar(entry);
  if (const auto value = map.get("loads"))
    for (const Entry& entry : read_named(report_, *value, "loads", "{press: {on: block.top, pressure: 1e6}}"))
      load(entry);
  properties_ = read_properties(report_, map.get("contact_properties"));
  for (const bool tied : {false, true})
    if (const auto value = map.get(tied ? "ties" : "contacts"))
      for (const Entry& entry :
           read_named(report_, *value, tied ? "ties" : "contacts", "{joint: {between: [base.top, block.bottom]}}"))
        pair_of_faces(entry, tied);
  tell_of_unused(properties_, model_.warnings);
  if (const auto value = map.get("output")) output(*value);
  if (const auto value = map.get("curves")) curves(*value);
  if (const auto value = map.get("restart")) restart(*value);
  steps(map.get("steps"));
  find_fits();
  find_tightened();
  find_stages();
  return std::move(model_);
}

bool is_in_space(const Node& root) {
  const auto in = [](const Node& map, std::string_view key) -> const Node* {
    const MapEntry* entry = map.kind == Node::Kind::map ? map.find(key) : nullptr;
    return entry == nullptr ? nullptr : entry->value.get();
  };
  if (const Node* analysis = in(root, "analysis"))
    if (const Node* space = in(*analysis, "space"); space && space->text != "false") return true;
  const Node* bodies = in(root, "bodies");
  if (bodies == nullptr || bodies->kind != Node::Kind::map) return false;
  return std::any_of(bodies->entries.begin(), bodies->entries.end(), [&](const MapEntry& body) {
    const Node* shape = in(*body.value, "shape");
    const auto& kinds = kinds_of_solid_shapes();
    return shape != nullptr && std::any_of(kinds.begin(), kinds.end(),
                                           [&](const std::string& kind) { return in(*shape, kind) != nullptr; });
  });
}

SpaceModel solid_model_of_tree(const NodePtr& root, Report& report, const std::string& file) {
  SpaceReader reader(report, file);
  const NodePtr tree = apply_parameters(root, report, reader.warnings());
  SpaceModel model = reader.read({tree, ""});
  report.throw_if_any(file);
  return model;
}

}  // namespace scabo::input
