// Stiffness of many small super-elements: several at once in vector registers, on all cores.
//
// A mesh of polygons has thousands of super-elements of 8 to 64 degrees of freedom. One at a time, LAPACK and BLAS
// spend their time on starting: their loops are shorter than a register. Here each lane of the registers holds another
// super-element (batch_kernel.hpp); the method is that of stiffness.hpp, without symmetry blocks. Super-elements of
// equal shape (the same boundary elements over the same node numbers) go together, in any order of input.
//
// What does not fit is solved one at a time by solve_super_element: more than 64 or fewer than 6 degrees of freedom,
// sectors whose stiffness differs more than a thousandfold (exact_riccati.hpp), and any lane whose stiffness does not
// leave the rotation free of force to `largest_residual`. That residual sees every step: a ring that is not positive
// definite, doubling that has not ended, lost digits.
#pragma once

#include <span>
#include <vector>

#include "scabo/element/coefficient_matrices.hpp"

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
  const BatchKernel* kernel = nullptr;  ///< null: the fastest that this processor runs
};

struct BatchSolution {
  std::vector<Matrix> K;  // one for each item, n x n, symmetric
  int alone = 0;          ///< number of items that went to solve_super_element
};

/// Throws what solve_super_element throws for an item that cannot be solved.
BatchSolution solve_batch(std::span<const BatchItem> items, const BatchOptions& options = {});

}  // namespace scabo::element
