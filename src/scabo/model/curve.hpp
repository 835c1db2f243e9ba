// A factor that varies within a step other than linearly.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scabo/base/error.hpp"

namespace scabo::model {

/// Linear between points; constant before the first and after the last.
struct CurveTable {
  struct Point {
    double at = 0.0;  ///< part of the step, 0 to 1
    double value = 0.0;
  };
  std::vector<Point> points;  ///< one or more, their positions ascending; two at one position where it jumps
  /// Positions as given, of those at 0 and 1: seconds, where the step is one in time.
  double first = 0.0, last = 1.0;
};

/// mean + amplitude sin(2 pi (turns + periods s)), s: part of the step.
struct CurveSine {
  double mean = 0.0, amplitude = 0.0;
  double periods = 1.0;  ///< > 0
  double turns = 0.0;    ///< at the start of the step, >= 0: of a curve over several steps
};

/// Of a curve that is the acceleration of a recorded ground motion: where it comes from.
struct RecordOfGround {
  std::string file;
  std::string of;  ///< what the file has: `acceleration`, `velocity` or `displacement`
  /// What a correction of the baseline has taken off: constant, and per time since the begin of the record. Empty: none
  /// was asked for.
  std::optional<std::array<double, 2>> baseline;
  /// At each point of the table: once and twice the integral of the acceleration, from rest (integrate_record()).
  std::vector<double> velocity, displacement;
};

struct Curve {
  std::string name;
  std::variant<CurveTable, CurveSine> kind;
  Source source;
  std::optional<RecordOfGround> record = {};
};

/// The part of a curve between `from` and `to`, as a curve from 0 to 1, of one of the steps that a curve runs over.
Curve piece_of(const Curve& curve, double from, double to);

/// The factor at part `s` of a step, 0 to 1.
double value_of(const Curve& curve, double s);

/// The factor in a step in time of this duration, at a time from its start: of a table, whose positions are seconds,
/// and of a sine over the duration. At a jump the value before it.
double value_at(const Curve& curve, double time, double duration);

/// Mean of value_at() between two times.
double mean_between(const Curve& curve, double from, double to, double duration);

/// Of a curve that is a record: its velocity and displacement.
void integrate_record(Curve& curve);

/// The factor of a support in a step in time: that of the curve, or the displacement of a record.
double displacement_at(const Curve& curve, double time, double duration);

/// What an acceleration that follows a curve has done since the begin of a step in time of this duration, at a time in
/// it.
struct GroundMotion {
  double largest = 0.0;  ///< acceleration
  double velocity = 0.0, displacement = 0.0;
};
GroundMotion ground_motion(const Curve& acceleration, double duration, double time);

/// Parts of the step, between 0 and 1, where the curve has a corner or an extreme, ascending.
std::vector<double> corners_of(const Curve& curve);

}  // namespace scabo::model
