#include "scabo/analysis/diagnostics/rolling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "scabo/analysis/diagnostics/mechanism.hpp"
#include "scabo/base/components.hpp"

namespace scabo::analysis {

namespace {

constexpr double most_missing = 0.5;  // of the moment that contact carries
constexpr double least_force = 1e-9;  // of the largest so far: less is what the tolerance leaves

/// What acts on a part at a pair, with its arm about the centre of the part, both displaced.
struct ActingForce {
  Vec2 arm, force;
  double normal = 0.0, length = 0.0;  ///< of its share in what the contact carries
};

/// What the forces of one contact carry, missing or not.
double carried_by(const std::vector<ActingForce>& forces) {
  Vec2 resultant = Vec2::Zero();
  double moment = 0.0, normal = 0.0, spread = 0.0, along_sides = 0.0;
  for (const ActingForce& at : forces) {
    resultant += at.force;
    moment += cross(at.arm, at.force);
    normal += at.normal;
    along_sides += 0.25 * at.length * at.force.norm();
  }
  for (const ActingForce& at : forces)
    if (normal > 0.0) spread += at.normal / normal * std::abs(cross(at.arm, resultant));
  return std::max(std::abs(moment), spread) + along_sides;
}

/// A part that may turn.
struct Turning {
  Vec2 centre = Vec2::Zero(), displaced = Vec2::Zero();  ///< where it is at first, and how far it has moved
  double missing = 0.0, carried = 0.0, forces = 0.0;
  std::map<int, std::vector<ActingForce>> of_contact;

