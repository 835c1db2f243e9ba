#include "scabo/contact/newton/undecided_pairs.hpp"

#include "scabo/contact/kkt/newton_direction.hpp"

namespace scabo::contact {

namespace {

/// Times |H|: forces and motions below it are undecided. At crack tips 10 and 100 do as well, with 1 Newton's method
/// finds none.
constexpr double undecided = 30.0;
/// Of so many pairs not more than one is undecided: Newton's method finds its state itself.
constexpr int few = 10;

}  // namespace

std::optional<Point> with_undecided_stuck(const BDifferentiableEquations& equations, const Point& from) {
  const Eigen::Index n = from.p.size();
  Residual at = equations.residual(from.p, from.a);
  if (few * equations.stick_below(undecided * at.largest(), from.p, at) <= equations.problem().pairs())
    return std::nullopt;
  Vector d;
  if (!NewtonDirection(equations).find(at, 0.0, d)) return std::nullopt;
  return Point{from.p + d.head(n), from.a + d.tail(from.a.size())};
}

}  // namespace scabo::contact
