// Reading of a model file: text, tree, sections, validation.
#include "scabo/input/read_model.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/input/document.hpp"
#include "scabo/input/overrides.hpp"
#include "scabo/input/parameters.hpp"
#include "scabo/input/reading.hpp"
#include "scabo/input/space/read_solid_model.hpp"
#include "scabo/input/text_file.hpp"
#include "scabo/model/bodies_in_one_place.hpp"

namespace scabo::input {

void read_analysis(Reading& reading, const Value& value) {
  const MapReader map(reading.report, value, {"space", "type", "plane", "thickness", "forces", "modes"},
                      "{plane: strain, thickness: 1.0}");
  Analysis& analysis = reading.model.analysis;
  bool type_known = true;
  if (const auto space = map.get("space")) read_flag(reading.report, *space);  // true: read_solid_model.cpp
  if (const auto type = map.get("type")) {
    const std::string remedy = "write static";
    const auto choice = read_choice(reading.report, *type, {"static", "modal", "dynamic"},
                                    {{"harmonic", remedy},
                                     {"buckling", remedy},
                                     {"fracture", remedy},
                                     {"axisymmetric", "write type: static and plane: axisymmetric"}});
    if (choice && *choice == "modal") analysis.type = AnalysisType::modal;
    reading.all_dynamic = choice && *choice == "dynamic";
    type_known = choice.has_value();
  }
  if (const auto modes = map.get("modes")) {
    if (analysis.type == AnalysisType::modal || !type_known) {
      analysis.modes = static_cast<int>(read_integer(reading.report, *modes, limits::modes).value_or(10));
    } else {
      map.refuse("modes", "belongs to a modal analysis: write type: modal, or leave it out");
    }
  }
  if (const auto plane = map.get("plane")) {
    const auto choice = read_choice(reading.report, *plane, {"stress", "strain", "axisymmetric"});
    if (choice && *choice == "strain") reading.model.analysis.plane = Plane::strain;
    if (choice && *choice == "axisymmetric") reading.model.analysis.plane = Plane::revolution;
  }
  if (const auto forces = map.get("forces")) {
    const auto choice = read_choice(reading.report, *forces, {"whole", "per_radian"});
    analysis.per_radian = choice && *choice == "per_radian";
    if (!analysis.revolved())
      map.refuse("forces", "is for bodies of revolution: write plane: axisymmetric, or leave it out");
  }
  if (analysis.revolved()) {
    map.refuse("thickness", "bodies of revolution go around the axis as a whole: leave 'thickness' out");
  } else if (const auto thickness = map.get("thickness")) {
    reading.model.analysis.thickness = read_number(reading.report, *thickness).value_or(1.0);
  }
}

void read_solver(Reading& reading, const Value& value) {
  const MapReader map(reading.report, value, {"tolerance", "iterations", "halvings", "uniqueness", "factorisation"},
                      "{tolerance: 1e-10}");
  SolverOptions& solver = reading.model.solver;
  if (const auto tolerance = map.get("tolerance"))
    solver.tolerance = read_number(reading.report, *tolerance).value_or(solver.tolerance);
  if (const auto iterations = map.get("iterations")) {
    solver.iterations = static_cast<int>(read_integer(reading.report, *iterations, limits::iterations).value_or(50));
  }
  if (const auto halvings = map.get("halvings")) {
    solver.halvings = static_cast<int>(read_integer(reading.report, *halvings, limits::halvings).value_or(6));
  }
  if (const auto uniqueness = map.get("uniqueness"))
    solver.uniqueness = read_flag(reading.report, *uniqueness).value_or(false);
  if (const auto factorisation = map.get("factorisation")) {
    const auto choice = read_choice(reading.report, *factorisation, {"cholmod", "mumps"}, {});
    if (choice && *choice == "mumps") solver.factorisation = Factorisation::mumps;
  }
}

namespace {

constexpr long format_version = 1;

void check_version(Reading& reading, const MapReader& map) {
  if (!map.has("scabo") && map.all_known()) {
    reading.report.error(map.map(), "the format version is missing: write 'scabo: 1' in the first line");
  }
  const auto value = map.get("scabo");
  if (!value) return;
  const auto version = read_number(reading.report, *value);
  if (version && *version != static_cast<double>(format_version)) {
    reading.report.error(
        *value, fmt::format("this program reads format version {}, not {}", format_version, value->node->text));
  }
}

constexpr const char* about_units =
    "leave it out, and write all numbers in one consistent set of units, such as m, N, Pa, kg/m3 or mm, N, MPa, t/mm3; "
    "`scabo plot --units m,N` and `scabo report --units m,N` label pictures";

void collect_texts(const Node& node, std::set<std::string>& texts) {
  if (node.kind == Node::Kind::scalar) texts.insert(node.text);
  for (const NodePtr& item : node.items) collect_texts(*item, texts);
  for (const MapEntry& entry : node.entries) collect_texts(*entry.value, texts);
}

/// `initial: [{on: block, velocity: [1, 0], rotation: 0.5}]`.
void read_initial(Reading& reading, const Value& value) {
  const auto items = read_list(reading.report, value, "[{on: block, velocity: [1, 0]}]");
  for (const Value& item : items.value_or(std::vector<Value>{})) {
    const MapReader map(reading.report, item, {"on", "velocity", "rotation"}, "{on: block, velocity: [1, 0]}");
    InitialVelocity initial;
    initial.source = item.source();
    if (const auto on = map.need("on")) {
      const ReadPlace place = read_place(reading, *on);
      if (place.place && place.place->kind != Place::Kind::body)
        reading.report.error(*on, "must name a body: an initial velocity is that of a whole body");
      initial.body = place.body;
    }
    if (const auto velocity = map.get("velocity"))
      initial.velocity = read_vector(reading.report, *velocity).value_or(Vec2::Zero());
    if (const auto rotation = map.get("rotation"))
      initial.rotation = read_number(reading.report, *rotation).value_or(0.0);
    reading.model.initial.push_back(initial);
  }
}

/// `added_mass: [{on: dam.upstream, level: 92, density: 1000}]`.
void read_added_masses(Reading& reading, const Value& value) {
  constexpr const char* example = "{on: dam.upstream, level: 92, density: 1000}";
  const auto items = read_list(reading.report, value, fmt::format("[{}]", example));
  for (const Value& item : items.value_or(std::vector<Value>{})) {
    const std::size_t before = reading.report.count();
    const MapReader map(reading.report, item, {"on", "level", "bottom", "density", "up"}, example);
    AddedMass water;
    water.source = item.source();
    if (const auto on = map.need("on")) water.on = read_place(reading, *on).place;
    water.level = number_or_unread(reading, map.need("level"));
    water.density = number_or_unread(reading, map.need("density"));
    if (const auto bottom = map.get("bottom")) water.bottom = read_number(reading.report, *bottom);
    if (const auto up = map.get("up"))
      if (const auto direction = read_vector(reading.report, *up))
        water.up = direction->norm() > 0.0 ? Vec2(direction->stableNormalized()) : Vec2(Vec2::Zero());
    if (water.on && reading.report.count() == before) reading.model.added_masses.push_back(std::move(water));
  }
}

/// `point_masses: [{on: tower.top_left, mass: 2000}]`.
void read_point_masses(Reading& reading, const Value& value) {
  constexpr const char* example = "{on: tower.top_left, mass: 2000}";
  const auto items = read_list(reading.report, value, fmt::format("[{}]", example));
  for (const Value& item : items.value_or(std::vector<Value>{})) {
    const std::size_t before = reading.report.count();
    const MapReader map(reading.report, item, {"on", "mass"}, example);
    PointMass point;
    point.source = item.source();
    if (const auto on = map.need("on")) point.on = read_place(reading, *on).place;
    point.mass = number_or_unread(reading, map.need("mass"));
    if (point.on && reading.report.count() == before) reading.model.point_masses.push_back(std::move(point));
  }
}

/// Reads all sections; each may use those before it.
void read_sections(Reading& reading, const Value& root) {
  const MapReader map(reading.report, root,
                      {"scabo",       "title",  "parameters",         "analysis", "materials", "bodies",     "supports",
                       "springs",     "loads",  "contact_properties", "contacts", "ties",      "curves",     "steps",
                       "solver",      "output", "tolerance",          "restart",  "initial",   "added_mass", "bars",
                       "point_masses"},
                      "'scabo: 1' and sections",
                      {{"units", about_units}, {"unit", about_units}, {"unit_system", about_units}});
  if (!map.is_map()) {
    reading.bodies_known = false;
    return;
  }
  check_version(reading, map);
  if (const auto title = map.get("title")) reading.model.title = read_text(reading.report, *title).value_or("");
  if (const auto analysis = map.get("analysis")) read_analysis(reading, *analysis);
  if (const auto solver = map.get("solver")) read_solver(reading, *solver);

  reading.materials_known = map.has("materials");
  if (const auto materials = map.get("materials")) read_materials(reading, *materials);
  for (const char* section : {"contacts", "ties"})
    if (const MapEntry* entry = root.node->find(section)) collect_texts(*entry->value, reading.texts_of_contacts);
  if (const auto bodies = map.need("bodies")) {
    read_bodies(reading, *bodies);
  } else {
    reading.bodies_known = false;
  }
  const auto& bodies = reading.model.bodies;
  if (std::any_of(bodies.begin(), bodies.end(), [](const Body& body) { return !body.rigid; })) map.need("materials");

  if (const auto supports = map.get("supports")) read_supports(reading, *supports);
  if (const auto springs = map.get("springs")) read_springs(reading, *springs);
  if (const auto bars = map.get("bars")) read_bars(reading, *bars);
  if (const auto loads = map.get("loads")) read_loads(reading, *loads);
  read_contacts_and_ties(reading, map.get("contact_properties"), map.get("contacts"), map.get("ties"));
  find_contacts_of_loads(reading);
  tell_of_pieces(reading);
  const std::size_t before_steps = reading.report.count();
  if (const auto restart = map.get("restart")) read_restart(reading, *restart);
  if (const auto curves = map.get("curves")) read_curves(reading, *curves);
  read_steps(reading, map.get("steps"));
  reading.steps_known = reading.report.count() == before_steps;
  find_named_steps(reading);
  if (const auto initial = map.get("initial")) read_initial(reading, *initial);
  if (const auto water = map.get("added_mass")) read_added_masses(reading, *water);
  if (const auto masses = map.get("point_masses")) read_point_masses(reading, *masses);
  if (const auto output = map.get("output")) read_output(reading, *output);
  if (const auto tolerance = map.get("tolerance"))
    read_tolerance(reading, *tolerance);
  else
    check_automatic_sizes(reading);
  // A misspelt section may be the missing one.
  if (!map.all_known()) reading.places_known = reading.conditions_known = reading.steps_known = false;
}

/// Warns about parts of the file that have no effect in a modal analysis, so that one file can be used for both kinds
/// of analysis.
void tell_what_has_no_effect(Reading& reading, const Value& root) {
  Model& model = reading.model;
  if (model.analysis.type != AnalysisType::modal || root.node->kind != Node::Kind::map) return;
  std::vector<std::string> parts;
  for (const char* section : {"bars", "loads", "contact_properties", "contacts", "curves", "restart", "steps", "solver",
                              "output", "tolerance"}) {
    const MapEntry* entry = root.node->find(section);
    if (entry != nullptr && entry->value && entry->value->kind != Node::Kind::null) parts.emplace_back(section);
  }
  if (std::any_of(model.bodies.begin(), model.bodies.end(), [](const Body& body) { return body.rigid; }))
    parts.emplace_back("rigid bodies");
  if (has_stages(model.bodies) || has_stages(model.supports)) parts.emplace_back("stages of construction");
  if (std::any_of(model.bodies.begin(), model.bodies.end(),
                  [](const Body& body) { return body.mesh.tolerance.has_value(); }))
    parts.emplace_back("tolerances of the mesh");
  if (std::any_of(model.springs.begin(), model.springs.end(),
                  [](const Spring& spring) { return spring.at_rest[0] != 0.0 || spring.at_rest[1] != 0.0; }))
    parts.emplace_back("displacements of springs at rest");
  if (!parts.empty()) {
    std::string list = parts.front();
    for (std::size_t i = 1; i < parts.size(); ++i) {
      list += i + 1 < parts.size() ? ", " : " and ";
      list += parts[i];
    }
    model.warnings.push_back({WarningKind::input, "modal",
                              fmt::format("a modal analysis ignores the model's {}{}", list,
                                          model.contacts.empty() ? "" : ": each body vibrates by itself")});
  }
  for (Support& support : model.supports) support.added = 0, support.removed = -1, support.placed = false;
  for (const Support& support : model.supports)
    if (std::any_of(support.displacement.begin(), support.displacement.end(),
                    [](const auto& u) { return u.value_or(0.0) != 0.0; }))
      model.warnings.push_back(
          {WarningKind::input, support.name,
           fmt::format("a modal analysis takes support '{}' as fixed and ignores the displacement that it prescribes",
                       support.name)});
}

/// Warns of gravity on a body whose stress is already that of ground under its weight.
void tell_of_weight_twice(Model& model) {
  const auto acts_on = [](const Load& load, int body, const Body& of) {
    return load.on ? load.on->body == body : !of.rigid;
  };
  for (const Load& gravity : model.loads)
    for (const Load& field : model.loads) {
      if (!std::holds_alternative<Gravity>(gravity.kind) || !std::holds_alternative<GroundStress>(field.kind)) continue;
      for (std::size_t b = 0; b < model.bodies.size(); ++b) {
        const Body& body = model.bodies[b];
        const auto index = static_cast<int>(b);
        if (body.outside || !acts_on(gravity, index, body) || !acts_on(field, index, body)) continue;
        model.warnings.push_back(
            {WarningKind::input, gravity.name,
             fmt::format(
                 "gravity '{}' acts on body '{}', whose stress '{}' is that of ground under its weight already: "
                 "the weight counts twice; name the other bodies by 'on', if it should not",
                 gravity.name, body.name, field.name)});
        break;
      }
    }
}

/// What validate cannot judge, because it could not be read.
Gaps gaps_of(const Reading& reading) {
  Gaps gaps;
  gaps.materials = !reading.materials_known;
  gaps.bodies = !reading.bodies_known || !reading.rigid_known;
  gaps.places = !reading.places_known;
  gaps.conditions = !reading.conditions_known;
  gaps.steps = !reading.steps_known;
  for (const BodyState& state : reading.bodies) {
    gaps.held.push_back(state.held);
    gaps.touched.push_back(state.touched);
  }
  return gaps;
}

/// The model of a tree, whose formulas are replaced by their values, with the mistakes that were found in its text.
Model read_tree(Reading& reading, const NodePtr& tree, const std::string& file) {
  const NodePtr root = apply_parameters(tree, reading.report, reading.model.warnings);
  const Value whole{root, ""};
  read_sections(reading, whole);
  reading.report.add(whole, validate(reading.model, gaps_of(reading)));
  tell_what_has_no_effect(reading, whole);
  tell_of_weight_twice(reading.model);
  reading.report.throw_if_any(file);
  if (auto warning = model::warning_of_bodies_in_one_place(reading.model))
    reading.model.warnings.push_back(std::move(*warning));
  return std::move(reading.model);
}

/// The tree of a text with its overrides; their mistakes are in `report`.
NodePtr tree_of_text(std::string_view text, const std::string& file, const std::vector<Override>& overrides,
                     Report& report) {
  std::vector<Diagnostic> mistakes;
  const NodePtr root = parse_yaml(text, mistakes);
  for (const Diagnostic& mistake : mistakes) report.error(mistake.at, mistake.message);
  if (!root) report.throw_if_any(file);
  if (root->kind == Node::Kind::null) refuse_file(file, "is empty: a model file starts with 'scabo: 1'");
  return apply_overrides(root, overrides, report);
}

void refuse_space(const Node& root, const std::string& file) {
  if (is_in_space(root))
    refuse_file(file,
                "is a model in space (analysis: {space: true}), which `scabo run`, `scabo check`, `scabo sweep` "
                "and Python take, in one process: use these");
}

}  // namespace

namespace {

/// `text`: of the model file; none of a model that was built in Python.
AnyModel read_any_tree(Reading& reading, const NodePtr& root, const std::string& file,
                       std::shared_ptr<const std::string> text) {
  reading.model.file = file;
  if (is_in_space(*root)) {
    SpaceModel model = solid_model_of_tree(root, reading.report, file);
    model.text = std::move(text);
    return model;
  }
  reading.model.text = std::move(text);
  return read_tree(reading, root, file);
}

}  // namespace

Document parse_document(std::string_view text, const std::string& file, const std::vector<Override>& overrides) {
  Reading reading;
  const NodePtr root = tree_of_text(text, file, overrides, reading.report);
  return {root, read_any_tree(reading, root, file, std::make_shared<const std::string>(text))};
}

AnyModel read_any_model(const std::string& file, const std::vector<Override>& overrides) {
  return parse_document(read_text_file(file), file, overrides).model;
}

Model parse_model(std::string_view text, const std::string& file, const std::vector<Override>& overrides) {
  Reading reading;
  const NodePtr root = tree_of_text(text, file, overrides, reading.report);
  refuse_space(*root, file);
  return std::get<Model>(read_any_tree(reading, root, file, std::make_shared<const std::string>(text)));
}

AnyModel model_of_tree(const NodePtr& root, const std::string& file) {
  Reading reading;
  return read_any_tree(reading, root, file, nullptr);
}

Model read_model(const std::string& file, const std::vector<Override>& overrides) {
  return parse_model(read_text_file(file), file, overrides);
}

}  // namespace scabo::input
