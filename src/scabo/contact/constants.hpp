// Every constant of the stages of the contact solver, with the reason for its value. None has a unit: W is scaled so
// that W_ii is 1 in the mean (search.hpp), so that motions are forces, and forces are compared with the largest one.
#pragma once

#include "scabo/base/types.hpp"

namespace scabo::contact {

struct GmresOptions {
  double tolerance = 1e-11;  ///< bound of the residual relative to b
  int restart = 80;          ///< number of vectors kept
  int iterations = 400;      ///< total number of products with A
};

/// Before the stages (neutral_motions.hpp).
struct NeutralConstants {
  double no_friction = 1e-12;  ///< coefficients up to it hold less than the tolerance of any balance
  double balanced = 1e-10;     ///< of the loads: those that drive a neutral motion by less are in balance along it
  double surely_felt = 1e-12;  ///< smallest eigenvalue of G'G, over the largest, far above rounding: none is neutral
};
inline constexpr NeutralConstants neutral_constants;

struct NewtonConstants {
  // The search (newton/newton.hpp).
  int memory = 6;            ///< merits of which the largest must be undercut: single kinks may raise it
  double sufficient = 1e-4;  ///< descent of the merit, of what the direction promises: as is usual
  int halvings = 12;         ///< of a step, most: a shorter one leads nowhere
  int unchecked = 8;         ///< whole steps that did not pass the search, most: a step may lead past a kink
  int going_around = 3;      ///< iterations since the merit was halved, after which undecided pairs are settled
  int patience = 16;         ///< iterations without halving |H|: the method creeps from kink to kink
  double part = 0.1;         ///< regularisation over |H| / largest force: it vanishes with |H| and stays the smaller
  double least = 1e-8;       ///< regularisation that rounding of a singular matrix needs
  double most = 1e-2;        ///< regularisation beyond which the direction is no longer Newton's
  double near = 1e3;         ///< of the aim: |H| below it that is not halved any more may be rounding, ...
  double halved = 0.25;      ///< ... halved as a part of the merit, a square
  // Branches (newton/b_differentiable.hpp).
  double tie = 1e-12;       ///< forces that differ by less of their size are equal within rounding
  double smallest = 4e-14;  ///< of the largest force: as small as rounding
  double room = 1e-9;       ///< of a change of forces: branches of a direction differ by more, or are those of ties
  double no_flexibility = 1e-14;  ///< of the mean W_ii: r of a component that nothing moves is that of the mean
  // Pairs whose states a point does not tell (newton/kept_states.hpp).
  double undecided_below = 30.0;  ///< times |H|, of forces and motions: 10 and 100 do as well, with 1 there are none
  int few = 10;  ///< a change of one of so many pairs is left to Newton's method itself, which finds it
  // The states of the last increment (newton/kept_states.hpp).
  double no_force = 1e-13;  ///< of the largest: what rounding leaves
  double at_bound = 1e-10;  ///< of the bound of friction: closer to it a pair slips
  // The bonded start (newton/bonded_start.hpp).
  double softness = 1e-3;      ///< of bonds, over W_ii: it shares forces among redundant pairs and hardly moves bodies
  double free_motion = 1e-6;   ///< stiffness against motions that bonds do not hold, where there are any
  double bond_balance = 1e-4;  ///< of the largest force: the start only has to be near equilibrium
  // Coarser problems (newton/coarse_start.hpp).
  int least_pairs = 48;      ///< below which a coarser problem saves nothing
  int of_held = 3;           ///< iterations: what is wrong with a held body is soon put right on more pairs
  int of_floating = 10;      ///< iterations: what is wrong with a floating one stays wrong on more pairs
  double coarse_aim = 5e-2;  ///< of the largest force: the pairs of the finer problem are others
};
inline constexpr NewtonConstants newton_constants;

/// Systems of Newton's method (kkt/newton_direction.hpp). Numbers of unknowns are those from which another way
/// is faster.
struct SystemConstants {
  int rounds_of_ties = 8;               ///< branches of ties that have not settled by then do not
  int motions_of_one_body = 3;          ///< of more bodies pairs are redundant, and ties are released
  double met = 1e-14;                   ///< of |H|: an equation of a component that nothing moves
  double no_lambda = 1e-14;             ///< of a sliding pair: its row across the slip is its force alone
  Eigen::Index least_sparse = 120;      ///< unknowns of sparse LU
  Eigen::Index least_of_line = 1200;    ///< unknowns of the preconditioner by halves of joints
  Eigen::Index least_of_single = 2500;  ///< unknowns of a factor in single precision, ...
  Eigen::Index most_of_single = 24000;  ///< ... which then takes 2.3 GB
  Eigen::Index most_of_dense = 8000;    ///< unknowns of a dense LU of W itself; GMRES takes hundreds of products
  Eigen::Index most_of_formed = 2500;   ///< unknowns of a dense LU of a W that is formed first
  double joining = 10.0;  ///< so many times the operations of a sparse factor: its order and iterations are not counted
  int many_motions = 60;  ///< with `many_pairs`: of walls in which some pairs are always redundant
  int many_pairs = 1000;
  double least_of_dense = 1e-15;    ///< reciprocal condition: beside soft springs a regular matrix has 1e-13 and less
  double least_of_sparse = 1e-13;   ///< the same as sparse LU estimates it, without equilibration
  double least_of_raised = 1e-16;   ///< of a preconditioner
  double least_of_balance = 1e-13;  ///< of the balance of rigid motions: less are held by too few pairs
  double exact = 1e-9;              ///< residual, of the right-hand side, up to which a direction solves its equations
  double descending = 0.5;          ///< residual up to which it is still one along which the merit falls
  double rounding = 1e-15;          ///< of the terms of a row: what its sum may leave
  Eigen::Index most_orthogonal = 120;  ///< unknowns of an orthogonal decomposition, ten times as expensive as LU, ...
  Eigen::Index most_shortest = 1000;   ///< ... and where the solution by LU is lost in rounding
  double rank = 1e-11;                 ///< of the largest pivot: what is less is no rank
  /// On the diagonal of a matrix that redundant pairs make singular for good, so that its factor preconditions GMRES.
  /// With 1e-6 and less rounding drifts in the null space (walls: 14 to 38 iterations instead of 1 to 5).
  double raise = 1e-4;
  double line_fine = 1e-8;                     ///< of each block of the halves, ...
  double line_coarse = 1e-6;                   ///< ... where ranks are too large: of thousands of pairs
  double as_good_as_double = 1e-11;            ///< residual of a direction that replaces one by LU
  double as_good_as_lu = 1e-8;                 ///< the same where there can be no LU
  GmresOptions singular_gmres{1e-4, 40, 80};   ///< with the raised factor: the next iteration mends what is left
  GmresOptions refining_gmres{1e-13, 40, 80};  ///< a factor in single precision is nearly the inverse
  GmresOptions line_gmres{1e-12, 40, 40};      ///< as is one of halves; without restart
  GmresOptions holding_gmres{1e-12, 60, 120};  ///< joined bodies lack the slopes of friction alone
  GmresOptions pairs_gmres{1e-11, 80, 400};    ///< the weakest preconditioner of all
  // Joints of rigid bodies (kkt/joints.hpp).
  double independent = 1e-10;   ///< of W_ii: what is left of a row that is a pivot of its own
  double equal_within = 1e-12;  ///< of W_ii: largest difference of W and A K A'
  double paying = 0.4;          ///< of the entries of W: more would not save anything
  int most_of_class = 4;        ///< joints whose pairs have the same neighbours: a tower of two blocks has two
};
inline constexpr SystemConstants system_constants;

struct InteriorConstants {
  double starts[3] = {1.0, 0.1, 10.0};  ///< products of the start over those that the loads suggest, tried in turn
  int crossover = 40;                   ///< iterations of Newton's method afterwards: what converges takes fewer
  int crossover_patience = 4;           ///< NewtonConstants::patience of these, which begin close to a solution
  Eigen::Index most_dense = 2500;       ///< rows of a dense W; a step then takes two seconds
  int most = 100;                       ///< steps; towers and walls that are solved take 11 to 90
  int patience = 5;   ///< steps without `gain` in the residual or in m: rounding, or steps that collapsed
  double gain = 0.9;  ///< of the least so far
  // A step (interior/interior_steps.hpp).
  double part = 0.95;           ///< of the way to the boundary of the cones; nearly whole where m is small
  double collapsed = 0.1;       ///< a step shorter than this is replaced by one that leads back to the middle, ...
  double centring = 0.8;        ///< ... with this sigma and no correction
  double distance_lag = 10.0;   ///< what lacks in the equations may fall so many times more slowly than m; ...
  double lagging = 0.9;         ///< ... beyond it sigma is at least this: y must not vanish before the motions come
  double settled = 1e-13;       ///< of the loads: what lacks less is rounding
  double least_of_mean = 1e-6;  ///< of the mean W_ii: least by which a pair is scaled; what is held does not give way
  double held = 1e-12;          ///< in D and E, over W_ii = 1: holds what nothing determines
  double no_friction = 1e-12;   ///< coefficients up to it are 0: their cone would have no inside
};
inline constexpr InteriorConstants interior_constants;

/// Rounds with slips held (interior/held_slips.hpp).
struct HeldConstants {
  int rounds = 60;             ///< most since the slips' distance was halved: they wander
  double first_aim = 1e-5;     ///< natural map after which the point is first crossed over
  double next_aim = 0.1;       ///< how much it falls between two crossings
  double aim = 1e-3;           ///< of the square of the slips' change: m at which a round ends
  double least = 1e-22;        ///< of the mean square of the loads: m that rounding leaves
  double met = 1e-2;           ///< of the slips' change: distance at which a round ends
  double start = 1e2;          ///< of the square of the slips' change: m at which a round starts
  double sticking = 3.0;       ///< times sqrt(m), to which slips are known: those below it are 0
  int most = 60;               ///< steps of a round, which is a convex problem
  std::size_t remembered = 3;  ///< changes of the extrapolation: more are nearly dependent
  double fall = 0.7;           ///< of the slips' distance in `rounds_of_way` rounds; otherwise another way
  int rounds_of_way = 30;      ///< after which another way is tried
};
inline constexpr HeldConstants held_constants;

struct SweepConstants {
  int most = 80000;                 ///< sweeps of either kind, with or without extrapolation
  Eigen::Index most_formed = 5000;  ///< rows of a W that would have to be formed
  int round = 20;                   ///< sweeps between two extrapolations: what they do not damp are few slow modes
  std::size_t depth = 8;            ///< changes remembered
  double part_of_joints = 0.1;      ///< work of a sweep over joints, of one over pairs
  int patience = 10000;             ///< sweeps without halving the natural map: they go around
};
inline constexpr SweepConstants sweep_constants;

}  // namespace scabo::contact
