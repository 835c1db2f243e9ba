// Discrete contact problems for tests, and a judge of their solutions that shares nothing with the solver.
#pragma once

#include <algorithm>
#include <cmath>

#include "scabo/contact/solve.hpp"
#include "support/random.hpp"

namespace scabo::test {

/// A flexibility as elastic bodies have it: positive definite, decaying with distance along the interface,
/// normal and tangent coupled.
Matrix elastic_flexibility(std::mt19937& random, int pairs, double size = 1.0, int d = 2);

/// Motions without contact forces: of mixed signs, some of them ties.
Vector mixed_motion(std::mt19937& random, int pairs, double size = 1.0, int d = 2);

contact::Problem held_problem(std::mt19937& random, int pairs, double most_friction, int d = 2);

/// A block on a floor, A the floor: n = +y, t = +x. Pairs along its base, equally spaced over `width`;
/// reference point at its middle, `height` above the base. Rigid motions [u_x, u_y, L rotation] with L =
/// width / 2, loads the works of [force_x, force_y, moment / L].
Matrix block_motions(int pairs, double width, double height);

/// The same as held_problem with a floating block of m = 1 (down), 2 (down, along), 3 rigid motions, pressed
/// down.
contact::Problem floating_problem(std::mt19937& random, int pairs, double most_friction);

/// Forces of plain Gauss-Seidel, pair by pair from none, after `sweeps` sweeps or fewer if they no longer change.
Vector swept_forces(const contact::Problem& problem, int sweeps);

/// Largest violation of Signorini's and Coulomb's conditions and of the balance of rigid motions, written out
/// case by case, with W scaled so that its diagonal is about 1.
double violation(const contact::Problem& problem, const Vector& p, const Vector& a);

}  // namespace scabo::test
