#include "scabo/analysis/dynamics/acting_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/analysis/state/loads.hpp"
#include "scabo/contact/pair_operator.hpp"

namespace scabo::analysis {

namespace {

/// Relative motions of all pairs under the vectors of all parts.
Vector motion_of(const Prepared& prepared, const std::vector<Vector>& of_parts) {
  Vector motion = Vector::Zero(static_cast<Eigen::Index>(2 * prepared.contact.pairs.size()));
  for (std::size_t p = 0; p < of_parts.size(); ++p)
    if (!prepared.is_absent(p)) motion += prepared.contact.motion[p] * of_parts[p];
  return motion;
}

std::vector<int> rows_of(const std::vector<int>& places) {
  std::vector<int> rows;
  rows.reserve(2 * places.size());
  for (const int i : places) rows.insert(rows.end(), {2 * i, 2 * i + 1});
  return rows;
}

/// Rows of a sparse matrix, and columns if it is `square`.
Eigen::SparseMatrix<double> rows_in(const Eigen::SparseMatrix<double>& matrix, const std::vector<int>& rows,
                                    bool square) {
  std::vector<int> place(static_cast<std::size_t>(matrix.rows()), -1);
  for (std::size_t k = 0; k < rows.size(); ++k) place[static_cast<std::size_t>(rows[k])] = static_cast<int>(k);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
    const int to = square ? place[static_cast<std::size_t>(column)] : static_cast<int>(column);
    if (to < 0) continue;
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, column); it; ++it)
      if (const int row = place[static_cast<std::size_t>(it.row())]; row >= 0)
        entries.emplace_back(row, to, it.value());
  }
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::SparseMatrix<double> block(n, square ? n : matrix.cols());
  block.setFromTriplets(entries.begin(), entries.end());
  return block;
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

contact::Delassus block_of(const contact::Delassus& W, const std::vector<int>& places) {
  if (2 * static_cast<Eigen::Index>(places.size()) == W.size()) return W;
  const std::vector<int> rows = rows_of(places);
  if (W.is_sparse()) return contact::Delassus(rows_in(W.sparse(), rows, true));
  if (W.is_dense()) return Matrix(W.factor() * W.matrix()(rows, rows));
  if (const contact::PairHolder* holder = W.holder())
    if (Matrix block = holder->flexibility(rows); block.rows() == static_cast<Eigen::Index>(rows.size())) return block;
  return Matrix(W.dense()(rows, rows));
}

ActingPairs acting_pairs(const InTime& in, const State& from, const Factors& at_end) {
  const Prepared& prepared = in.at_rest;
  ActingPairs acting;
  const double none = rounding_of_gaps(prepared), h = in.system.size;
  const Vector velocity = motion_of(prepared, from.velocity);
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

contact::RigidMap block_of(const contact::RigidMap& G, const std::vector<int>& places) {
  return contact::RigidMap(rows_in(G.sparse(), rows_of(places), false));
}

contact::Problem pose(const ActingPairs& pairs, const Prepared& prepared, const State& t) {
  contact::Problem problem;
  problem.W = block_of(prepared.contact.W, pairs.places);
  problem.G = block_of(prepared.contact.G, pairs.places);
  problem.f = Vector::Zero(prepared.contact.rigid_motions());
  std::vector<Vector> free;
  for (std::size_t p = 0; p < prepared.structure.parts.size(); ++p) {
    const system::BodySystem& part = *prepared.structure.parts[p];
    if (prepared.is_absent(p)) {
      free.push_back(Vector::Zero(part.size()));
      continue;
    }
    free.push_back(part.displacement(t.forces[p], t.prescribed[p]));
    problem.f.segment(prepared.contact.first_rigid[p], part.rigid_motions().cols()) =
        part.rigid_motions().transpose() * t.forces[p];
  }
  problem.q = entries_of(motion_of(prepared, free), pairs.places);
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
  Vector motion = motion_of(prepared, state.u);
  if (state.offset.size() > 0) motion += state.offset;
  Vector gaps(static_cast<Eigen::Index>(prepared.contact.pairs.size()));
  for (Eigen::Index i = 0; i < gaps.size(); ++i) gaps[i] = gap_at(prepared, state.factors, i) + motion[2 * i];
  return gaps;
}

}  // namespace scabo::analysis
