#include "scabo/analysis/dynamics/acting_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/analysis/state/loads.hpp"
#include "scabo/analysis/state/pair_motions.hpp"

namespace scabo::analysis {

namespace {

std::vector<int> rows_of(const std::vector<int>& places) {
  std::vector<int> rows;
  rows.reserve(2 * places.size());
  for (const int i : places) rows.insert(rows.end(), {2 * i, 2 * i + 1});
  return rows;
}

/// Of each of `count` rows its number among those of some pairs, -1: of another pair.
std::vector<int> places_of_rows(const std::vector<int>& places, Eigen::Index count) {
  const std::vector<int> rows = rows_of(places);
  std::vector<int> place(static_cast<std::size_t>(count), -1);
  for (std::size_t k = 0; k < rows.size(); ++k) place[static_cast<std::size_t>(rows[k])] = static_cast<int>(k);
  return place;
}

Eigen::Index rows_of_all(const Prepared& prepared) {
  return 2 * static_cast<Eigen::Index>(prepared.contact.pairs.size());
}

}  // namespace

bool has_massless_side(const InTime& in, Eigen::Index pair) {
  const auto number = static_cast<std::size_t>(in.at_rest.contact.pairs[static_cast<std::size_t>(pair)].contact);
  const model::Contact& contact = in.at_rest.model.contacts[number];
  const system::Dofs& dofs = in.at_rest.structure.dofs;
  return in.inertia[dofs.part_of(contact.a.body)].is_massless() ||
         in.inertia[dofs.part_of(contact.b.body)].is_massless();
}

double rounding_of_gaps(const Prepared& prepared) {
  constexpr double part = 1e-10;
  double size = 0.0;
  for (const auto& of_part : prepared.structure.parts) size = std::max(size, of_part->lever());
  return part * size;
}

Vector entries_of(const Vector& of_pairs, const std::vector<int>& places) { return of_pairs(rows_of(places)); }

contact::Problem problem_of(const Prepared& prepared, const std::vector<int>& places) {
  contact::Problem problem;
  const auto rows = static_cast<Eigen::Index>(2 * places.size()), all = rows_of_all(prepared);
  const std::vector<int> place = places_of_rows(places, all);
  problem.W = rows == all ? prepared.contact.W : system::block_of(prepared.contact.W, place);
  problem.G = contact::RigidMap(
      system::block_of(prepared.contact.G.sparse(), place, {}, rows, prepared.contact.rigid_motions()));
  problem.q = Vector::Zero(rows);
  problem.f = Vector::Zero(prepared.contact.rigid_motions());
  return problem;
}

ActingPairs acting_pairs(const InTime& in, const State& from, const Factors& at_end) {
  const Prepared& prepared = in.at_rest;
  ActingPairs acting;
  const double none = rounding_of_gaps(prepared), h = in.system.size;
  const Vector velocity = motion_under(prepared.contact.motion, from.velocity, rows_of_all(prepared));
  const contact::JointLaws laws = laws_at(prepared, at_end);
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double gap = from.gap[k];
    const bool closes = gap + 0.5 * h * velocity[2 * k] <= none;
    const bool carried = from.p[2 * k] != 0.0 && (std::abs(gap) <= none || has_massless_side(in, k));
    if (closes || carried || laws.of_pair[i]->limits(from.history[i]).tension > 0.0)
      acting.places.push_back(static_cast<int>(i));
  }
  acting.laws.of_pair = at_places(laws.of_pair, acting.places);
  acting.laws.area = laws.area(acting.places);
  return acting;
}

contact::Problem pose(const ActingPairs& pairs, const Prepared& prepared, const State& t,
                      std::vector<system::BegunSolve>& begun) {
  contact::Problem problem = problem_of(prepared, pairs.places);
  if (!pairs.places.empty()) problem.q = entries_of(free_motion(prepared, t, &begun).pairs, pairs.places);
  for (std::size_t p = 0; p < prepared.structure.parts.size(); ++p)
    if (const Matrix& rigid = prepared.structure.parts[p]->rigid_motions(); rigid.cols() > 0 && !prepared.is_absent(p))
      problem.f.segment(prepared.contact.first_rigid[p], rigid.cols()) = rigid.transpose() * t.forces[p];
  return problem;
}

void give_to_all(const ActingPairs& pairs, const contact::Solution& solution, const contact::History& history,
                 const State& from, State& to) {
  to.p = Vector::Zero(from.p.size());
  to.history = from.history;
  to.states.assign(from.states.size(), contact::ContactState::open);
  for (std::size_t k = 0; k < pairs.places.size(); ++k) {
    const auto i = static_cast<std::size_t>(pairs.places[k]);
    to.p.segment<2>(static_cast<Eigen::Index>(2 * i)) = solution.p.segment<2>(static_cast<Eigen::Index>(2 * k));
    to.history[i] = history[k];
    to.states[i] = solution.states[k];
  }
}

Vector gaps_at(const Prepared& prepared, const State& state) {
  Vector motion = motion_under(prepared.contact.motion, state.u, rows_of_all(prepared));
  if (state.offset.size() > 0) motion += state.offset;
  Vector gaps(static_cast<Eigen::Index>(prepared.contact.pairs.size()));
  for (Eigen::Index i = 0; i < gaps.size(); ++i) gaps[i] = gap_at(prepared, state.factors, i) + motion[2 * i];
  return gaps;
}

}  // namespace scabo::analysis
