// `output` of models in space: values at points and along lines, and resultants over sections.
#include <fmt/format.h>

#include <algorithm>

#include "scabo/input/space/space_reader.hpp"
#include "scabo/input/suggestions.hpp"
#include "scabo/model/limits.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::input {

using namespace model;

/// The index of a body; -1 if there is none of this name, which is reported.
int SpaceReader::body_named(const Value& value) {
  std::vector<std::string> known;
  for (const SpaceBody& body : model_.bodies) known.push_back(body.name);
  const auto text = read_text(report_, value);
  const auto found = text ? std::find(known.begin(), known.end(), *text) : known.end();
  if (found != known.end()) return static_cast<int>(found - known.begin());
  if (text)
    report_.error(value, fmt::format("there is no body named {}{}", quoted_name(*text), suggestion(*text, known)));
  return -1;
}

/// `[0, 0, 1]` or `{at: [0, 0, 1], name: tip, body: post}`.
void SpaceReader::point(const Value& value) {
  SpacePoint point;
  point.source = value.source();
  point.name = fmt::format("point_{}", model_.points.size() + 1);
  const std::size_t before = report_.count();
  if (value.node->kind == Node::Kind::sequence) {
    point.at = vector(value);
  } else {
    const MapReader map(report_, value, {"at", "name", "body"}, "[0, 0, 1] or {at: [0, 0, 1], name: tip}");
    if (const auto at = map.need("at")) point.at = vector(*at);
    if (const auto name = map.get("name"))
      if (const auto text = read_text(report_, *name); text && check_name(report_, name->source(), *text))
        point.name = *text;
    if (const auto body = map.get("body")) point.body = body_named(*body);
  }
  const auto is_named_so = [&](const SpacePoint& other) { return other.name == point.name; };
  if (std::any_of(model_.points.begin(), model_.points.end(), is_named_so))
    report_.error(value, fmt::format("another point is already named '{}': rename one of them", point.name));
  if (report_.count() == before) model_.points.push_back(std::move(point));
}

/// `{from: [0, 0, 0], to: [0, 0, 1], points: 101, name: axis, body: post}`.
void SpaceReader::line(const Value& value) {
  const std::size_t before = report_.count();
  const MapReader map(report_, value, {"from", "to", "points", "name", "body"}, "{from: [0, 0, 0], to: [0, 0, 1]}");
  SpaceLine line;
  line.source = value.source();
  line.name = fmt::format("line_{}", model_.lines.size() + 1);
  line.from = needed_vector(report_, map, "from");
  line.to = needed_vector(report_, map, "to");
  if (const auto points = map.get("points"))
    line.points = static_cast<int>(read_integer(report_, *points, limits::line_points).value_or(line.points));
  if (const auto name = map.get("name"))
    if (const auto text = read_text(report_, *name); text && check_name(report_, name->source(), *text))
      line.name = *text;
  if (const auto body = map.get("body")) line.body = body_named(*body);
  if (report_.count() == before && line.from == line.to)
    report_.error(value, "ends where it starts: give two different points, or use 'points'");
  for (const SpaceLine& other : model_.lines)
    if (other.name == line.name) report_.error(value, fmt::format("another line is already named '{}'", line.name));
  if (report_.count() == before) model_.lines.push_back(std::move(line));
}

