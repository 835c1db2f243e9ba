#include "scabo/analysis/rolling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "scabo/base/components.hpp"

namespace scabo::analysis {

namespace {

constexpr double largest_part_missed = 0.5;  // of what contact carries
constexpr double resolved = 0.05;            // of the distance of nodes: a shift of the contact that the mesh can tell
constexpr double no_gap = 1e-9;              // of the length of a contact: differences of gaps that are rounding
constexpr double no_rotation = 1e-12;        // of the largest component of a rigid motion

/// Whether supports and springs let a part turn; unbounded parts do not.
bool may_turn(const Prepared& prepared, std::size_t p) {
  if (prepared.is_absent(p) || prepared.structure.dofs.is_unbounded(p)) return false;
  const system::BodySystem& part = *prepared.structure.parts[p];
  if (part.has_springs()) return true;
  const Matrix& ways = part.rigid_coordinates();
  return ways.cols() > 0 && ways.row(2).lpNorm<Eigen::Infinity>() > no_rotation;
}

/// sum u x f of an elastic part. Displacements are taken relative to their mean: the forces add up to nothing.
double missed_by_elastic(const Prepared& prepared, const State& state, std::size_t p) {
  const system::BodySystem& part = *prepared.structure.parts[p];
  Vector forces = state.forces[p] + prepared.contact.motion[p].transpose() * state.p;
  system::add_reactions(part.constraints(), state.reactions[p], forces);
  if (part.has_springs()) forces += part.spring_forces(state.u[p]);
  const auto u = state.u[p].reshaped(2, state.u[p].size() / 2);
  const Vec2 mean = u.rowwise().mean();
  double moment = 0.0;
  for (Eigen::Index node = 0; node < u.cols(); ++node)
    moment += cross(Vec2(u.col(node) - mean), Vec2(forces.segment<2>(2 * node)));
  return moment;
}

/// The side of a contact that belongs to a part: 0 (A) or 1 (B).
struct Side {
  std::size_t contact = 0;
  int side = 0;
};

/// A force of a pair on a body, where it acts on the body as drawn.
struct Acting {
  Vec2 point, force;
};

/// The contacts of all parts with the forces of their pairs.
class Contacts {
 public:
  Contacts(const Prepared& prepared, const State& state)
      : prepared_(prepared),
        state_(state),
        sides_(prepared.structure.parts.size()),
        pairs_(prepared.mesh.interfaces.size()) {
    for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i)
      pairs_[static_cast<std::size_t>(prepared.contact.pairs[i].contact)].push_back(i);
    for (std::size_t c = 0; c < pairs_.size(); ++c)
      for (const int side : {0, 1})
        if (!pairs_[c].empty()) sides_[part_of(c, side)].push_back({c, side});
  }

  const std::vector<Side>& of_part(std::size_t p) const { return sides_[p]; }

  std::vector<Acting> forces_on(const Side& side) const {
    std::vector<Acting> acting;
    for (const std::size_t i : pairs_[side.contact]) {
      const mesh::ContactPair& pair = mesh_pair(prepared_, prepared_.contact.pairs[i]);
      const auto row = static_cast<Eigen::Index>(2 * i);
      const Vec2 on_b = state_.p[row] * pair.normal + state_.p[row + 1] * tangent_of(pair.normal);
      if (on_b.isZero(0.0)) continue;
      acting.push_back({prepared_.mesh.point_of(static_cast<int>(side.contact), pair, side.side),
                        side.side == 1 ? on_b : Vec2(-on_b)});
    }
    return acting;
  }

 private:
  std::size_t part_of(std::size_t contact, int side) const {
    const model::Contact& named = prepared_.model.contacts[contact];
    return prepared_.structure.dofs.part_of(side == 0 ? named.a.body : named.b.body);
  }

