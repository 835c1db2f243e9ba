#include "scabo/convert/write_supports.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "scabo/files/text_cursor.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::convert {

namespace {

using model::number_text;

class SupportWriter {
 public:
  explicit SupportWriter(SolidModelWriter& to) : to_(to) {}

  void write() {
    collect();
    for (const auto& [body, of] : radial_) hold_cylinder(body, of);
    add_clamped_nodes();
    write_directions();
  }

 private:
  using Direction = std::array<double, 3>;

  /// Nodes of a body that are held alike.
  struct HeldAlike {
    std::set<int> nodes;
    std::string label;
    files::DeckPlace at;

    void add(int node, const Given& given) {
      nodes.insert(node);
      if (label.empty()) label = given.label, at = given.at;
    }
  };

  void collect() {
    for (const auto& [at, given] : to_.content.displacements) {
      to_.tell_stages(given);
      const int first = to_.bodies.of_node[static_cast<std::size_t>(at.first)];
      if (to_.bodies.bodies[static_cast<std::size_t>(first)].rigid) {
        to_.remarks.essential(given.at, "the support holds nodes of a rigid body; hold its reference node");
        continue;
      }
      std::vector<int> bodies{first};
      if (const auto further = to_.bodies.further_of.find(at.first); further != to_.bodies.further_of.end())
        bodies.insert(bodies.end(), further->second.begin(), further->second.end());
      const auto own = to_.axes.find(at.first);
      const bool along_radius = at.second == 0 && own != to_.axes.end() && own->second.radius > 0.0 &&
                                is_zero(given.course) && !is_clamped(at.first);
      for (const int body : bodies)
        if (along_radius)
          radial_[body].add(at.first, given);
        else
          hold(body, at.first, at.second, given);
    }
  }

  /// Whether a node is fixed along all of its axes, so that they do not matter.
  bool is_clamped(int node) const {
    for (int component = 0; component < 3; ++component) {
      const auto given = to_.content.displacements.find({node, component});
      if (given == to_.content.displacements.end() || !is_zero(given->second.course)) return false;
    }
    return true;
  }

  void hold(int body, int node, int component, const Given& given) {
    const Course course = is_zero(given.course) ? Course(given.course.size()) : given.course;
    const auto own = to_.axes.find(node);
    const bool clamped = own != to_.axes.end() && is_clamped(node);
    if (own == to_.axes.end() || clamped) {
      Direction direction{};
      direction[static_cast<std::size_t>(component)] = 1.0;
      held_[{body, direction, course}].add(node, given);
      if (clamped) clamped_[{body, along(own->second.rows.row(component)).first, course}].push_back(node);
      return;
    }
    const auto [direction, sense] = along(own->second.rows.row(component));
    held_[{body, direction, sense > 0.0 ? course : scaled(course, sense)}].add(node, given);
    constexpr std::size_t most = 4;  // for one label, as of two planes
    std::set<Direction>& directions = directions_[{body, given.label, component}];
    directions.insert(direction);
    if (directions.size() > most)
      to_.remarks.essential(given.at, fmt::format("the axes of '{}' by *TRANSFORM turn from node to node; in the "
                                                  "model, hold the face by {{on: {}.FACE, fix: normal}}",
                                                  files::printable(given.label), to_.name_of(body)));
  }

  /// Sides between nodes that are held along a direction have corners that are clamped.
  void add_clamped_nodes() {
    for (const auto& [key, nodes] : clamped_)
      if (const auto found = held_.find(key); found != held_.end())
        found->second.nodes.insert(nodes.begin(), nodes.end());
  }

  /// The direction of an axis, rounded and with its largest component positive, so that nodes of one plane have the
  /// same one; and its sense along the axis.
  static std::pair<Direction, double> along(const Eigen::Vector3d& axis) {
    Eigen::Index largest = 0;
    (axis.cwiseAbs().array() > 0.5 * axis.cwiseAbs().maxCoeff()).maxCoeff(&largest);  // the first large one
    const double sense = axis[largest] > 0.0 ? 1.0 : -1.0;
    Direction direction{};
    for (int k = 0; k < 3; ++k)
      direction[static_cast<std::size_t>(k)] = std::round(1e10 * sense * axis[k]) / 1e10 + 0.0;
    return {direction, sense};
  }

  // ---- radii

  static bool are_equal(double radius, double other) { return std::abs(radius - other) <= 1e-6 * other; }

  /// Sides of nodes that are fixed along radii are held along their normals; nodes of no such side by themselves.
  void hold_cylinder(int body, const HeldAlike& of) {
    const double first = to_.axes.at(*of.nodes.begin()).radius;
    if (!std::all_of(of.nodes.begin(), of.nodes.end(),
                     [&](int node) { return are_equal(to_.axes.at(node).radius, first); }))
      return to_.remarks.essential(of.at,
                                   fmt::format("nodes of '{}' are held along radii by *TRANSFORM, and do not lie on "
                                               "one cylinder; hold the cylinders one by one",
                                               files::printable(of.label)));
    const std::vector<int> sides = sides_of_cylinder(body, of.nodes, first);
    std::set<int> single = of.nodes;
    for (const int side : sides)
      for (const int node : nodes_of(side)) single.erase(node);
    for (const int node : single) hold(body, node, 0, to_.content.displacements.at({node, 0}));
    if (sides.empty()) return;
    const std::string set = to_.set_of(to_.sets.sides, sides, of.label);
    add(body, set, "fix: normal", to_.names.take(set));
  }

