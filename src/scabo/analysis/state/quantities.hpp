// Numbers that users ask for by name (model/quantity.hpp): their values, and how they depend on the state.
#pragma once

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// The value in a converged increment with its displacements; nothing if there is none, as for a crack tip whose
/// factors are undefined.
std::optional<double> value_of(const Discretisation& discretisation, const IncrementResult& increment,
                               const model::Quantity& quantity);

/// The same for a number of one contact.
std::optional<double> value_in(const ContactResult& contact, const model::Quantity& quantity);

/// What rounding and the tolerance of the certificate leave uncertain of the number, in its unit: `tolerance` times the
/// largest force, displacement or stress intensity factor of the increment. Zero by symmetry is not found more exactly.
double rounding_of(const Discretisation& discretisation, const IncrementResult& increment,
                   const model::Quantity& quantity, double tolerance);

/// A warning for every column of the history that stays empty, because its tip is of a kind that has other figures.
std::vector<Warning> quantity_warnings(const model::Model& model, const IncrementResult& increment);

/// Throws InputError for points that lie in no body or in several, and for cracks with two tips of which none is named.
void check_quantities(const model::Model& model, const mesh::Mesh& mesh);

/// Linear part J of a number about an accepted state, for small changes of displacements u, contact forces p and nodal
/// forces f:
///
///     dJ = sum over bodies of (c . du + r . df) + c_p . dp                                                       (1)
struct Functional {
  std::vector<Vector> c;  ///< [body]
  std::vector<Vector> r;  ///< [body]; of a reaction, whose force is what the loads and contact forces leave over
  Vector c_p;             ///< 2N
};
Functional derivative_of(const Prepared& prepared, const State& state, const model::Quantity& quantity);

/// Displacements of the dual problem, one vector for each body: the z for which dJ = sum of z . df for all nodal forces
/// df, while every pair keeps its accepted state: open, p = 0; stick, no relative motion; slip, no normal motion and
/// dp_t = +- mu dp_n, with the sign of the accepted force. With p = T y for the forces y that may change, and S y the
/// motions that must not,
///
///     [S'W T  S'G] [y]     [S'B A f]                 [T'W S  T'G]  [w]   [T'(B A c + c_p)]
///     [G'T     0 ] [a] = - [N'f    ],                [G'S     0 ]  [v] = [N'c            ],
///
///     z = A (c - B'S w) - N v + r                                                                               (2)
///
/// A, N: flexibility and rigid motions of the bodies (system/body_system.hpp), B: motion of the pairs. The second
/// matrix is the transpose of the first, which is not symmetric where pairs slip with friction.
std::vector<Vector> dual_displacements(const Prepared& prepared, const State& state, const Functional& functional);

}  // namespace scabo::analysis
