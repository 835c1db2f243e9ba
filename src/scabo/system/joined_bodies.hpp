// What a contact solver may ask of all bodies together besides the entries of W (contact/pair_operator.hpp).
//
// Products with W are solves with the factors of the bodies, which visit only what lies between the pairs and the root
// of the elimination tree. Held pairs join the bodies: with v all free degrees of freedom (supports apart), K their
// stiffness with springs, C v the motions of the pairs and C_h those of the held directions,
//
//     K v - C_h'p = -E r     C_h v + eps p = u     =>     (K + C_h' eps^-1 C_h) v = C_h' eps^-1 u - E r
//
// one sparse symmetric positive definite matrix, whatever the number of pairs; p = eps^-1 (u - C_h v). E r: W takes a
// body without supports as held at as many degrees of freedom E as it has rigid motions N (body_system.hpp), and there
// are resultants left where z = N'C'p is not zero: (E'N)' r = z. The rigid motions are then a = (E'N)^-1 E'v.
//
// eps is 1e-4 of the flexibility of single nodes, c'diag(K)^-1 c for the row c of C, so that (W_hh + eps)^-1 is within
// about 1e-4 of W_hh^-1; less would cost p its digits, since u - C_h v cancels. Springs between the sides add their
// softness to it.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "scabo/contact/pair_operator.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/system/structure.hpp"

namespace scabo::system {

/// The rows of a part's pair matrix that are not zero, over the degrees of freedom that they touch.
struct TouchedPart {
  std::vector<int> rows, dofs;                          ///< ascending
  Eigen::SparseMatrix<double, Eigen::RowMajor> motion;  ///< rows x dofs
};
TouchedPart touched_part(const Eigen::SparseMatrix<double>& motion);

/// Products with W, and its diagonal blocks. The parts must outlive this.
class PairProducts final : public contact::PairOperator {
 public:
  /// `motion`: per part, 2N x size of u; `softness`: of springs between the sides, 2N, or empty.
  PairProducts(const Structure& structure, const std::vector<Eigen::SparseMatrix<double>>& motion,
               Vector softness = {});
  Eigen::Index size() const override { return size_; }
  Vector times(const Vector& p) const override;
  Matrix diagonal_blocks() const override;
  /// What part `p` adds to them.
  Matrix diagonal_blocks_of(std::size_t p) const;

 private:
  struct Part {
    const BodySystem* body;
    TouchedPart touched;
  };
  Eigen::Index size_ = 0;
  Vector softness_;
  std::vector<Part> parts_;
};

/// Matrices of the joined bodies, made when pairs are first held. The parts must outlive this.
class JoinedBodies final : public contact::PairHolder {
 public:
  /// Null where the stiffness of a part is divided among processes. `motion`: per part, 2N x size of u; `softness`: of
  /// springs between the sides, 2N.
  static std::shared_ptr<const JoinedBodies> of(const Structure& structure,
                                                std::vector<Eigen::SparseMatrix<double>> motion, Vector softness = {});
  JoinedBodies(const Structure& structure, std::vector<Eigen::SparseMatrix<double>> motion, Vector softness = {});
  std::unique_ptr<contact::HeldPairs> hold(const std::vector<int>& rows) const override;
  double operations() const override { return operations_; }
  Matrix flexibility(const std::vector<int>& rows) const override;

 private:
  friend class JoinedPairs;
  struct Part {
    const BodySystem* body;
    std::vector<Vec2> nodes;  // none of a rigid body
  };
  /// A part with rigid motions.
  struct Floating {
    Eigen::Index first = 0;           // column of G
    std::vector<int> further;         // E, among all v
    Eigen::PartialPivLU<Matrix> map;  // E'N, m x m
  };
  struct Matrices {
    linalg::SparseMatrix K;
    Eigen::SparseMatrix<double, Eigen::RowMajor> C;  // 2N x v
    Vector softness;                                 // 2N, eps: of c'diag(K)^-1 c, and springs
    std::vector<Vec2> positions;                     // of v
    std::vector<Floating> floating;
    Eigen::Index rigid_motions = 0;
  };
  void make() const;

  std::vector<Part> parts_;
  std::vector<Eigen::SparseMatrix<double>> motion_;
  Vector of_springs_;  // 2N, softness
  double operations_ = 0.0;
  mutable Matrices matrices_;
  mutable std::once_flag made_;
};

}  // namespace scabo::system