  const Prepared& prepared_;
  const State& state_;
  std::vector<std::vector<Side>> sides_;         // of every part
  std::vector<std::vector<std::size_t>> pairs_;  // of every contact
};

/// The same of a rigid part, u = theta x arm: -theta sum arm . f. Springs are taken to act at its centroid.
double missed_by_rigid(const Prepared& prepared, const State& state, const Contacts& contacts, std::size_t p) {
  const system::BodySystem& part = *prepared.structure.parts[p];
  double sum = 0.0;
  for (std::size_t load = 0; load < prepared.structure.outward.size(); ++load)
    sum += state.factors.loads[load] * presence_of(prepared, state.factors, p) * prepared.structure.outward[load][p];
  for (const Side& side : contacts.of_part(p))
    for (const auto& [point, force] : contacts.forces_on(side)) sum += (point - part.reference()).dot(force);
  for (std::size_t c = 0; c < part.constraints().size(); ++c)
    if (const system::Constraint& constraint = part.constraints()[c]; !constraint.rotation)
      sum += state.reactions[p][static_cast<Eigen::Index>(c)] *
             (constraint.point - part.reference()).dot(constraint.direction());
  return -state.u[p][2] / part.lever() * sum;
}

/// Where the two sides of a contact touch first as they are drawn, on one of them.
struct FirstTouch {
  std::vector<Vec2> points;  ///< one, or those of all nodes that touch together
  double spacing = 0.0;      ///< of nodes there
};

/// Where a parabola through the gaps of three successive nodes is least, at a distance from the middle one; `before`
/// and `after`: distances to the others, whose gaps exceed that of the middle by `rise_before` and `rise_after` > 0.
double least_of_parabola(double before, double after, double rise_before, double rise_after) {
  const double slope =
                   (rise_after * before * before - rise_before * after * after) / (before * after * (before + after)),
               curvature = 2.0 * (rise_after * before + rise_before * after) / (before * after * (before + after));
  return std::clamp(-slope / curvature, -before, after);
}

FirstTouch first_touch(const Prepared& prepared, const Side& on) {
  const std::vector<mesh::ContactPair>& pairs = prepared.mesh.interfaces[on.contact].pairs;
  std::vector<Vec2> points;
  double length = 0.0;
  std::size_t least = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    points.push_back(prepared.mesh.point_of(static_cast<int>(on.contact), pairs[k], on.side));
    if (k > 0) length += (points[k] - points[k - 1]).norm();
    if (pairs[k].gap < pairs[least].gap) least = k;
  }
  const auto touches = [&](std::size_t k) { return pairs[k].gap - pairs[least].gap <= no_gap * length; };
  std::size_t first = least, last = least;
  while (first > 0 && touches(first - 1)) --first;
  while (last + 1 < pairs.size() && touches(last + 1)) ++last;
  FirstTouch touch;
  const double before = first > 0 ? (points[first] - points[first - 1]).norm() : 0.0,
               after = last + 1 < pairs.size() ? (points[last + 1] - points[last]).norm() : 0.0;
  touch.spacing = std::max(before, after);
  if (first < last || before == 0.0 || after == 0.0) {
    touch.points.assign(points.begin() + static_cast<std::ptrdiff_t>(first),
                        points.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    return touch;
  }
  const double shift = least_of_parabola(before, after, pairs[least - 1].gap - pairs[least].gap,
                                         pairs[least + 1].gap - pairs[least].gap);
  const Vec2 along = shift > 0.0 ? Vec2(points[least + 1] - points[least]) : Vec2(points[least] - points[least - 1]);
  touch.points = {points[least] + shift * along.normalized()};
  return touch;
}

/// The moment that a contact carries of a part by where its forces act: their resultant times the distance of its line
/// from where the sides touch first; 0 where it passes between points that do, or nearer than the mesh can tell.
double carried_by(const std::vector<Acting>& acting, const FirstTouch& touch) {
  if (acting.empty()) return 0.0;
  Vec2 resultant = Vec2::Zero();
  for (const Acting& at : acting) resultant += at.force;
  double least = HUGE_VAL, largest = -HUGE_VAL;
  for (const Vec2& from : touch.points) {
    double moment = 0.0;
    for (const auto& [point, force] : acting) moment += cross(Vec2(point - from), force);
    least = std::min(least, moment);
    largest = std::max(largest, moment);
  }
  if (least <= 0.0 && largest >= 0.0) return 0.0;
  const double carried = std::min(std::abs(least), std::abs(largest));
  return carried > resolved * touch.spacing * resultant.norm() ? carried : 0.0;
}

/// The moment of the springs of a part about a point.
double moment_of_springs(const Prepared& prepared, const State& state, std::size_t p, const Vec2& about) {
  const system::BodySystem& part = *prepared.structure.parts[p];
  const Vector springs = part.spring_forces(state.u[p]);
  if (prepared.structure.dofs.is_rigid(p))
    return springs[2] * part.lever() + cross(Vec2(part.reference() - about), Vec2(springs.head<2>()));
  const std::vector<Vec2>& nodes = prepared.structure.dofs.nodes(p);
  double moment = 0.0;
  for (std::size_t node = 0; node < nodes.size(); ++node)
    moment += cross(Vec2(nodes[node] - about), Vec2(springs.segment<2>(place_of(node))));
  return moment;
}

/// Of a part, whether it rolls or not; nothing where no contact has moved along its sides.
std::optional<Rolling> rolling_of(const Prepared& prepared, const State& state, const Contacts& contacts,
                                  std::size_t p) {
  Rolling rolling;
  rolling.part = p;
  rolling.sprung = prepared.structure.parts[p]->has_springs();
  double of_springs = 0.0;  // about where a contact touches first, at most
  for (const Side& side : contacts.of_part(p)) {
    const FirstTouch touch = first_touch(prepared, side);
    rolling.carried += carried_by(contacts.forces_on(side), touch);
    if (rolling.sprung)
      of_springs = std::max(of_springs, std::abs(moment_of_springs(prepared, state, p, touch.points.front())));
  }
  if (rolling.carried == 0.0) return {};
  rolling.carried += of_springs;
  rolling.missed = std::abs(prepared.structure.dofs.is_rigid(p) ? missed_by_rigid(prepared, state, contacts, p)
                                                                : missed_by_elastic(prepared, state, p));
  return rolling;
}

}  // namespace

