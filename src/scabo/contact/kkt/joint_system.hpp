// Linear systems of pairs whose W is that of joints (joints.hpp):
//
//     (D + L K C') z = b        n unknowns, each of one pair; D diagonal, positive; L, C: n x R, in the columns of the
//                               joint of the pair
//
// With the resultants y = C'z of the joints and their motions w = K y this is D z + L w = b. The unknowns of a joint
// are eliminated one after the other: what the first j of them say about y and w are R equations F y + M w = h, at
// first y = 0. With one more, y grows by c z, and its own equation d z + l'w = b is added; a reflection (Householder)
// of the R + 1 equations leaves z in the last one alone. At the end
//
//     (F + M K) y = h           R equations and unknowns a joint, sparse
//
// is solved, and the last equations, backwards, give z. Reflections do no harm where D is tiny (pairs that stick), huge
// (open), and both in one joint: y + C' D^-1 L K y = C' D^-1 b, which is shorter, lost ten digits.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "scabo/contact/kkt/joints.hpp"
#include "scabo/contact/kkt/rigid_system.hpp"
#include "scabo/linalg/sparse_general_solver.hpp"

namespace scabo::contact {

template <int d>
class JointSystem : public RigidSystem {
 public:
  static constexpr int R = Joints<d>::R;

  /// Of joints whose A and K are scaled alike: the pivots' own motions K_kk become 1.
  explicit JointSystem(Joints<d> joints);

  bool factorise(const SaddleRows& rows, const Vector& D) override;
  void solve(const Vector& b, Vector& z) const override;

 private:
  Vector spread(const Vector& s) const;  // K s

  Joints<d> joints_;
  /// One unknown after its reflection 1 - tau [u; u_own] [u; u_own]': alpha z + f'y + m'w = h.
  struct Eliminated {
    int joint = 0;
    Eigen::Matrix<double, R, 1> u, f, m, c;
    double u_own = 0.0, tau = 0.0, scale = 1.0, alpha = 1.0;
  };
  std::vector<Eliminated> eliminated_;
  Eigen::SparseMatrix<double> matrix_;
  linalg::SparseGeneralSolver lu_;
};

extern template class JointSystem<2>;
extern template class JointSystem<3>;

}  // namespace scabo::contact
