// Convergence history of the contact solver: convergence.csv, one line for every iteration, and
// convergence.svg, the residual over the iterations for every increment (docs/results.md).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scabo/analysis/state/solution.hpp"
#include "scabo/contact/solution.hpp"

namespace scabo::result {

/// First line of convergence.csv, with the names of the columns.
extern const std::string_view convergence_table_header;

/// Lines of an increment, converged or not.
std::string convergence_table_rows(const analysis::IncrementResult& increment);

/// One curve of the plot.
struct ConvergenceCurve {
  std::string name;
  std::vector<contact::Iteration> iterations;
  bool converged = true;
};

/// A self-contained SVG plot: residual (logarithmic) over iterations, with colours from the first curve to the last;
/// red: not converged. If there are more than 60 curves, every n-th is drawn, and also those that did not converge
/// unless these are more than 60 themselves. A single curve has its stages named.
std::string convergence_plot(const std::vector<ConvergenceCurve>& curves, const std::string& title, double tolerance);

/// The same for a run.
std::string convergence_plot(const analysis::StaticSolution& solution);

/// Text near the beginning of such a plot, by which it is recognised.
extern const std::string_view convergence_plot_mark;

}  // namespace scabo::result
