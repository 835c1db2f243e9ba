// The solvers of a discrete contact problem, by name. The default is `b_differentiable`, Newton on the
// B-differentiable equations with all its fallback strategies (solve.hpp). The others are earlier methods of the
// literature, kept for comparison and as alternatives; the headers beside this one give their equations and limits.
// docs/methods/14_other_solvers.md compares them.
//
//     name                 space  friction  cohesion  rigid    method
//     b_differentiable     2, 3   yes       yes       yes      Newton, line search, other starts
//     newton_only          2, 3   yes       yes       yes      its first attempt only
//     trial_and_error      2, 3   yes       no        yes      states are assumed and corrected
//     quadratic_programme  2, 3   no        no        no       active set; exact
//     lemke                2      yes       no        no       pivots on a complementarity problem
//     fischer_burmeister   2, 3   yes       no        yes      smoothing Newton on the cone
//     alart_curnier        2, 3   yes       yes       yes      nonsmooth Newton, augmented force
//     gauss_seidel         2, 3   yes       no        no       pair by pair
//     tresca               2, 3   yes       yes       yes      fixed point on the friction bound
//     proximal_point       2, 3   yes       yes       yes      sequence of problems with W + alpha
//     siconos_nsgs         2, 3   yes       no        no       of Siconos, if built with SCABO_SICONOS
//     siconos_lemke        2      yes       no        no       likewise
//     siconos_nsn_ac       3      yes       no        no       likewise
//     siconos_nsn_fb       3      yes       no        no       likewise
//
// cohesion: cohesion and tension; rigid: rigid motions that only contact holds. A solver refuses problems that it
// cannot handle: the status is not_converged, with the reason. A result counts as solved only with the certificate.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scabo/contact/solve.hpp"

namespace scabo::compare {

enum class Method {
  b_differentiable,
  newton_only,
  trial_and_error,
  quadratic_programme,
  lemke,
  fischer_burmeister,
  alart_curnier,
  gauss_seidel,
  tresca,
  proximal_point,
  siconos_nsgs,
  siconos_lemke,
  siconos_nsn_ac,
  siconos_nsn_fb
};

/// Nothing if there is no solver of this name in this build.
std::optional<Method> method_named(std::string_view name);
std::string method_name(Method method);
/// Names of the solvers in this build, the default first.
std::vector<std::string> method_names();

contact::Solution solve_with(Method method, const contact::Problem& problem, const contact::Start& start = {},
                            const contact::SolverOptions& options = {});

}  // namespace scabo::compare
