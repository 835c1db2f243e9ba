// Memory and time that an analysis will need, estimated from its mesh before anything is solved.
//
// For a body of n degrees of freedom, b symmetry blocks, k components of its contacts, N pairs in all:
//
//     one super-element   (8 + block_bytes / b) n^2 bytes; dense_seconds n^3 / b^2 for stiffness,
//                         dense_field_seconds n^3 / b^2 for fields, dense_factor_seconds n^3 for its factor;
//                         last_digits_seconds n^3 / b^2 and last_digits_bytes n^2 / b besides where its scaling centre
//                         is near the boundary or its sectors differ much in stiffness
//                         (element/plane/exact_riccati.hpp)
//     many cells          sparse_bytes n; mesh, cells and fields in times proportional to n, of finite elements
//                         shorter ones; more bytes and seconds where no two cells are equal
//     their factor        fill_bytes n log2(n); order_seconds n log2(n) + factor_seconds n^1.5
//                         (nested dissection in the plane); more where no two cells are equal, as cells of many
//                         sides couple more nodes
//     condensation        dense: dense_condense_seconds n^2 k; sparse: sweep_seconds n + condense_seconds k n^0.5 +
//                         flexibility_seconds k^2
//     contact             contact_bytes k^2; contact_seconds (2N)^2 for each increment; of many bodies, eliminated by
//                         nested dissection, wall_bytes 2N k besides and wall_seconds 2N k for each iteration, k
//                         averaged. Where bodies are held by contact alone an increment may besides take
//                         interior_steps of interior points, each interior_seconds (2N)^3 or wall_seconds 2N k: which
//                         ones do is not known before. Rigid bodies take rigid_seconds 2N for each iteration, by
//                         their motions; their interior points go by pairs, as those of others. Of more than 6,000
//                         pairs of few bodies a factor of all bodies, joined_iterations times in an increment
//
// Estimates within a factor of two are enough to decide (benchmarks/README.md compares them with measurements).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scabo/mesh/mesh.hpp"
#include "scabo/model/model.hpp"
#include "scabo/run/sizes.hpp"

namespace scabo::run {

/// Measured on one thread of a Xeon with AVX-512 (family 6, model 207). Bytes, or seconds. `benchmarks/plan.py --fit`
/// finds them from measured runs and writes them here.
struct CostConstants {
  double base_bytes = 25e6;                 ///< of the program itself
  double block_bytes = 88.0;                ///< for n^2 / b of a super-element: eleven matrices of doubling and modes
  double dense_seconds = 1.5e-9;            ///< for n^3 / b^2
  double last_digits_seconds = 1.1e-8;      ///< for n^3 / b^2 of super-elements that get their last digits
  double last_digits_bytes = 140.0;         ///< for n^2 / b of them: nine matrices of long double
  double dense_field_seconds = 1e-9;        ///< for n^3 / b^2
  double dense_factor_seconds = 3.2e-12;    ///< for n^3
  double dense_condense_seconds = 1.5e-11;  ///< for n^2 k
  double least_large_cell = 200.0;          ///< degrees of freedom of a cell that costs as one super-element does
  double sparse_bytes = 1300.0;             ///< for n: mesh, cells, fields and their text
  double own_cell_bytes = 3000.0;           ///< for n of polygons and cells of a file, which are all different
  double own_cell_seconds = 1.5e-6;         ///< for n of them
  double own_mesh_seconds = 1.2e-6;         ///< for n of them besides
  double own_factor_seconds = 1.4e-8;       ///< for n^1.5 of them besides
  double fill_bytes = 150.0;                ///< for n log2(n): the factor and what its computation needs
  double order_seconds = 9.6e-8;            ///< for n log2(n): order of elimination, entries of the factor
  double factor_seconds = 6.1e-9;           ///< for n^1.5: its operations
  double mesh_seconds = 1.1e-6;             ///< for n
  double fem_mesh_seconds = 2.7e-7;         ///< for n of finite elements
  double cell_seconds = 9.6e-7;             ///< for n
  double solve_seconds = 1.8e-8;            ///< for n log2(n) and one right-hand side
  double sweep_seconds = 2.8e-8;            ///< for n: the sweep over the factor that condenses
  double condense_seconds = 3.8e-7;         ///< for k n^0.5
  double flexibility_seconds = 1.4e-9;      ///< for k^2
  double contact_bytes = 50.0;              ///< for k^2 of each body: W and matrices of Newton's method
  double interior_seconds = 1e-10;          ///< for (2N)^3 and one step of interior points of few bodies
  double interior_steps = 60.0;             ///< of an increment in which Newton's method finds nothing: 10 to 100
  double contact_seconds = 6.5e-8;          ///< for (2N)^2 and one increment
  double wall_seconds = 1e-6;               ///< for 2N k of many bodies and one iteration, k of an average body
  double wall_first_iterations = 8.0;       ///< of the first increment: 2 to 10
  double wall_iterations = 6.0;             ///< of each one after it: 4 under small loads, 10 near the collapse load
  double rigid_seconds = 2e-6;              ///< for 2N of rigid bodies and one iteration, by their motions
  double wall_bytes = 300.0;                ///< for 2N k of many bodies: their saddle matrix and its factor
  double joined_iterations = 15.0;          ///< of Newton, each with twice the time of a factorisation
  double field_seconds = 1.8e-6;            ///< for n and one increment with fields
  double fem_field_seconds = 8.5e-7;        ///< for n of finite elements
  double own_field_seconds = 3.2e-6;        ///< for n of polygons and cells of a file besides
};

struct Plan {
  Sizes sizes;
  int increments = 1;
  bool first_mesh_only = false;  ///< refinement makes finer ones, which are not known yet
  double bytes = 0.0;
  double mesh = 0.0, cells = 0.0, factorise = 0.0, condense = 0.0, contact = 0.0, fields = 0.0;  ///< seconds
  double interior = 0.0;  ///< seconds besides, where every increment takes interior points; none, some or all may
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

/// Why the analysis does not fit, with remedies, the last of them `anyway`: how to start it nevertheless. Empty if it
/// fits.
std::string why_it_does_not_fit(const Plan& plan, const std::optional<Memory>& available, std::string_view anyway);

}  // namespace scabo::run
