// The three stages of a solve and its last resort, in their order. Each ends with what it found and says why it stopped
// (docs/methods/12_contact_solver.md).
#pragma once

#include "scabo/contact/search.hpp"

namespace scabo::contact {

/// 1. Newton's method on the B-differentiable equations: from the last increment, from a coarser problem, from
/// bonded pairs where contact alone holds bodies, or from zero.
StageEnd newton_stage(Search& search);

/// 2. Interior points from three starts, each with Newton's method after it.
StageEnd interior_stage(Search& search);

/// 3. Sweeps of nonsmooth Gauss-Seidel, accelerated, with Newton's method after them: for a W that is rank deficient.
StageEnd sweeps_stage(Search& search);

/// The last resort: interior points with slips held, as a fixed point. A round costs a thousand sweeps.
StageEnd held_slips_stage(Search& search);

}  // namespace scabo::contact
