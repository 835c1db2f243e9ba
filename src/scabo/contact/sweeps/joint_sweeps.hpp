// Sweeps of Gauss-Seidel (gauss_seidel.hpp) over pairs of rigid bodies with W = A K A' of their joints (joints.hpp).
// The same result as pair by pair in the same order; the motion of a joint is kept by its R components, those of its
// own forces are added at once and those of other joints when the sweep leaves it.
#pragma once

#include <vector>

#include "scabo/contact/constants.hpp"
#include "scabo/contact/kkt/joints.hpp"
#include "scabo/contact/sweeps/gauss_seidel.hpp"
#include "scabo/contact/sweeps/pair_problem.hpp"

namespace scabo::contact {

template <int d>
class JointSweeps final : public GaussSeidel {
 public:
  /// The problem must outlive this object.
  JointSweeps(const Problem& problem, Joints<d> joints);
  void start(const Vector& p) override;
  void reorder(std::minstd_rand& random) override;  ///< of the joints, and of the pairs of each
  double sweep(Vector& p) override;
  double part_of_work() const override { return sweep_constants.part_of_joints; }

 private:
  static constexpr int R = Joints<d>::R;
  using Components = Eigen::Matrix<double, R, 1>;
  void leave(int joint);

  const Problem* problem_;
  Joints<d> joints_;
  std::vector<PairProblem<d>> pairs_;
  std::vector<int> order_;                      // those of a joint side by side
  std::vector<typename Joints<d>::Block> own_;  // K of each joint with itself
  std::vector<Components> motion_;              // of the pivots of each joint, K A'p
  Components left_ = Components::Zero();        // A'dp of the joint that is swept, not yet added to others
};

extern template class JointSweeps<2>;
extern template class JointSweeps<3>;

}  // namespace scabo::contact
