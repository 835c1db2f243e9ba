#include "scabo/analysis/space/held_nodes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "scabo/analysis/space/prepared_solids.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/mesh/space/face_normals.hpp"
#include "scabo/system/rigid_solid.hpp"

namespace scabo::analysis {

namespace {

constexpr double parallel = 1e-6;  // sine of the angle to a span in which a direction counts as lying

/// Whether both are normals of one smooth surface, not both of planes.
bool is_smooth(const SupportedDirection& a, const SupportedDirection& b) {
  using Kind = SupportedDirection::Kind;
  const bool curved = a.kind == Kind::normal_of_curved_face || b.kind == Kind::normal_of_curved_face;
  return curved && a.kind != Kind::given && b.kind != Kind::given &&
         a.direction.dot(b.direction) >= mesh::cosine_of_turn;
}

}  // namespace

std::vector<std::size_t> order_of_supports(const model::SpaceModel& model) {
  std::vector<std::size_t> order(model.supports.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key_of = [&](std::size_t i) {
    const model::Stay& stay = model.supports[i].stay;
    return std::tuple(model.supports[i].is_staged(), stay.added,
                      stay.removed < 0 ? -std::numeric_limits<int>::max() : -stay.removed);
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return key_of(i) < key_of(j); });
  return order;
}

bool HeldNodes::Follows::is(double wanted) const {
  constexpr double same = 1e-9;
  return std::abs(value - wanted) <= same * (size + std::abs(wanted));
}

std::optional<HeldNodes::Follows> HeldNodes::follows(const std::vector<const Held*>& others, std::size_t support,
                                                     const SupportedDirection& along) const {
  const auto has_factor = [&](const Held& other) {
    return other.support != support && (model_.supports[other.support].named || model_.supports[support].named);
  };
  for (const Held* other : others)
    if (is_smooth(other->along, along))
      return Follows{other->along.value, std::abs(other->along.value), has_factor(*other), other->support};
  if (others.empty()) return {};
  Matrix directions(3, static_cast<Eigen::Index>(others.size()));
  for (std::size_t k = 0; k < others.size(); ++k)
    directions.col(static_cast<Eigen::Index>(k)) = others[k]->along.direction;
  const Vector parts = directions.colPivHouseholderQr().solve(along.direction);
  if ((directions * parts - along.direction).norm() > parallel) return {};
  Follows found{0.0, 0.0, false, 0};
  Eigen::Index largest = 0;
  parts.cwiseAbs().maxCoeff(&largest);
  found.first = others[static_cast<std::size_t>(largest)]->support;
  for (std::size_t k = 0; k < others.size(); ++k) {
    const double part = parts[static_cast<Eigen::Index>(k)], value = others[k]->along.value;
    found.value += part * value;
    found.size += std::abs(part * value);
    if (std::abs(part) > parallel && has_factor(*others[k])) found.has_factor = true;
  }
  return found;
}

std::optional<std::size_t> HeldNodes::hold(std::size_t support, int node, const SupportedDirection& along) {
  const model::SpaceSupport& of = model_.supports[support];
  std::vector<const Held*> always, at_times;  // when this support is there
  for (const Held& other : held_[{of.on.body, node}]) {
    const model::Stay& stay = model_.supports[other.support].stay;
    if (!model_.supports[other.support].is_staged() || stay.covers(of.stay))
      always.push_back(&other);
    else if (stay.meets(of.stay))
      at_times.push_back(&other);
  }
  if (const auto known = follows(always, support, along)) {
    const bool at_rest = known->size == 0.0 && along.value == 0.0;
    return known->is(along.value) && (at_rest || !known->has_factor) ? std::nullopt : std::optional(known->first);
  }
  for (const Held* other : at_times) {
    always.push_back(other);
    const auto there = follows(always, support, along);
    if (there && !there->is(along.value)) return other->support;  // factors may still part them: a hand-over
    always.pop_back();
  }
  add(support, node, along);
  return {};
}

void HeldNodes::add(std::size_t support, int node, const SupportedDirection& along) {
  const Eigen::Vector3d& direction = along.direction;
  const model::SpaceSupport& of = model_.supports[support];
  std::vector<Held>& others = held_[{of.on.body, node}];
  std::array<bool, 3> taken{};
  for (const Held& other : others)
    if (of.is_staged() == model_.supports[other.support].is_staged())
      taken[static_cast<std::size_t>(other.place)] = true;
  const auto is_free = [&](int k) { return !taken[static_cast<std::size_t>(k)]; };
  int axis = -1, place = 0;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(direction[k]) == 1.0) axis = k;
    if (std::tuple(is_free(k), std::abs(direction[k])) > std::tuple(is_free(place), std::abs(direction[place])))
      place = k;
  }
  system::Constraint made;
  made.dof = static_cast<int>(in_space.of(node, place));
  made.component = place == axis ? axis : -1;
  made.inclined = direction;
  made.value = along.value;
  if (axis >= 0) made.inclined = Eigen::Vector3d::Unit(axis), made.value *= direction[axis];  // in its own sense
  others.push_back({support, along, place});
  take(support, made);
}

void HeldNodes::take(std::size_t support, system::Constraint constraint) {
  const model::SpaceSupport& of = model_.supports[support];
  constraint.support = static_cast<int>(support);
  if (of.is_staged())
    posed_.held_points.push_back({of.on.body, constraint, of.stay});
  else
    posed_.bodies[static_cast<std::size_t>(of.on.body)].supports.push_back(constraint);
}

std::optional<std::size_t> HeldNodes::hold_motion(std::size_t support, int motion, double value) {
  const model::SpaceSupport& of = model_.supports[support];
  std::vector<std::pair<std::size_t, double>>& others = motions_[{of.on.body, motion}];
  for (const auto& [other, prescribed] : others) {
    const model::Stay& stay = model_.supports[other].stay;
    if (!model_.supports[other].is_staged() || (stay.meets(of.stay) && (stay.covers(of.stay) || prescribed != value)))
      return other;
  }
  others.emplace_back(support, value);
  take(support, system::held_motion(motion, value));
  return {};
}

bool HeldNodes::resists(int body, int node, const Eigen::Vector3d& direction) const {
  const auto found = held_.find({body, node});
  return found != held_.end() && std::any_of(found->second.begin(), found->second.end(), [&](const Held& held) {
           return std::abs(held.along.direction.dot(direction)) > parallel;
         });
}

}  // namespace scabo::analysis
