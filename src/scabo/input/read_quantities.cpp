// `tolerance: {of: joint.normal_force, relative: 1e-4}` and `output: {error_of: [joint.normal_force, tip.uy]}`.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scabo/input/reading.hpp"
#include "scabo/input/suggestions.hpp"
#include "scabo/model/side_faces.hpp"

namespace scabo::input {

namespace {

constexpr const char* tolerance_example = "{of: joint.normal_force, relative: 1e-4}";
constexpr const char* quantities_example = "[joint.normal_force, floor.reaction_y]";

/// What stands after the last dot.
struct QuantityWord {
  const char* word;
  Quantity::Kind kind;
  int component;
};
constexpr QuantityWord quantity_words[] = {
    {"normal_force", Quantity::Kind::normal_force, 0}, {"tangential_force", Quantity::Kind::tangential_force, 0},
    {"max_gap", Quantity::Kind::max_gap, 0},           {"reaction_x", Quantity::Kind::reaction, 0},
    {"reaction_y", Quantity::Kind::reaction, 1},       {"ux", Quantity::Kind::displacement, 0},
    {"uy", Quantity::Kind::displacement, 1},           {"K_I", Quantity::Kind::stress_intensity, 0},
    {"K_II", Quantity::Kind::stress_intensity, 1}};
/// That have a history, but no error bar.
constexpr QuantityWord history_words[] = {{"force_x", Quantity::Kind::contact_force, 0},
                                          {"force_y", Quantity::Kind::contact_force, 1},
                                          {"moment", Quantity::Kind::contact_moment, 0},
                                          {"vx", Quantity::Kind::velocity, 0},
                                          {"vy", Quantity::Kind::velocity, 1},
                                          {"stress_xx", Quantity::Kind::stress, 0},
                                          {"stress_yy", Quantity::Kind::stress, 1},
                                          {"stress_xy", Quantity::Kind::stress, 2},
                                          {"stress_zz", Quantity::Kind::stress, 3},
                                          {"principal_1", Quantity::Kind::stress, 4},
                                          {"principal_2", Quantity::Kind::stress, 5},
                                          {"principal_3", Quantity::Kind::stress, 6},
                                          {"von_mises", Quantity::Kind::stress, 7},
                                          {"max_pressure", Quantity::Kind::max_pressure, 0},
                                          {"centre_x", Quantity::Kind::centre_of_pressure, 0},
                                          {"centre_y", Quantity::Kind::centre_of_pressure, 1},
                                          {"open", Quantity::Kind::pairs_in_state, 0},
                                          {"stick", Quantity::Kind::pairs_in_state, 1},
                                          {"slip", Quantity::Kind::pairs_in_state, 2},
                                          {"broken", Quantity::Kind::broken_pairs, 0},
                                          {"first_pair_in_contact", Quantity::Kind::end_pair, 0},
                                          {"last_pair_in_contact", Quantity::Kind::end_pair, 1},
                                          {"pore_force", Quantity::Kind::pore_force, 0},
                                          {"total_normal_force", Quantity::Kind::total_normal_force, 0},
                                          {"tension", Quantity::Kind::bar_tension, 0},
                                          {"T", Quantity::Kind::t_stress, 0},
                                          {"T_left", Quantity::Kind::t_stress, 1},
                                          {"T_right", Quantity::Kind::t_stress, 2},
                                          {"G", Quantity::Kind::energy_release, 0},
                                          {"J", Quantity::Kind::energy_release, 1},
                                          {"K_tt", Quantity::Kind::corner_stress, 0},
                                          {"K_rt", Quantity::Kind::corner_stress, 1}};

/// Of the whole model, with a history only.
constexpr QuantityWord model_words[] = {
    {"external_energy", Quantity::Kind::external_energy, 0},  {"friction_energy", Quantity::Kind::friction_energy, 0},
    {"kinetic_energy", Quantity::Kind::energy_in_time, 0},    {"damping_energy", Quantity::Kind::energy_in_time, 1},
    {"impact_energy", Quantity::Kind::energy_in_time, 2},     {"projection_energy", Quantity::Kind::energy_in_time, 3},
    {"massless_energy", Quantity::Kind::energy_in_time, 4},   {"ground_velocity_x", Quantity::Kind::ground_velocity, 0},
    {"ground_velocity_y", Quantity::Kind::ground_velocity, 1}};

class QuantityReader {
 public:
  /// `for_history`: also numbers without an error bar.
  QuantityReader(Reading& reading, const Value& value, bool for_history = false)
      : reading_(reading), value_(value), for_history_(for_history) {}

