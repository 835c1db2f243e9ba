// Saddle systems (saddle_system.hpp) where all bodies are rigid: W = Y'Y, with few rows of Y for each body, so that a
// system of the bodies' motions replaces that of the forces, of which there are several for each body.
//
//     [ D + L'Y'Y C   L'G ] [ z ]   [ b ]        V = [Y; G'], w = Y C z
//     [ G'C           -E  ] [ a ] = [ g ]        ([1; E] + V C D^-1 L'V') [w; a] = V C D^-1 b - [0; g]
//
// and z = D^-1 (b - L'V' [w; a]), D positive. The motions of two bodies are coupled where a pair lies between them:
// the pattern is that of all pairs, whatever unknowns they have. z loses the digits by which 1 / D exceeds W: it
// preconditions GMRES, and interior points, whose D falls to 0, do without.
#pragma once

#include <vector>

#include "scabo/contact/kkt/saddle_matrix.hpp"

namespace scabo::contact {

class BodySystem {
 public:
  /// Whether the bodies of a problem are known to be rigid, and have fewer motions than pairs have forces.
  static bool is_of(const Problem& problem);

  explicit BodySystem(const Problem& problem);

  /// `D`: in place of that of `rows`, positive. Keeps a reference to `rows`. False where a pivot is zero.
  [[nodiscard]] bool factorise(const SaddleRows& rows, const Vector& D);
  /// x = [z; a] of b = [b; g].
  void solve(const Vector& b, Vector& x) const;

 private:
  Eigen::Index motions_;  // m
  int dimension_;
  Eigen::SparseMatrix<double> V_, matrix_;
  std::vector<std::vector<int>> rows_of_pair_;  // of V
  std::vector<Matrix> V_of_pair_;               // these rows, d columns
  const SaddleRows* rows_ = nullptr;
  Vector D_;
  linalg::SparseGeneralSolver lu_;
};

}  // namespace scabo::contact
