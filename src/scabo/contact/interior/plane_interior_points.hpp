// Interior points for the laws of the plane, above all Coulomb's, as a linear complementarity problem: for bodies that
// contact alone holds, from forces that are known roughly.
//
// Slip is divided into forward and backward, u_t = v+ - v-, and friction has what it may grow by in either direction:
//
//     u = q + W p + G a,   G' p + f = 0
//     p_n u_n = m,   (mu p_n + p_t) v+ = m,   (mu p_n - p_t) v- = m,   all factors > 0,   m -> 0
//
// The equations are linear but for the three products, and with u_n, v+ and v- eliminated the matrix of a step is
// [W + D, G; G' 0], D of 2 x 2 blocks of the pairs:
//
//     D_nn = u_n / p_n,   D_tt = v+ / s+ + v- / s-,   D_tn = mu (v+ / s+ - v- / s-),   s+- = mu p_n +- p_t
//
// With cohesion c, tensile strength c_t and coefficients mu_f, mu_b by direction the first product is (p_n + c_t) u_n,
// and s+ = c + mu_f (p_n)+ + p_t, s- = c + mu_b (p_n)+ - p_t, with (p_n)+ rounded off at zero where c_t > 0.
//
// The six factors of a pair are kept apart from p_n, s+- and the motions they stand for. A step would end where the
// first of some ten thousand comes to its boundary; if a few stay behind, the others go further, and what then lacks in
// the equations of those few, p_n = x_n and so on, is taken by the next step. Where a step is short all the same, all
// factors are divided anew from the forces and motions reached, with equal products.
//
// In contact/interior_point, for space, the same law is one of cones, y = (u_n + |u_t|, u_t): its path has a kink
// wherever the friction of a pair changes its sign.
#pragma once

#include "scabo/contact/deadline.hpp"
#include "scabo/contact/interior/interior_point.hpp"

namespace scabo::contact {

/// A plane problem with W sparse, or dense with at most 2,500 rows; any law of the pairs.
bool may_take_plane_interior_points(const Problem& problem);

/// Steps that are too short to go on with, near the solution and where its states are not yet known; 0: none is.
struct ShortSteps {
  double near = 0.0, far = 0.0;
};

class PlaneInteriorPoints {
 public:
  /// From forces p, in the cones or not, and motions a of the rigid bodies, W_ii being 1 in the mean. Where p_n - r u_n
  /// is tension it becomes a gap, and what friction cannot carry a slip: x - y = p_n - r u_n, x y = r m, p_n = x and r
  /// u_n = y, m being `start` times what is usual, 12 times the square of the mean friction bound, and alike with
  /// friction.
  PlaneInteriorPoints(const Problem& problem, const Vector& p, const Vector& a, double start);
  ~PlaneInteriorPoints();

  /// Steps until the root of the mean square of H, over the largest force, is not above `aim` after a step that was
  /// nearly whole, or until they no longer lead on; or, after the first few, until one is shorter than `shorter` says,
  /// or the residual of six steps is still large. `residual` is that figure.
  InteriorPointEnd advance(double aim, const IsSolution& content, const Deadline& deadline,
                           const ShortSteps& shorter = {});

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace scabo::contact
