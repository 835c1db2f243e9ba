#include "scabo/system/elastic_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "scabo/base/components.hpp"
#include "scabo/base/error.hpp"
#include "scabo/linalg/changed_factor.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/system/ranks.hpp"
#include "scabo/system/rigid_motions.hpp"
#include "scabo/system/same_nodes.hpp"

namespace scabo::system {

ElasticBody::ElasticBody(std::shared_ptr<Factored> factored, const Positions& nodes,
                         std::vector<Constraint> constraints)
    : factored_(std::move(factored)),
      motions_(nodes, factored_->stiffness.revolved),
      free_(static_cast<std::size_t>(nodes.columns().size()), true) {
  constraints_ = std::move(constraints);
  inclined_ = InclinedNodes(constraints_, motions_.components());
  find_rigid_motions(nodes);
  for (const Constraint& constraint : constraints_) free_[static_cast<std::size_t>(constraint.dof)] = false;
  for (const int dof : stiffness().on_axis) free_[static_cast<std::size_t>(dof)] = false;
  solved_ = free_;
  further_ = further_dofs();
  for (int dof : further_) solved_[static_cast<std::size_t>(dof)] = false;
  find_forces_on_further();
  place_.assign(solved_.size(), -1);
  for (std::size_t i = 0; i < solved_.size(); ++i)
    if (solved_[i]) place_[i] = static_cast<int>(dofs_.size()), dofs_.push_back(static_cast<int>(i));
}

void ElasticBody::find_rigid_motions_in_space(const Matrix& nodes) {
  const RigidMotionsInSpace motions(nodes);
  lever_ = motions.lever();
  Matrix all(size(), 6);
  for (Eigen::Index dof = 0; dof < size(); ++dof) all.row(dof) = motions.along(dof);
  Matrix held(static_cast<Eigen::Index>(constraints_.size()), 6);
  for (std::size_t c = 0; c < constraints_.size(); ++c)
    held.row(static_cast<Eigen::Index>(c)) =
        constraints_[c].direction_in_space().transpose() *
        all.middleRows<3>(motions_.components().first_of_node(constraints_[c].dof));
  rigid_coordinates_ = null_space(held);
  if (has_springs())
    rigid_coordinates_ = at_rest(rigid_coordinates_, all.transpose() * (stiffness().springs.matrix * all));
  rigid_motions_ = all * rigid_coordinates_;
}

void ElasticBody::find_rigid_motions(const Positions& nodes) {
  if (nodes.components().dimension == 3) {
    find_rigid_motions_in_space(nodes.columns());
  } else {
    const std::vector<Vec2> in_plane = nodes.in_plane();
    rigid_coordinates_ =
        free_motions(in_plane, constraints_, stiffness().springs.directions, reference_, lever_, is_revolved());
    if (stiffness().resists_rigid_motions) rigid_coordinates_ = Matrix::Zero(3, 0);
    rigid_motions_.resize(size(), rigid_coordinates_.cols());
    for (std::size_t i = 0; i < in_plane.size(); ++i)
      rigid_motions_.middleRows<2>(place_of(i)) = rigid_point(in_plane[i], reference_, lever_) * rigid_coordinates_;
  }
  for (Eigen::Index k = 0; k < rigid_motions_.cols(); ++k) {
    Vector along = inclined_.along(rigid_motions_.col(k));
    for (const Constraint& constraint : constraints_) along[constraint.dof] = 0.0;
    rigid_motions_.col(k) = inclined_.displacements(std::move(along));
  }
}

std::vector<int> ElasticBody::further_dofs() const {
  std::vector<int> chosen;
  if (rigid_motions_.cols() == 0) return chosen;
  // Equal pivots are common, of equal corners for one. Rounded, they are equal in every unit of length, and the
  // choice, on which W and the iterations depend, is the same.
  Matrix along = rigid_motions_;
  for (Eigen::Index k = 0; k < along.cols(); ++k) along.col(k) = inclined_.along(along.col(k));
  const Matrix rounded = (along.transpose().array() * 0x1p30).round() * 0x1p-30;
  const Eigen::ColPivHouseholderQR<Matrix> qr(rounded);
  for (Eigen::Index k = 0; k < rigid_motions_.cols(); ++k) chosen.push_back(qr.colsPermutation().indices()[k]);
  return chosen;
}

void ElasticBody::find_forces_on_further() {
  const Eigen::Index m = rigid_motions_.cols();
  Matrix B(m, m);
  for (Eigen::Index k = 0; k < m; ++k) B.col(k) = inclined_.along(rigid_motions_.col(k))(further_);
  on_further_ = m > 0 ? Matrix(B.transpose().inverse()) : Matrix(0, 0);
}

bool ElasticBody::equals(const ElasticBody& other) const {
  return dofs_ == other.dofs_ && inclined_ == other.inclined_ && equal(stiffness(), other.stiffness());
}

void ElasticBody::factorise(linalg::SparseOptions options) {
  const Positions& nodes = factored_->nodes;
  const std::vector<int>& contact_dofs = factored_->contact_dofs;
  // Many of them are condensed fast in a balanced tree only, that of dissection: of a layer of 1,500 x 54 eight-node
  // elements with 3,001 pairs in 1.6 s instead of 9.1 s, while the factorisation takes as long.
  constexpr std::size_t many = 1000;
  const bool plane = nodes.components().dimension == 2;
  if (plane && contact_dofs.size() >= many && options.ordering == linalg::Ordering::automatic)
    options.ordering = linalg::Ordering::dissection_by_position;
  for (const int dof : dofs_)
    if (plane) options.positions.push_back(nodes.columns().col(plane_components.node_of(dof)));
  if (stiffness().divided) {
    linalg::FactorisationCosts costs;
    auto factor = stiffness().divided->factorise(dofs_, inclined_, stiffness().springs.matrix, contact_dofs, costs);
    factored_->solver = linalg::SymmetricPositiveSolver(static_cast<int>(dofs_.size()), std::move(factor), costs);
  } else if (stiffness().dense) {
    factored_->solver = linalg::SymmetricPositiveSolver(is_whole_alone() ? Matrix((*stiffness().dense)(dofs_, dofs_))
                                                                         : Matrix(whole_dense()(dofs_, dofs_)));
  } else {
    factored_->solver = linalg::SymmetricPositiveSolver(
        principal_part(is_whole_alone() ? stiffness().sparse : whole_sparse(), dofs_, place_), options);
  }
}

bool ElasticBody::factorise_by(const ElasticBody& like, const Positions& nodes_of_like) {
  const Positions& nodes = factored_->nodes;
  const auto is_sparse = [](const Stiffness& one) { return !one.dense && !one.divided; };
  if (!is_large() || !is_sparse(stiffness()) || !is_sparse(like.stiffness()) || nodes.components().dimension != 2)
    return false;
  const std::vector<int> nodes_there = same_nodes(nodes, nodes_of_like);
  std::vector<int> same, near;
  for (const int dof : dofs_) {
    const int there = nodes_there[static_cast<std::size_t>(plane_components.node_of(dof))];
    const auto place = there < 0 ? -1 : place_of(there, plane_components.component_of(dof));
    same.push_back(place < 0 ? -1 : like.place_[static_cast<std::size_t>(place)]);
  }
  for (const int dof : factored_->contact_dofs)
    if (const int place = place_[static_cast<std::size_t>(dof)]; place >= 0) near.push_back(place);
  linalg::SparseMatrix whole, whole_of_like;
  if (!is_whole_alone()) whole = whole_sparse().markAsRValue();
  if (!like.is_whole_alone()) whole_of_like = like.whole_sparse().markAsRValue();
  const linalg::PrincipalPart A{is_whole_alone() ? stiffness().sparse : whole, dofs_, place_},
      A_of_like{like.is_whole_alone() ? like.stiffness().sparse : whole_of_like, like.dofs_, like.place_};
  auto factor = linalg::factor_by_changes(A, {A_of_like, {like.factored_, &like.solver()}}, same, near);
  if (!factor) return false;
  factored_->solver =
      linalg::SymmetricPositiveSolver(static_cast<int>(dofs_.size()), std::move(factor), like.solver().costs());
  return true;
}

Displaced ElasticBody::displaced(const Vector& f, const Vector& prescribed, const Balanced& wanted,
                                 const BegunSolve* begun) const {
  Displaced to{held_displacement(prescribed), {}};
  const bool at_rest = to.u.isZero(0.0);
  if (at_rest && f.isZero(0.0)) return {std::move(to.u), Vector::Zero(size())};
  to.u += begun && begun->begun.size() > 0 ? solved_from(*begun, f)
                                           : solved(at_rest ? f : Vector(f - internal_forces(to.u)));
  Left left = left_by(to.u, f);
  const double acting = largest_acting(left.forces, f);
  if (is_large()) {
    const double largest = std::max(acting, wanted.at_least), allowed = wanted.part * largest;
    const Goal reached = goal(f, largest);
    if (largest_left(left.forces, reached) <= allowed) return {std::move(to.u), std::move(left.forces)};
    Refined exact = refined(to.u, f, allowed, reached, &left);
    return {linalg::rounded(exact.u), std::move(exact.left)};
  }
  to.u -= solved(left.forces);  // another solve of a small body costs nothing
  if (!rounding_matters(to.u, acting, wanted)) return to;
  Refined exact = refined(to.u, f, wanted);
  return {linalg::rounded(exact.u), std::move(exact.left)};
}

Vector ElasticBody::displacement_at(const Vector& f, const Vector& prescribed, const std::vector<int>& dofs,
                                    BegunSolve* begun) const {
  Vector u = held_displacement(prescribed);
  const bool at_rest = u.isZero(0.0);
  if (dofs.empty() || (at_rest && f.isZero(0.0))) return u;
  if (!at_rest || !is_large()) return displacement(f, prescribed);
  // A few others tell how far the body bends, and so whether rounding matters.
  constexpr std::size_t samples = 64;
  std::vector<int> wanted;
  std::vector<char> chosen(place_.size(), 0);
  const auto want = [&](int dof) {
    for (const int component : all_if_inclined(dof)) {
      const auto i = static_cast<std::size_t>(component);
      if (place_[i] >= 0 && !chosen[i]) chosen[i] = 1, wanted.push_back(component);
    }
  };
  for (const int dof : dofs) want(dof);
  for (std::size_t k = 0; k < samples; ++k) want(dofs_[k * dofs_.size() / samples]);
  std::vector<int> places;
  for (const int dof : wanted) places.push_back(place_[static_cast<std::size_t>(dof)]);
  Vector v = Vector::Zero(size());
  Vector half = solver().begin(inclined_.components(f)(dofs_));
  v(wanted) = solver().solve_at(half, places);
  if (begun) *begun = {f, std::move(half)};
  u = inclined_.displacements(std::move(v));
  double acting = f.lpNorm<Eigen::Infinity>();  // and what holds a body without supports against its loads
  if (rigid_motions_.cols() > 0) acting = std::max(acting, (rigid_motions_.transpose() * f).lpNorm<Eigen::Infinity>());
  return rounding_matters(u, acting) ? displacement(f, prescribed) : u;
}

bool ElasticBody::moves(int dof) const {
  const Components of_nodes = motions_.components();
  return place_[static_cast<std::size_t>(dof)] >= 0 ||
         (!inclined_.none() && inclined_.of(of_nodes.node_of(dof)) != nullptr);
}

Matrix ElasticBody::flexibility(const std::vector<int>& dofs, bool refines) const {
  const Components of_nodes = motions_.components();
  const bool any = !inclined_.none() && std::any_of(dofs.begin(), dofs.end(), [&](int dof) {
    return inclined_.of(of_nodes.node_of(dof)) != nullptr;
  });
  if (!any) return flexibility_along(dofs, refines);
  // u = T v on these degrees of freedom, with all of every inclined node.
  std::vector<int> all;
  std::vector<Eigen::Triplet<double>> entries;
  std::map<int, int> column_of;
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const auto row = static_cast<int>(i);
    const int node = of_nodes.node_of(dofs[i]);
    const auto* const M = inclined_.of(node);
    if (!M) {
      entries.emplace_back(row, static_cast<int>(all.size()), 1.0);
      all.push_back(dofs[i]);
      continue;
    }
    const auto [at, added] = column_of.emplace(node, static_cast<int>(all.size()));
    for (int k = 0; k < of_nodes.dimension; ++k) {
      if (added) all.push_back(static_cast<int>(of_nodes.of(node, k)));
      entries.emplace_back(row, at->second + k, (*M)(of_nodes.component_of(dofs[i]), k));
    }
  }
  Eigen::SparseMatrix<double> T(static_cast<Eigen::Index>(dofs.size()), static_cast<Eigen::Index>(all.size()));
  T.setFromTriplets(entries.begin(), entries.end());
  const Matrix half = T * flexibility_along(all, refines), A = T * half.transpose();
  return 0.5 * (A + A.transpose());
}

