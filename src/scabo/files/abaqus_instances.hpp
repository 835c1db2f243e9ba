// Parts and their instances in an input file of Abaqus: whose numbers and names a line means, and where an instance is.
//
// Numbers of nodes and elements are those of a part. Here the number k of instance i (from 0) is k + (i + 1) 10^12, and
// its set S is called `I.S` as outside of it; numbers and names of no instance stay as they are. At the end all numbers
// become small again, with the same distance from instance to instance, a power of ten: 5 of the second may be 105.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::files {

using Vec3 = Eigen::Vector3d;

/// A copy of a part: x = about + turn (x of the part + shift - about).
struct Placement {
  Vec3 shift = Vec3::Zero(), about = Vec3::Zero();
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();

  Vec3 operator()(const Vec3& x) const { return about + turn * (x + shift - about); }
};

/// By an angle in degrees about the axis from a to b; nothing if they are one point. Quarter turns are exact.
std::optional<Eigen::Matrix3d> turn_about(const Vec3& a, const Vec3& b, double degrees);

class AbaqusInstances {
 public:
  static constexpr int none = -1;
  static constexpr std::int64_t spacing = 1'000'000'000'000;

  int add(const std::string& name, const Placement& placement);
  std::size_t count() const { return names_.size(); }
  const std::vector<std::string>& names() const { return names_; }
  const Placement& placement(int instance) const { return placements_[static_cast<std::size_t>(instance)]; }

  /// Number of an instance, in any case; `none` if there is none of this name.
  int find(std::string_view name) const;
  /// `Block-1.5` as instance and rest; nothing if no instance is called what stands before a dot.
  std::optional<std::pair<int, std::string>> split(std::string_view name) const;

  std::string full_name(int instance, const std::string& name) const;
  static std::int64_t full_number(int instance, std::int64_t number) { return number + (instance + 1) * spacing; }

 private:
  std::vector<std::string> names_;
  std::vector<Placement> placements_;
};

/// From numbers of instances to small ones.
class SmallNumbers {
 public:
  /// `instances`: how many there are. All numbers must be added before one is asked for.
  explicit SmallNumbers(std::size_t instances) : largest_(instances + 1, 0) {}
  void add(std::int64_t number);
  /// What is added to the numbers of an instance, `none` included.
  std::int64_t offset(int instance) const;
  std::int64_t operator()(std::int64_t number) const;
  std::int64_t largest(int instance) const { return largest_[static_cast<std::size_t>(instance + 1)]; }

 private:
  std::vector<std::int64_t> largest_;  // by instance, the first of no instance
};

}  // namespace scabo::files
