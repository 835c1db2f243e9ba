// Nonsmooth Gauss-Seidel: pair by pair, the exact solution of the pair's own problem (Jourdan, Alart, Jean, Comput.
// Methods Appl. Mech. Engrg. 155 (1998) 31). Convergence is linear at best: it is a start for Newton, a fallback where
// Newton fails, and the iteration that sweeps.hpp accelerates.
#pragma once

#include <variant>
#include <vector>

#include "scabo/contact/pair_problem.hpp"
#include "scabo/contact/problem.hpp"

namespace scabo::contact {

/// Sweeps over the pairs of a problem of d components without rigid motions (m = 0). A condensed W is formed. The
/// problem must outlive them.
template <int d>
class PairSweeps {
 public:
  [[gnu::hot]] explicit PairSweeps(const Problem& problem);
  /// motion = q + W p from scratch; for a start, and where rounding has piled up.
  [[gnu::hot]] void start(const Vector& p, Vector& motion) const;
  /// One sweep on forces and motions: the largest change of a force component.
  [[gnu::hot]] double sweep(Vector& p, Vector& motion);
  const std::vector<PairProblem<d>>& pairs() const { return pairs_; }

 private:
  [[gnu::hot]] void read_block(Eigen::Index i, double* block) const;
  [[gnu::hot]] void add(Eigen::Index i, const double* change, double* motion) const;

  const Problem* problem_;
  std::vector<PairProblem<d>> pairs_;
  const double* values_ = nullptr;
  const int *columns_ = nullptr, *rows_ = nullptr;  // of a sparse W
};

extern template class PairSweeps<2>;
extern template class PairSweeps<3>;

/// The same in two or three components, with its motions.
class GaussSeidel {
 public:
  explicit GaussSeidel(const Problem& problem);
  void start(const Vector& p);
  double sweep(Vector& p);
  const Vector& motion() const { return motion_; }

 private:
  std::variant<PairSweeps<2>, PairSweeps<3>> sweeps_;
  Vector motion_;
};

/// Forces after `sweeps` sweeps from `p`, or fewer where they stop changing.
Vector gauss_seidel(const Problem& problem, Vector p, int sweeps);

}  // namespace scabo::contact