  std::optional<Quantity> read() {
    const auto text = read_text(reading_.report, value_);
    if (!text) return {};
    quantity_.name = *text;
    quantity_.source = value_.source();
    if (*text == "elastic_energy") return quantity_;
    for (const QuantityWord& known : model_words)
      if (for_history_ && *text == known.word) {
        quantity_.kind = known.kind;
        quantity_.component = known.component;
        return quantity_;
      }
    const auto dot = text->rfind('.');
    const std::string word = dot == std::string::npos ? *text : text->substr(dot + 1);
    const auto* found = std::find_if(std::begin(quantity_words), std::end(quantity_words),
                                     [&](const QuantityWord& known) { return known.word == word; });
    if (for_history_ && found == std::end(quantity_words)) {
      found = std::find_if(std::begin(history_words), std::end(history_words),
                           [&](const QuantityWord& known) { return known.word == word; });
      if (found == std::end(history_words)) return refuse_for_history(word);
    }
    if (!for_history_ && found == std::end(quantity_words)) {
      std::vector<std::string> words{"elastic_energy"};
      for (const QuantityWord& known : quantity_words) words.emplace_back(known.word);
      const std::string near = nearest_name(word, words);
      return refuse(fmt::format(
          "'{}' is not a number that can have an error bar: write elastic_energy, or a name and one of normal_force, "
          "tangential_force, max_gap, reaction_x, reaction_y, ux, uy, K_I, K_II, as in joint.normal_force{}",
          one_line(word), near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near)));
    }
    if (dot == std::string::npos || dot == 0)
      return refuse(fmt::format("needs a name before '{0}', as in joint.{0}", word));
    quantity_.kind = found->kind;
    quantity_.component = found->component;
    const std::string name = text->substr(0, dot);
    switch (found->kind) {
      case Quantity::Kind::reaction:
        return of_support(name);
      case Quantity::Kind::displacement:
      case Quantity::Kind::velocity:
      case Quantity::Kind::stress:
        return name.find('.') == std::string::npos ? of_point(name) : of_corner(name);
      case Quantity::Kind::stress_intensity:
      case Quantity::Kind::t_stress:
      case Quantity::Kind::energy_release:
      case Quantity::Kind::corner_stress:
        return of_tip(name, word);
      case Quantity::Kind::contact_moment:
        return of_moment(name);
      case Quantity::Kind::bar_tension:
        return of_bar(name);
      default:
        return of_contact(name);
    }
  }

  /// A point or corner, for its displacement.
  std::optional<Quantity> read_point() {
    const auto text = read_text(reading_.report, value_);
    if (!text) return {};
    quantity_.name = *text;
    quantity_.source = value_.source();
    quantity_.kind = Quantity::Kind::displacement;
    return text->find('.') == std::string::npos ? of_point(*text) : of_corner(*text);
  }

 private:
  std::optional<Quantity> refuse_for_history(const std::string& word) {
    std::vector<std::string> words{"elastic_energy", "external_energy", "friction_energy", "kinetic_energy"};
    for (const QuantityWord& known : quantity_words) words.emplace_back(known.word);
    for (const QuantityWord& known : history_words) words.emplace_back(known.word);
    const std::string near = nearest_name(word, words);
    return refuse(
        fmt::format("'{}' is not a number that can have a history: write elastic_energy, external_energy, "
                    "friction_energy or kinetic_energy, or a name and one of {}, as in joint.normal_force{}",
                    one_line(word), fmt::join(words.begin() + 4, words.end(), ", "),
                    near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near)));
  }

  std::optional<Quantity> refuse(const std::string& message) {
    reading_.report.error(value_, message);
    return {};
  }

