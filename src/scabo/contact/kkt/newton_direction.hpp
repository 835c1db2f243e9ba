// The direction d of Newton's method: H(z) + H'(z; d) = 0.
//
// On chosen branches it is linear. Forces whose row holds no motion are eliminated (open normals, free tangents, in
// slip the component along e, which follows the normal force); what remains are the unknowns y of
//
//     [ L'(R W + alpha) C + 1 - lambda   L'R G  ] [ y  ]   [ -H - L'R W known ]
//     [ G'C                              -alpha ] [ da ] = [ -H_R - G' known  ]       dp = known + C y
//
// with a column in C and a row in L for each: n (+ mu e in slip), both tangents where it sticks, in space the tangent
// across e with weight lambda where it slips. alpha: regularisation, 0 where there need be none.
//
// At ties the branches depend on d: a mixed complementarity problem of a few pairs. It is solved by following the
// branches of d until they are its own.
//
// Which factorisation, size and structure decide (docs/methods/12_contact_solver.md, one saddle system). Joined bodies
// (pair_operator.hpp) are the preconditioner of the matrix above but with n for n + mu e in C. Without any LU it is the
// matrix with the diagonal blocks of the pairs for W (preconditioners.hpp).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "scabo/contact/kkt/gmres.hpp"
#include "scabo/contact/kkt/saddle_matrix.hpp"
#include "scabo/contact/newton/b_differentiable.hpp"

namespace scabo::contact {

/// Whether joining the bodies of a problem costs less than a dense LU of `unknowns` unknowns, of a W that is dense, or
/// W is not dense and they can be joined.
bool holding_pays(const Problem& problem, Eigen::Index unknowns);

class NewtonDirection {
 public:
  /// Keeps a reference.
  explicit NewtonDirection(const BDifferentiableEquations& equations);
  ~NewtonDirection();

  /// d = [dp; da] for the branches of `at`, and its motions `at.along`; at ties the branches may be changed, of few
  /// bodies to those of d, of many to the ones that hold least. False where there is none.
  bool find(Residual& at, double regularisation, Vector& d);

 private:
  bool solve(Residual& at, double regularisation, Vector& d);
  bool solve_in_turn();
  void lay_out(const Residual& at, double regularisation);
  void add_unknown(int pair, const Eigen::Vector3d& row, const Eigen::Vector3d& column, double scale, double own);
  bool solve_dense();
  enum class DenseEnd { solved, lost_in_rounding, failed };
  /// `most`: of the residual, over that of y_ = 0.
  DenseEnd judged(Eigen::Index n, double most) const;
  double residual_of(Eigen::Index n) const;
  double rounding_of(Eigen::Index n) const;
  DenseEnd solve_regular(Eigen::Index n);
  DenseEnd solve_raised(Eigen::Index n);
  bool solve_shortest(Eigen::Index n, double rounding);
  bool solve_along_joints();
  bool solve_by_single_precision();
  /// y_ by GMRES, with products with the matrix itself. Whether the residual is at most `most` of that of y_ = 0.
  bool solve_preconditioned(const std::function<void(const Vector&, Vector&)>& precondition,
                            const GmresOptions& options, double most);
  bool solve_sparse();
  bool solve_rigid();
  bool solve_by_holding();
  bool solve_iteratively();

  const BDifferentiableEquations& equations_;
  SaddleRows rows_;     // with L R for L; E: alpha
  Vector scale_, own_;  // n, or more: r of the row, r lambda; 1 - lambda
  Vector known_, moved_, right_, y_;
  struct Workspace;
  std::unique_ptr<Workspace> work_;
  std::vector<bool> immovable_;  // dN, or empty
};

}  // namespace scabo::contact
