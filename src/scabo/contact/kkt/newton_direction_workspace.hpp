// What newton_direction*.cpp share: memory that is kept from one direction to the next, and when a system counts as
// solved.
#pragma once

#include <optional>
#include <vector>

#include "scabo/contact/kkt/gmres.hpp"
#include "scabo/contact/kkt/joint_order.hpp"
#include "scabo/contact/kkt/joint_system.hpp"
#include "scabo/contact/kkt/line_preconditioner.hpp"
#include "scabo/contact/kkt/newton_direction.hpp"
#include "scabo/linalg/general_solver.hpp"
#include "scabo/linalg/single_precision_solver.hpp"
#include "scabo/linalg/sparse_general_solver.hpp"

namespace scabo::contact {

struct NewtonDirection::Workspace {
  Matrix A, factor;
  linalg::GeneralSolver solver;
  Eigen::MatrixXf single;
  linalg::SinglePrecisionSolver single_solver;
  LinePreconditioner along_joints;
  bool line_fails = false;     // pairs do not follow each other along joints, or W is too ill-conditioned
  bool single_fails = false;   // W is too ill-conditioned: of slender bodies
  bool holding_fails = false;  // it takes too many iterations, or none hold the bodies
  Vector column, full, image, residual;
  Eigen::SparseMatrix<double> sparse, raised;
  Eigen::SparseMatrix<double, Eigen::RowMajor> G;  // by rows, for sparse saddle systems
  std::vector<double> sum;
  std::vector<int> touched;
  linalg::SparseGeneralSolver sparse_solver;
  std::optional<JointOrder> joint_order;  // of sparse saddle systems with many unknowns
  bool joints_sought = false;
  std::optional<JointSystem<2>> joints_in_plane;
  std::optional<JointSystem<3>> joints_in_space;
  bool redundant = false;  // a sparse system was singular before: pairs of three bodies that meet in a point
  Matrix blocks;           // of W on its diagonal, for the preconditioner

  // Pairs of three bodies that meet in a point, or of a body wedged between others, are redundant: their forces are not
  // unique, and the matrix is singular for good. It is factorised with this much on the diagonal of the force rows (the
  // mean W_ii is 1), and GMRES with that factor as its preconditioner solves the singular system itself. With 1e-6 and
  // less rounding drifts in the null space (walls of blocks: 14 to 38 iterations instead of 1 to 5).
  static constexpr double raise = 1e-4;
  static constexpr GmresOptions singular_gmres{1e-12, 40, 80};
  /// Residual, relative to the right-hand side, up to which a direction solves its equations; up to `descending` it is
  /// still one along which the merit falls.
  static constexpr double exact = 1e-9, descending = 0.5;
};

}  // namespace scabo::contact
