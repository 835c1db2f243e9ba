// Stiffness of several super-elements of equal shape at once, one in each lane of the vector registers.
//
// Every value is a vector, whose lane l belongs to super-element l. Arrays are index-major, lane-minor (struct of
// arrays), aligned to 64 bytes. The steps are those of stiffness.hpp without symmetry blocks: eq. (1.6) of the
// coefficient matrices, removal of the translations, ring doubling, and restoration of the translations.
//
// The same source (batch_kernel_lanes.hpp) is compiled once for each instruction set; those that the processor supports
// are determined at run time.
#pragma once

namespace scabo::element {

/// A boundary element: its nodes, and its shape functions at the points of its quadrature rule (column-major, points x
/// count).
struct BatchElement {
  const int* nodes;
  int count, points;
  const double *N, *N_eta, *weights;
};

/// Data common to all lanes.
struct BatchShape {
  int nodes = 0, elements = 0;
  const BatchElement* element = nullptr;
  int elasticities = 1;  ///< 1 for all elements, or one for each
};

/// Data of the super-elements, one per lane.
struct BatchLanes {
  const double* x;          // 2 nodes vectors
  const double* D;          // 6 vectors for each elasticity: D11 D12 D13 D22 D23 D33
  const double* thickness;  // 1 vector
  double* K;                // n (n + 1) / 2 vectors, n = 2 nodes: lower triangle by rows
  double* residual;         // 1 vector: |K r| / (|K| |r|) in the 1-norm, r the rotation; NaN where the solution failed
  double* cancellation;     // 1 vector: largest E2_ii / K_ii
};

struct BatchKernel {
  const char* instructions;  ///< name of the instruction set
  int lanes;
  /// `workspace`: batch_workspace(shape) vectors.
  void (*solve)(const BatchShape& shape, const BatchLanes& lanes, double* workspace);
};

/// Size of the workspace in vectors.
inline long batch_workspace(const BatchShape& shape) {
  const long n = 2 * shape.nodes;
  return 6 * n * n + 5 * n;
}

/// The kernels that this processor can run, the fastest first: a pointer for `rank` 0, 1 ..., then null. There is at
/// least one.
const BatchKernel* batch_kernel(int rank);

}  // namespace scabo::element
