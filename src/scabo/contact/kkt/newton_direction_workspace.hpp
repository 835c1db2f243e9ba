// What newton_direction*.cpp share: memory that is kept from one direction to the next.
#pragma once

#include <memory>
#include <optional>

#include "scabo/contact/constants.hpp"
#include "scabo/contact/kkt/newton_direction.hpp"
#include "scabo/contact/kkt/preconditioners.hpp"
#include "scabo/contact/kkt/rigid_system.hpp"
#include "scabo/linalg/general_solver.hpp"
#include "scabo/linalg/single_precision_solver.hpp"

namespace scabo::contact {

struct NewtonDirection::Workspace {
  explicit Workspace(const Problem& problem) : rigid(RigidSystem::of(problem)) {
    if (!rigid && problem.W.is_sparse()) saddle.emplace(problem);
  }

  Matrix A, factor;
  linalg::GeneralSolver solver;
  Eigen::MatrixXf single;
  linalg::SinglePrecisionSolver single_solver;
  LinePreconditioner along_joints;
  PairPreconditioner by_pairs;
  bool line_fails = false;     // pairs do not follow each other along joints, or W is too ill-conditioned
  bool single_fails = false;   // W is too ill-conditioned: of slender bodies
  bool holding_fails = false;  // it takes too many iterations, or none hold the bodies
  Vector full, image, residual;
  std::unique_ptr<RigidSystem> rigid;
  std::optional<SparseSaddle> saddle;
  Eigen::SparseMatrix<double> sparse;
  bool redundant = false;  // a sparse system is singular, or expected to be: pairs of three bodies that meet in a point
};

}  // namespace scabo::contact