Matrix ElasticBody::flexibility_along(const std::vector<int>& dofs, bool refines) const {
  std::vector<int> places, at;
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const int place = place_[static_cast<std::size_t>(dofs[i])];
    if (place >= 0) places.push_back(place), at.push_back(static_cast<int>(i));
  }
  Matrix A = solver().inverse_block(places);
  if (at.size() < dofs.size()) {
    const Matrix of_solved = std::move(A);
    A = Matrix::Zero(static_cast<Eigen::Index>(dofs.size()), static_cast<Eigen::Index>(dofs.size()));
    A(at, at) = of_solved;
  }
  // The factor alone gives it to about its condition times the unit of rounding. Where soft springs or soft parts hold
  // a body, contact takes most of it away again, and the error grows with the square.
  const double condition = has_springs() ? 1e4 : 1e5;
  constexpr double most_entries = 1e9;  // some seconds; above, analysis/diagnostics/softly_held corrects what it can
  const double here = at.empty() ? 0.0 : factored_->largest_diagonal * A.diagonal().maxCoeff();
  const double entries = stiffness().entries() * static_cast<double>(at.size());
  if (refines && here > condition && entries < most_entries) {
    const Vector none = Vector::Zero(size());
    for (std::size_t j = 0; j < at.size(); ++j) {
      Vector force = none;
      force[dofs[static_cast<std::size_t>(at[j])]] = 1.0;
      force = inclined_.forces(std::move(force));
      const Vector u = inclined_.along(linalg::rounded(refined(solved(force), force, {}).u));
      for (std::size_t i = 0; i < at.size(); ++i) A(at[i], at[j]) = u[dofs[static_cast<std::size_t>(at[i])]];
    }
    A = 0.5 * (A + A.transpose()).eval();
  }
  return A;
}

