#include "scabo/contact/newton/undecided_pairs.hpp"

#include "scabo/contact/kkt/newton_direction.hpp"

namespace scabo::contact {

std::optional<Point> with_undecided_stuck(const BDifferentiableEquations& equations, const Point& from) {
  const Eigen::Index n = from.p.size();
  Residual at = equations.residual(from.p, from.a);
  if (undecided_pairs.few * equations.stick_below(undecided_pairs.below * at.largest(), from.p, at) <=
      equations.problem().pairs())
    return std::nullopt;
  Vector d;
  if (!NewtonDirection(equations).find(at, 0.0, d)) return std::nullopt;
  return Point{from.p + d.head(n), from.a + d.tail(from.a.size())};
}

}  // namespace scabo::contact
