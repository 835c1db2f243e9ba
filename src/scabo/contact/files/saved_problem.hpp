// A discrete problem as stored in a file, with additional data for a solver: its start and, if known, its solution.
//
// Three layouts (docs/methods/13_problem_files.md), distinguished by their content:
//   FCLIB, local form      HDF5, group fclib_local       fclib.hpp
//   FCLIB, global form     HDF5, group fclib_global      fclib.hpp, reduced to the pairs by global_problem.hpp
//   Siconos text           .dat                          text_problem.hpp
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scabo/contact/files/global_problem.hpp"
#include "scabo/contact/problem.hpp"
#include "scabo/contact/solve.hpp"

namespace scabo::contact {

struct SavedProblem {
  Problem problem;
  Start start;                        ///< history, or a guess from another program; empty: none
  Vector r, a;                        ///< solution in the file; empty: none
  double force_scale = 0.0;           ///< SolverOptions::force_scale; 0 if not in the file
  std::vector<std::string> contacts;  ///< names; empty in files of other programs
  std::vector<int> contact_of_pair;   ///< N or empty: index into `contacts`
  std::vector<int> number_of_pair;    ///< N or empty: from 1, as in contact.csv
  std::string title, description;
  std::string layout;                                ///< such as `FCLIB, local form`, for display
  std::shared_ptr<const GlobalReduction> reduction;  ///< if the file has the global form
};

/// Reads a file of any of these layouts. Throws InputError with file, dataset or line, and remedy.
SavedProblem read_problem_file(const std::string& file);

}  // namespace scabo::contact
