#include "scabo/analysis/growth/tips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scabo/analysis/growth/grow.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/geometry/plane/outline_checks.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::analysis {

namespace {

const model::Body& body_of(const model::Model& model, const Tip& tip) {
  return model.bodies[static_cast<std::size_t>(tip.body)];
}

double tolerance_in(const model::Body& body) { return 1e-9 * geometry::outline_size(body.outline); }

geometry::Edge line(const Vec2& from, const Vec2& to) {
  geometry::Edge edge;
  edge.start = from;
  edge.end = to;
  return edge;
}

/// A line in a body that cracks do not pass, and what it is called.
struct Barrier {
  geometry::Edge edge;
  std::string what;
};

/// Edges of outline and regions, and segments of cracks, without those that begin or end at the tip.
std::vector<Barrier> barriers_of(const model::Model& model, const Tip& tip) {
  const model::Body& body = body_of(model, tip);
  const Vec2 here = position_of(model, tip);
  std::vector<Barrier> barriers;
  for (const geometry::Edge& edge : body.outline.edges)
    barriers.push_back({edge, fmt::format("edge '{}'", model::shown_name(edge))});
  for (const model::Region& region : body.regions)
    for (const geometry::Edge& edge : region.outline.edges)
      barriers.push_back({edge, fmt::format("region '{}'", region.name)});
  for (std::size_t c = 0; c < body.cracks.size(); ++c) {
    const std::vector<Vec2>& path = body.cracks[c].path;
    for (std::size_t k = 0; k + 1 < path.size(); ++k)
      if (static_cast<int>(c) != tip.crack || (path[k] != here && path[k + 1] != here))
        barriers.push_back({line(path[k], path[k + 1]), static_cast<int>(c) == tip.crack
                                                            ? "itself"
                                                            : fmt::format("crack '{}'", body.cracks[c].name)});
  }
  return barriers;
}

std::vector<Tip> ends_that_may_grow(const model::Model& model) {
  const std::vector<model::GrowingCrack>& named = model.steps.back().growth->cracks;
  const auto may_grow = [&](int body, int crack, bool at_end) {
    return named.empty() || std::any_of(named.begin(), named.end(), [&](const model::GrowingCrack& one) {
             return one.body == body && one.crack == crack && (at_end ? one.at_end : one.at_start);
           });
  };
  std::vector<Tip> ends;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    for (std::size_t c = 0; c < model.bodies[b].cracks.size(); ++c)
      for (const bool at_end : {false, true}) {
        const Tip tip{static_cast<int>(b), static_cast<int>(c), at_end};
        if (may_grow(tip.body, tip.crack, at_end)) ends.push_back(tip);
      }
  return ends;
}

bool is_tip(const model::Model& model, const Tip& tip) {
  const Vec2 here = position_of(model, tip);
  const double tolerance = 3.0 * tolerance_in(body_of(model, tip));
  const std::vector<Barrier> barriers = barriers_of(model, tip);
  return std::all_of(barriers.begin(), barriers.end(),
                     [&](const Barrier& barrier) { return geometry::distance_to(barrier.edge, here) > tolerance; });
}

/// The point of the path next to the tip.
const Vec2& point_before(const model::Model& model, const Tip& tip) {
  const std::vector<Vec2>& path = crack_of(model, tip).path;
  return tip.at_end ? path[path.size() - 2] : path[1];
}

double size_at(const model::Model& model, const Tip& tip) {
  const Vec2 here = position_of(model, tip);
  double distance = (here - point_before(model, tip)).norm();
  for (const Barrier& barrier : barriers_of(model, tip))
    distance = std::min(distance, geometry::distance_to(barrier.edge, here));
  return std::min(0.5 * model.steps.back().growth->step, 0.25 * distance);
}

}  // namespace

std::vector<Tip> growing_tips(const model::Model& model) {
  std::vector<Tip> tips = ends_that_may_grow(model);
  std::erase_if(tips, [&](const Tip& tip) { return !is_tip(model, tip); });
  return tips;
}

