// `bars` of models in space.
#include <fmt/format.h>

#include "scabo/input/space/space_reader.hpp"

namespace scabo::input {

using namespace model;

namespace {

constexpr const char* example_of_bar =
    "{between: [cover.washer, [0, 0, 4]], area: 817e-6, young: 210e9, preload: 150e3}";
constexpr const char* example_of_ends =
    "[cover.washer, seat.thread], each a face, an edge, a set of nodes, {body: seat, at: [6, 3, 1]} or a point [x, y, "
    "z] of the "
    "ground";

}  // namespace

/// A face or set of nodes, `{body: wall, at: [0, 3, 1]}`, or a point of the ground.
std::optional<SpaceBar::End> SpaceReader::bar_end(const Value& value) {
  const std::size_t before = report_.count();
  SpaceBar::End end;
  if (value.node->kind == Node::Kind::sequence) {
    end.at = vector(value);
  } else if (value.node->kind == Node::Kind::map && value.node->find("at") != nullptr) {
    const MapReader map(report_, value, {"body", "at"}, "{body: wall, at: [0, 3, 1]}");
    if (const auto body = map.need("body")) end.body = body_named(*body);
    if (const auto at = map.get("at")) end.at = vector(*at);
  } else {
    end.on = place(value);
  }
  if (report_.count() > before) return {};
  return end;
}

void SpaceReader::bar(const Entry& entry) {
  const std::size_t before = report_.count();
  const MapReader map(report_, entry.value, {"between", "k", "area", "young", "preload", "tightened"}, example_of_bar,
                      {{"stiffness", "write k, in N/m, or area and young"},
                       {"on", "write between, with the two ends"},
                       {"length", "it is the distance of the two ends"}});
  if (!map.is_map()) return;
  SpaceBar bar;
  bar.name = entry.key;
  bar.source = entry.value.source();
  if (const auto between = map.need("between")) {
    const auto items = read_list(report_, *between, example_of_ends);
    if (items && items->size() != 2)
      report_.error(*between, fmt::format("must be the two ends {}, not a list of {}", example_of_ends, items->size()));
    for (std::size_t k = 0; items && items->size() == 2 && k < 2; ++k)
      if (auto end = bar_end((*items)[k])) bar.between[k] = std::move(*end);
    if (report_.count() == before && !bar.between[0].on && !bar.between[1].on && bar.between[0].body < 0 &&
        bar.between[1].body < 0)
      report_.error(*between, "has both ends in the ground, which does not move: put one of them on a body");
  }
  const bool by_area = map.has("area") || map.has("young");
  if (map.has("k") == by_area && map.all_known())
    report_.error(map.map(), "needs k, in N/m, or area and young, whose stiffness is young times area over the length");
  if (const auto k = map.get("k")) bar.stiffness = number_from(k, 0.0, false);
  if (by_area && !map.has("k")) {
    bar.area = number_from(map.need("area"), 0.0, false);
    bar.young = number_from(map.need("young"), 0.0, false);
  }
  bar.preload = number(map.get("preload"));
  if (const auto step = map.get("tightened")) {
    if (!map.has("preload"))
      map.refuse("tightened", "needs a 'preload' beside it, the tension at the end of that step");
    tightened_bars_.emplace_back(model_.bars.size(), *step);
  }
  model_.bars.push_back(std::move(bar));
}

}  // namespace scabo::input
