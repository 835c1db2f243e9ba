// What newton_direction*.cpp share: memory that is kept from one direction to the next.
#pragma once

#include <optional>
#include <tuple>

#include "scabo/contact/constants.hpp"
#include "scabo/contact/kkt/body_system.hpp"
#include "scabo/contact/kkt/joint_system.hpp"
#include "scabo/contact/kkt/newton_direction.hpp"
#include "scabo/contact/kkt/preconditioners.hpp"
#include "scabo/linalg/general_solver.hpp"
#include "scabo/linalg/single_precision_solver.hpp"

namespace scabo::contact {

struct NewtonDirection::Workspace {
  explicit Workspace(const Problem& problem) {
    if (BodySystem::is_of(problem))
      bodies.emplace(problem);
    else if (problem.W.is_sparse())
      saddle.emplace(problem);
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
  std::optional<BodySystem> bodies;
  std::optional<SparseSaddle> saddle;
  Eigen::SparseMatrix<double> sparse;
  bool joints_sought = false;
  std::tuple<std::optional<JointSystem<2>>, std::optional<JointSystem<3>>> joints;  // in the plane, in space
  bool redundant = false;  // a sparse system was singular before: pairs of three bodies that meet in a point
};

}  // namespace scabo::contact
