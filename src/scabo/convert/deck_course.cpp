#include "scabo/convert/deck_course.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/convert/deck_fields.hpp"
#include "scabo/files/abaqus_lines.hpp"
#include "scabo/files/text_cursor.hpp"

namespace scabo::convert {

bool is_zero(const Course& course) {
  for (const Leg& leg : course) {
    if (leg.end != 0.0) return false;
    for (const auto& [part, value] : leg.table)
      if (value != 0.0) return false;
  }
  return true;
}

double scale_of(const Course& course) {
  for (const Leg& leg : course)
    if (leg.end != 0.0) return leg.end;
  for (const Leg& leg : course)
    for (const auto& [part, value] : leg.table)
      if (value != 0.0) return value;
  return 1.0;
}

Course scaled(Course course, double factor) {
  for (Leg& leg : course) {
    leg.end *= factor;
    for (auto& [part, value] : leg.table) value *= factor;
  }
  return course;
}

double Amplitude::value(double time) const {
  if (time <= points.front().first) return points.front().second;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (time <= points[i].first) {
      const auto& [t0, v0] = points[i - 1];
      const auto& [t1, v1] = points[i];
      return t1 > t0 ? v0 + (v1 - v0) * (time - t0) / (t1 - t0) : v1;
    }
  return points.back().second;
}

std::map<std::string, Amplitude> read_amplitudes(const files::AbaqusDeck& deck, Remarks& remarks) {
  using files::upper;
  std::map<std::string, Amplitude> amplitudes;
  for (const files::DeckBlock& block : deck.blocks) {
    if (block.name != "AMPLITUDE") continue;
    Amplitude amplitude;
    amplitude.at = block.at;
    amplitude.total_time = upper(parameter(block, "TIME")).starts_with("TOTAL");
    amplitude.absolute = upper(parameter(block, "VALUE")).starts_with("ABS");
    const std::string definition = upper(parameter(block, "DEFINITION", "TABULAR"));
    const std::string name = upper(parameter(block, "NAME"));
    bool usable = definition == "TABULAR" && !name.empty();
    if (!usable) {
      remarks.essential(block.at, "only an *AMPLITUDE with a name and a table of times and values is taken; write one");
      continue;
    }
    std::vector<double> numbers;
    for (const files::DeckLine& line : block.lines)
      for (std::size_t k = 0; usable && k < line.fields.size(); ++k) {
        const auto value = number(remarks, line, k, "a number of *AMPLITUDE");
        usable = value.has_value();
        numbers.push_back(value.value_or(0.0));
      }
    for (std::size_t k = 0; k + 1 < numbers.size(); k += 2) amplitude.points.emplace_back(numbers[k], numbers[k + 1]);
    const bool ascending = std::is_sorted(amplitude.points.begin(), amplitude.points.end(),
                                          [](const auto& x, const auto& y) { return x.first <= y.first; });
    if (usable && (amplitude.points.empty() || numbers.size() % 2 == 1 || !ascending)) {
      remarks.essential(block.at, "an *AMPLITUDE needs pairs of time and value, the times ascending; correct it");
      usable = false;
    }
    if (usable && !amplitudes.emplace(name, std::move(amplitude)).second)
      remarks.essential(block.at, fmt::format("there is another *AMPLITUDE '{}' before this one; give each a name of "
                                              "its own",
                                              files::printable(parameter(block, "NAME"))));
  }
  return amplitudes;
}

std::optional<std::string> delayed_amplitude(std::map<std::string, Amplitude>& amplitudes, const std::string& name,
                                             const files::DeckBlock& block, Remarks& remarks) {
  const std::string text = parameter(block, "TIME DELAY");
  if (text.empty()) return name;
  double delay = 0.0;
  if (!files::parse_number(std::string_view(text), delay) || !std::isfinite(delay)) {
    remarks.essential(block.at,
                      fmt::format("'{}' is no TIME DELAY of {}; write a time", files::printable(text), block.written));
    return std::nullopt;
  }
  const std::string delayed = fmt::format("{} DELAYED BY {}", name, text);
  Amplitude later = amplitudes.at(name);
  for (auto& [time, value] : later.points) time += delay;
  amplitudes.emplace(delayed, std::move(later));
  return delayed;
}

void begin_at(Leg& leg, double value, double part) {
  std::vector<std::pair<double, double>> table = {{0.0, value}};
  const auto after = std::find_if(leg.table.begin(), leg.table.end(),
                                  [part](const auto& point) { return point.first >= part * (1.0 - 1e-9); });
  const auto& [t1, v1] = *after;
  const auto& [t0, v0] = *std::prev(after);
  if (t1 > part * (1.0 + 1e-9)) table.emplace_back(part, v0 + (v1 - v0) * (part - t0) / (t1 - t0));
  table.insert(table.end(), after, leg.table.end());
  leg.table = std::move(table);
}

Leg leg_along(const Amplitude& amplitude, double factor, double start, double period) {
  Leg leg;
  leg.table.emplace_back(0.0, factor * amplitude.value(start));
  for (const auto& [time, value] : amplitude.points) {
    const double part = (time - start) / period;
    if (part > 1e-12 && part < 1.0 - 1e-12 && part > leg.table.back().first)
      leg.table.emplace_back(part, factor * value);
  }
  leg.end = factor * amplitude.value(start + period);
  leg.table.emplace_back(1.0, leg.end);
  return leg;
}

}  // namespace scabo::convert
