#include "scabo/contact/starts/kept_states.hpp"

#include <cmath>

#include "scabo/contact/newton_direction.hpp"

namespace scabo::contact {

namespace {

constexpr double no_force = 1e-13;  // of the largest: what rounding leaves
constexpr double at_bound = 1e-10;  // of the bound of friction
constexpr int few = 10;             // of so many pairs not more than one seems to change: Newton finds them itself

/// The state of pair `i` that its forces tell, and H on that branch in place of that on the branch of `at`. Whether
/// these branches differ.
bool keep_state(const BDifferentiableEquations& equations, Eigen::Index i, const Vector& p, double rounding,
                Residual& at) {
  const Problem& problem = equations.problem();
  const double p_n = p[2 * i], p_t = p[2 * i + 1], strength = p_n + problem.tension_of(i);
  const Vector& r = equations.r();
  Branch branch;
  branch.contact = std::isinf(strength) || strength > rounding;
  at.H[2 * i] = branch.contact ? r[2 * i] * at.motion[2 * i] : strength;
  const double bound = problem.friction_bound(i, p_n, p_t);
  if (!(bound > rounding)) {
    branch.tangent = Branch::Tangent::free;
    at.H[2 * i + 1] = p_t;
  } else if (std::abs(p_t) < (1.0 - at_bound) * bound) {
    branch.tangent = Branch::Tangent::stick;
    at.H[2 * i + 1] = r[2 * i + 1] * at.motion[2 * i + 1];
  } else {
    branch.tangent = Branch::Tangent::slip;
    branch.along = Vec2(std::copysign(1.0, p_t), 0.0);
    branch.slope = p_n > 0.0 ? problem.mu_against(i, p_t) : 0.0;
    branch.lambda = bound / std::abs(p_t);
    at.H[2 * i + 1] = p_t - branch.along[0] * bound;
  }
  Branch& seeming = at.branches[static_cast<std::size_t>(i)];
  const bool differ = seeming.contact != branch.contact || seeming.tangent != branch.tangent;
  seeming = branch;
  return differ;
}

}  // namespace

std::optional<KeptStates> keep_states(const BDifferentiableEquations& equations, const Vector& p, const Vector& a,
                                      Residual at) {
  const Problem& problem = equations.problem();
  const double largest = p.size() > 0 ? p.lpNorm<Eigen::Infinity>() : 0.0;
  if (problem.dimension != 2 || !(largest > 0.0)) return std::nullopt;
  int changes = 0;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i)
    changes += keep_state(equations, i, p, no_force * largest, at) ? 1 : 0;
  if (few * changes <= problem.pairs()) return std::nullopt;
  Vector d;
  NewtonDirection direction(equations);
  if (!direction.find(p, at, 0.0, NewtonDirection::Ties::free, d)) return std::nullopt;
  return KeptStates{p + d.head(p.size()), a + d.tail(a.size())};
}

}  // namespace scabo::contact
