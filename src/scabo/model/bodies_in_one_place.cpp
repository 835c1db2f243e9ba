#include "scabo/model/bodies_in_one_place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "scabo/geometry/box_tree.hpp"
#include "scabo/geometry/plane/common_area.hpp"

namespace scabo::model {

namespace {

using geometry::Box;

constexpr double rounding_of_places = 1e-6;  // of the size of the smaller body, as for edges that touch

/// Bodies are numbered as in the model, the smaller number first.
using Pair = std::pair<std::size_t, std::size_t>;

std::set<Pair> joined_pairs(const Model& model) {
  std::set<Pair> joined;
  const auto add = [&](const Place& a, const Place& b) {
    joined.insert(std::minmax(static_cast<std::size_t>(a.body), static_cast<std::size_t>(b.body)));
  };
  for (const Contact& contact : model.contacts) add(contact.a, contact.b);
  for (const Tie& tie : model.ties) add(tie.a, tie.b);
  return joined;
}

bool are_there_together(const Body& a, const Body& b) {
  const auto end_of = [](const Body& body) {
    return body.removed < 0 ? std::numeric_limits<int>::max() : body.removed;
  };
  return std::max(a.added, b.added) < std::min(end_of(a), end_of(b));
}

}  // namespace

std::optional<Warning> warning_of_bodies_in_one_place(const Model& model) {
  if (model.analysis.type == AnalysisType::modal) return {};  // each body by itself
  std::vector<std::size_t> bodies;
  std::vector<Box> boxes;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].outside || model.bodies[b].image) continue;
    bodies.push_back(b);
    boxes.push_back(geometry::box_of(model.bodies[b].outline));
  }
  const std::set<Pair> joined = joined_pairs(model);
  const geometry::BoxTree tree(boxes);
  std::vector<Pair> found;
  Vec2 place = Vec2::Zero();  // of the first pair
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto common = [&](const Box& box) -> Vec2 {
      return boxes[i].high.cwiseMin(box.high) - boxes[i].low.cwiseMax(box.low);
    };
    std::vector<std::size_t> near;
    tree.visit([&](std::size_t node) { return common(tree.nodes()[node].box).minCoeff() > 0.0; },
               [&](std::size_t j) {
                 if (j > i && common(boxes[j]).minCoeff() > 0.0) near.push_back(j);
               });
    std::sort(near.begin(), near.end());
    for (const std::size_t j : near) {
      const Pair pair(bodies[i], bodies[j]);
      const Body &a = model.bodies[pair.first], &b = model.bodies[pair.second];
      if ((a.rigid && b.rigid) || !are_there_together(a, b) || joined.contains(pair)) continue;
      const double tolerance =
          rounding_of_places * std::min((boxes[i].high - boxes[i].low).norm(), (boxes[j].high - boxes[j].low).norm());
      const auto point = geometry::common_area(a.outline, b.outline, tolerance);
      if (!point) continue;
      if (found.empty()) place = *point;
      found.push_back(pair);
    }
  }
  if (found.empty()) return {};
  const std::string &first = model.bodies[found.front().first].name, &second = model.bodies[found.front().second].name;
  const std::size_t others = found.size() - 1;
  const std::string more =
      others == 0 ? "" : fmt::format(", as do {} more pair{} of bodies,", others, others == 1 ? "" : "s");
  return Warning{
      WarningKind::overlap, first + " " + second,
      fmt::format("bodies '{}' and '{}' overlap at ({:.6g}, {:.6g}){} and no contact or tie joins them: neither "
                  "hinders the other there; move or remove one, or join them",
                  first, second, place.x(), place.y(), more)};
}

}  // namespace scabo::model
