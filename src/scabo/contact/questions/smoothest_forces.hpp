// The smoothest of contact forces that are not unique although all motions are.
//
// Forces dp of the pairs that change no force on any body, A dp = 0 (A: forces on the points of bodies and resultants
// of rigid bodies by the forces of the pairs), move nothing: bodies that meet in a point may pass any force around it.
// Of all forces that the laws admit for the motions of a solution,
//
//     open         none                                 slip     p_n >= 0,  p_t = -+ (c + mu p_n)
//     stick, touch p_n >= 0,  |p_t| <= c + mu p_n       bonded   any
//     open, with a shear strength and without slip      p_n = 0,  |p_t| <= c
//     with tensile strength T: p_n >= -T, |p_t| <= c, or p_n >= 0, |p_t| <= c + mu p_n: not convex, so that the least
//     sum is looked for in the convex hull first, and a force that is in neither part then goes to the nearer one
//
// those are chosen whose tractions p / a are nearest to those of one stress s in each point x that several of these
// pairs share, and next to that the shortest ones (a: tributary area of the pair, n: its normal, E = 1e-10):
//
//     min over p and s   sum_x sum_i a_i |p_i / a_i + s_x n_i|^2  +  E sum_i a_i |p_i / a_i|^2                     (1)
//
// A stress that is continuous in the point is found exactly, however many bodies meet there under whatever angles: a
// body that is cut into pieces which stick to each other has the pressures of the whole one. The shortest forces alone
// would do so only where the normals around the point add up to nothing, not where a joint ends on another one. Where
// no two pairs share a point (a rigid body on more points than it needs), (1) gives the shortest tractions, those of a
// linear distribution. (1) has no unit, and does not depend on the mesh beyond what pairs there are.
//
// The pairs are divided into groups that A connects; most pairs belong to none, because their force is all that acts on
// a point of a body. A group is as large as a meeting point, or as a body that is rigid and all its pairs.
#pragma once

#include <vector>

#include "scabo/contact/certificate.hpp"
#include "scabo/contact/solution.hpp"

namespace scabo::contact {

/// Where the forces of the pairs act, and how they are counted.
struct ActionOfPairs {
  Eigen::SparseMatrix<double> on_bodies;  ///< A, rows x 2N: without what supports take; its rows stand in blocks
  std::vector<int> first_row;  ///< of every block: the rows of a point of an elastic body, or of a rigid body
  std::vector<char> is_point;  ///< of every block
  std::vector<Vec2> normal;    ///< N, out of A
  Vector area;                 ///< N, length^2, > 0: tributary length times thickness
};

struct SmoothestForces {
  Vector p;         ///< 2N; those of the solution, to the bit, where they are unique or as smooth already
  int changed = 0;  ///< pairs whose forces differ from those of the solution
  int left = 0;     ///< pairs in groups so large that their forces were left as they are
};

/// For a solved problem in the plane; `scales` of its certificate. No motion changes beyond rounding.
SmoothestForces smoothest_forces(const Problem& problem, const Solution& solution, const ActionOfPairs& action,
                                 const Scales& scales);

}  // namespace scabo::contact
