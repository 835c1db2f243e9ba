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
// Dense LU up to a few thousand unknowns, sparse LU where W is sparse (many bodies), GMRES otherwise. Where bodies can
// be joined at the pairs that hold (pair_operator.hpp), and that is cheaper than LU, or W is known by its products
// alone, the joined bodies are the preconditioner: the matrix above but with n for n + mu e in C. Of more than
// 1,200 unknowns of a dense W, GMRES solves in double precision, by products with W itself; its preconditioner is the
// matrix above by halves of joints (line_preconditioner.hpp), and where pairs do not follow each other along joints, of
// more than 2,500 unknowns, an LU in single precision. Without any LU the
// preconditioner is the matrix above with the diagonal blocks D of the pairs for W: da from (G'C) D^-1 (L'R G) da =
// ..., then y from D. Where redundant pairs make the matrix singular, the factor of a raised matrix preconditions GMRES
// on the matrix itself; that of rigid bodies is factorised by their joints (joint_system.hpp).
#pragma once

#include <Eigen/LU>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "scabo/contact/kkt/gmres.hpp"
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

  /// d = [dp; da] for the branches of `at`; at ties they may be changed, of few bodies to those of d, of many to the
  /// ones that hold least. False where there is none.
  bool find(Residual& at, double regularisation, Vector& d);

 private:
  struct Unknown {
    int pair = 0;
    Eigen::Vector3d row, column;  // components [n, t, t]
    double scale = 0.0;           // of the row: r, r lambda
    double own = 0.0;             // 1 - lambda
  };
  bool solve(const Residual& at, double regularisation, Vector& d);
  void lay_out(const Residual& at);
  bool solve_dense(double regularisation);
  bool solve_along_joints(double regularisation);
  bool solve_by_single_precision(double regularisation);
  /// y_ by GMRES, with products with the matrix itself; false if it is less exact than LU in double precision.
  bool solve_preconditioned(double regularisation, const std::function<void(const Vector&, Vector&)>& precondition,
                            const GmresOptions& options);
  void lay_out_sparse(double regularisation);
  bool factorise_sparse(const Eigen::SparseMatrix<double>& A);
  bool solve_sparse(double regularisation);
  template <int d>
  bool solve_by_joints(double regularisation);
  bool solve_by_holding(double regularisation);
  bool solve_iteratively(double regularisation);
  /// The matrix above times x = [y; da].
  void apply(const Vector& x, double regularisation, Vector& result);
  /// The preconditioner of GMRES.
  struct PairBlocks {
    std::vector<Eigen::Matrix3d> inverse;  // of D, for each pair
    Matrix motion, force;                  // L'R G, G'C
    Eigen::PartialPivLU<Matrix> balance;   // of G'C D^-1 L'R G
  };
  PairBlocks pair_blocks(double regularisation);
  void solve_pairs(const PairBlocks& blocks, const Eigen::Ref<const Vector>& x, Vector& y) const;
  void expand(const Vector& y, Vector& dp) const;
  void gather(const Vector& motion, Vector& rows) const;

  const BDifferentiableEquations& equations_;
  std::vector<Unknown> unknowns_;
  std::vector<int> first_of_pair_;  // N + 1
  Vector known_, moved_, right_, y_;
  struct Workspace;
  std::unique_ptr<Workspace> work_;
  std::vector<bool> immovable_;  // dN, or empty
};

}  // namespace scabo::contact
