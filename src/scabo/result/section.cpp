#include "scabo/result/section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/element/cell_locator.hpp"
#include "scabo/geometry/line_basis.hpp"

namespace scabo::result {

namespace {

constexpr int gauss_points = 8;
/// Of two parts of a line in different bodies: more is a line along their border, less an interference.
constexpr double most_overlap = 0.1;

/// Crossings of a line with other lines, as parts of its length.
class Cuts {
 public:
  Cuts(const Vec2& from, const Vec2& to) : from_(from), along_(to - from) {}

  /// Adds the crossing with the line from a to b, if there is one.
  void add(const Vec2& a, const Vec2& b) {
    const Vec2 other = b - a;
    const double determinant = cross(along_, other);
    if (std::abs(determinant) <= 1e-14 * along_.norm() * other.norm()) return;  // parallel
    const double t = cross(a - from_, other) / determinant, s = cross(a - from_, along_) / determinant;
    constexpr double slack = 1e-9;
    if (t > 0.0 && t < 1.0 && s >= -slack && s <= 1.0 + slack) at_.push_back(t);
  }

  /// Adds the crossing with the line on which direction . x is `place`.
  void add(const Vec2& direction, double place) {
    const double slope = direction.dot(along_);
    if (std::abs(slope) <= 1e-14 * along_.norm()) return;
    const double t = (place - direction.dot(from_)) / slope;
    if (t > 0.0 && t < 1.0) at_.push_back(t);
  }

  /// 0, the crossings in ascending order, 1.
  std::vector<double> sorted() {
    at_.push_back(0.0), at_.push_back(1.0);
    std::sort(at_.begin(), at_.end());
    const auto same = [](double a, double b) { return b - a <= 1e-12; };
    at_.erase(std::unique(at_.begin(), at_.end(), same), at_.end());
    at_.back() = 1.0;
    return std::move(at_);
  }

 private:
  Vec2 from_, along_;
  std::vector<double> at_;
};

void add_cell(const mesh::BodyMesh& mesh, const mesh::Cell& cell, Cuts& cuts) {
  const bool rays = cell.kind == mesh::CellKind::superelement;
  for (const mesh::LineElement& element : cell.boundary) {
    const auto node = [&](std::size_t k) -> const Vec2& {
      return mesh.nodes[static_cast<std::size_t>(element.nodes[k])];
    };
    for (std::size_t k = 0; k + 1 < element.nodes.size(); ++k) cuts.add(node(k), node(k + 1));
    if (!rays) continue;
    cuts.add(cell.centre, node(0));
    cuts.add(cell.centre, node(element.nodes.size() - 1));
  }
}

/// Parts of the line in the body: the crossings with the sides and rays of its cells between which it runs.
std::vector<std::pair<double, double>> parts_in(const analysis::Discretisation& discretisation, std::size_t body,
                                                const model::Section& section) {
  const mesh::BodyMesh& mesh = discretisation.mesh.bodies[body];
  Cuts cuts(section.from, section.to);
  for (const mesh::Cell& cell : mesh.cells) add_cell(mesh, cell, cuts);
  for (const model::Load& load : discretisation.model.loads) {  // the stress bends where a table of temperatures does
    const auto* temperature = std::get_if<model::Temperature>(&load.kind);
    if (!temperature || !temperature->table || temperature->table->centre ||
        (load.on && load.on->body != static_cast<int>(body)))
      continue;
    for (const auto& point : temperature->table->points) cuts.add(temperature->table->along, point.at);
  }
  const std::vector<double> at = cuts.sorted();
  std::vector<std::pair<double, double>> parts;
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    const double middle = 0.5 * (at[i] + at[i + 1]);
    if (mesh::holds(discretisation.model.bodies[body], section.from + middle * (section.to - section.from)))
      parts.emplace_back(at[i], at[i + 1]);
  }
  return parts;
}

}  // namespace

std::vector<SectionPoint> points_of_section(const analysis::Discretisation& discretisation,
                                            const model::HistoryItem& item, const model::Section& section) {
  static const geometry::GaussRule rule = geometry::gauss_rule(gauss_points);
  const model::Model& model = discretisation.model;
  const Vec2 along = section.to - section.from;
  const double length = along.norm();
  const Vec2 n(-along.y() / length, along.x() / length);
  std::vector<SectionPoint> points;
  std::vector<std::pair<std::pair<double, double>, std::size_t>> taken;  // parts of the line with their bodies
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].rigid || (section.body >= 0 && static_cast<std::size_t>(section.body) != b)) continue;
    for (const auto& part : parts_in(discretisation, b, section)) {
      for (const auto& [other, other_body] : taken)
        if (std::min(part.second, other.second) - std::max(part.first, other.first) >
            most_overlap * std::min(part.second - part.first, other.second - other.first))
          throw InputError(
              model.file, {{item.source, fmt::format("the line runs along the border of body '{}' and body '{}', which "
                                                     "both have stress there: name one of them with 'body'",
                                                     model.bodies[other_body].name, model.bodies[b].name)}});
      for (std::size_t g = 0; g < rule.points.size(); ++g) {
        const double t = part.first + 0.5 * (1.0 + rule.points[g]) * (part.second - part.first);
        SectionPoint point;
        point.at.name = item.name;
        point.at.body = static_cast<int>(b);
        point.at.at = section.from + t * along;
        point.normal = n;
        point.arm = (t - 0.5) * along;
        point.weight = 0.5 * rule.weights[g] * (part.second - part.first) * length *
                       model::extent_of(model, point.at.body).at(point.at.at.x());
        points.push_back(std::move(point));
      }
    }
    for (const auto& part : parts_in(discretisation, b, section)) taken.emplace_back(part, b);
  }
  if (points.empty())
    throw InputError(
        model.file,
        {{item.source, section.body >= 0 ? fmt::format("the line does not cut body '{}': move it",
                                                       model.bodies[static_cast<std::size_t>(section.body)].name)
                                         : "the line cuts no elastic body: move it"}});
  return points;
}

}  // namespace scabo::result
