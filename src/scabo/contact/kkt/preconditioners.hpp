// Preconditioners for the matrix of a Newton direction (newton_direction.hpp) that costs too much to factorise,
//
//     [ A  M ]     A = L'W C + D
//     [ F -E ]     M = L'G,  F = G'C
//
// The rigid motions are eliminated by an approximation of A^-1: da from (F A^-1 M + E) da = F A^-1 x - y.
#pragma once

#include <vector>

#include "scabo/contact/kkt/saddle_matrix.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/linalg/hierarchical_solver.hpp"

namespace scabo::contact {

class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  void solve(const Vector& x, Vector& result) const;

 protected:
  /// False where too few pairs hold the bodies.
  bool eliminate_motions(const Problem& problem, const SaddleRows& rows);

 private:
  virtual void solve_forces(const Vector& x, Vector& y) const = 0;  // y = A^-1 x

  Matrix F_, solved_;                    // A^-1 M
  Eigen::PartialPivLU<Matrix> balance_;  // F A^-1 M + E
};

/// A dense W whose pairs follow each other along joints: A by halves of low coupling (linalg/hierarchical_solver.hpp).
class LinePreconditioner : public Preconditioner {
 public:
  /// Keeps nothing of its arguments. False where this does not pay or the matrix is singular.
  bool factorise(const Problem& problem, const SaddleRows& rows);

 private:
  void solve_forces(const Vector& x, Vector& y) const override { A_.solve(x, y); }

  linalg::HierarchicalSolver A_;
};

/// Any W: A by the blocks of its pairs, of one problem.
class PairPreconditioner : public Preconditioner {
 public:
  bool factorise(const Problem& problem, const SaddleRows& rows);

 private:
  void solve_forces(const Vector& x, Vector& y) const override;

  Matrix diagonal_;                       // blocks of W
  std::vector<int> first_;                // N + 1, of the unknowns
  std::vector<Eigen::Matrix3d> inverse_;  // for each pair
};

}  // namespace scabo::contact
