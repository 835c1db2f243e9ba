// Memory and time that an analysis will need, estimated from its mesh before anything is solved.
//
// n degrees of freedom of a body, N pairs, steps of the analysis and what they cost:
//
//     one super-element        dense_bytes n^2, dense_seconds n^3                       (ring doubling and modes)
//     many cells               cell_bytes of fields and stiffness for each, cell_seconds for each
//     factor of a sparse body  fill n log2(n) numbers; factor_seconds n^1.5            (nested dissection in the plane)
//     condensation             2N right-hand sides, each through the factor
//     contact                  dense matrices of 2N rows and columns, contact_seconds (2N)^3 for each increment
//
// Estimates within a factor of two are enough for a decision (benchmarks/README.md: estimates and measurements).
#pragma once

#include <optional>
#include <string>

#include "scabo/mesh/mesh.hpp"
#include "scabo/model/model.hpp"
#include "sizes.hpp"

namespace scabo::app {

/// Measured on one thread of a Xeon with AVX-512 (family 6, model 207), 2026.
struct CostConstants {
  double base_bytes = 25e6;           ///< of the program itself
  double dense_bytes = 96.0;          ///< for n^2 of a super-element: twelve matrices
  double dense_seconds = 1.5e-9;      ///< for n^3 of a super-element
  double sparse_bytes = 3000.0;       ///< for each degree of freedom of a sparse body: mesh, cells, fields, text of results
  double fill_bytes = 120.0;          ///< for n log2(n): factor and its copies
  double factor_seconds = 2e-8;       ///< for n^1.5
  double cell_seconds = 2e-5;         ///< for each degree of freedom of a sparse body: cells and assembly
  double solve_seconds = 1e-8;        ///< for n log2(n) and one right-hand side
  double contact_bytes = 50.0;        ///< for (2N)^2: W and matrices of Newton's method
  double contact_seconds = 3e-9;      ///< for (2N)^3 and one increment
  double write_seconds = 2e-5;        ///< for each degree of freedom and increment with fields
};

struct Plan {
  Sizes sizes;
  int increments = 1;
  bool first_mesh_only = false;  ///< refinement makes finer ones, which are not known yet
  double bytes = 0.0;
  double mesh = 0.0, cells = 0.0, factorise = 0.0, condense = 0.0, contact = 0.0, fields = 0.0;  ///< seconds
  double seconds() const { return mesh + cells + factorise + condense + contact + fields; }
};
Plan plan_of(const model::Model& model, const mesh::Mesh& mesh, const CostConstants& costs = {});

/// `less than a second`, `40 s`, `12 min`, `3.5 h`.
std::string duration_text(double seconds);

/// Whether it takes more than a minute or 2 GB.
bool is_long(const Plan& plan);

/// One line; of long analyses also the time of every stage.
std::string describe(const Plan& plan);

/// Bytes that this process can still take: of the machine, of its control group (containers), of `ulimit -v`.
struct Memory {
  double bytes = 0.0;
  std::string limit;  ///< `this machine`, `the limit of the container`, `ulimit -v`
};
std::optional<Memory> available_memory();

/// Why the analysis does not fit, with a remedy; empty if it does.
std::string why_it_does_not_fit(const Plan& plan, const std::optional<Memory>& available);

}  // namespace scabo::app
