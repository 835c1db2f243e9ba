// Records of ground motion: what a file says of an acceleration, a velocity or a displacement over time.
//
//     PEER (.AT2, .VT2, .DT2)   four lines of text, of which the third says what the values are and the last has NPTS
//                               and DT, then values in g, cm/s or cm
//     K-NET                     lines of text with `Sampling Freq(Hz)` and `Scale Factor`, of which values are
//                               multiples, in cm/s2
//     table                     time and value in two columns, or in one of several; separated by blanks, commas or
//                               semicolons
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scabo/base/error.hpp"

namespace scabo::files {

/// What the values of a record are.
enum class MotionKind { acceleration, velocity, displacement };

struct Record {
  double begin = 0.0, step = 0.0;   ///< times, seconds
  std::vector<double> values;       ///< as in the file, K-NET's times its scale factor
  std::optional<std::string> unit;  ///< `g`, `cm/s2`, `cm/s` or `cm`; empty: the file does not say
};

/// `column`: of the values in a table, from 2. Throws InputError, with the line, for a file that cannot be read, that
/// has gaps or times that are not equally spaced.
Record read_record(const std::string& file, int column = 2);

/// An acceleration over time: linear between its points, two at one time where it jumps; 0 before and after them.
struct Acceleration {
  std::vector<double> times, values;

  double largest() const;
  double velocity() const;      ///< its integral: what the ground has gained at the end
  double displacement() const;  ///< at the end, of a ground that was at rest
};

/// The acceleration of a record, whose values are multiplied by `factor`. Velocities are linear between their times, so
/// that the acceleration is constant there; of displacements it is the second difference at every time, linear between.
Acceleration acceleration_of(const Record& record, MotionKind kind, double factor);

/// What a baseline correction takes off: constant + slope (t - begin).
struct Baseline {
  double constant = 0.0, slope = 0.0;
};
/// The constant with which the velocity is 0 at the end; `line`: with a slope, the displacement too.
Baseline baseline_of(const Acceleration& acceleration, bool line);
void subtract(const Baseline& baseline, Acceleration& acceleration);

}  // namespace scabo::files
