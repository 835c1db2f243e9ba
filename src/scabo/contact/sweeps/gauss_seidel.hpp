// Nonsmooth Gauss-Seidel: pair by pair, the exact solution of the problem of one pair (Jourdan, Alart, Jean, Comput.
// Methods Appl. Mech. Engrg. 155 (1998) 31). Convergence is at best linear. It is the iteration
// that long_sweeps.hpp accelerates.
#pragma once

#include <memory>
#include <random>
#include <vector>

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

/// Sweeps over the pairs of a problem without rigid motions (m = 0).
class GaussSeidel {
 public:
  virtual ~GaussSeidel() = default;
  /// Computes the motion q + W p anew: for a start, and when rounding has accumulated.
  virtual void start(const Vector& p) = 0;
  /// Draws the order of the sweeps that follow.
  virtual void reorder(std::minstd_rand& random) = 0;
  /// Performs one sweep and returns the largest change of a force component.
  virtual double sweep(Vector& p) = 0;
  /// Operations of a sweep, of those of one over single pairs.
  virtual double part_of_work() const { return 1.0; }
};

/// By the joints of rigid bodies where there are any (kkt/joints.hpp), whose search costs as much as some tens of
/// sweeps; else, or where `joints` is false, by single pairs: a condensed W is formed. The problem must outlive it.
std::unique_ptr<GaussSeidel> gauss_seidel(const Problem& problem, bool joints = true);

}  // namespace scabo::contact
