// Stiffness of many small super-elements: several at once in vector registers, on all cores.
//
// A mesh of polygons has thousands of super-elements of 8 to 64 degrees of freedom. If they are solved one at a time,
// LAPACK and BLAS spend most of the time on overhead, because the loops are shorter than a register. Here each lane of
// the registers contains another super-element (batch_kernel.hpp); the method is that of stiffness.hpp without symmetry
// blocks. Super-elements of equal shape (the same boundary elements over the same node numbers) are solved together,
// whatever their order in the input.
//
// The following are left to solve_super_element: super-elements of more than 64 or fewer than 6 degrees of freedom,
// those whose sectors differ in stiffness by more than a factor of 1000 (exact_riccati.hpp), and those whose stiffness
// from a lane does not leave a rotation free of force to within `largest_residual`. That residual shows failures of
// every step: a ring that is not positive definite, doubling that has not converged, loss of precision.
#pragma once

#include <span>
#include <vector>

#include "scabo/element/facet/coefficient_matrices.hpp"

namespace scabo::element {

struct BatchKernel;

/// A super-element of a batch.
struct BatchItem {
  Ring ring;
  Elasticity D;  // force / length^2
  double thickness = 1.0;
};

struct BatchOptions {
  int threads = 1;
  double largest_residual = 1e-12;      ///< |K r| / (|K| |r|), r the rotation
  const BatchKernel* kernel = nullptr;  ///< null: the fastest that this processor can run
};

struct BatchSolution {
  std::vector<Matrix> K;         ///< one for each item, n x n, symmetric; empty for those in `alone`
  std::vector<double> rounding;  ///< one for each item, as SuperElementSolution::rounding
  std::vector<int> alone;        ///< items that solve_super_element must solve, in ascending order
};

BatchSolution solve_batch(std::span<const BatchItem> items, const BatchOptions& options = {});

}  // namespace scabo::element
