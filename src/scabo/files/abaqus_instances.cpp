#include "scabo/files/abaqus_instances.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scabo/files/abaqus_lines.hpp"

namespace scabo::files {

std::optional<Eigen::Matrix3d> turn_about(const Vec3& a, const Vec3& b, double degrees) {
  const Vec3 along = b - a;
  if (!(along.norm() > 0.0)) return std::nullopt;
  const Vec3 axis = along.normalized();
  const double quarters = degrees / 90.0;
  double c = std::cos(degrees * std::numbers::pi / 180.0), s = std::sin(degrees * std::numbers::pi / 180.0);
  if (quarters == std::round(quarters)) {
    c = std::round(c);
    s = std::round(s);
  }
  Eigen::Matrix3d cross;
  cross << 0.0, -axis.z(), axis.y(), axis.z(), 0.0, -axis.x(), -axis.y(), axis.x(), 0.0;
  return Eigen::Matrix3d(c * Eigen::Matrix3d::Identity() + s * cross + (1.0 - c) * axis * axis.transpose());
}

int AbaqusInstances::add(const std::string& name, const Placement& placement) {
  names_.push_back(name);
  placements_.push_back(placement);
  return static_cast<int>(names_.size()) - 1;
}

int AbaqusInstances::find(std::string_view name) const {
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (upper(names_[i]) == upper(name)) return static_cast<int>(i);
  return none;
}

std::optional<std::pair<int, std::string>> AbaqusInstances::split(std::string_view name) const {
  for (auto dot = name.find('.'); dot != std::string_view::npos; dot = name.find('.', dot + 1))
    if (const int instance = find(name.substr(0, dot)); instance != none)
      return std::pair(instance, std::string(name.substr(dot + 1)));
  return std::nullopt;
}

std::string AbaqusInstances::full_name(int instance, const std::string& name) const {
  return instance == none ? name : names_[static_cast<std::size_t>(instance)] + "." + name;
}

void SmallNumbers::add(std::int64_t number) {
  const auto of = static_cast<std::size_t>(number / AbaqusInstances::spacing);
  if (of < largest_.size()) largest_[of] = std::max(largest_[of], number % AbaqusInstances::spacing);
}

std::int64_t SmallNumbers::offset(int instance) const {
  if (instance == AbaqusInstances::none) return 0;
  std::int64_t step = 10;
  while (step <= *std::max_element(largest_.begin(), largest_.end())) step *= 10;
  return (instance + (largest_.front() > 0 ? 1 : 0)) * step;
}

std::int64_t SmallNumbers::operator()(std::int64_t number) const {
  const std::int64_t of = number / AbaqusInstances::spacing;
  if (of >= static_cast<std::int64_t>(largest_.size())) return number;
  return number % AbaqusInstances::spacing + offset(static_cast<int>(of) - 1);
}

}  // namespace scabo::files
