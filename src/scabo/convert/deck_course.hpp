// Values of a deck over its steps, and the amplitudes that they follow.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scabo/convert/remark.hpp"
#include "scabo/files/abaqus.hpp"

namespace scabo::convert {

/// A value over one step: linear to `end`, or by `table` of [part of the step, value] from 0 to 1.
struct Leg {
  double end = 0.0;
  std::vector<std::pair<double, double>> table = {};
  friend bool operator==(const Leg&, const Leg&) = default;
  friend auto operator<=>(const Leg&, const Leg&) = default;
};
using Course = std::vector<Leg>;  ///< one for each step

struct Given {
  Course course;
  std::string label;  ///< the set or number of the deck
  files::DeckPlace at;
  int added = 0, removed = -1;  ///< of a support: the steps in which it begins and ends, as those of model::Support
};

/// True if the value is 0 all the time.
bool is_zero(const Course& course);
/// A value by which a course becomes factors: its first end that is not 0, or else such a value of a table.
double scale_of(const Course& course);
Course scaled(Course course, double factor);

/// *AMPLITUDE: a table of time and value, times ascending; constant before its first and after its last time.
struct Amplitude {
  std::vector<std::pair<double, double>> points;
  bool total_time = false;  ///< times count from the begin of the analysis, not of the step
  bool absolute = false;    ///< values are not multiplied by those of the loads
  files::DeckPlace at;

  double value(double time) const;
};

/// The tables of the deck, by name in upper case; those of other kinds become remarks.
std::map<std::string, Amplitude> read_amplitudes(const files::AbaqusDeck& deck, Remarks& remarks);

/// The name of an amplitude as a block uses it: with TIME DELAY that of another one, which is added, whose times are
/// later; nothing, with a remark, if the delay is no number.
std::optional<std::string> delayed_amplitude(std::map<std::string, Amplitude>& amplitudes, const std::string& name,
                                             const files::DeckBlock& block, Remarks& remarks);

/// `factor` times the amplitude over a step of length `period` from `start`. Its table holds both ends, even if nothing
/// lies between them.
Leg leg_along(const Amplitude& amplitude, double factor, double start, double period);

/// Lets a leg with a table of both ends begin at another value; from `part` of the step on it is as it was.
void begin_at(Leg& leg, double value, double part);

}  // namespace scabo::convert
