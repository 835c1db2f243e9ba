// `output` of models in space: values at points, and resultants over sections.
#include <fmt/format.h>

#include <algorithm>

#include "scabo/input/space/space_reader.hpp"
#include "scabo/input/suggestions.hpp"
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
  if (report_.count() == before) model_.points.push_back(std::move(point));
}

/// `cut: {section: {point: [0, 0, 1], normal: [0, 0, 1], body: post}}`.
void SpaceReader::section(const Entry& entry) {
  const MapReader quantity(report_, entry.value, {"section"}, "{section: {point: [0, 0, 1], normal: [0, 0, 1]}}",
                           only_in_the_plane({"edge", "displacement", "axes", "relative_to", "about"}));
  const auto value = quantity.is_map() ? quantity.need("section") : std::nullopt;
  if (!value) return;
  const std::size_t before = report_.count();
  const MapReader map(report_, *value, {"point", "normal", "about", "body"}, "{point: [0, 0, 1], normal: [0, 0, 1]}",
                      {{"from", "a section in space is a plane: give its 'point' and 'normal'"},
                       {"to", "a section in space is a plane: give its 'point' and 'normal'"}});
  SpaceSection section;
  section.name = entry.key;
  section.source = value->source();
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
  const MapReader map(
      report_, value, {"points", "history"}, "{points: [[0, 0, 1]]}",
      only_in_the_plane({"lines", "grid", "fields", "every", "discrete_problems", "error", "error_of"}));
  if (const auto points = map.get("points"))
    for (const Value& item : read_list(report_, *points, "[[0, 0, 1]]").value_or(std::vector<Value>{})) point(item);
  if (const auto history = map.get("history"))
    for (const Entry& entry :
         read_named(report_, *history, "sections", "{cut: {section: {point: [0, 0, 1], normal: [0, 0, 1]}}}"))
      section(entry);
}

}  // namespace scabo::input
