#include "scabo/contact/newton/kept_states.hpp"

#include <cmath>

#include "scabo/contact/constants.hpp"
#include "scabo/contact/kkt/newton_direction.hpp"

namespace scabo::contact {

namespace {

/// The state of pair `i` that its forces tell, and H on that branch in place of that on the branch of `at`. Whether
/// these branches differ.
bool keep_state(const BDifferentiableEquations& equations, Eigen::Index i, const Vector& p, double small,
                Residual& at) {
  const Problem& problem = equations.problem();
  const Eigen::Index d = problem.dimension, n = d * i;
  const auto p_t = p.segment(n + 1, d - 1);
  const double p_n = p[n], strength = p_n + problem.tension_of(i), friction = p_t.norm();
  const Vector& r = equations.r();
  Branch branch;
  branch.contact = std::isinf(strength) || strength > small;
  at.H[n] = branch.contact ? r[n] * at.motion[n] : strength;
  const double bound = problem.friction_bound(i, p_n, p_t[0]);
  if (!(bound > small)) {
    branch.tangent = Branch::Tangent::free;
    at.H.segment(n + 1, d - 1) = p_t;
  } else if (friction < (1.0 - newton_constants.at_bound) * bound) {
    branch.tangent = Branch::Tangent::stick;
    at.H.segment(n + 1, d - 1) = r[n + 1] * at.motion.segment(n + 1, d - 1);
  } else {
    branch.tangent = Branch::Tangent::slip;
    branch.along = d == 2 ? Vec2(std::copysign(1.0, p_t[0]), 0.0) : Vec2(p_t / friction);
    branch.slope = p_n > 0.0 ? problem.mu_against(i, p_t[0]) : 0.0;
    branch.lambda = d == 2 ? bound / friction : 0.0;
    at.H.segment(n + 1, d - 1) = p_t - bound * branch.along.head(d - 1);
  }
  Branch& seeming = at.branches[static_cast<std::size_t>(i)];
  const bool differ = seeming.contact != branch.contact || seeming.tangent != branch.tangent;
  seeming = branch;
  return differ;
}

}  // namespace

std::optional<Point> with_states_kept(const BDifferentiableEquations& equations, const Point& from) {
  const Problem& problem = equations.problem();
  const double largest = from.p.size() > 0 ? from.p.lpNorm<Eigen::Infinity>() : 0.0;
  if (!(largest > 0.0)) return std::nullopt;
  Residual at = equations.residual(from.p, from.a);
  const double before = at.merit();
  int changes = 0;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i)
    changes += keep_state(equations, i, from.p, newton_constants.no_force * largest, at) ? 1 : 0;
  if (newton_constants.few * changes <= problem.pairs()) return std::nullopt;
  Vector d;
  if (!NewtonDirection(equations).find(at, 0.0, d)) return std::nullopt;
  Point kept{from.p + d.head(from.p.size()), from.a + d.tail(from.a.size())};
  if (!(equations.residual(kept.p, kept.a).merit() < before)) return std::nullopt;
  return kept;
}

std::optional<Point> with_undecided_stuck(const BDifferentiableEquations& equations, const Point& from) {
  const Eigen::Index n = from.p.size();
  Residual at = equations.residual(from.p, from.a);
  if (newton_constants.few * equations.stick_below(newton_constants.undecided_below * at.largest(), from.p, at) <=
      equations.problem().pairs())
    return std::nullopt;
  Vector d;
  if (!NewtonDirection(equations).find(at, 0.0, d)) return std::nullopt;
  return Point{from.p + d.head(n), from.a + d.tail(from.a.size())};
}

}  // namespace scabo::contact
