// Steps of interior points for every pair law (problem.hpp), in the plane and in space.
//
// Each pair is divided by the root of its own W_ii, so that forces, motions and products of all pairs are of a size.
// The conditions of the path, m -> 0, for the pairs that have them:
//
//     (p_n + tau) u_n = m                                         x = p_n + tau, y = u_n; bonded: u_n = 0
//     (b, p_t) o (sigma, u_t) = m e,  b = c + mu (p_n)+           X, Y in the cone of tangential_cone.hpp; sigma is
//                                                                 free; infinite c: u_t = 0; b = 0 for all p_n: p_t = 0
//     u = q + W p + G a,  G'p + f = 0
//
// x, y, X and Y are kept apart from the forces and motions they stand for, which a whole step brings together: no
// point need satisfy any of the equations at the start. (p_n)+ is rounded off at zero where there is tensile strength,
// as much as products of size m round off the law.
//
// Step. With the scaling F X = F^-1 Y = l of the cone, H = F^2 and y / x for the half-line, the products linearised are
//
//     dy + (y / x) dx = r_n / x,   dY + H dX = F (l \ R)
//
// The direction e of F has its own row, in which dp_e and dp_n occur: with z_e = dp_e + mu' dp_n as the unknown the
// matrix of all pairs is [W C + D, G; G'C, -E], D diagonal (saddle_system.hpp),
//
//     D_n = y / x,   D_e = (h_1 + h_2) / 2,   mu' = (mu_f h_1 - mu_b h_2) / (h_1 + h_2),   D across e: h_3
//
// h = phi^2; D has a little more, by which forces that move nothing are held (Friedlander and Orban, Math. Program.
// Comput. 4 (2012) 71). What slips or is open has a large D and stands alone in its row. Of the two ways to dx and dy,
// through the product or through the equations of motion, each is taken where it loses no digits. A predictor with r
// for m = 0 comes first, then the corrector for sigma m, sigma = (m reached / m)^3, with the products of the
// predictor's changes (Mehrotra, SIAM J. Optim. 2 (1992) 575).
//
// The problem is not convex. With the slips held it is (held_slips.hpp): then u_n = y + beta.Y - lift, lift the beta.Y
// of slips that are given, which makes the matrix symmetric.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "scabo/contact/interior/tangential_cone.hpp"
#include "scabo/contact/kkt/saddle_system.hpp"

namespace scabo::contact {

template <int d>
class InteriorSteps {
  using Index = Eigen::Index;
  using Cone = TangentialCone<d>;
  using V = typename Cone::V;
  using M = typename Cone::M;
  using T = typename Cone::T;
  using TT = typename Cone::TT;

 public:
  /// What a step changes: forces, rigid motions, factors of the products. Scaled.
  struct Point {
    Vector p, a, x, y, X, Y;
  };

  /// W sparse or dense.
  explicit InteriorSteps(const Problem& problem);
  InteriorSteps(const InteriorSteps&) = delete;  // its system refers to its problem
  InteriorSteps& operator=(const InteriorSteps&) = delete;

  /// All pairs with the same normal force, `factor` times what the loads suggest.
  void start(double factor);
  /// Lifts beta.Y held from now on, one of each pair, instead of none.
  void hold(Vector lifts) { lifts_ = std::move(lifts); }

  void evaluate();
  /// What the steps so far have left is measured by what this iterate has; after evaluate().
  void measure_from_here() { first_gap_ = lacks_.gap, first_distance_ = distance(); }
  /// False where no step exists.
  bool advance();

  const Point& point() const { return at_; }
  void go_to(const Point& point) { at_ = point; }
  double gap() const { return lacks_.gap; }  ///< m
  double distance() const;                   ///< what lacks in the equations
  double step() const { return step_; }      ///< length of the last one
  double size_of_loads() const { return size_of_loads_; }
  Vector lifts() const;  ///< beta.Y of the slips of now
  Vector forces() const { return at_.p.cwiseQuotient(scale_); }
  Vector rigid_motions() const { return at_.a.cwiseProduct(length_); }
  /// Forces whose states are exactly open, stick or slip: p - u brought to the boundary of the law.
  Vector at_the_boundary() const;

 private:
  enum class Tangential { none, equation, cone };
  /// What lacks in the equations.
  struct Lacks {
    Vector u;                    // motions of the forces
    Vector x, y, X, Y, balance;  // Y: dN, of the tangents
    Vector forward, backward;    // mu_f (p_n)+', mu_b (p_n)+'
    double gap = 0.0;
  };
  struct Scaling {
    Vector phi, lambda;  // dN
    std::vector<M> Q;
    std::vector<TT> directions;
  };

  V part(const Vector& v, Index i) const { return v.segment<d>(d * i); }
  T tangents(const Vector& v, Index i) const { return v.segment<d - 1>(d * i + 1); }
  bool opens(Index i) const { return std::isfinite(problem_.tension_of(i)); }
  bool has_cone(Index i) const { return kind_[static_cast<std::size_t>(i)] == Tangential::cone; }

  double balancing_force();
  std::pair<double, double> pressure(Index i, double p_n, double m) const;
  bool scale_pairs();
  void lay_out();
  Point direction(const Vector& of_normals, const Vector& of_cones) const;
  Vector right_side(const Vector& of_normals, const Vector& of_cones) const;
  V cone_right(Index i, const Vector& of_cones) const;
  void complete_normal(Index i, double right, const Vector& du, Point& change) const;
  void complete_cone(Index i, const V& right, const Vector& du, Point& change) const;
  double reach(const Point& change) const;
  double gap_of(const Point& at) const;
  void move(const Point& change, double step, Point& at) const;

  Vector scale_, length_;  // of the pairs' components, of the rigid motions
  Problem problem_;        // scaled
  std::vector<Tangential> kind_;
  std::vector<int> first_;  // unknown of each pair
  int products_ = 0;        // of which m is the mean
  double size_of_loads_ = 0.0;
  SaddleSystem system_;
  SaddleRows rows_;
  Point at_;
  Lacks lacks_;
  Scaling scaling_;
  Vector lifts_;
  double first_gap_ = 0.0, first_distance_ = 0.0, step_ = 0.0;
};

}  // namespace scabo::contact