Vector ElasticBody::flexed(const std::vector<int>& dofs, const Vector& forces) const {
  Vector load = Vector::Zero(size());
  load(dofs) = forces;
  load = inclined_.components(std::move(load));
  std::vector<int> wanted, places;
  for (const int dof : dofs)
    for (const int component : all_if_inclined(dof))
      if (const int place = place_[static_cast<std::size_t>(component)]; place >= 0)
        wanted.push_back(component), places.push_back(place);
  Vector v = Vector::Zero(size());
  v(wanted) = solver().solve_at(solver().begin(load(dofs_)), places);
  return inclined_.displacements(std::move(v))(dofs);
}

FreeStiffness ElasticBody::free_stiffness() const {
  ensure(!is_divided(), "the stiffness of a divided body is not here");
  FreeStiffness free;
  std::vector<int> place(free_.size(), -1);
  for (std::size_t i = 0; i < free_.size(); ++i)
    if (free_[i]) place[i] = static_cast<int>(free.dofs.size()), free.dofs.push_back(static_cast<int>(i));
  if (stiffness().dense)
    free.K = Matrix(whole_dense()(free.dofs, free.dofs)).sparseView();
  else
    free.K = principal_part(whole_sparse(), free.dofs, place);
  const Components of_nodes = motions_.components();
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < free.dofs.size(); ++k) {
    const int dof = free.dofs[k], column = static_cast<int>(k);
    const auto* const M = inclined_.of(of_nodes.node_of(dof));
    if (!M)
      entries.emplace_back(dof, column, 1.0);
    else
      for (int row = 0; row < of_nodes.dimension; ++row)
        entries.emplace_back(of_nodes.first_of_node(dof) + row, column, (*M)(row, of_nodes.component_of(dof)));
  }
  free.map.resize(size(), static_cast<Eigen::Index>(free.dofs.size()));
  free.map.setFromTriplets(entries.begin(), entries.end());
  free.motions.resize(static_cast<Eigen::Index>(further_.size()), rigid_motions_.cols());
  for (Eigen::Index k = 0; k < rigid_motions_.cols(); ++k)
    free.motions.col(k) = inclined_.along(rigid_motions_.col(k))(further_);
  for (const int dof : further_) free.further.push_back(place[static_cast<std::size_t>(dof)]);
  return free;
}

