#include "scabo/analysis/dynamics/projection.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "scabo/analysis/dynamics/acting_pairs.hpp"
#include "scabo/analysis/state/pair_motions.hpp"

namespace scabo::analysis {

namespace {

/// d of all parts under normal forces of some pairs, and prescribed values.
std::vector<Vector> displacements(const Prepared& prepared, const Vector& nu, const Vector& a,
                                  const std::vector<Vector>& prescribed) {
  std::vector<Vector> d;
  for (std::size_t p = 0; p < prepared.structure.parts.size(); ++p) {
    const system::BodySystem& part = *prepared.structure.parts[p];
    if (prepared.is_absent(p)) {
      d.push_back(Vector::Zero(part.size()));
      continue;
    }
    Vector of_part = part.displacement(prepared.contact.motion[p].transpose() * nu, prescribed[p]);
    if (const Matrix& rigid = part.rigid_motions(); rigid.cols() > 0)
      of_part += rigid * a.segment(prepared.contact.first_rigid[p], rigid.cols());
    d.push_back(std::move(of_part));
  }
  return d;
}

/// Gaps that the displacements leave.
Vector gaps_after(const Prepared& prepared, const Vector& gap, const std::vector<Vector>& d) {
  const Vector motion = motion_under(prepared.contact.motion, d, 2 * gap.size());
  return gap + Vector(motion.reshaped(2, gap.size()).row(0));
}

/// How far the displacements of the constraints are from where they are prescribed.
std::vector<Vector> drift_of(const Prepared& at_rest, const State& to, double none, bool& any) {
  std::vector<Vector> drift;
  for (std::size_t p = 0; p < to.u.size(); ++p) {
    Vector of_part = Vector::Zero(to.prescribed[p].size());
    if (!at_rest.is_absent(p)) of_part = to.prescribed[p] - support_values(*at_rest.structure.parts[p], to.u[p]);
    any = any || (of_part.array().abs() > none).any();
    drift.push_back(std::move(of_part));
  }
  return drift;
}

/// Pairs that overlap, but for those with a massless side.
std::vector<int> overlapping(const InTime& in, const Vector& gap, double none) {
  std::vector<int> places;
  for (Eigen::Index i = 0; i < gap.size(); ++i)
    if (gap[i] < -none && !has_massless_side(in, i)) places.push_back(static_cast<int>(i));
  return places;
}

/// Adds places that are not among others, which are ascending and stay so.
void add(const std::vector<int>& places, std::vector<int>& to) {
  std::vector<int> all;
  std::set_union(to.begin(), to.end(), places.begin(), places.end(), std::back_inserter(all));
  to = std::move(all);
}

/// nu of some pairs, of which `gap` is what the supports leave of the gaps; empty where it was not found.
std::vector<Vector> projected(const Prepared& prepared, const std::vector<int>& places, const Vector& gap,
                              const std::vector<Vector>& drift) {
  contact::Problem problem = problem_of(prepared, places);
  problem.mu = Vector::Zero(static_cast<Eigen::Index>(places.size()));
  for (std::size_t k = 0; k < places.size(); ++k) problem.q[static_cast<Eigen::Index>(2 * k)] = gap[places[k]];
  const contact::Solution solution = contact::solve(problem);
  if (solution.status != contact::Status::solved) return {};
  Vector nu = Vector::Zero(2 * gap.size());
  for (std::size_t k = 0; k < places.size(); ++k) nu[2 * places[k]] = solution.p[static_cast<Eigen::Index>(2 * k)];
  return displacements(prepared, nu, solution.a, drift);
}

}  // namespace

Vector support_values(const system::BodySystem& part, const Vector& u) {
  Vector values(static_cast<Eigen::Index>(part.constraints().size()));
  for (std::size_t c = 0; c < part.constraints().size(); ++c) {
    const system::Constraint& constraint = part.constraints()[c];
    double& value = values[static_cast<Eigen::Index>(c)];
    if (constraint.dof >= 0)
      value = constraint.direction().dot(Vec2(u.segment<2>(constraint.dof / 2 * 2)));
    else if (constraint.rotation)
      value = u[2];
    else
      value =
          constraint.direction().dot(Vec2(system::rigid_point(constraint.point, part.reference(), part.lever()) * u));
  }
  return values;
}

Projection project(const InTime& in, const State& t, State& to) {
  const Prepared& prepared = in.system.prepared;
  const double none = rounding_of_gaps(in.at_rest);
  bool moves = false;
  const std::vector<Vector> drift = drift_of(in.at_rest, to, none, moves);
  std::vector<int> places = overlapping(in, to.gap, none);
  if (places.empty() && !moves) return {};
  for (Eigen::Index i = 0; i < to.gap.size(); ++i)  // closed ones as well
    if (t.p[2 * i] > 0.0 && !has_massless_side(in, i)) add({static_cast<int>(i)}, places);
  Projection projection{
      displacements(prepared, Vector::Zero(t.p.size()), Vector::Zero(prepared.contact.rigid_motions()), drift)};
  const Vector gap = gaps_after(prepared, to.gap, projection.displacement);
  constexpr int rounds = 8;  // more pairs overlap once the first ones do no more
  for (int round = 0; round < rounds && !places.empty(); ++round) {
    projection.displacement = projected(prepared, places, gap, drift);
    if (projection.displacement.empty()) return {};  // overlaps stay until the next step
    const std::size_t before = places.size();
    add(overlapping(in, gaps_after(prepared, to.gap, projection.displacement), none), places);
    if (places.size() == before) break;
  }
  for (std::size_t p = 0; p < to.u.size(); ++p) to.u[p] += projection.displacement[p];
  to.gap = gaps_at(in.at_rest, to);
  return projection;
}

}  // namespace scabo::analysis
