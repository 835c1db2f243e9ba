// A preconditioner for the matrix of a Newton direction (newton_direction.hpp) of a dense W whose pairs follow each
// other along joints:
//
//     [ A  M ]     A = (row combinations) W (column combinations) + diagonal
//     [ F  0 ]     M = (row combinations) G,  F = G'(column combinations)
//
// A by halves of low coupling (linalg/hierarchical_solver.hpp), the rigid motions from F A^-1 M.
#pragma once

#include <Eigen/LU>
#include <vector>

#include "scabo/contact/problem.hpp"
#include "scabo/linalg/hierarchical_solver.hpp"

namespace scabo::contact {

/// Sums of components of pairs, with weights: entries [first[j], first[j + 1]) belong to sum j. Sums are in the order
/// of their pairs.
struct Combinations {
  std::vector<std::size_t> first{0};
  std::vector<Eigen::Index> component;
  std::vector<double> weight;

  void add(Eigen::Index of, double with) {
    component.push_back(of);
    weight.push_back(with);
  }
  void close() { first.push_back(component.size()); }
  Eigen::Index size() const { return static_cast<Eigen::Index>(first.size()) - 1; }
};

class LinePreconditioner {
 public:
  /// Keeps nothing of its arguments. W must be dense. False where this does not pay or the matrix is singular.
  bool factorise(const Problem& problem, const Combinations& rows, const Combinations& columns, const Vector& diagonal);
  void solve(const Vector& x, Vector& result) const;

 private:
  linalg::HierarchicalSolver A_;
  Matrix solved_;  // A^-1 M
  Matrix F_;
  Eigen::PartialPivLU<Matrix> balance_;  // F A^-1 M
  mutable Vector part_, y_, da_;
};

}  // namespace scabo::contact
