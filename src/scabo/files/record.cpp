#include "scabo/files/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

#include "scabo/files/bytes_of_file.hpp"
#include "scabo/files/text_cursor.hpp"

namespace scabo::files {

namespace {

struct Line {
  int number = 0;
  std::string text;
};

std::vector<Line> lines_of(const std::string& file) {
  const std::optional<std::string> bytes = bytes_of_file(file);
  if (!bytes) fail_in_file(file, 0, 0, "the file of the record cannot be read: " + why_unreadable(file));
  std::istringstream stream(*bytes);
  std::vector<Line> lines;
  constexpr int most = 10'000'000;
  for (std::string text; std::getline(stream, text);) {
    if (static_cast<int>(lines.size()) == most)
      fail_in_file(file, most, 0, "the record has more than ten million lines");
    lines.push_back({static_cast<int>(lines.size()) + 1, std::move(text)});
  }
  return lines;
}

/// Numbers of a line; nothing if something else is in it.
std::optional<std::vector<double>> numbers_of(std::string_view text) {
  constexpr std::string_view separators = " \t,;\r";
  std::vector<double> numbers;
  while (true) {
    const auto begin = text.find_first_not_of(separators);
    if (begin == std::string_view::npos) return numbers;
    text.remove_prefix(begin);
    const std::string_view word = text.substr(0, text.find_first_of(separators));
    if (!parse_number(word, numbers.emplace_back()) || !std::isfinite(numbers.back())) return {};
    text.remove_prefix(word.size());
  }
}

/// The number after `key`.
std::optional<double> number_after(std::string_view text, std::string_view key) {
  const auto found = text.find(key);
  if (found == std::string_view::npos) return {};
  const auto begin = text.find_first_not_of(" =\t:", found + key.size());
  if (begin == std::string_view::npos) return {};
  const std::string_view rest = text.substr(begin);
  double value = 0.0;
  return parse_number(rest.substr(0, rest.find_first_not_of("+-.0123456789eEdD")), value) ? std::optional(value)
                                                                                          : std::nullopt;
}

/// All numbers from line `first` on.
void add_values(const std::string& file, const std::vector<Line>& lines, std::size_t first, Record& record) {
  for (std::size_t i = first; i < lines.size(); ++i) {
    const auto numbers = numbers_of(lines[i].text);
    if (!numbers) fail_in_file(file, lines[i].number, 0, "must be numbers: values of the record");
    record.values.insert(record.values.end(), numbers->begin(), numbers->end());
  }
}

/// The third line: `VELOCITY TIME SERIES IN UNITS OF CM/S`.
std::string unit_of_peer(std::string_view text) {
  const auto says = [&](std::string_view word) { return text.find(word) != std::string_view::npos; };
  if (says("DISPLACEMENT")) return "cm";
  if (says("VELOCITY")) return "cm/s";
  return says("CM/S") ? "cm/s2" : "g";
}

/// The fourth line has `NPTS= 4000, DT= .005 SEC`, or `4000 .005 NPTS, DT`.
Record read_peer(const std::string& file, const std::vector<Line>& lines) {
  const Line& header = lines[3];
  std::optional<double> count = number_after(header.text, "NPTS"), step = number_after(header.text, "DT");
  if (!count || !step) {
    const auto numbers = numbers_of(header.text.substr(0, header.text.find("NPTS")));
    if (!numbers || numbers->size() < 2)
      fail_in_file(file, header.number, 0,
                   "must have the number of values and their time step, as in NPTS= 4000, DT= .005 SEC");
    count = (*numbers)[0], step = (*numbers)[1];
  }
  Record record{0.0, *step, {}, unit_of_peer(lines[2].text)};
  add_values(file, lines, 4, record);
  if (static_cast<double>(record.values.size()) != *count)
    fail_in_file(file, header.number, 0,
                 fmt::format("says that {} values follow, but {} do", *count, record.values.size()));
  return record;
}

Record read_k_net(const std::string& file, const std::vector<Line>& lines) {
  std::optional<double> frequency, scale;
  std::size_t first = 0;
  for (; first < lines.size(); ++first) {
    const std::string& text = lines[first].text;
    if (text.starts_with("Sampling Freq")) frequency = number_after(text, ")");
    if (text.starts_with("Scale Factor"))
      if (const auto above = number_after(text, "Factor"), below = number_after(text, "/"); above && below)
        scale = *above / *below;
    if (text.starts_with("Memo")) break;
  }
  if (!frequency || !(*frequency > 0.0) || !scale)
    fail_in_file(file, 0, 0, "looks like a record of K-NET, but has no 'Sampling Freq(Hz)' or no 'Scale Factor'");
  Record record{0.0, 1.0 / *frequency, {}, "cm/s2"};
  add_values(file, lines, first + 1, record);
  for (double& value : record.values) value *= *scale;
  return record;
}

Record read_table(const std::string& file, const std::vector<Line>& lines, int column) {
  Record record;
  std::vector<double> times;
  constexpr double unequal = 0.01;  // of a time step; times are often rounded
  for (const Line& line : lines) {
    const auto begin = line.text.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line.text[begin] == '#' || line.text[begin] == '%') continue;
    const auto numbers = numbers_of(line.text);
    if (!numbers && times.empty()) continue;  // titles of the columns
    if (!numbers || static_cast<int>(numbers->size()) < column)
      fail_in_file(file, line.number, 0,
                   fmt::format("must have {} numbers or more: the time and, in column {}, the value",
                               std::max(2, column), column));
    times.push_back((*numbers)[0]);
    record.values.push_back((*numbers)[static_cast<std::size_t>(column) - 1]);
    const std::size_t n = times.size();
    if (n == 2) record.step = times[1] - times[0];
    if (n < 2) continue;
    const double step = times[n - 1] - times[n - 2];
    if (!(step > 0.0)) fail_in_file(file, line.number, 0, "times must be ascending");
    if (std::abs(step - record.step) > unequal * record.step)
      fail_in_file(file, line.number, 0,
                   fmt::format("the time step is {:.6g} here and {:.6g} before: a record has equal steps and no gaps",
                               step, record.step));
  }
  if (times.size() > 1) {
    record.begin = times.front();
    record.step = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  }
  return record;
}

}  // namespace