double ElasticBody::operations() const {
  const double dense = std::pow(static_cast<double>(dofs_.size()), 3.0) / 3.0;
  return stiffness().dense ? dense : solver().costs().operations;
}

Vector ElasticBody::unbalanced(const Vector& u, const Vector& f) const {
  Left plain = left_by(u, f);
  if (!u.allFinite()) return std::move(plain.forces);
  const double acting = largest_acting(plain.forces, f), allowed = Balanced().part * acting;
  const Goal reached = goal(f, acting);
  if (is_large() ? largest_left(plain.forces, reached) <= allowed : !rounding_matters(u, acting))
    return std::move(plain.forces);
  Refined exact = is_large() ? refined(u, f, allowed, reached, &plain) : refined(u, f, {});
  constexpr double last_digits = 256 * std::numeric_limits<double>::epsilon();
  if (!((linalg::rounded(exact.u) - u).lpNorm<Eigen::Infinity>() <= last_digits * u.lpNorm<Eigen::Infinity>()))
    return std::move(plain.forces);
  return std::move(exact.left);
}

Vector ElasticBody::reactions_of(const Vector& unbalanced) const {
  const Vector remaining = inclined_.components(unbalanced);
  Vector forces(static_cast<Eigen::Index>(constraints_.size()));
  for (std::size_t c = 0; c < constraints_.size(); ++c)
    forces[static_cast<Eigen::Index>(c)] = remaining[constraints_[c].dof];
  return forces;
}

