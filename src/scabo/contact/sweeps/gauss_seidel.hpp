// Nonsmooth Gauss-Seidel: pair by pair, the exact solution of the problem of one pair (Jourdan, Alart, Jean, Comput.
// Methods Appl. Mech. Engrg. 155 (1998) 31). Convergence is at best linear. It is the iteration
// that long_sweeps.hpp accelerates.
#pragma once

#include <variant>
#include <vector>

#include "scabo/contact/problem.hpp"
#include "scabo/contact/sweeps/joint_sweeps.hpp"
#include "scabo/contact/sweeps/pair_problem.hpp"

namespace scabo::contact {

/// Sweeps over the pairs of a problem with d components and without rigid motions (m = 0). A condensed W is formed. The
/// problem must outlive this object.
template <int d>
class PairSweeps {
 public:
  [[gnu::hot]] explicit PairSweeps(const Problem& problem);
  /// Computes the motion q + W p anew: for a start, and when rounding has accumulated.
  [[gnu::hot]] void start(const Vector& p);
  /// Performs one sweep and returns the largest change of a force component.
  [[gnu::hot]] double sweep(Vector& p);
  const Vector& motion() const { return motion_; }

 private:
  [[gnu::hot]] void add(Eigen::Index i, const double* change);

  const Problem* problem_;
  std::vector<PairProblem<d>> pairs_;
  Vector motion_;
  const double* values_ = nullptr;
  double factor_ = 1.0;                             // of the values
  const int *columns_ = nullptr, *rows_ = nullptr;  // of a sparse W
};

extern template class PairSweeps<2>;
extern template class PairSweeps<3>;

/// The same for two or three components; by the joints of rigid bodies where there are any (joints.hpp), whose search
/// costs as much as some tens of sweeps.
class GaussSeidel {
 public:
  explicit GaussSeidel(const Problem& problem);
  void start(const Vector& p);
  double sweep(Vector& p);
  Vector motion() const;
  bool of_joints() const { return sweeps_.index() >= 2; }

 private:
  using Sweeps = std::variant<PairSweeps<2>, PairSweeps<3>, JointSweeps<2>, JointSweeps<3>>;
  static Sweeps sweeps_of(const Problem& problem);

  Sweeps sweeps_;
};

}  // namespace scabo::contact
