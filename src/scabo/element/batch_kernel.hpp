// Stiffness of several super-elements of equal shape at once, one in each lane of the vector registers.
//
// A value here is a vector: lane l belongs to super-element l. Arrays are index-major, lane-minor (struct of arrays),
// aligned to 64 bytes. The steps are those of stiffness.hpp without symmetry blocks: eq. (1.6) of the coefficient
// matrices, the translations taken out, ring doubling, the translations put back.
//
// The same source (batch_kernel_lanes.hpp) is compiled once for each instruction set; which ones this processor has is
// asked when the program runs.
#pragma once

namespace scabo::element {

/// A boundary element: its nodes, and its basis at the points of its rule (column-major, points x count).
struct BatchElement {
  const int* nodes;
  int count, points;
  const double *N, *N_eta, *weights;
};

/// What all lanes have in common.
struct BatchShape {
  int nodes = 0, elements = 0;
  const BatchElement* element = nullptr;
  int elasticities = 1;  ///< 1 for all elements, or one for each
};

/// One super-element a lane.
struct BatchLanes {
  const double* x;          // 2 nodes vectors
  const double* D;          // 6 vectors for each elasticity: D11 D12 D13 D22 D23 D33
  const double* thickness;  // 1 vector
  double* K;                // n (n + 1) / 2 vectors, n = 2 nodes: lower triangle by rows
  double* residual;  // 1 vector: |K r| / (|K| |r|) in the norm of sums, r the rotation; not a number where it failed
};

struct BatchKernel {
  const char* instructions;  ///< name of the instruction set
  int lanes;
  /// `workspace`: batch_workspace(shape) vectors.
  void (*solve)(const BatchShape& shape, const BatchLanes& lanes, double* workspace);
};

/// Number of vectors of workspace.
inline long batch_workspace(const BatchShape& shape) {
  const long n = 2 * shape.nodes;
  return 6 * n * n + 4 * n;
}

/// The kernels that this processor can run, the fastest first: a pointer for `rank` 0, 1 ..., then null. One at least.
const BatchKernel* batch_kernel(int rank);

}  // namespace scabo::element
