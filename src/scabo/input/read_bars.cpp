// `bars`.
#include <fmt/format.h>

#include "scabo/input/reading.hpp"

namespace scabo::input {

namespace {

constexpr const char* bar_example =
    "{between: [flange.hole, [0.075, -0.1]], area: 817e-6, young: 210e9, preload: 150e3}";
constexpr const char* ends_example =
    "[flange.hole, seat.hole], each an edge, a corner, {body: seat, near: [6, 3]} or a "
    "point [x, y] of the ground";

/// A place of a body, or a point of the ground.
std::optional<Bar::End> read_end(Reading& reading, const Value& value) {
  Bar::End end;
  if (value.node->kind == Node::Kind::sequence) {
    const auto point = read_vector(reading.report, value);
    if (!point) return {};
    end.at = *point;
    return end;
  }
  const ReadPlace place = read_place(reading, value);
  if (place.body >= 0) reading.state(place.body).touched = true;
  if (!place.place) return {};
  end.on = place.place;
  return end;
}

void read_between(Reading& reading, const Value& value, Bar& bar) {
  const auto items = read_list(reading.report, value, ends_example);
  if (!items) {
    reading.places_known = false;
    return;
  }
  if (items->size() != 2) {
    reading.report.error(value, fmt::format("must be the two ends {}, not a list of {}", ends_example, items->size()));
    reading.places_known = false;
    return;
  }
  for (std::size_t k = 0; k < 2; ++k)
    if (auto end = read_end(reading, (*items)[k])) bar.between[k] = std::move(*end);
}

std::optional<Bar> read_bar(Reading& reading, const Entry& entry) {
  Report& report = reading.report;
  const std::size_t before = report.count();
  const MapReader map(report, entry.value, {"between", "k", "area", "young", "preload", "tightened"}, bar_example,
                      {{"stiffness", "write k, in N/m, or area and young"},
                       {"on", "write between, with the two ends"},
                       {"length", "it is the distance of the two ends"}});
  Bar bar;
  bar.name = entry.key;
  bar.source = entry.value.source();
  if (!map.is_map()) return {};
  if (const auto between = map.need("between"))
    read_between(reading, *between, bar);
  else
    reading.places_known = false;
  const bool by_area = map.has("area") || map.has("young");
  if (map.has("k") == by_area && map.all_known())
    report.error(map.map(), "needs k, in N/m, or area and young, whose stiffness is young times area over the length");
  if (const auto k = map.get("k")) bar.stiffness = number_or_unread(reading, k);
  if (by_area && !map.has("k")) {
    bar.area = number_or_unread(reading, map.need("area"));
    bar.young = number_or_unread(reading, map.need("young"));
  }
  if (const auto preload = map.get("preload")) bar.preload = number_or_unread(reading, preload);
  if (const auto step = map.get("tightened")) {
    if (!map.has("preload"))
      map.refuse("tightened", "needs a 'preload' beside it, the tension at the end of that step");
    reading.steps_of_bars.emplace_back(reading.model.bars.size(), *step);
  }
  if (report.count() > before) return {};
  return bar;
}

}  // namespace

void read_bars(Reading& reading, const Value& value) {
  for (const Entry& entry :
       read_named(reading.report, value, "bar", "hanger: {between: [deck.left, [0, 9]], k: 2e6}")) {
    const std::size_t steps = reading.steps_of_bars.size();
    if (auto bar = read_bar(reading, entry)) {
      reading.model.bars.push_back(std::move(*bar));
    } else {
      reading.conditions_known = false;
      reading.steps_of_bars.resize(steps);
    }
  }
}

}  // namespace scabo::input