  /// The part named `name`, of parts with the names `known`; silent where one of them could not be read.
  std::optional<Quantity> find(const char* what, const std::string& name, const std::vector<std::string>& known,
                               bool all_known) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end())
      return all_known ? refuse(fmt::format("there is no {} named {}{}", what, quoted_name(name),
                                            reading_.report.full() ? "" : suggestion(name, known)))
                       : std::nullopt;
    quantity_.index = static_cast<int>(found - known.begin());
    return quantity_;
  }

  std::optional<Quantity> of_contact(const std::string& name) {
    std::vector<std::string> known;
    for (const Contact& contact : reading_.model.contacts) known.push_back(contact.name);
    return find("contact", name, known, reading_.conditions_known);
  }

  std::optional<Quantity> of_bar(const std::string& name) {
    std::vector<std::string> known;
    for (const Bar& bar : reading_.model.bars) known.push_back(bar.name);
    return find("bar", name, known, reading_.conditions_known);
  }

  /// Of a contact, or of a support that prescribes a rotation.
  std::optional<Quantity> of_moment(const std::string& name) {
    const auto& contacts = reading_.model.contacts;
    const auto& supports = reading_.model.supports;
    const auto is_named = [&](const auto& part) { return part.name == name; };
    const auto support = std::find_if(supports.begin(), supports.end(), is_named);
    if (support == supports.end() || std::any_of(contacts.begin(), contacts.end(), is_named)) return of_contact(name);
    quantity_.kind = Quantity::Kind::support_moment;
    quantity_.index = static_cast<int>(support - supports.begin());
    return quantity_;
  }

  std::optional<Quantity> of_support(const std::string& name) {
    std::vector<std::string> known;
    for (const Support& support : reading_.model.supports) known.push_back(support.name);
    const auto& springs = reading_.model.springs;
    const auto spring = std::find_if(springs.begin(), springs.end(), [&](const Spring& of) { return of.name == name; });
    if (spring == springs.end() || std::find(known.begin(), known.end(), name) != known.end())
      return find("support", name, known, reading_.conditions_known);
    if (!for_history_)
      return refuse(fmt::format("the force of springs, here '{}', has no error bar: name a support", name));
    quantity_.kind = Quantity::Kind::spring_force;
    quantity_.index = static_cast<int>(spring - springs.begin());
    return quantity_;
  }

  std::optional<Quantity> of_point(const std::string& name) {
    std::vector<std::string> known;
    for (const OutputPoint& point : reading_.model.output.points) known.push_back(point.name);
    if (!find("output point", name, known, true)) return {};
    const OutputPoint& point = reading_.model.output.points[static_cast<std::size_t>(quantity_.index)];
    quantity_.at = point.at;
    quantity_.index = point.body;
    return quantity_;
  }

  /// Sets the index of the body before the first dot. False if it is not known.
  bool find_body(const std::string& name) {
    const std::string body = name.substr(0, name.find('.'));
    quantity_.index = reading_.body_index(body);
    if (quantity_.index >= 0) return reading_.state(quantity_.index).shape;
    std::vector<std::string> known;
    if (!reading_.report.full())
      for (const Body& of : reading_.model.bodies) known.push_back(of.name);
    if (reading_.bodies_known)
      refuse(fmt::format("there is no body named {}{}", quoted_name(body), suggestion(body, known)));
    return false;
  }

  std::optional<Quantity> of_corner(const std::string& name) {
    if (!find_body(name)) return {};
    const std::string part = name.substr(name.find('.') + 1);
    const Body& body = reading_.body(quantity_.index);
    std::vector<std::string> known;
    for (const Corner& corner : body.outline.corners) {
      if (std::find(corner.names.begin(), corner.names.end(), part) != corner.names.end()) {
        quantity_.at = corner.position;
        return quantity_;
      }
      known.insert(known.end(), corner.names.rbegin(), corner.names.rend());
    }
    return refuse(fmt::format("body '{}' has no corner named {}{}", body.name, quoted_name(part),
                              reading_.report.full() ? "" : suggestion(part, known)));
  }

  /// Of a crack, or of the corner at the scaling centre by any of its names.
  std::optional<Quantity> of_tip(const std::string& name, const std::string& word) {
    if (name.find('.') == std::string::npos)
      return refuse(fmt::format("needs a body and its crack, as in plate.flaw.{}", word));
    if (!find_body(name)) return {};
    quantity_.crack = name.substr(name.find('.') + 1);
    const Body& body = reading_.body(quantity_.index);
    const std::string crack = quantity_.crack.substr(0, quantity_.crack.find('.'));
    std::vector<std::string> known;
    for (const Crack& of : body.cracks) known.push_back(of.name);
    if (body.rigid || std::find(known.begin(), known.end(), crack) != known.end()) return quantity_;
    if (std::string centre = name_of_centre_corner(body); !centre.empty()) {
      const Corner& corner = body.outline.corners[static_cast<std::size_t>(body.mesh.centre_corner)];
      if (std::find(corner.names.begin(), corner.names.end(), quantity_.crack) != corner.names.end()) {
        quantity_.crack = std::move(centre);
        return quantity_;
      }
      known.push_back(std::move(centre));
    }
    const bool corner = std::any_of(body.outline.corners.begin(), body.outline.corners.end(), [&](const Corner& of) {
      return std::find(of.names.begin(), of.names.end(), quantity_.crack) != of.names.end();
    });
    if (corner)
      return refuse(
          fmt::format("body '{0}' has no crack named {1}, and its scaling centre is not at this corner: only "
                      "there does a corner have factors (mesh: {{centre: ...}})",
                      body.name, quoted_name(quantity_.crack)));
    return refuse(fmt::format("body '{}' has no crack named {}{}", body.name, quoted_name(crack),
                              reading_.report.full() ? "" : suggestion(crack, known)));
  }

  Reading& reading_;
  const Value& value_;
  bool for_history_;
  Quantity quantity_;
};

}  // namespace

