// What `scabo sweep --vary` asks for: values of one place of the model, and all combinations of several.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scabo::app {

/// One `--vary path=values`.
struct SweepAxis {
  std::string path;                 ///< as for `--set`
  std::vector<std::string> values;  ///< at least one, as text of the model file
};

/// Largest number of runs of one sweep.
constexpr std::size_t most_sweep_points = 10'000;

/// `path=0.1,0.2,0.5`; `path=0.1:0.9:9`, nine equally spaced numbers with both ends; `path=log:1e-3:1:4`, four numbers
/// of equal ratio. Commas within brackets do not separate. A path without a dot is the name of a parameter. Throws
/// InputError.
SweepAxis parse_axis(std::string_view text);

/// The values of every axis at one point, the last axis varying fastest. `index` from 0.
std::vector<std::string> values_at(const std::vector<SweepAxis>& axes, std::size_t index);
/// Number of points. Throws InputError if there are more than most_sweep_points, or if a path is given twice.
std::size_t count_points(const std::vector<SweepAxis>& axes);

}  // namespace scabo::app
