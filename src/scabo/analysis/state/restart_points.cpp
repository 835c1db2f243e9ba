#include "scabo/analysis/state/restart_points.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/analysis/state/fields.hpp"
#include "scabo/linalg/decompositions.hpp"

namespace scabo::analysis {

namespace {

using Numbers = std::vector<double>;

/// What a constraint holds: whether it is a rotation, the node of an elastic body, the direction, the point of a rigid
/// one.
constexpr std::size_t numbers_of_constraint = 6;
Numbers described(const system::Constraint& constraint) {
  const int node = constraint.dof >= 0 ? plane_components.node_of(constraint.dof) : -1;
  const Vec2 along = constraint.direction();
  return {
      constraint.rotation ? 1.0 : 0.0, 1.0 * node, along.x(), along.y(), constraint.point.x(), constraint.point.y()};
}

/// 1 or -1 if two hold the same motion in the same or the other sense, 0 if they do not.
double sense_of(const double* a, const double* b) {
  constexpr double parallel = 1e-9;  // sine of the angle
  if (a[0] != b[0]) return 0.0;
  if (a[0] != 0.0) return 1.0;
  const bool same_place = a[1] == b[1] && a[4] == b[4] && a[5] == b[5];
  if (!same_place || std::abs(a[2] * b[3] - a[3] * b[2]) > parallel) return 0.0;
  return a[2] * b[2] + a[3] * b[3] > 0.0 ? 1.0 : -1.0;
}

bool belongs_to_pair(const Field& field) { return field.lasts && field.owner == Owner::pair; }

const std::string& first_body_of(const Prepared& now, std::size_t part) {
  return now.model.bodies[static_cast<std::size_t>(now.structure.dofs.bodies_of(part).front())].name;
}

const system::BarSystem& point_of_pair(const Prepared& now, std::size_t pair) {
  return now.structure.bars[static_cast<std::size_t>(now.contact.pairs[pair].index)];
}

/// Positions among all pairs of the points of a part.
std::vector<Eigen::Index> points_in_part(const Prepared& now, std::size_t part) {
  std::vector<Eigen::Index> points;
  for (std::size_t i = 0; i < now.contact.pairs.size(); ++i)
    if (is_held_point(now, now.contact.pairs[i]) && point_of_pair(now, i).b.part == part)
      points.push_back(static_cast<Eigen::Index>(i));
  return points;
}

/// A field of a pair that a constraint would be: it sticks, and exerts the reaction.
void append_reaction(const Field& field, double reaction, Numbers& numbers) {
  Numbers of(static_cast<std::size_t>(field.count), 0.0);
  if (std::string_view(field.name) == "p") of.front() = reaction;
  if (std::string_view(field.name) == "states") of.front() = static_cast<double>(contact::ContactState::stick);
  numbers.insert(numbers.end(), of.begin(), of.end());
}

}  // namespace

std::vector<EndState::Held> held_at_end(const Prepared& now, const State& state) {
  std::vector<EndState::Held> all;
  for (std::size_t p = 0; p < now.structure.parts.size(); ++p) {
    const std::vector<system::Constraint>& constraints = now.structure.parts[p]->constraints();
    const std::vector<Eigen::Index> points = points_in_part(now, p);
    if (now.is_absent(p) || (points.empty() && constraints.empty())) continue;
    EndState::Held held;
    held.name = first_body_of(now, p);
    const auto add = [&](const system::Constraint& constraint) {
      for (const double number : described(constraint)) held.constraints.push_back(number);
    };
    for (const Eigen::Index point : points) add(*point_of_pair(now, static_cast<std::size_t>(point)).held);
    for (const system::Constraint& constraint : constraints) add(constraint);
    held.u.assign(state.u[p].begin(), state.u[p].end());
    for (const Field& field : fields_of_state()) {
      if (!belongs_to_pair(field)) continue;
      const Numbers numbers = field.get(state);
      Numbers& of = held.fields[field.name];
      if (numbers.empty() && field.optional) continue;  // all are zero
      of = entries_at(numbers, field.count, points);
      for (const double reaction : state.reactions[p]) append_reaction(field, reaction, of);
    }
    all.push_back(std::move(held));
  }
  return all;
}

void continue_points(const Prepared& now, const EndState& end, State& state) {
  for (std::size_t i = 0; i < now.contact.pairs.size(); ++i) {
    if (!is_held_point(now, now.contact.pairs[i])) continue;
    const Numbers wanted = described(*point_of_pair(now, i).held);
    const auto held =
        std::ranges::find(end.held, first_body_of(now, point_of_pair(now, i).b.part), &EndState::Held::name);
    if (held == end.held.end()) continue;
    for (std::size_t k = 0; (k + 1) * numbers_of_constraint <= held->constraints.size(); ++k) {
      const double sense = sense_of(wanted.data(), &held->constraints[k * numbers_of_constraint]);
      if (sense == 0.0) continue;
      for (const Field& field : fields_of_state()) {
        const auto found = held->fields.find(field.name);
        if (!belongs_to_pair(field) || found == held->fields.end() || found->second.empty()) continue;
        const auto count = static_cast<std::size_t>(field.count);
        const auto first = found->second.begin() + static_cast<std::ptrdiff_t>(k * count);
        Numbers numbers = field.get(state);
        if (numbers.empty()) {
          if (std::all_of(first, first + field.count, [](double x) { return x == 0.0; })) continue;
          numbers.assign(count * now.contact.pairs.size(), 0.0);
        }
        std::copy(first, first + field.count, numbers.begin() + static_cast<std::ptrdiff_t>(i * count));
        if (std::string_view(field.name) == "p") numbers[i * count] *= sense;
        field.set(state, numbers);
      }
      break;
    }
  }
}

bool continue_motions(const Prepared& now, const EndState& end, State& state) {
  bool any = false;
  for (std::size_t p = 0; p < now.structure.parts.size(); ++p) {
    const Matrix& rigid = now.structure.parts[p]->rigid_motions();
    if (now.is_absent(p) || rigid.cols() == 0 || points_in_part(now, p).empty()) continue;
    const auto held = std::ranges::find(end.held, first_body_of(now, p), &EndState::Held::name);
    if (held == end.held.end() || held->u.size() != static_cast<std::size_t>(rigid.rows())) continue;
    const Vector moved = Eigen::Map<const Vector>(held->u.data(), rigid.rows()) - state.u[p];
    const Matrix normal = rigid.transpose() * rigid;
    state.rigid_motion.segment(now.contact.first_rigid[p], rigid.cols()) +=
        normal.ldlt().solve(rigid.transpose() * moved);
    any = true;
  }
  return any;
}

}  // namespace scabo::analysis
