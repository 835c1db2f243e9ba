#include "scabo/result/solid/solid_figures.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace scabo::result {

SolidTotals totals_of(const analysis::SolidIncrement& increment, std::size_t contact, const Eigen::Vector3d& about) {
  SolidTotals totals;
  for (const analysis::SolidPair& pair : increment.pairs) {
    if (pair.contact != static_cast<int>(contact)) continue;
    const Eigen::Vector3d normal = pair.normal_force() * pair.normal;
    totals.normal += normal;
    totals.tangential += pair.force - normal;
    totals.moment += (pair.point - about).cross(pair.force);
    totals.largest_pressure = std::max(totals.largest_pressure, pair.normal_force() / pair.area);
    totals.largest_gap = std::max(totals.largest_gap, pair.gap);
    totals.open += pair.state == contact::ContactState::open;
    totals.stick += pair.state == contact::ContactState::stick;
    totals.slip += pair.state == contact::ContactState::slip;
    totals.broken += pair.broken;
  }
  return totals;
}

std::vector<SolidReaction> reactions_of(const analysis::PosedSolids& posed, std::size_t supports,
                                        const analysis::SolidIncrement& increment) {
  std::vector<SolidReaction> sums(supports);
  const auto add = [&](const analysis::SolidBody& body, const system::Constraint& held, double reaction) {
    const Eigen::Vector3d value = reaction * held.direction_in_space();
    SolidReaction& sum = sums[static_cast<std::size_t>(held.support)];
    if (held.rotation) {
      sum.moment += value;
      return;
    }
    const Eigen::Vector3d at = body.rigid_at ? *body.rigid_at : Eigen::Vector3d(body.mesh.nodes.col(held.dof / 3));
    sum.force += value;
    sum.moment += at.cross(value);
  };
  for (std::size_t b = 0; b < increment.reactions.size(); ++b)
    for (std::size_t c = 0; c < posed.model.bodies[b].supports.size(); ++c)
      add(posed.model.bodies[b], posed.model.bodies[b].supports[c],
          increment.reactions[b][static_cast<Eigen::Index>(c)]);
  for (std::size_t k = 0; k < posed.model.held_points.size() && increment.held.size() > 0; ++k) {
    const analysis::SolidHeldPoint& point = posed.model.held_points[k];
    add(posed.model.bodies[static_cast<std::size_t>(point.body)], point.held,
        increment.held[static_cast<Eigen::Index>(k)]);
  }
  return sums;
}

namespace {

double figure_of(const SolidTotals& totals, const model::SpaceQuantity& quantity) {
  using Kind = model::SpaceQuantity::Kind;
  switch (quantity.kind) {
    case Kind::normal_force:
      return totals.normal[quantity.component];
    case Kind::tangential_force:
      return totals.tangential[quantity.component];
    case Kind::contact_moment:
      return totals.moment[quantity.component];
    case Kind::max_pressure:
      return totals.largest_pressure;
    case Kind::max_gap:
      return totals.largest_gap;
    case Kind::open:
      return totals.open;
    case Kind::stick:
      return totals.stick;
    case Kind::slip:
      return totals.slip;
    case Kind::broken:
      return totals.broken;
    default:
      return totals.normal[quantity.component] + totals.tangential[quantity.component];
  }
}

}  // namespace

double value_of(const model::SpaceModel& model, const analysis::PosedSolids& posed,
                const analysis::SolidIncrement& increment, const model::SpaceQuantity& quantity) {
  using Kind = model::SpaceQuantity::Kind;
  const auto of = static_cast<std::size_t>(std::max(quantity.of, 0));
  switch (quantity.kind) {
    case Kind::elastic_energy:
      return increment.energy.elastic;
    case Kind::external_energy:
      return increment.energy.external;
    case Kind::friction_energy:
      return increment.energy.friction;
    case Kind::reaction:
      return reactions_of(posed, model.supports.size(), increment)[of].force[quantity.component];
    case Kind::support_moment:
      return reactions_of(posed, model.supports.size(), increment)[of].moment[quantity.component];
    case Kind::spring_force:
      return increment.springs[of][quantity.component];
    case Kind::bar_tension:
      return increment.bars[of];
    case Kind::tension:
    case Kind::shortening:
      for (std::size_t i = 0; i < posed.model.preloads.size(); ++i)
        if (posed.model.preloads[i].body == quantity.of)
          return quantity.kind == Kind::tension ? increment.tensions[i].force : increment.tensions[i].shortening;
      throw BrokenInvariant("a bolt without preload");
    default:
      return figure_of(totals_of(increment, of, model.contacts[of].about), quantity);
  }
}

}  // namespace scabo::result