void read_quantities(Reading& reading, const Value& value, std::vector<Quantity>& quantities) {
  const auto items = read_list(reading.report, value, quantities_example);
  if (!items) return;
  for (const Value& item : *items)
    if (auto quantity = QuantityReader(reading, item).read()) quantities.push_back(std::move(*quantity));
}

namespace {

std::optional<Section> read_section(Reading& reading, const Value& value) {
  const std::size_t before = reading.report.count();
  const MapReader map(reading.report, value, {"from", "to", "body"}, "{from: [0, 1], to: [2, 1]}");
  Section section;
  if (const auto from = map.need("from")) section.from = read_vector(reading.report, *from).value_or(Vec2::Zero());
  if (const auto to = map.need("to")) section.to = read_vector(reading.report, *to).value_or(Vec2::Zero());
  const auto body = read_body_of(reading, map);
  if (!body || reading.report.count() > before) return {};
  section.body = *body;
  return section;
}

}  // namespace

namespace {

constexpr const char* history_forms =
    "{section: {from: [0, 1], to: [2, 1]}}, {edge: wall.bottom} or {displacement: wall.toe, axes: 30}";

/// `30`, in degrees, or a straight edge.
std::optional<ResultAxes> read_axes(Reading& reading, const Value& value) {
  ResultAxes axes;
  const auto text = value.node->kind == Node::Kind::scalar ? read_text(reading.report, value) : std::nullopt;
  const bool number =
      text && (text->find_first_not_of("+-.0123456789eE") == std::string::npos || text->starts_with('.'));
  if (!text || (!number && text->find('.') == std::string::npos)) {
    reading.report.error(value, "must be an angle in degrees or a straight edge, as in 30 or dam.face");
    return {};
  }
  if (number) {
    const auto angle = read_number(reading.report, value);
    if (!angle) return {};
    axes.kind = ResultAxes::Kind::angle;
    axes.first = {std::cos(*angle * std::numbers::pi / 180.0), std::sin(*angle * std::numbers::pi / 180.0)};
    return axes;
  }
  const ReadPlace place = read_place(reading, value);
  if (!place.place) return {};
  const Body& body = reading.body(place.body);
  const Edge* edge = place.place->kind == Place::Kind::edge
                         ? &body.outline.edges[static_cast<std::size_t>(place.place->index)]
                         : nullptr;
  if (!edge || edge->arc || edge->is_chain()) {
    reading.report.error(value, fmt::format("'{}' is no straight edge, which has one normal: name another, or give an "
                                            "angle in degrees",
                                            one_line(*text)));
    return {};
  }
  axes.kind = ResultAxes::Kind::edge;
  const Vec2 along = (edge->end - edge->start).normalized();  // with the material on its left
  axes.first = {along.y(), -along.x()};
  return axes;
}

std::optional<EdgeResultant> read_edge_resultant(Reading& reading, const MapReader& map) {
  const std::size_t before = reading.report.count();
  EdgeResultant edge;
  const ReadPlace place = read_place(reading, *map.get("edge"));
  if (const auto about = map.get("about")) edge.about = read_vector(reading.report, *about).value_or(Vec2::Zero());
  if (const auto axes = map.get("axes")) edge.axes = read_axes(reading, *axes).value_or(ResultAxes{});
  map.refuse("relative_to", "belongs to a displacement: leave it out");
  map.refuse("displacement", "'edge' already says what is wanted: remove one of the two");
  if (!place.place || reading.report.count() > before) return {};
  edge.on = *place.place;
  return edge;
}

std::optional<PlaceDisplacement> read_place_displacement(Reading& reading, const MapReader& map) {
  const std::size_t before = reading.report.count();
  PlaceDisplacement place;
  const auto of = QuantityReader(reading, *map.get("displacement"), true).read_point();
  if (const auto other = map.get("relative_to")) place.relative_to = QuantityReader(reading, *other, true).read_point();
  if (const auto axes = map.get("axes")) place.axes = read_axes(reading, *axes).value_or(ResultAxes{});
  map.refuse("about", "is the point of a moment, and a displacement has none: leave it out");
  if (!of || reading.report.count() > before) return {};
  place.of = *of;
  return place;
}

/// A history that is a map.
std::optional<decltype(HistoryItem::of)> read_history_map(Reading& reading, const Value& value) {
  const MapReader map(reading.report, value, {"section", "edge", "displacement", "relative_to", "about", "axes"},
                      history_forms);
  if (!map.is_map()) return {};
  if (const auto cut = map.get("section")) {
    for (const char* key : {"edge", "displacement", "relative_to", "about", "axes"})
      map.refuse(key, "does not go with 'section', which has axes along and across its line: leave it out");
    return read_section(reading, *cut);
  }
  if (map.has("edge")) return read_edge_resultant(reading, map);
  if (map.has("displacement")) return read_place_displacement(reading, map);
  if (map.all_known()) reading.report.error(value, fmt::format("does not say what is wanted: write {}", history_forms));
  return {};
}

}  // namespace

