// Validation of supports, and of supports that contradict each other where they share a point.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "scabo/model/checking.hpp"

namespace scabo::model {

namespace {

const char* key_of_component(SupportAxes axes, std::size_t component) {
  if (axes == SupportAxes::edge) return component == 0 ? "displacement.normal" : "displacement.tangent";
  if (axes == SupportAxes::direction) return "displacement.value";
  return component == 0 ? "displacement.0" : "displacement.1";
}

/// Whether a support has the axes that it prescribes displacements along.
bool check_axes(Checking& checking, const std::string& path, const Support& support) {
  if (support.axes == SupportAxes::xy) return true;
  if (checking.model.analysis.type == AnalysisType::modal) {
    checking.error(path, "", "a modal analysis takes supports along x and y only: fix x, y or both");
    return false;
  }
  if (support.axes == SupportAxes::direction && std::abs(support.along.norm() - 1.0) > 1e-9) {
    checking.error(path, "", "the direction along must not be [0, 0]: give the direction in which the place is held");
    return false;
  }
  if (support.axes != SupportAxes::edge || support.on.kind == Place::Kind::edge || support.on.kind == Place::Kind::face)
    return true;
  checking.error(path, "on",
                 fmt::format("normal and tangent are those of an edge, which '{}' is not: name an edge, or give a "
                             "direction, along: [1, 2]",
                             text_of(checking.model, support.on)));
  return false;
}

/// Whether a support that prescribes a rotation acts on a rigid body.
bool check_rotation(Checking& checking, const std::string& path, const Support& support) {
  if (!support.rotation) return true;
  if (!checking.number(path, "rotation", *support.rotation)) return false;
  constexpr double largest = 0.1;
  if (std::abs(*support.rotation) > largest) {
    checking.error(path, "rotation",
                   fmt::format("must be from -0.1 to 0.1, not {}: it is in radians, and the theory is valid for small "
                               "rotations only",
                               number_text(*support.rotation)),
                   number_text(*support.rotation));
    return false;
  }
  if (support.at && !checking.vector(path, "at", *support.at)) return false;
  if (!checking.is_body(support.on.body)) return true;
  const Body& body = checking.body(support.on.body);
  if (body.rigid && support.on.kind == Place::Kind::body && support.axes == SupportAxes::xy) return true;
  checking.error(path, "rotation",
                 !body.rigid
                     ? fmt::format("'{}' is elastic: only rigid bodies have a rotation; put one on it", body.name)
                 : support.on.kind != Place::Kind::body
                     ? fmt::format("is that of a rigid body as a whole: write on: {}", body.name)
                     : "the displacement beside it is [ux, uy], null where it is free: a direction of its own does not "
                       "go with a rotation");
  return false;
}

}  // namespace

void check_supports(Checking& checking) {
  const Model& model = checking.model;
  std::unordered_set<std::string> names;
  for (std::size_t i = 0; i < model.supports.size(); ++i) {
    const Support& support = model.supports[i];
    const std::string path = path_of("supports", support.source, i);
    checking.enter(support.source);
    if (support.name.empty())
      checking.error(path, "name", "has no value: give one");
    else if (!names.insert(support.name).second)
      checking.error(path, "name",
                     fmt::format("another support is already named '{}': rename one of them", support.name));
    if (checking.is_body(support.on.body)) checking.held[static_cast<std::size_t>(support.on.body)] = 1;
    bool good = check_place(checking, path + ".on", support.on);
    if (good && support.on.kind == Place::Kind::face && checking.body(support.on.body).outside) {
      checking.error(path, "on", endless_face(model, support.on));
      good = false;
    }
    good = check_axes(checking, path, support) && good;
    for (std::size_t c = 0; c < 2; ++c)
      if (support.displacement[c] &&
          !checking.number(path, key_of_component(support.axes, c), *support.displacement[c]))
        good = false;
    good = check_rotation(checking, path, support) && good;
    if (support.varies() && good &&
        (support.on.kind != Place::Kind::edge || checking.body(support.on.body).rigid ||
         support.axes != SupportAxes::xy)) {
      checking.error(path, "displacement.formula", "is that of an edge of an elastic body: give numbers, [ux, uy]");
      good = false;
    }
    if (!support.displacement[0] && !support.displacement[1] && !support.rotation) {
      checking.error(path, "displacement", "prescribes no displacement: give a number for x or y");
      good = false;
    }
    checking.support[i] = good;
    if (!good) checking.gaps.conditions = true;
  }
}

namespace {

/// Whether a corner belongs to a place of the same body.
bool includes_corner(const Place& place, int corner, const Outline& outline) {
  switch (place.kind) {
    case Place::Kind::body:
      return true;
    case Place::Kind::corner:
      return place.index == corner;
    case Place::Kind::edge:
      return place.index == corner || outline.next(place.index) == corner;
    case Place::Kind::face:
    case Place::Kind::mouth:
    case Place::Kind::near:
      return false;  // known only after meshing
  }
  return false;
}

/// Whether two places of the same body certainly share a point.
bool share_a_point(const Place& a, const Place& b, const Body& body) {
  const auto is_point = [](const Place& p) { return p.kind == Place::Kind::near || p.kind == Place::Kind::mouth; };
  if (is_point(a) && is_point(b)) return a.kind == b.kind && a.near == b.near && a.index == b.index;
  if (is_point(a) || is_point(b)) {
    return a.kind == Place::Kind::body || b.kind == Place::Kind::body;
  }
  if (a.kind == Place::Kind::edge && b.kind == Place::Kind::edge && a.index == b.index) return true;
  // A body and an edge share the ends of the edge; a corner shares itself; two edges may share a corner.
  const Place& smaller = a.kind == Place::Kind::body ? b : a;
  const Place& larger = a.kind == Place::Kind::body ? a : b;
  if (smaller.kind == Place::Kind::body) return true;
  // At the mouth of a crack on a corner the two edges have different nodes.
  const auto shared = [&](int corner) {
    const bool mouth = !body.cracks.empty() && body.cracks.front().at == 0.0 && body.cracks.front().edge == corner;
    return !mouth && includes_corner(larger, corner, body.outline);
  };
  return shared(smaller.index) || (smaller.kind == Place::Kind::edge && shared(body.outline.next(smaller.index)));
}

/// Where a support stands: its line in a file, or its path.
std::string where(const Support& support, std::size_t index) {
  const Source& source = support.source;
  if (source.line > 0) return fmt::format("line {}", source.line);
  return source.path.empty() ? path_of("supports", source, index) : source.path;
}

/// Whether two supports that share a point move it differently in some step.
bool differ(const Model& model, std::size_t first, std::size_t second, std::size_t component) {
  const auto& a = model.supports[first].displacement[component];
  const auto& b = model.supports[second].displacement[component];
  return a && b && std::any_of(model.steps.begin(), model.steps.end(), [&](const Step& step) {
           return *a * step.support_factors[first] != *b * step.support_factors[second] ||
                  (*a != 0.0 && support_curve(step, first) != support_curve(step, second));
         });
}

/// Equal places have equal keys.
using PlaceKey = std::tuple<Place::Kind, int, double, double>;
PlaceKey key_of(const Place& place) { return {place.kind, place.index, place.near.x(), place.near.y()}; }

/// For the supports of one place: the first that prescribes x and the first that prescribes y. Later ones have the same
/// motion or were reported.
using First = std::array<std::optional<std::size_t>, 2>;
using Places = std::map<PlaceKey, First>;

/// The previous supports of the body that a new one can contradict: those at its own place, and those at places that
/// share a point with it. A `near` place shares a point only with itself and with the whole body, and there may be many
/// of them.
std::vector<const First*> candidates(const Places& places, const Place& place, const Body& body) {
  std::vector<const First*> found;
  const auto add = [&](const Place& other) {
    if (const auto at = places.find(key_of(other)); at != places.end() && share_a_point(other, place, body))
      found.push_back(&at->second);
  };
  Place other;
  add(place);
  other.kind = Place::Kind::body;
  if (place.kind != Place::Kind::body) add(other);
  if (place.kind == Place::Kind::edge || place.kind == Place::Kind::corner)
    for (const int index : {body.outline.previous(place.index), place.index, body.outline.next(place.index)})
      for (const Place::Kind kind : {Place::Kind::edge, Place::Kind::corner}) {
        other.kind = kind;
        other.index = index;
        if (key_of(other) != key_of(place)) add(other);
      }
  if (place.kind == Place::Kind::body)
    for (const auto& [key, first] : places)
      if (std::get<0>(key) != Place::Kind::body) found.push_back(&first);
  return found;
}

void report_conflict(Checking& checking, std::size_t first, std::size_t second, std::size_t component) {
  const Support& a = checking.model.supports[first];
  const Support& b = checking.model.supports[second];
  checking.enter(b.source);
  checking.error(path_of("supports", b.source, second), "",
                 fmt::format("prescribes another {} of {} than the support of {} in {}, although they share a point: "
                             "remove one, or free the component there",
                             component == 0 ? "x" : "y", text_of(checking.model, b.on), text_of(checking.model, a.on),
                             where(a, first)));
}

}  // namespace

void check_conflicting_supports(Checking& checking) {
  const Model& model = checking.model;
  std::vector<Places> of_body(model.bodies.size());
  for (std::size_t i = 0; i < model.supports.size(); ++i) {
    const Support& support = model.supports[i];
    // Along other directions and by formulas they are compared at the nodes (system/structure.cpp).
    // Where a rotation is prescribed, points move differently: the body compares them (system/body_system.hpp).
    // Those that begin or end are compared at the nodes as well (system/constraints.cpp).
    if (!checking.support[i] || support.is_staged() || support.axes != SupportAxes::xy || support.rotation ||
        support.varies())
      continue;
    Places& places = of_body[static_cast<std::size_t>(support.on.body)];
    const auto at = places.find(key_of(support.on));
    // A whole body shares points with all places; once one was compared, another like it adds nothing.
    const bool known = at != places.end() && (!support.displacement[0] || at->second[0]) &&
                       (!support.displacement[1] || at->second[1]);
    std::optional<std::pair<std::size_t, std::size_t>> conflict;  // the first other support, component
    const auto compare = [&](const First& first) {
      for (std::size_t c = 0; c < 2; ++c)
        if (first[c] && (!conflict || *first[c] < conflict->first) && differ(model, *first[c], i, c))
          conflict = {*first[c], c};
    };
    if (known && support.on.kind == Place::Kind::body) {
      compare(at->second);
    } else {
      for (const First* first : candidates(places, support.on, checking.body(support.on.body))) compare(*first);
    }
    if (conflict) report_conflict(checking, conflict->first, i, conflict->second);  // one message for each support
    First& own = places[key_of(support.on)];
    for (std::size_t c = 0; c < 2; ++c)
      if (support.displacement[c] && !own[c]) own[c] = i;
  }
}

}  // namespace scabo::model
