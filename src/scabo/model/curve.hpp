// A factor that varies within a step other than linearly.
#pragma once

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
  std::vector<Point> points;  ///< one or more, their positions ascending
};

/// mean + amplitude sin(2 pi (turns + periods s)), s: part of the step.
struct CurveSine {
  double mean = 0.0, amplitude = 0.0;
  double periods = 1.0;  ///< > 0
  double turns = 0.0;    ///< at the start of the step, >= 0: of a curve over several steps
};

struct Curve {
  std::string name;
  std::variant<CurveTable, CurveSine> kind;
  Source source;
};

/// The part of a curve between `from` and `to`, as a curve from 0 to 1, of one of the steps that a curve runs over.
Curve piece_of(const Curve& curve, double from, double to);

/// The factor at part `s` of a step, 0 to 1.
double value_of(const Curve& curve, double s);

/// Parts of the step, between 0 and 1, where the curve has a corner or an extreme, ascending.
std::vector<double> corners_of(const Curve& curve);

}  // namespace scabo::model
