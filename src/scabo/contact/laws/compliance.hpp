// How far a pair gives way under a force of its own, whatever holds the bodies.
//
// W of a body that contact alone holds is that of the body held in a few points, which may be any: W + G X + X' G'
// gives the same motions beyond rigid ones. What does not depend on them is the motion under forces in balance,
//
//     W_kk free of it = v' W v,      v = e_k - G (G'G)^-1 G' e_k
//
// a unit force at component k and the smallest forces of all pairs that balance it. A symmetric model has symmetric
// values, and a model that is turned, or whose bodies have another order, has the same ones.
#pragma once

#include <map>
#include <memory>

#include "scabo/contact/problem.hpp"

namespace scabo::linalg {
class SymmetricPositiveSolver;
}

namespace scabo::contact {

class Compliance {
 public:
  /// Keeps a reference to the problem: its W and G must stay.
  explicit Compliance(const Problem& problem);
  ~Compliance();

  const Vector& diagonal() const { return diagonal_; }  ///< of W, dN
  /// v' W v of component k, computed when it is first asked for.
  double of(Eigen::Index k);

 private:
  double in_balance(Eigen::Index k);
  void factorise();

  const Problem& problem_;
  Vector diagonal_;
  std::unique_ptr<linalg::SymmetricPositiveSolver> rigid_;  // of G'G, columns of length 1
  Vector length_;                                           // of the columns of G
  Matrix of_motions_, between_motions_;                     // W G and G'W G, where W is not sparse
  std::map<Eigen::Index, double> known_;
};

}  // namespace scabo::contact
