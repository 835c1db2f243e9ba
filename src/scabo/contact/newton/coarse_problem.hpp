// A plane contact problem with half as many pairs: neighbouring pairs share one force and their mean motion.
//
// A force p_c of a group is distributed in equal shares s_i (1, or 1/2 for two) to its members, p = P p_c. Galerkin's
// method gives
//
//     W_c = P' W P     q_c = P' q     G_c = P' G     f_c = f                          P'P diagonal, sum_i s_i = 1
//
// W_c is symmetric and positive semidefinite if W is, the motion of a group is the mean of those of its members, and
// G_c' p_c + f = G' p + f: the balance of the rigid motions and their a are those of the fine problem. The law of a
// group is that of its weakest member,
//
//     mu_c = min mu_i     c_c = min c_i / s_i     c_t,c = min c_t,i / s_i,
//
// so that P p_c satisfies the law of every pair if p_c satisfies that of every group.
//
// Groups: each pair forms a group with that free pair with which it is most strongly coupled, by the measure
//
//     kappa_ij = (W_nn)_ij / sqrt((W_nn)_ii (W_nn)_jj),
//
// if this is at least half of its strongest coupling; bonded pairs (infinite tension) are grouped only with bonded
// pairs. A pair without such a neighbour remains single.
#pragma once

#include <vector>

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

struct CoarseProblem {
  Problem problem;
  std::vector<int> group;  // N: group of each fine pair
  Vector share;            // N: share of the force of the group

  /// p = P p_c.
  Vector prolong(const Vector& p_coarse) const;
};

/// W must be dense and d = 2.
CoarseProblem coarse_problem(const Problem& problem);

}  // namespace scabo::contact