void read_history(Reading& reading, const Value& value) {
  constexpr const char* example = "{tip: upper.top_right.uy, cut: {section: {from: [0, 1], to: [2, 1]}}}";
  for (const Entry& entry : read_named(reading.report, value, "histories", example)) {
    HistoryItem item;
    item.name = entry.key;
    item.source = entry.key_source;
    if (entry.value.node->kind == Node::Kind::scalar) {
      const auto quantity = QuantityReader(reading, entry.value, true).read();
      if (!quantity) continue;
      item.of = *quantity;
    } else {
      const std::size_t before = reading.report.count();
      const auto of = read_history_map(reading, entry.value);
      if (!of || reading.report.count() > before) continue;
      item.of = *of;
    }
    reading.model.output.history.push_back(std::move(item));
  }
}

void read_tolerance(Reading& reading, const Value& value) {
  const std::size_t before = reading.report.count();
  const MapReader map(reading.report, value, {"of", "relative"}, tolerance_example);
  if (!map.is_map()) return;
  QuantityTolerance tolerance;
  tolerance.source = value.source();
  const auto of = map.need("of");
  const auto relative = map.need("relative");
  const auto quantity = of ? QuantityReader(reading, *of).read() : std::nullopt;
  if (relative) tolerance.relative = read_number(reading.report, *relative).value_or(0.0);
  if (!quantity || reading.report.count() > before) return;
  tolerance.of = *quantity;
  reading.model.tolerance = std::move(tolerance);
}

}  // namespace scabo::input
