// A plane contact problem with half as many pairs: neighbours share one force and move as their mean.
//
// A force p_c of a group goes in equal shares s_i (1, or 1/2 of two) to its members, p = P p_c. Galerkin:
//
//     W_c = P' W P     q_c = P' q     G_c = P' G     f_c = f                          P'P diagonal, sum_i s_i = 1
//
// W_c is symmetric and positive semidefinite with W, the motion of a group is the mean of its members', and
// G_c' p_c + f = G' p + f: the balance of the rigid motions and their a are those of the fine problem. The law of a
// group is that of its weakest member,
//
//     mu_c = min mu_i     c_c = min c_i / s_i     c_t,c = min c_t,i / s_i,
//
// so that P p_c lies within the law of every pair where p_c lies within that of every group.
//
// Groups: each pair with the pair not yet taken that it couples with most,
// kappa_ij = (W_nn)_ij / sqrt((W_nn)_ii (W_nn)_jj), where that is at least half of its strongest coupling; bonded pairs
// (infinite tension) with bonded ones only. A pair without such a neighbour stays single.
#pragma once

#include <vector>

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

struct CoarseProblem {
  Problem problem;
  std::vector<int> group;  // N: of each fine pair
  Vector share;            // N: of the group's force

  /// p = P p_c.
  Vector prolong(const Vector& p_coarse) const;
};

/// W must be dense and d = 2.
CoarseProblem coarse_problem(const Problem& problem);

}  // namespace scabo::contact