double ElasticBody::imbalance_of(const Vector& unbalanced) const {
  const Vector remaining = inclined_.components(unbalanced);
  double largest = 0.0;
  for (std::size_t i = 0; i < free_.size(); ++i)
    if (free_[i]) largest = std::max(largest, std::abs(remaining[static_cast<Eigen::Index>(i)]));
  return largest;
}

double ElasticBody::elastic_energy(const Vector& u) const {
  const Vector resisting = internal_forces(u);
  return !by_differences() && energy_needs_digits(u, resisting) ? exact_energy(u) : 0.5 * u.dot(resisting);
}

double ElasticBody::elastic_energy(const Vector& u, const Vector& f, const Vector& unbalanced) const {
  const Vector resisting = f + unbalanced;
  // By differences, forces are known more exactly than rounding of u leaves them.
  const bool exact = by_differences();
  if (!exact && rounding_matters(u, resisting.lpNorm<Eigen::Infinity>())) return exact_energy(u);  // u is refined
  Vector acting = Vector::Zero(size());
  const Vector left = inclined_.components(unbalanced);
  for (const Constraint& constraint : constraints_) acting[constraint.dof] = left[constraint.dof];
  const double work = u.dot(f) + inclined_.along(u).dot(acting);
  return work - (!exact && energy_needs_digits(u, resisting) ? exact_energy(u) : 0.5 * u.dot(resisting));
}

double ElasticBody::energy_lost(const Vector& u) const {
  // An estimate: digits that the rigid motions take from it do not count.
  const Vector strained = stiffness().resists_rigid_motions ? u : motions_.taken_out_of(u);
  const double largest = strained.lpNorm<Eigen::Infinity>();
  if (!(largest > 0.0)) return 0.0;
  const Vector square = (strained / largest).cwiseAbs2();  // the fourth power of a displacement may overflow
  const double sum = square.dot(stiffness().times_squares(square));
  return 0.5 * stiffness().rounding * std::sqrt(sum) * largest * largest;  // errors of single entries, independent
}

double ElasticBody::stiff_force(const Vector& u) const {
  return factored_->largest_diagonal * u.lpNorm<Eigen::Infinity>();
}

double ElasticBody::exact_energy(const Vector& u) const {
  return 0.5 * u.dot(forces_left(linalg::twofold(u), Vector::Zero(size())));
}

Matrix ElasticBody::whole_dense() const {
  Matrix K = *stiffness().dense;
  if (has_springs()) K += stiffness().springs.matrix;
  return inclined_.none() ? K : inclined_.stiffness(std::move(K));
}

linalg::SparseMatrix ElasticBody::whole_sparse() const {
  const linalg::SparseMatrix K = has_springs() ? with_springs(stiffness()) : stiffness().sparse;
  return inclined_.none() ? K : inclined_.stiffness(K);
}

std::vector<int> ElasticBody::all_if_inclined(int dof) const {
  const Components of_nodes = motions_.components();
  if (!inclined_.of(of_nodes.node_of(dof))) return {dof};
  std::vector<int> all(static_cast<std::size_t>(of_nodes.dimension));
  std::iota(all.begin(), all.end(), static_cast<int>(of_nodes.first_of_node(dof)));
  return all;
}

Vector ElasticBody::held_displacement(const Vector& prescribed) const {
  Vector u = Vector::Zero(size());
  for (std::size_t c = 0; c < constraints_.size(); ++c)
    u[constraints_[c].dof] = prescribed[static_cast<Eigen::Index>(c)];
  return inclined_.displacements(std::move(u));
}

Vector ElasticBody::solved(const Vector& f) const {
  const Vector load = inclined_.components(f);
  Vector v = Vector::Zero(size());
  v(dofs_) = solver().solve(load(dofs_)).col(0);
  return inclined_.displacements(std::move(v));
}

Vector ElasticBody::solved_from(const BegunSolve& begun, const Vector& f) const {
  const Vector more = inclined_.components(f - begun.f);
  Vector v = Vector::Zero(size());
  v(dofs_) = solver().solve_from(begun.begun, more(dofs_));
  return inclined_.displacements(std::move(v));
}

}  // namespace scabo::system
