// Saddle systems (saddle_system.hpp) where all bodies are rigid: W = Y'Y, with few rows of Y for each body, so that a
// system of the bodies' motions replaces that of the forces, of which there are several for each body.
//
//     [ D + L'Y'Y C   L'G ] [ z ]   [ b ]        V = [Y; G'], w = Y C z
//     [ G'C           -E  ] [ a ] = [ g ]        ([1; E] + V C D^-1 L'V') [w; a] = V C D^-1 b - [0; g]
//
// and z = D^-1 (b - L'V' [w; a]), D positive. The pattern is that of all pairs, whatever unknowns they have. z loses
// the digits by which 1 / D exceeds W: it preconditions GMRES, and interior points, whose D falls to 0, go by the
// joints.
#pragma once

#include <vector>

#include "scabo/contact/kkt/rigid_system.hpp"

namespace scabo::contact {

class MotionSystem : public RigidSystem {
 public:
  /// Whether the bodies of a problem are known to be rigid, and have fewer motions than pairs have forces.
  static bool is_of(const Problem& problem);

  explicit MotionSystem(const Problem& problem);

  bool factorise(const SaddleRows& rows, const Vector& D) override;
  void solve(const Vector& b, Vector& x) const override;

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