  /// The displaced arm of a force at a point that has moved by `u`, while what exerts it has turned.
  Vec2 add(const Vec2& x, const Vec2& u, double turned, const Vec2& force) {
    const Vec2 arm = x - centre, further = u - displaced - turned * Vec2(-arm.y(), arm.x());
    missing += cross(further, force);
    return arm + further;
  }
  bool rolls(double largest_force) const {
    return forces > least_force * largest_force && std::abs(missing) > most_missing * carried;
  }
};

bool may_turn(const Prepared& prepared, std::size_t p) {
  const system::BodySystem& part = *prepared.structure.parts[p];
  const bool has_bar = std::any_of(prepared.structure.bars.begin(), prepared.structure.bars.end(),
                                   [&](const system::BarSystem& bar) { return bar.pull[p].size() > 0; });
  const bool is_held = std::any_of(prepared.contact.pairs.begin(), prepared.contact.pairs.end(), [&](const auto& at) {
    return is_held_point(prepared, at) && prepared.structure.bars[static_cast<std::size_t>(at.index)].b.part == p;
  });
  return !prepared.is_absent(p) && !part.has_springs() && !has_bar && !is_held && !part.is_revolved() &&
         part.rigid_motions().cols() > 0 && !part.rigid_coordinates().row(2).isZero(1e-9);
}

/// How far a point of a part has moved whose u is that of a rigid motion.
Vec2 moved(const Prepared& prepared, const State& state, std::size_t p, const Vec2& x, const Eigen::Vector3d& motion) {
  const system::BodySystem& part = *prepared.structure.parts[p];
  const Vec2 u = system::rigid_point(x, part.reference(), part.lever()) * motion;
  return state.replaced.moved.empty() ? u : Vec2(u + state.replaced.moved[p]);
}

/// Rotation of a part, rad; of an unbounded one 0.
double rotation_of_part(const Prepared& prepared, const State& state, std::size_t p) {
  if (prepared.structure.dofs.is_unbounded(p) || prepared.is_absent(p)) return 0.0;
  return nearest_rigid_motion(prepared, p, state.u[p])[2] / prepared.structure.parts[p]->lever();
}

Turning at_rest(const Prepared& prepared, const State& state, std::size_t p) {
  const system::BodySystem& part = *prepared.structure.parts[p];
  const Eigen::Matrix3d areas = moments_of_part(prepared, p);
  Turning turning;
  turning.centre = part.reference() + part.lever() / areas(0, 0) * Vec2(areas(1, 2), -areas(0, 2));
  turning.displaced = moved(prepared, state, p, turning.centre, nearest_rigid_motion(prepared, p, state.u[p]));
  return turning;
}

void add_reactions(const Prepared& prepared, const State& state, std::size_t p, Turning& turning) {
  const std::vector<system::Constraint>& constraints = prepared.structure.parts[p]->constraints();
  for (std::size_t c = 0; c < constraints.size(); ++c) {
    const int node = constraints[c].dof / 2;
    const bool rigid = prepared.structure.dofs.is_rigid(p);
    const Vec2 x = rigid ? constraints[c].point : prepared.structure.dofs.nodes(p)[static_cast<std::size_t>(node)];
    Vec2 u = rigid ? moved(prepared, state, p, x, state.u[p]) : Vec2(state.u[p].segment<2>(place_of(node)));
    if (!rigid && !state.replaced.moved.empty()) u += state.replaced.moved[p];
    turning.add(x, u, 0.0, state.reactions[p][static_cast<Eigen::Index>(c)] * constraints[c].direction());
  }
}

/// The forces of all pairs, on the parts that may turn.
void add_pairs(const Prepared& prepared, const State& state, std::vector<std::optional<Turning>>& of_part) {
  const Vector& areas = prepared.contact.laws.area;
  std::vector<double> rotation;
  for (std::size_t p = 0; p < of_part.size(); ++p) rotation.push_back(rotation_of_part(prepared, state, p));
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    const Vec2 p = state.p.segment<2>(place_of(i));
    const system::ContactSystem::Pair& at = prepared.contact.pairs[i];
    if (at.is_bar()) continue;
    const mesh::ContactPair& pair = mesh_pair(prepared, at);
    const model::Contact& contact = prepared.model.contacts[static_cast<std::size_t>(at.contact)];
    const std::array<std::size_t, 2> part = {prepared.structure.dofs.part_of(contact.a.body),
                                             prepared.structure.dofs.part_of(contact.b.body)};
    if (p.isZero(0.0) || part[0] == part[1]) continue;
    const double length = areas[static_cast<Eigen::Index>(i)] / model::thickness_between(prepared.model, contact);
    for (const int side : {0, 1}) {
      std::optional<Turning>& turning = of_part[part[static_cast<std::size_t>(side)]];
      if (!turning) continue;
      const Vec2 force = (side == 0 ? -1.0 : 1.0) * (p[0] * pair.normal + p[1] * tangent_of(pair.normal));
      const Vec2 arm = turning->add(prepared.mesh.point_of(at.contact, pair, side),
                                    displacement_of(prepared, state, at.contact, pair, side),
                                    rotation[part[static_cast<std::size_t>(1 - side)]], force);
      turning->forces += force.norm();
      turning->of_contact[at.contact].push_back({arm, force, std::abs(p[0]), length});
    }
  }
}

}  // namespace

std::string rolling_body(const Prepared& prepared, const State& state) {
  std::vector<std::optional<Turning>> of_part(prepared.structure.parts.size());
  bool any = false;
  for (std::size_t p = 0; p < of_part.size(); ++p) {
    if (!may_turn(prepared, p)) continue;
    any = true;
    of_part[p] = at_rest(prepared, state, p);
    add_reactions(prepared, state, p, *of_part[p]);
  }
  if (!any) return {};
  add_pairs(prepared, state, of_part);
  std::size_t most = of_part.size();
  double largest = 0.0;
  for (std::size_t p = 0; p < of_part.size(); ++p) {
    if (!of_part[p]) continue;
    for (const auto& [contact, forces] : of_part[p]->of_contact) of_part[p]->carried += carried_by(forces);
    if (!of_part[p]->rolls(state.largest_force)) continue;
    const double part = std::abs(of_part[p]->missing) / of_part[p]->carried;
    if (part > largest) largest = part, most = p;
  }
  if (most == of_part.size()) return {};
  return fmt::format(
      "{} rolls: it turns by {:.3g} rad, and where it has moved to, {:.0f} % of the moment that contact carries is "
      "missing",
      prepared.structure.dofs.name_of(most, prepared.model), rotation_of_part(prepared, state, most), 100.0 * largest);
}

}  // namespace scabo::analysis