std::optional<Rolling> rolling_part(const Prepared& prepared, const State& state) {
  const Contacts contacts(prepared, state);
  std::optional<Rolling> worst;
  for (std::size_t p = 0; p < prepared.structure.parts.size(); ++p) {
    if (contacts.of_part(p).empty() || !may_turn(prepared, p)) continue;
    const std::optional<Rolling> rolling = rolling_of(prepared, state, contacts, p);
    if (!rolling || !(rolling->missed > largest_part_missed * rolling->carried)) continue;
    if (!worst || rolling->missed * worst->carried > worst->missed * rolling->carried) worst = rolling;
  }
  return worst;
}

Vector motion_of_rolling(const Prepared& prepared, const State& state, const Rolling& rolling) {
  const Eigen::Index first = prepared.contact.first_rigid[rolling.part],
                     count = prepared.structure.parts[rolling.part]->rigid_motions().cols();
  Vector motion = Vector::Zero(state.a.size());
  motion.segment(first, count) = state.a.segment(first, count);
  return motion;
}

std::string describe_rolling(const Prepared& prepared, const State& state, const Rolling& rolling) {
  const double turned = rolling.missed / rolling.carried;
  std::string motion;
  if (const Vector amplitudes = motion_of_rolling(prepared, state, rolling); !amplitudes.isZero(0.0))
    motion = fmt::format(" ({})", describe_motions(prepared, amplitudes));
  return fmt::format(
      "{} rolls{}: its loads move along with it, and what contact seems to carry by pressing on another part of the "
      "round side, {:.3g} (force times length), is missed by {:.0f} % with the arms of the displaced body; add a "
      "support{}, or loads under which it does not turn",
      prepared.structure.dofs.name_of(rolling.part, prepared.model), motion, rolling.carried, 100.0 * turned,
      rolling.sprung ? ", or stiffer springs" : "");
}

}  // namespace scabo::analysis
