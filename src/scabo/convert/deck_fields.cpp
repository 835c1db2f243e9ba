#include "scabo/convert/deck_fields.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "scabo/files/abaqus_lines.hpp"

namespace scabo::convert {

using files::DeckBlock;
using files::DeckLine;
using files::upper;

bool is_on(const DeckBlock& block, const std::string& parameter) {
  const auto found = block.parameters.find(parameter);
  return found != block.parameters.end() && upper(found->second) != "NO";
}

std::string parameter(const DeckBlock& block, const std::string& name, const std::string& otherwise) {
  const auto found = block.parameters.find(name);
  return found == block.parameters.end() ? otherwise : found->second;
}

std::optional<double> number(Remarks& remarks, const DeckLine& line, std::size_t field, const char* what,
                             std::optional<double> otherwise) {
  if (field >= line.fields.size() || line.fields[field].empty()) {
    if (!otherwise) remarks.essential(line.at, fmt::format("{} is missing on this line; add it", what));
    return otherwise;
  }
  double value = 0.0;
  if (files::parse_number(std::string_view(line.fields[field]), value) && std::isfinite(value)) return value;
  remarks.essential(line.at, fmt::format("'{}' is not a number, but {} stands here; correct it",
                                         files::printable(line.fields[field]), what));
  return std::nullopt;
}

std::optional<std::vector<double>> numbers_of(Remarks& remarks, const DeckBlock& block, std::size_t count,
                                              const char* what) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < block.lines.size(); ++i) {
    if (block.lines[i].fields.empty()) continue;
    if (numbers.size() >= count) {
      remarks.essential(block.lines[i].at,
                        fmt::format("{} that depends on temperature is not taken; give one value", what));
      return std::nullopt;
    }
    for (std::size_t k = 0; k < block.lines[i].fields.size() && numbers.size() < count; ++k) {
      const auto value = number(remarks, block.lines[i], k, what);
      if (!value) return std::nullopt;
      numbers.push_back(*value);
    }
  }
  if (numbers.size() == count) return numbers;
  remarks.essential(block.at,
                    fmt::format("{} needs {} numbers, and {} are here; add the others", what, count, numbers.size()));
  return std::nullopt;
}

std::optional<std::vector<int>> components_of(const std::string& word, int dimension) {
  static const std::map<std::string, std::vector<int>> kinds = {
      {"XSYMM", {0}},     {"YSYMM", {1}},     {"ZSYMM", {2}},          {"XASYMM", {1, 2}},
      {"YASYMM", {0, 2}}, {"ZASYMM", {0, 1}}, {"ENCASTRE", {0, 1, 2}}, {"PINNED", {0, 1, 2}}};
  const auto kind = kinds.find(files::upper(word));
  if (kind == kinds.end()) return {};
  std::vector<int> components = kind->second;
  std::erase_if(components, [dimension](int component) { return component >= dimension; });
  return components;
}

std::optional<Eigen::Vector3d> gravity_of(Remarks& remarks, const DeckLine& line, int dimension) {
  const auto g = number(remarks, line, 2, "the acceleration");
  const auto x = number(remarks, line, 3, "the direction of gravity", 0.0),
             y = number(remarks, line, 4, "the direction of gravity", 0.0),
             z = number(remarks, line, 5, "the direction of gravity", 0.0);
  if (!g || !x || !y || !z) return std::nullopt;
  const double length = std::hypot(*x, *y, *z);
  if (*g != 0.0 && (!(length > 0.0) || (dimension == 2 && std::abs(*z) > 1e-9 * length))) {
    remarks.essential(line.at, fmt::format("gravity needs a direction{}; correct the last three numbers",
                                           dimension == 2 ? " in the plane" : ""));
    return std::nullopt;
  }
  const double scale = length > 0.0 ? *g / length : 0.0;
  return scale * Eigen::Vector3d(*x, *y, dimension == 2 ? 0.0 : *z);
}

std::optional<double> rotation_of(Remarks& remarks, const DeckLine& line) {
  const auto square = number(remarks, line, 2, "the square of the angular velocity");
  std::array<double, 6> axis{};  // a point, a direction
  for (std::size_t k = 0; k < axis.size(); ++k) {
    const auto value = number(remarks, line, 3 + k, "a point and the direction of the axis", 0.0);
    if (!value) return std::nullopt;
    axis[k] = *value;
  }
  const double length = std::hypot(axis[3], axis[4], axis[5]);
  if (square && *square >= 0.0 && axis[0] == 0.0 && axis[2] == 0.0 && length > 0.0 && std::abs(axis[4]) == length)
    return square;
  if (square)
    remarks.essential(line.at,
                      "a rotation (CENTRIF) needs the square of an angular velocity, and the axis x = 0: the "
                      "point 0, 0, 0 and the direction 0, 1, 0");
  return std::nullopt;
}

}  // namespace scabo::convert
