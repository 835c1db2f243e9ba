// The linear systems of contact problems: one saddle matrix for interior points and for Newton's method,
//
//     [ L'W C + D   L'G ] [ z  ]   [ b ]          dp = C z     n unknowns z, each of one pair
//     [ G'C         -E  ] [ da ] = [ g ]          W, G of a problem, E >= 0 a small multiple of 1
//
// D diagonal, >= 0; L and C have one column for each unknown, of the components [n, t[, t]] of its pair. Interior
// points have all forces as unknowns; Newton's method those whose rows hold motions, and what slips follows its normal
// force in C. Large D stand alone in their rows: rows are divided by 1 + D, and solutions are refined once, on which
// the last digits of the forces depend where W is rank deficient.
//
// Three backends: rigid bodies, by their motions or those of their joints (rigid_system.hpp); W sparse,
// LU of the sparse matrix in whole blocks of the pairs, of many bodies ordered by their joints (joint_order.hpp); W
// dense, LU by LAPACK.
#pragma once

#include <memory>

#include "scabo/contact/kkt/saddle_matrix.hpp"

namespace scabo::contact {

class SaddleSystem {
 public:
  /// W sparse or dense. Keeps a reference to `problem`.
  explicit SaddleSystem(const Problem& problem);
  ~SaddleSystem();
  SaddleSystem(SaddleSystem&&) noexcept;

  /// False where a pivot is zero.
  [[nodiscard]] bool factorise(const SaddleRows& rows);
  /// [z; da] of [b; g], of what was factorised last.
  Vector solve(const Vector& right) const;

 private:
  struct Backend;
  struct Dense;
  struct Rigid;
  struct Sparse;
  std::unique_ptr<Backend> backend_;
  const Problem& problem_;
  SaddleRows rows_;  // multiplied by
  Vector row_;       // n + m
};

}  // namespace scabo::contact