double Acceleration::largest() const {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

double Acceleration::velocity() const {
  double v = 0.0;
  for (std::size_t i = 1; i < times.size(); ++i) v += 0.5 * (times[i] - times[i - 1]) * (values[i - 1] + values[i]);
  return v;
}

double Acceleration::displacement() const {
  double v = 0.0, u = 0.0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double h = times[i] - times[i - 1];
    u += h * v + h * h * (2.0 * values[i - 1] + values[i]) / 6.0;
    v += 0.5 * h * (values[i - 1] + values[i]);
  }
  return u;
}

Acceleration acceleration_of(const Record& record, MotionKind kind, double factor) {
  Acceleration made;
  const std::vector<double>& of = record.values;
  const double h = record.step;
  const auto add = [&](std::size_t i, double value) {
    made.times.push_back(record.begin + static_cast<double>(i) * h);
    made.values.push_back(factor * value);
  };
  switch (kind) {
    case MotionKind::acceleration:
      for (std::size_t i = 0; i < of.size(); ++i) add(i, of[i]);
      break;
    case MotionKind::velocity:
      for (std::size_t i = 0; i + 1 < of.size(); ++i)
        for (const std::size_t end : {i, i + 1}) add(end, (of[i + 1] - of[i]) / h);
      break;
    case MotionKind::displacement:
      add(0, 0.0);
      for (std::size_t i = 1; i + 1 < of.size(); ++i) add(i, (of[i + 1] - 2.0 * of[i] + of[i - 1]) / (h * h));
      add(of.size() - 1, 0.0);
      break;
  }
  return made;
}

Baseline baseline_of(const Acceleration& acceleration, bool line) {
  const double T = acceleration.times.back() - acceleration.times.front(), v = acceleration.velocity();
  if (!line) return {v / T, 0.0};
  // c0 T + c1 T^2/2 = v,  c0 T^2/2 + c1 T^3/6 = u
  const double slope = 12.0 * (0.5 * v * T - acceleration.displacement()) / (T * T * T);
  return {v / T - 0.5 * slope * T, slope};
}

void subtract(const Baseline& baseline, Acceleration& acceleration) {
  for (std::size_t i = 0; i < acceleration.times.size(); ++i)
    acceleration.values[i] -= baseline.constant + baseline.slope * (acceleration.times[i] - acceleration.times.front());
}

Record read_record(const std::string& file, int column) {
  const std::vector<Line> lines = lines_of(file);
  const bool is_peer = lines.size() > 4 && lines[3].text.find("NPTS") != std::string::npos;
  const bool is_k_net = !lines.empty() && lines.front().text.starts_with("Origin Time");
  Record record = is_peer    ? read_peer(file, lines)
                  : is_k_net ? read_k_net(file, lines)
                             : read_table(file, lines, column);
  if (record.values.size() < 2) fail_in_file(file, 0, 0, "has no record: two values or more are needed");
  if (!(record.step > 0.0)) fail_in_file(file, 0, 0, "has a time step that is not positive");
  return record;
}

}  // namespace scabo::files
