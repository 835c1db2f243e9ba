#include "compare/siconos.hpp"

#ifdef SCABO_SICONOS

#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>
#include <sn_error_handling.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdlib>
#include <memory>

namespace scabo::compare {

namespace {

using Options = std::unique_ptr<SolverOptions, decltype(&solver_options_delete)>;
using Value = std::unique_ptr<FrictionContactProblem, decltype(&frictionContactProblem_free)>;

double* copied(const double* from, Eigen::Index size) {  // Siconos frees its input
  auto* to = static_cast<double*>(std::malloc(sizeof(double) * static_cast<std::size_t>(size)));
  std::copy(from, from + size, to);
  return to;
}

/// Gauss-Seidel in the plane and Lemke require a dense W; the solvers in space are faster with a sparse one.
NumericsMatrix* matrix_of(const Problem& problem) {
  const Matrix& W = problem.W.dense();
  const auto n = static_cast<int>(W.rows());
  NumericsMatrix* M = NM_create(problem.dimension == 2 ? NM_DENSE : NM_SPARSE, n, n);
  if (problem.dimension == 2) {
    std::copy(W.data(), W.data() + W.size(), M->matrix0);
    return M;
  }
  NM_triplet_alloc(M, std::max<CS_INT>(1, (W.array() != 0.0).count()));
  for (int column = 0; column < n; ++column)
    for (int row = 0; row < n; ++row)
      if (W(row, column) != 0.0) NM_entry(M, row, column, W(row, column));
  return M;
}

int solver_of(const std::string& name, int dimension) {
  if (name == "siconos_lemke") return SICONOS_FRICTION_2D_LEMKE;
  if (name == "siconos_nsn_ac") return SICONOS_FRICTION_3D_NSN_AC;
  if (name == "siconos_nsn_fb") return SICONOS_FRICTION_3D_NSN_FB;
  return dimension == 2 ? SICONOS_FRICTION_2D_NSGS : SICONOS_FRICTION_3D_NSGS;
}

constexpr int gave_up = -1000;

/// Calls the driver. Siconos ends the process on its own fatal errors unless its long jump is caught; no C++ object may
/// exist in this function.
int drive(int dimension, FrictionContactProblem* problem, double* p, double* u, SolverOptions* options) {
  if (setjmp(*sn_get_jmp_buf()) != 0) return gave_up;
  const int status = dimension == 2 ? fc2d_driver(problem, p, u, options) : fc3d_driver(problem, p, u, options);
  sn_release_jmp_buf();
  return status;
}

}  // namespace

bool siconos_is_built() { return true; }

End siconos(const std::string& name, const Problem& problem, const Vector& p, const Control& control) {
  const Eigen::Index size = problem.q.size();
  const int solver = solver_of(name, problem.dimension);
  End end;
  end.p = p;
  if (size > 0 && !(problem.W.diagonal().minCoeff() > 0.0)) {  // required by Siconos
    end.residual = largest(residual_of(problem, pair_stiffness(problem), p, Vector()));
    end.reason = "Siconos needs W_ii > 0";
    return end;
  }
  const Options options(solver_options_create(solver), &solver_options_delete);
  const bool sweeps = solver == SICONOS_FRICTION_2D_NSGS || solver == SICONOS_FRICTION_3D_NSGS;
  options->iparam[SICONOS_IPARAM_MAX_ITER] = (sweeps ? 400 : 20) * control.iterations;
  // Its residuals are relative to |q|.
  const double q_size = problem.q.norm();
  options->dparam[SICONOS_DPARAM_TOL] = control.small / (q_size > 0.0 ? q_size : 1.0);
  if (solver == SICONOS_FRICTION_3D_NSGS)
    solver_options_update_internal(options.get(), 0, SICONOS_FRICTION_3D_ONECONTACT_NSN_GP);
  const Value value(
      frictionContactProblem_new_with_data(problem.dimension, problem.pairs(), matrix_of(problem),
                                           copied(problem.q.data(), size), copied(problem.mu.data(), problem.pairs())),
      &frictionContactProblem_free);
  Vector u = motion_of(problem, p, Vector());
  Vector found = p;
  const int status = drive(problem.dimension, value.get(), found.data(), u.data(), options.get());
  end.iterations = options->iparam[SICONOS_IPARAM_ITER_DONE];
  if (status != gave_up && found.allFinite()) end.p = found;
  end.residual = largest(residual_of(problem, pair_stiffness(problem), end.p, Vector()));
  end.converged = end.residual <= control.small;
  end.reason = status == gave_up ? "a fatal error in Siconos" : "ended with status " + std::to_string(status);
  end.trace.push_back({end.iterations, end.residual, 0.0, 1.0, 0, name});
  return end;
}

}  // namespace scabo::compare

#else

namespace scabo::compare {

bool siconos_is_built() { return false; }

End siconos(const std::string&, const Problem&, const Vector&, const Control&) { return {}; }

}  // namespace scabo::compare

#endif
