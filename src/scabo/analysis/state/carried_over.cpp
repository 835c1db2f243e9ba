#include "scabo/analysis/state/carried_over.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/geometry/plane/foot_points.hpp"

namespace scabo::analysis {

namespace {

using PairMember = double CarriedPair::*;

const mesh::ContactPair& pair_in_mesh(const Prepared& prepared, const system::ContactSystem::Pair& at) {
  return prepared.mesh.interfaces[static_cast<std::size_t>(at.contact)].pairs[static_cast<std::size_t>(at.index)];
}

/// Arc length of the point of a pair on its edge or crack in `model`.
double arc_length(const model::Model& model, const Prepared& prepared, int contact, const mesh::ContactPair& pair,
                  int side) {
  const model::Contact& named = model.contacts[static_cast<std::size_t>(contact)];
  const model::Place& place = side == 0 ? named.a : named.b;
  const model::Body& body = model.bodies[static_cast<std::size_t>(place.body)];
  const Vec2 x = prepared.mesh.point_of(contact, pair, side);
  if (place.kind == model::Place::Kind::face)
    return arc_length_on(body.cracks[static_cast<std::size_t>(place.index / 2)], x);
  if (place.kind != model::Place::Kind::edge) return 0.0;
  const geometry::Edge& edge = body.outline.edges[static_cast<std::size_t>(place.index)];
  const auto foot = geometry::foot_on(edge, x);
  return foot ? foot->t * edge.length() : 0.0;
}

/// Pairs of one contact in the order of their arc length on one side.
class Along {
 public:
  Along(const std::vector<CarriedPair>& pairs, PairMember at) : at_(at), pairs_(pairs) {
    std::stable_sort(pairs_.begin(), pairs_.end(),
                     [at](const CarriedPair& one, const CarriedPair& other) { return one.*at < other.*at; });
  }

  CarriedPair value(double s) const {
    CarriedPair value;
    if (pairs_.empty()) return value;
    const auto above = std::lower_bound(pairs_.begin(), pairs_.end(), s,
                                        [this](const CarriedPair& pair, double x) { return pair.*at_ < x; });
    const CarriedPair& high = above == pairs_.end() ? pairs_.back() : *above;
    const CarriedPair& low = above == pairs_.begin() ? pairs_.front() : *(above - 1);
    const double length = high.*at_ - low.*at_;
    const bool beyond = length <= 0.0 && std::abs(s - low.*at_) > rounding * spacing();
    const double part = length > 0.0 ? (s - low.*at_) / length : 0.0;
    const CarriedPair& nearer = part < 0.5 ? low : high;
    value.pressure = beyond ? 0.0 : std::lerp(low.pressure, high.pressure, part);
    value.shear = beyond ? 0.0 : std::lerp(low.shear, high.shear, part);
    value.slip = std::lerp(low.slip, high.slip, part);
    value.motion = low.motion + part * (high.motion - low.motion);
    value.closed = !beyond && nearer.closed;
    value.history = nearer.history;
    value.direction = direction_near(s);
    return value;
  }

 private:
  static constexpr double rounding = 1e-6;  // of the length of the contact

  double spacing() const { return pairs_.back().*at_ - pairs_.front().*at_; }
  int direction_near(double s) const {
    const CarriedPair* nearest = nullptr;
    for (const CarriedPair& pair : pairs_)
      if (pair.closed && (nearest == nullptr || std::abs(pair.*at_ - s) < std::abs(nearest->*at_ - s))) nearest = &pair;
    return nearest == nullptr ? 0 : nearest->direction;
  }

  PairMember at_;
  std::vector<CarriedPair> pairs_;
};

/// Whether the pairs are at the same places.
bool at_same_places(const std::vector<CarriedPair>& before, const std::vector<CarriedPair>& now) {
  return before.size() == now.size() &&
         std::equal(before.begin(), before.end(), now.begin(), [](const CarriedPair& one, const CarriedPair& other) {
           return one.at_a == other.at_a && one.at_b == other.at_b;
         });
}

}  // namespace

double arc_length_on(const model::Crack& crack, const Vec2& x) {
  double nearest = std::numeric_limits<double>::infinity(), at = 0.0, before = 0.0;
  for (std::size_t k = 0; k + 1 < crack.path.size(); ++k) {
    const Vec2 along = crack.path[k + 1] - crack.path[k];
    const double part = std::clamp((x - crack.path[k]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    if (const double distance = (crack.path[k] + part * along - x).norm(); distance < nearest)
      nearest = distance, at = before + part * along.norm();
    before += along.norm();
  }
  return at;
}

CarriedPairs pairs_to_carry(const Prepared& prepared, const State& state, const model::Model* on) {
  const model::Model& model = on != nullptr ? *on : prepared.model;
  CarriedPairs carried(prepared.model.contacts.size());
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    const system::ContactSystem::Pair& at = prepared.contact.pairs[i];
    const mesh::ContactPair& pair = pair_in_mesh(prepared, at);
    const auto k = static_cast<Eigen::Index>(i);
    CarriedPair& value = carried[static_cast<std::size_t>(at.contact)].emplace_back();
    value.at_a = arc_length(model, prepared, at.contact, pair, 0);
    value.at_b = arc_length(model, prepared, at.contact, pair, 1);
    value.pressure = state.p[2 * k] / prepared.contact.laws.area[k];
    value.shear = state.p[2 * k + 1] / prepared.contact.laws.area[k];
    value.slip = state.slip[k];
    if (state.replaced.slip_before.size() > 0) value.slip += state.replaced.slip_before[k];
    value.motion =
        displacement_of(prepared, state, at.contact, pair, 1) - displacement_of(prepared, state, at.contact, pair, 0);
    value.closed = state.states[i] != contact::ContactState::open;
    if (state.states[i] == contact::ContactState::slip) value.direction = value.shear > 0.0 ? -1 : 1;
    value.history = state.history[i];
  }
  return carried;
}

std::vector<CarriedPair> carried_to(const Prepared& prepared, const CarriedPairs& before) {
  CarriedPairs now(before.size());
  for (const system::ContactSystem::Pair& at : prepared.contact.pairs) {
    CarriedPair& pair = now[static_cast<std::size_t>(at.contact)].emplace_back();
    pair.at_a = arc_length(prepared.model, prepared, at.contact, pair_in_mesh(prepared, at), 0);
    pair.at_b = arc_length(prepared.model, prepared, at.contact, pair_in_mesh(prepared, at), 1);
  }
  std::vector<CarriedPair> all;
  for (std::size_t c = 0; c < now.size(); ++c) {
    if (at_same_places(before[c], now[c])) {
      all.insert(all.end(), before[c].begin(), before[c].end());
      continue;
    }
    const Along on_a(before[c], &CarriedPair::at_a), on_b(before[c], &CarriedPair::at_b);
    for (CarriedPair& pair : now[c]) {
      const CarriedPair a = on_a.value(pair.at_a), b = on_b.value(pair.at_b);
      pair.pressure = 0.5 * (a.pressure + b.pressure);
      pair.shear = 0.5 * (a.shear + b.shear);
      pair.slip = 0.5 * (a.slip + b.slip);
      pair.motion = 0.5 * (a.motion + b.motion);
      pair.closed = a.closed || b.closed;
      pair.direction = std::clamp(a.direction + b.direction, -1, 1);
      pair.history = a.history;
      all.push_back(pair);
    }
  }
  return all;
}

}  // namespace scabo::analysis
