// A plane contact problem of some of the pairs, where W is not formed (system/joined_bodies.hpp): every g-th pair of a
// joint touches, and its force stands for those of its neighbours.
//
//     W_c = W_ss     q_c = q_s     G_c = G_s     f_c = f                     s: the sampled pairs
//
// What lies between two sampled pairs bends a little more than under a force that is spread; further away the
// difference is small. Forces are spread again in proportion to hat functions phi_j over the pairs of a joint,
//
//     p_i = sum_j phi_j(i) p_cj / sum_k phi_j(k),
//
// which keeps the force of each sampled pair, and with it the balance of forces. Motions do not agree with them: a
// force that is spread leaves less of a dent. What is reliable is whether a pair is open, sticks or slips.
#pragma once

#include <optional>
#include <vector>

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

struct SampledProblem {
  Problem problem;          // N_c pairs, W dense
  std::vector<int> pairs;   // N_c, ascending: those sampled
  std::vector<int> before;  // N: the place among them of the last one not after the pair, on its joint; else the next
  std::vector<double> weight;  // N: phi of that one; 1 - weight is that of the one after it
  Vector sum;                  // N_c, of phi

  /// Of forces.
  Vector spread(const Vector& p_sampled) const;
  /// The place among the sampled pairs of the one nearest to pair `i`.
  int nearest(Eigen::Index i) const {
    return before[static_cast<std::size_t>(i)] + (weight[static_cast<std::size_t>(i)] < 0.5 ? 1 : 0);
  }
};

/// About `most` pairs or fewer. Nothing where W has no holder that knows joints and their flexibility, or there are not
/// several times as many pairs. d = 2.
std::optional<SampledProblem> sampled_problem(const Problem& problem, int most);

}  // namespace scabo::contact