namespace {

struct SpaceWord {
  const char* word;
  SpaceQuantity::Kind kind;
  bool vector;  // followed by _x, _y or _z
};
using NumberKind = SpaceQuantity::Kind;
constexpr SpaceWord words_of_model[] = {{"elastic_energy", NumberKind::elastic_energy, false},
                                        {"external_energy", NumberKind::external_energy, false},
                                        {"friction_energy", NumberKind::friction_energy, false}};
constexpr SpaceWord words_of_contact[] = {{"force", NumberKind::force, true},
                                          {"normal_force", NumberKind::normal_force, true},
                                          {"tangential_force", NumberKind::tangential_force, true},
                                          {"moment", NumberKind::contact_moment, true},
                                          {"max_pressure", NumberKind::max_pressure, false},
                                          {"max_gap", NumberKind::max_gap, false},
                                          {"open", NumberKind::open, false},
                                          {"stick", NumberKind::stick, false},
                                          {"slip", NumberKind::slip, false},
                                          {"broken", NumberKind::broken, false}};
constexpr SpaceWord words_of_support[] = {{"reaction", NumberKind::reaction, true},
                                          {"moment", NumberKind::support_moment, true}};
constexpr SpaceWord words_of_springs[] = {{"reaction", NumberKind::spring_force, true}};
constexpr SpaceWord words_of_bars[] = {{"tension", NumberKind::bar_tension, false}};
constexpr const char* words_of_stress[] = {"stress_xx", "stress_yy", "stress_zz",
                                           "stress_xy", "stress_yz", "stress_xz"};
constexpr SpaceWord words_of_bolts[] = {{"tension", NumberKind::tension, false},
                                        {"shortening", NumberKind::shortening, false}};

/// Whether `text` is one of these words, which it then sets.
template <std::size_t count>
bool find_space_word(const SpaceWord (&words)[count], const std::string& text, SpaceQuantity& quantity) {
  for (const SpaceWord& known : words)
    for (int k = 0; k < (known.vector ? 3 : 1); ++k)
      if (text == (known.vector ? fmt::format("{}_{}", known.word, "xyz"[k]) : known.word)) {
        quantity.kind = known.kind;
        quantity.component = k;
        return true;
      }
  return false;
}

/// The same for the values at a point.
bool find_word_of_point(const std::string& text, SpaceQuantity& quantity) {
  const auto set = [&](NumberKind kind, int component) {
    quantity.kind = kind;
    quantity.component = component;
    return true;
  };
  for (int k = 0; k < 6; ++k)
    if (text == words_of_stress[k]) return set(NumberKind::stress, k);
  for (int k = 0; k < 3; ++k) {
    if (text == fmt::format("u{}", "xyz"[k])) return set(NumberKind::displacement, k);
    if (text == fmt::format("principal_{}", k + 1)) return set(NumberKind::principal, k);
  }
  return text == "von_mises" && set(NumberKind::von_mises, 0);
}

}  // namespace

/// The index of a point of `output.points`; -1 if there is none of this name, which is reported.
int SpaceReader::point_named(const Value& value) {
  std::vector<std::string> known;
  for (const SpacePoint& point : model_.points) known.push_back(point.name);
  const auto text = read_text(report_, value);
  const auto found = text ? std::find(known.begin(), known.end(), *text) : known.end();
  if (found != known.end()) return static_cast<int>(found - known.begin());
  if (text)
    report_.error(
        value, fmt::format("there is no point of 'points' named {}{}", quoted_name(*text), suggestion(*text, known)));
  return -1;
}

/// `sliding: joint.tangential_force_x`.
void SpaceReader::quantity(const Entry& entry) {
  const auto text = read_text(report_, entry.value);
  if (!text) return;
  SpaceQuantity quantity;
  quantity.name = entry.key;
  const auto dot = text->rfind('.');
  const std::string name = dot == std::string::npos ? "" : text->substr(0, dot),
                    word = dot == std::string::npos ? *text : text->substr(dot + 1);
  bool found = name.empty() && find_space_word(words_of_model, word, quantity), named = found;
  const auto look = [&](const auto& words, const auto& parts) {
    if (found || name.empty()) return;
    SpaceQuantity candidate = quantity;
    if (!find_space_word(words, word, candidate)) return;
    named = true;
    for (std::size_t i = 0; i < parts.size() && !found; ++i)
      if (parts[i].name == name) {
        candidate.of = static_cast<int>(i);
        quantity = candidate;
        found = true;
      }
  };
  look(words_of_contact, model_.contacts);
  look(words_of_support, model_.supports);
  look(words_of_springs, model_.springs);
  look(words_of_bars, model_.bars);
  look(words_of_bolts, model_.bodies);
  if (SpaceQuantity candidate = quantity; !found && !name.empty() && find_word_of_point(word, candidate)) {
    named = true;
    for (std::size_t i = 0; i < model_.points.size() && !found; ++i)
      if (model_.points[i].name == name) {
        candidate.of = static_cast<int>(i);
        quantity = candidate;
        found = true;
      }
  }
  if (found && (quantity.kind == NumberKind::tension || quantity.kind == NumberKind::shortening))
    found = body_at(quantity.of).preload.has_value();
  if (found && quantity.kind == NumberKind::broken &&
      model_.contacts[static_cast<std::size_t>(quantity.of)].law.cohesion == 0.0)
    return report_.error(entry.value, fmt::format("contact '{}' has no 'cohesion' that could be lost", name));
  if (found) return model_.quantities.push_back(std::move(quantity));
  if (named)
    return report_.error(
        entry.value, fmt::format("there is no contact, support, springs, bolt, bar or point called {} that has '{}'",
                                 quoted_name(name), word));
  report_.error(
      entry.value,
      fmt::format("{} is not a number of a history in space, as joint.force_x, joint.max_pressure, joint.open, "
                  "ground.reaction_z, bolt.tension, tip.uz or elastic_energy are",
                  quoted_name(*text)));
}

