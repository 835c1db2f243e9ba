// Results that are requested.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scabo/model/place.hpp"
#include "scabo/model/quantity.hpp"

namespace scabo::model {

/// A point at which results are requested. `body`: -1 for every body that contains it.
struct OutputPoint {
  std::string name;
  Vec2 at = Vec2::Zero();
  int body = -1;
  Source source;
};

/// `points` equally spaced points from `from` to `to`, both included.
struct OutputLine {
  std::string name;
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();
  int points = 101;  ///< 2 or more
  int body = -1;
  Source source;
};

/// Points of a rectangular grid, as far as they lie in bodies: `spacing` apart within the bounding box of the bodies,
/// or counts[0] x counts[1] points from `low` to `high`.
struct OutputGrid {
  std::optional<double> spacing;  ///< > 0
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
  std::array<int, 2> counts{};  ///< without spacing: 1 or more each
  int body = -1;
  Source source;
};

/// Resultant of the stress over a line that cuts bodies, on its length s from the middle towards `to`:
///
///     n = t turned by +90 degrees, t = (to - from) / |to - from|
///     normal = int n . sigma n ds,  shear = int t . sigma n ds,  moment = int s (n . sigma n) ds
///
/// times the thickness: the force of the side that n points to on the other side, tension positive, and its moment
/// about the middle of the line, counter-clockwise.
struct Section {
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();
  int body = -1;  ///< only this body; -1: all elastic ones
};

/// Two directions at right angles along which results are given: x and y; turned by an angle; or the outward normal of
/// a straight edge and the tangent a quarter turn counter-clockwise from it.
struct ResultAxes {
  enum class Kind { xy, angle, edge };
  Kind kind = Kind::xy;
  Vec2 first = Vec2(1.0, 0.0);  ///< unit vector; the second is a quarter turn counter-clockwise from it

  Vec2 second() const { return {-first.y(), first.x()}; }
};

/// Resultant of all that acts on an elastic body through one of its edges, and its moment
/// (analysis/state/edge_forces.hpp).
struct EdgeResultant {
  Place on;                   ///< an edge, or a face on which supports, springs or a contact act
  Vec2 about = Vec2::Zero();  ///< point of the moment
  ResultAxes axes;
};

/// Displacement of a point or corner along axes of its own.
struct PlaceDisplacement {
  Quantity of;                               ///< its point; the component is not used
  std::optional<Quantity> relative_to = {};  ///< another point, whose displacement is taken off
  ResultAxes axes;
};

/// What is written to history.csv after every increment.
struct HistoryItem {
  std::string name;
  std::variant<Quantity, Section, EdgeResultant, PlaceDisplacement> of;
  Source source;
};

/// Groups of arrays written to the .vtu files.
struct OutputFields {
  bool displacement = true, stress = true;  ///< of every body
  bool principal = true, von_mises = true;  ///< of every body, derived from its stress
  bool contact = true;                      ///< in a separate file: state, pressure and slip along the contacts
  bool any_of_bodies() const { return displacement || stress || principal || von_mises; }
};

/// Output requested in addition to the files of every run, and the content of those files.
struct Output {
  std::vector<OutputPoint> points;
  std::vector<OutputLine> lines;
  std::optional<OutputGrid> grid;
  std::vector<HistoryItem> history;
  bool error = false;              ///< estimate the error of every increment
  std::vector<Quantity> error_of;  ///< numbers that get an error bar
  bool discrete_problems = false;  ///< write the contact problem of every increment to a file
  int every = 1;                   ///< .vtu files of every so many increments, and of the last
  OutputFields fields;
};

}  // namespace scabo::model