std::optional<Tip> end_on_a_border(const model::Model& model) {
  for (const Tip& tip : ends_that_may_grow(model)) {
    const model::Body& body = body_of(model, tip);
    const auto is_on = [&](const geometry::Outline& outline) {
      return std::any_of(outline.edges.begin(), outline.edges.end(), [&](const geometry::Edge& edge) {
        return geometry::distance_to(edge, position_of(model, tip)) <= 3.0 * tolerance_in(body);
      });
    };
    if (!is_on(body.outline) && std::any_of(body.regions.begin(), body.regions.end(),
                                            [&](const model::Region& region) { return is_on(region.outline); }))
      return tip;
  }
  return {};
}

const model::Crack& crack_of(const model::Model& model, const Tip& tip) {
  return body_of(model, tip).cracks[static_cast<std::size_t>(tip.crack)];
}

std::string name_of_crack(const model::Model& model, const Tip& tip) {
  return body_of(model, tip).name + "." + crack_of(model, tip).name;
}

std::string name_of(const model::Model& model, const Tip& tip) {
  return name_of_crack(model, tip) + (tip.at_end ? ".end" : ".start");
}

Vec2 position_of(const model::Model& model, const Tip& tip) {
  const std::vector<Vec2>& path = crack_of(model, tip).path;
  return tip.at_end ? path.back() : path.front();
}

Vec2 direction_of(const model::Model& model, const Tip& tip) {
  return (position_of(model, tip) - point_before(model, tip)).normalized();
}

double length_of(const model::Crack& crack) {
  double length = 0.0;
  for (std::size_t k = 0; k + 1 < crack.path.size(); ++k) length += (crack.path[k + 1] - crack.path[k]).norm();
  return length;
}

void extend(model::Model& model, const Tip& tip, const Vec2& to) {
  std::vector<Vec2>& path =
      model.bodies[static_cast<std::size_t>(tip.body)].cracks[static_cast<std::size_t>(tip.crack)].path;
  path.insert(tip.at_end ? path.end() : path.begin(), to);
}

void refine_at_tips(model::Model& model, const std::vector<Tip>& tips,
                    const std::vector<std::vector<model::LocalSize>>& sizes) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) model.bodies[b].mesh.refine = sizes[b];
  for (const Tip& tip : tips) {
    model::LocalSize local;
    local.near = position_of(model, tip);
    local.size = size_at(model, tip);
    model.bodies[static_cast<std::size_t>(tip.body)].mesh.refine.push_back(local);
  }
}

model::Model with_fine_tips(model::Model model) {
  std::vector<std::vector<model::LocalSize>> sizes;
  for (const model::Body& body : model.bodies) sizes.push_back(body.mesh.refine);
  refine_at_tips(model, growing_tips(model), sizes);
  return model;
}

std::optional<Meeting> meeting(const model::Model& model, const Tip& tip, const Vec2& ahead) {
  const geometry::Edge way = line(position_of(model, tip), ahead);
  std::optional<Meeting> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const Barrier& barrier : barriers_of(model, tip))
    for (const Vec2& point : geometry::shared_points(way, barrier.edge, tolerance_in(body_of(model, tip))))
      if (const double distance = (point - way.start).norm(); distance < least) {
        least = distance;
        nearest = Meeting{point, barrier.what};
      }
  return nearest;
}

void check_growth(const model::Model& model) {
  if (!model::has_growth(model)) return;
  const std::string file = model.file.empty() ? "model" : model.file;
  if (const auto tip = end_on_a_border(model))
    throw InputError(
        file,
        {{model.steps.back().source,
          fmt::format("the tip '{}' lies on the border of a region, where materials meet: growth from there is not "
                      "available in this version, so let it end inside one material",
                      name_of(model, *tip))}});
  if (!growing_tips(model).empty()) return;
  throw InputError(file,
                   {{model.steps.back().source,
                     "no crack of the step has a tip that could grow: both ends of each lie on the boundary or on "
                     "another crack"}});
}

}  // namespace scabo::analysis
