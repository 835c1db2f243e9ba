// Refinement of displacements in twice the working precision.
#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/system/elastic_body.hpp"

namespace scabo::system {

bool ElasticBody::rounding_matters(const Vector& u, double acting, const Balanced& wanted) const {
  // Of a small body K u leaves some four units of rounding.
  constexpr double unit = std::numeric_limits<double>::epsilon(), small = 1e-12, small_enough = 1e-11;
  const double part = is_large() ? small_enough : std::min(small, 0.25 * wanted.part);
  return unit * stiff_force(u) > part * acting;
}

bool ElasticBody::energy_needs_digits(const Vector& u, const Vector& resisting) const {
  return std::numeric_limits<double>::epsilon() * stiff_force(u) > 1e-12 * resisting.lpNorm<Eigen::Infinity>();
}

double ElasticBody::largest_acting(const Vector& unbalanced, const Vector& f) const {
  double largest = f.lpNorm<Eigen::Infinity>();
  if (is_large() && !constraints_.empty())
    largest = std::max(largest, reactions_of(unbalanced).lpNorm<Eigen::Infinity>());
  return largest;
}

ElasticBody::Goal ElasticBody::goal(const Vector& f, double largest_force) const {
  const Vector held = on_further_ * (rigid_motions_.transpose() * f);
  return {held, is_large() ? std::max(1.0, f.lpNorm<1>() / largest_force) : HUGE_VAL};
}

double ElasticBody::largest_left(const Vector& unbalanced, const Goal& of) const {
  const Vector left = inclined_.components(unbalanced);
  double largest = 0.0;
  for (const int dof : dofs_) largest = std::max(largest, std::abs(left[dof]));
  for (std::size_t k = 0; k < further_.size(); ++k)
    largest = std::max(largest, std::abs(left[further_[k]] + of.held[static_cast<Eigen::Index>(k)]));
  Vector free = left;  // without reactions, which at an inclined node have all components
  for (std::size_t i = 0; i < free_.size(); ++i)
    if (!free_[i]) free[static_cast<Eigen::Index>(i)] = 0.0;
  free = inclined_.forces(std::move(free));
  const Vector sums = motions_.resultants_of(free);
  for (Eigen::Index k = 0; k < sums.size(); ++k)
    largest =
        std::max(largest, std::abs(sums[k]) / (k < motions_.components().dimension ? of.spread : lever_ * of.spread));
  return largest;
}

ElasticBody::Left ElasticBody::left_by(const Vector& u, const Vector& f) const {
  if (!by_differences()) return {internal_forces(u) - f, 0.0};
  Left left;
  left.forces = forces_left(linalg::twofold(u), f, Product::by_differences, &left.rounding);
  return left;
}

ElasticBody::Refined ElasticBody::refined(const Vector& u, const Vector& f, const Balanced& wanted) const {
  const double largest = f.lpNorm<Eigen::Infinity>();
  return refined(u, f, std::min(1e-14, wanted.part) * largest, goal(f, largest));
}

ElasticBody::Refined ElasticBody::refined(const Vector& u, const Vector& f, double allowed, const Goal& of,
                                          const Left* first) const {
  Refined best{linalg::twofold(u), {}};
  // One product for all: to rounding, they are those of two matrices.
  Product product = Product::twofold;
  if (by_differences()) {
    Left known = first ? *first : left_by(u, f);
    if (known.rounding <= 0.1 * allowed) product = Product::by_differences;
    best.left = std::move(known.forces);
  }
  if (product == Product::twofold) best.left = forces_left(best.u, f);
  if (dofs_.empty()) return best;
  const auto solved_part = [&](const Vector& forces) { return Vector(inclined_.components(forces)(dofs_)); };
  const Vector nothing = Vector::Zero(size());
  Refined now = best;
  Vector along = nothing;  // the direction, in the components of `solved_part`
  double before = 0.0, least = largest_left(best.left, of);
  constexpr int most = 40;
  const int patience = is_large() ? 2 : 5;  // its solves take long
  constexpr double hardly = 1e-9;
  int since_best = 0;
  bool changes = false;
  for (int k = 0; k < most && since_best < patience && (least > allowed || changes); ++k) {
    const Vector remaining = solved_part(now.left), correction = solver().solve(remaining).col(0);
    const double decrease = remaining.dot(correction);
    along *= before > 0.0 ? decrease / before : 0.0;
    along(dofs_) -= correction;
    before = decrease;
    const Vector direction = inclined_.displacements(along);
    const Vector resisting = forces_left(linalg::twofold(direction), nothing, product);
    const double curvature = direction.dot(resisting);
    if (!(curvature > 0.0)) break;
    const linalg::Twofold step{-remaining.dot(Vector(along(dofs_))) / curvature, 0.0};
    changes = is_large() && direction.lpNorm<Eigen::Infinity>() * step.high > hardly * u.lpNorm<Eigen::Infinity>();
    for (Eigen::Index dof = 0; dof < direction.size(); ++dof) {
      if (direction[dof] == 0.0) continue;
      linalg::Twofold& component = now.u[static_cast<std::size_t>(dof)];
      component = component + step * linalg::Twofold{direction[dof], 0.0};
    }
    if (k == 0 && product == Product::by_differences)
      now.left += step.high * resisting;  // rounding of K times a small correction is far smaller than that of K u
    else
      now.left = forces_left(now.u, f, product);
    ++since_best;
    if (const double size = largest_left(now.left, of); size < least) best = now, least = size, since_best = 0;
  }
  return best;
}

}  // namespace scabo::system
