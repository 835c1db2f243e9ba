// Nonsmooth Gauss-Seidel: pair by pair, the exact solution of the local problem. Slow and hard to stop: a start for
// Newton where Newton's own fail (Jourdan, Alart, Jean, Comput. Methods Appl. Mech. Engrg. 155 (1998) 31).
#pragma once

#include <Eigen/SparseCore>

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

/// Force of one pair, [normal, tangents], whose motion is free + W p, for its own part of W (d x d): open, stick, or slip
/// at the bound. In space slip is u_t = -s p_t with s > 0 from one equation, bracketed and found by regula falsi.
Vector local_force(const Matrix& W, const Vector& free, double mu, double cohesion = 0.0, double tension = 0.0);

/// Sweeps over the pairs of a problem without rigid motions (m = 0), dense or sparse.
class GaussSeidel {
 public:
  explicit GaussSeidel(const Problem& problem);
  /// One sweep on the forces p: the largest change of a force component.
  double sweep(Vector& p);
  /// Recomputes the motions of p from scratch; for a start, and where rounding has piled up.
  void start(const Vector& p);
  const Vector& motion() const { return motion_; }

 private:
  const Problem& problem_;
  Matrix blocks_;
  Vector motion_;
};

/// Forces after `sweeps` sweeps from `p`, or fewer where they stop changing.
Vector gauss_seidel(const Problem& problem, Vector p, int sweeps);

}  // namespace scabo::contact
