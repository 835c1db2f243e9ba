#include "scabo/analysis/space/solid_restart_points.hpp"

#include <algorithm>
#include <array>

#include "scabo/linalg/decompositions.hpp"
#include "scabo/system/rigid_solid.hpp"

namespace scabo::analysis {

namespace {

constexpr const char* reaction_name = "reaction";
constexpr const char* offset_name = "offset";  // along the direction that is held

/// What a constraint holds: the node of an elastic body or the motion of a rigid one, and the direction.
constexpr std::size_t numbers_of_held = 4;
std::array<double, numbers_of_held> described(const SolidBody& body, const system::Constraint& held) {
  const Eigen::Vector3d along = held.direction_in_space();
  return {1.0 * (body.rigid_at ? system::held_motion(held) : in_space.node_of(held.dof)), along.x(), along.y(),
          along.z()};
}

/// Whether a constraint of another run holds the same.
bool is_same(const std::array<double, numbers_of_held>& wanted, const double* other) {
  constexpr double rounding = 1e-9;
  const Eigen::Vector3d a(wanted[1], wanted[2], wanted[3]), b(other[1], other[2], other[3]);
  return wanted[0] == other[0] && (a - b).norm() <= rounding;
}

/// Places of the pairs of a body that are held points.
std::vector<Eigen::Index> points_on(const PreparedSolids& now, std::size_t body) {
  std::vector<Eigen::Index> places;
  const std::vector<system::ContactSystem::Pair>& pairs = now.contact().pairs;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (now.is_held_point(pairs[i]) && now.model.held_points[now.held_point(pairs[i])].body == static_cast<int>(body))
      places.push_back(static_cast<Eigen::Index>(i));
  return places;
}

const SolidHeldPoint& point_at(const PreparedSolids& now, Eigen::Index place) {
  return now.model.held_points[now.held_point(now.contact().pairs[static_cast<std::size_t>(place)])];
}

MovedSolids moved_in(const PreparedSolids& now, const SolidState& state) {
  return moved_solids(now, applied_to_solids(now, state.factors, state.shortening, state.released), state.p, state.a);
}

}  // namespace

std::vector<EndState::Held> solids_held_at_end(const PreparedSolids& now, const SolidState& state) {
  const MovedSolids moved = moved_in(now, state);
  const Vector reactions = reactions_of_held_points(now, state.p, 0.0, {});
  std::vector<EndState::Held> all;
  for (std::size_t b = 0; b < now.model.bodies.size(); ++b) {
    const SolidBody& body = now.model.bodies[b];
    const std::vector<Eigen::Index> points = points_on(now, b);
    if (now.is_absent(b) || (points.empty() && body.supports.empty())) continue;
    EndState::Held held;
    held.name = body.name;
    held.u.assign(moved.u[b].begin(), moved.u[b].end());
    const auto add = [&](const system::Constraint& constraint, double reaction, double offset) {
      for (const double number : described(body, constraint)) held.constraints.push_back(number);
      held.fields[reaction_name].push_back(reaction);
      held.fields[offset_name].push_back(offset);
    };
    for (const Eigen::Index place : points)
      add(point_at(now, place).held,
          reactions[static_cast<Eigen::Index>(now.held_point(now.contact().pairs[static_cast<std::size_t>(place)]))],
          state.offset.size() > 0 ? state.offset[in_space.of(place)] : 0.0);
    for (std::size_t c = 0; c < body.supports.size(); ++c)
      add(body.supports[c], moved.reactions[b][static_cast<Eigen::Index>(c)], 0.0);
    all.push_back(std::move(held));
  }
  return all;
}

void continue_held_points(const PreparedSolids& now, const EndState& end, SolidState& state) {
  std::vector<const EndState::Held*> continued(now.model.bodies.size(), nullptr);
  for (std::size_t b = 0; b < now.model.bodies.size(); ++b) {
    const SolidBody& body = now.model.bodies[b];
    const auto held = std::ranges::find(end.held, body.name, &EndState::Held::name);
    if (now.is_absent(b) || held == end.held.end()) continue;
    for (const Eigen::Index place : points_on(now, b)) {
      const SolidHeldPoint& point = point_at(now, place);
      const auto wanted = described(body, point.held);
      const std::size_t count = held->constraints.size() / numbers_of_held;
      std::size_t k = 0;
      while (k < count && !is_same(wanted, &held->constraints[k * numbers_of_held])) ++k;
      if (k == count) continue;
      const double offset = kept(held->fields, offset_name).at(k);
      state.p[in_space.of(place)] = kept(held->fields, reaction_name).at(k) / lever_of(now.model, point);
      state.states[static_cast<std::size_t>(place)] = contact::ContactState::stick;
      if (state.offset.size() == 0 && offset != 0.0) state.offset = Vector::Zero(state.p.size());
      if (state.offset.size() > 0) state.offset[in_space.of(place)] = offset;
      continued[b] = &*held;
    }
  }
  const MovedSolids moved = moved_in(now, state);
  for (std::size_t b = 0; b < continued.size(); ++b) {
    const Matrix& rigid = now.structure.parts[b]->rigid_motions();
    if (continued[b] == nullptr || rigid.cols() == 0) continue;
    const Vector away = Eigen::Map<const Vector>(continued[b]->u.data(), rigid.rows()) - moved.u[b];
    state.a.segment(now.contact().first_rigid[b], rigid.cols()) +=
        (rigid.transpose() * rigid).ldlt().solve(rigid.transpose() * away);
  }
}

}  // namespace scabo::analysis