/// `foot: {face: wall.bottom, about: [3, 0, 0]}`.
void SpaceReader::face_resultant(const Entry& entry) {
  const MapReader map(report_, entry.value, {"face", "about"}, "{face: block.bottom}", only_in_the_plane({"axes"}));
  const std::size_t before = report_.count();
  SpaceFaceResultant of;
  of.name = entry.key;
  if (const auto on = map.need("face"))
    if (const auto place = face(*on)) of.on = *place;
  if (const auto about = map.get("about")) of.about = vector(*about);
  if (report_.count() == before) model_.resultants.push_back(std::move(of));
}

/// `drift: {displacement: top, relative_to: foot}`.
void SpaceReader::displacement_of_point(const Entry& entry) {
  const MapReader map(report_, entry.value, {"displacement", "relative_to"}, "{displacement: tip, relative_to: foot}",
                      only_in_the_plane({"axes"}));
  const std::size_t before = report_.count();
  SpaceDisplacement of;
  of.name = entry.key;
  if (const auto point = map.need("displacement")) of.point = point_named(*point);
  if (const auto other = map.get("relative_to")) of.relative_to = point_named(*other);
  if (report_.count() == before) model_.displacements.push_back(std::move(of));
}

/// A section, the resultant over a face or the displacement of a point.
void SpaceReader::quantity_of_several(const Entry& entry) {
  constexpr const char* example =
      "{section: {point: [0, 0, 1], normal: [0, 0, 1]}}, {face: block.bottom} or {displacement: tip}";
  if (entry.value.node->kind != Node::Kind::map) return (void)MapReader(report_, entry.value, {"section"}, example);
  const auto has = [&](const char* key) { return entry.value.node->find(key) != nullptr; };
  if (has("face")) return face_resultant(entry);
  if (has("displacement")) return displacement_of_point(entry);
  const MapReader map(report_, entry.value, {"section"}, example,
                      {{"edge", "what acts on a body in space acts through its faces: write 'face'"},
                       {"axes", "a model in space does not have it (docs/model/space.md): leave it out"},
                       {"about", "stands within a section, or beside 'face'"},
                       {"relative_to", "stands beside 'displacement', a point of 'points'"}});
  if (const auto value = map.need("section")) section(entry, *value);
}

/// `cut: {section: {point: [0, 0, 1], normal: [0, 0, 1], body: post}}`.
void SpaceReader::section(const Entry& entry, const Value& value) {
  const std::size_t before = report_.count();
  const MapReader map(report_, value, {"point", "normal", "about", "body"}, "{point: [0, 0, 1], normal: [0, 0, 1]}",
                      {{"from", "a section in space is a plane: give its 'point' and 'normal'"},
                       {"to", "a section in space is a plane: give its 'point' and 'normal'"}});
  SpaceSection section;
  section.name = entry.key;
  section.source = value.source();
  if (const auto point = map.need("point")) section.point = vector(*point);
  const auto normal = map.need("normal");
  if (normal) section.normal = vector(*normal);
  if (normal && report_.count() == before && section.normal.isZero(0.0))
    report_.error(*normal, "has no direction: not all of it may be 0");
  section.normal.stableNormalize();
  if (const auto about = map.get("about")) section.about = vector(*about);
  if (const auto body = map.get("body")) {
    section.body = body_named(*body);
    if (section.body >= 0 && body_at(section.body).rigid)
      report_.error(*body, fmt::format("body {} is rigid and has no stress: name an elastic one",
                                       quoted_name(body_at(section.body).name)));
  }
  if (report_.count() == before) model_.sections.push_back(std::move(section));
}

void SpaceReader::output(const Value& value) {
  const MapReader map(report_, value, {"points", "lines", "history"}, "{points: [[0, 0, 1]]}",
                      only_in_the_plane({"grid", "fields", "every", "discrete_problems", "error", "error_of"}));
  if (const auto points = map.get("points"))
    for (const Value& item : read_list(report_, *points, "[[0, 0, 1]]").value_or(std::vector<Value>{})) point(item);
  if (const auto lines = map.get("lines"))
    for (const Value& item :
         read_list(report_, *lines, "[{from: [0, 0, 0], to: [0, 0, 1]}]").value_or(std::vector<Value>{}))
      line(item);
  if (const auto history = map.get("history"))
    for (const Entry& entry :
         read_named(report_, *history, "quantities", "{cut: {section: {point: [0, 0, 1], normal: [0, 0, 1]}}}"))
      entry.value.node->kind == Node::Kind::scalar ? quantity(entry) : quantity_of_several(entry);
}

}  // namespace scabo::input