  std::vector<int> nodes_of(int side) const {
    return files::nodes_of_side(to_.deck.solid->cells[static_cast<std::size_t>(side / 4)], side % 4);
  }

  /// Outer sides of a body between nodes that are fixed along their radii, or in all directions. A side at the end of a
  /// shaft may have all of its corners on the rim: its normal is not a radius, and it is left out.
  std::vector<int> sides_of_cylinder(int body, const std::set<int>& held, double radius) const {
    std::set<int> among = held;
    for (const auto& [node, axes] : to_.axes)
      if (axes.radius > 0.0 && are_equal(axes.radius, radius) && is_clamped(node)) among.insert(node);
    std::vector<int> sides;
    for (const int side : to_.bodies.outer) {
      if (to_.bodies.of_cell[static_cast<std::size_t>(side / 4)] != body) continue;
      const std::vector<int> corners =
          files::corners_of(to_.deck.solid->cells[static_cast<std::size_t>(side / 4)], side % 4);
      const std::vector<int> nodes = nodes_of(side);
      if (std::all_of(corners.begin(), corners.end(), [&](int node) { return among.contains(node); }) &&
          std::any_of(nodes.begin(), nodes.end(), [&](int node) { return held.contains(node); }) &&
          faces_radii(corners))
        sides.push_back(side);
    }
    return sides;
  }

  /// Whether the normal of a side is within 30 degrees of the mean of the radii at its corners.
  bool faces_radii(const std::vector<int>& corners) const {
    const Eigen::Matrix3d x = to_.deck.solid->nodes(Eigen::all, corners);
    const Eigen::Vector3d area = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0));
    Eigen::Vector3d radius = Eigen::Vector3d::Zero();
    for (const int node : corners) radius += to_.axes.at(node).rows.row(0);
    return std::abs(area.dot(radius)) >= std::sqrt(0.75) * area.norm() * radius.norm();
  }

  // ---- the model

  void write_directions() {
    std::map<std::pair<int, std::string>, std::set<char>> fixed;  // body and set: the axes along which it is held
    for (const auto& [key, of] : held_) {
      const auto& [body, direction, course] = key;
      const std::string set = to_.set_of(to_.sets.nodes, {of.nodes.begin(), of.nodes.end()}, of.label);
      const auto axis = std::find(direction.begin(), direction.end(), 1.0);
      if (is_zero(course) && axis != direction.end()) {
        fixed[{body, set}].insert("xyz"[axis - direction.begin()]);
      } else {
        write_direction(body, set, direction, course);
      }
    }
    for (const auto& [at, axes] : fixed)
      add(at.first, at.second, fmt::format("fix: [{}]", fmt::join(axes, ", ")), to_.names.take(at.second));
  }

  void write_direction(int body, const std::string& set, const Direction& direction, const Course& course) {
    const std::string name = to_.names.take(set);
    const double scale = is_zero(course) ? 0.0 : scale_of(course);
    if (const auto axis = std::find(direction.begin(), direction.end(), 1.0); axis != direction.end()) {
      std::array<std::string, 3> values{"null", "null", "null"};
      values[static_cast<std::size_t>(axis - direction.begin())] = number_text(scale);
      add(body, set, fmt::format("displacement: [{}]", fmt::join(values, ", ")), name);
    } else if (scale == 0.0) {
      add(body, set, fmt::format("fix: {{along: {}}}", yaml_vector(direction)), name);
    } else {
      add(body, set, fmt::format("displacement: {{along: {}, value: {}}}", yaml_vector(direction), number_text(scale)),
          name);
    }
    if (scale != 0.0) to_.driven.push_back({name, scaled(course, 1.0 / scale)});
  }

  void add(int body, const std::string& set, const std::string& what, const std::string& name) {
    to_.parts.supports +=
        fmt::format("  - {{on: {}.{}, {}, name: {}}}\n", to_.name_of(body), set, what, yaml_word(name));
    ++to_.result.supports;
  }

  SolidModelWriter& to_;
  using Key = std::tuple<int, Direction, Course>;  // body, direction and course
  std::map<Key, HeldAlike> held_;
  std::map<Key, std::vector<int>> clamped_;  // along axes of their own
  std::map<int, HeldAlike> radial_;          // by body: nodes that are fixed along radii
  std::map<std::tuple<int, std::string, int>, std::set<Direction>> directions_;  // by body, label and component
};

}  // namespace

void write_supports(SolidModelWriter& writer) { SupportWriter(writer).write(); }

}  // namespace scabo::convert
