// The frictional contact problem before it is condensed to the pairs (FCLIB's global form):
//
//     M v = f + H r + G l,   0 = G' v + b,   u = H' v + w,   u and r of every pair as in problem.hpp
//
// v (n): velocities or displacements; M (n x n): mass or stiffness, nonsingular; H (n x dN): forces of the pairs on v;
// G (n x k) and l (k): bilateral constraints and their forces, k may be 0. With the symmetric
//
//     S = [M, -G; -G', 0],   S [v; l] = [f + H r; b]
//
// the problem is u = W r + q with W = [H; 0]' S^-1 [H; 0] and q = w + [H; 0]' S^-1 [f; b]. M need not be symmetric
// (problems from other programs are kept as they are); W is then as unsymmetric as M^-1.
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <stdexcept>

#include "scabo/contact/pair_operator.hpp"
#include "scabo/contact/problem.hpp"
#include "scabo/linalg/symmetric_positive_solver.hpp"

namespace scabo::contact {

struct GlobalProblem {
  int dimension = 3;  // d: 2 or 3
  Eigen::SparseMatrix<double> M, H, G;
  Vector f, w, b;
  Vector mu;  // N
};

/// W = H' M^-1 H by its products, of a symmetric positive definite M.
class FactorisedPairs : public PairOperator {
 public:
  FactorisedPairs(const Eigen::SparseMatrix<double>& M, Eigen::SparseMatrix<double> H, int dimension)
      : M_(M), H_(std::move(H)), dimension_(dimension) {}
  Eigen::Index size() const override { return H_.cols(); }
  Vector times(const Vector& p) const override { return H_.transpose() * M_.solve(Vector(H_ * p)); }
  /// dN solves; above 4000 rows they are estimated by probing with 64 d vectors of random signs, accurate to a few
  /// percent: they are used only for scaling and preconditioning.
  Matrix diagonal_blocks() const override;

 private:
  linalg::SymmetricPositiveSolver M_;
  Eigen::SparseMatrix<double> H_;
  int dimension_;
};

/// A global problem and its factorisation.
class GlobalReduction {
 public:
  /// Throws SingularProblem.
  explicit GlobalReduction(GlobalProblem problem);
  ~GlobalReduction();
  GlobalReduction(const GlobalReduction&) = delete;
  GlobalReduction& operator=(const GlobalReduction&) = delete;

  const GlobalProblem& global() const { return global_; }
  /// The problem condensed to the pairs. W is an operator if M is symmetric positive definite, G is empty and forming W
  /// is too expensive; sparse if the blocks of M allow it; dense otherwise. Throws SingularProblem.
  Problem problem() const;
  /// [v; l] for the forces r.
  Vector motion(const Vector& r) const;

 private:
  struct Factor;
  GlobalProblem global_;
  std::unique_ptr<Factor> factor_;
};

struct SingularProblem : std::runtime_error {
  SingularProblem() : std::runtime_error("M (with its constraints G) is singular") {}
};

}  // namespace scabo::contact
