// What supports hold at the nodes of elastic bodies and at the points of rigid ones.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/mesh/plane/crack_faces.hpp"
#include "scabo/model/side_faces.hpp"
#include "scabo/system/structure.hpp"

namespace scabo::system {

namespace {

constexpr const char* component_name[2] = {"x", "y"};

/// Whether the two supports have the same motion in every step.
bool same_history(const model::Model& model, int a, int b) {
  for (const model::Step& step : model.steps)
    if (step.support_factors[static_cast<std::size_t>(a)] != step.support_factors[static_cast<std::size_t>(b)] ||
        model::support_curve(step, static_cast<std::size_t>(a)) !=
            model::support_curve(step, static_cast<std::size_t>(b)))
      return false;
  return true;
}

class ConstraintCollector {
 public:
  ConstraintCollector(const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs)
      : model_(model),
        mesh_(mesh),
        dofs_(dofs),
        constraints_(dofs.parts()),
        staged_(dofs.parts()),
        held_by_(dofs.parts()),
        staged_by_(dofs.parts()) {}

  void add(int index) {
    const model::Support& support = model_.supports[static_cast<std::size_t>(index)];
    const auto body = static_cast<std::size_t>(support.on.body);
    const std::size_t part = dofs_.part_of(support.on.body);
    std::vector<Constraint>& of_part = (support.is_staged() ? staged_ : constraints_)[part];
    if (support.rotation)
      of_part.push_back({-1, Vec2::Zero(), 0, true, index, *support.rotation * half_size(model_.bodies[body].outline)});
    for (int component = 0; component < 2; ++component) {
      const auto value = support.displacement[static_cast<std::size_t>(component)];
      if (!value) continue;
      if (model_.bodies[body].rigid) {
        const std::vector<Vec2> points =
            support.at ? std::vector<Vec2>{*support.at} : rigid_points(support.on, model_.bodies[body]);
        for (const Vec2& point : points) of_part.push_back(constraint_along(support, component, point, index, *value));
        if (!support.rotation && support.on.kind == model::Place::Kind::body && !dofs_.revolved() &&
            !holds_rotation(of_part, index, support.is_staged()))
          of_part.push_back({-1, Vec2::Zero(), component, true, index, 0.0});
        continue;
      }
      const std::vector<int> nodes = mesh::nodes_of(support.on, mesh_).nodes;
      const bool of_face = support.on.kind == model::Place::Kind::face && support.axes == model::SupportAxes::edge;
      const std::map<int, Vec2> normals = of_face ? normals_at(support.on, nodes) : std::map<int, Vec2>{};
      for (const int node : nodes) {
        const Vec2& point = mesh_.bodies[body].nodes[static_cast<std::size_t>(node)];
        const double here = *value * shape_at(support, component, point);
        add(support.on.body, node,
            constraint_along(support, component, point, index, here, of_face ? &normals.at(node) : nullptr));
      }
    }
  }

  struct Found {
    std::vector<std::vector<Constraint>> constraints, staged;
  };
  Found finish() {
    if (!diagnostics_.empty()) throw InputError(model_.file, std::move(diagnostics_));
    return {std::move(constraints_), std::move(staged_)};
  }

 private:
  double shape_at(const model::Support& support, int component, const Vec2& point) {
    const model::PointFormula& shape = support.shape[static_cast<std::size_t>(component)];
    if (!shape) return 1.0;
    const auto value = shape(point);
    if (const auto* number = std::get_if<double>(&value)) return *number;
    if (without_number_.insert(&shape).second)
      diagnostics_.push_back({support.source, fmt::format("the formula for u{} of support '{}' {} at ({:.6g}, {:.6g})",
                                                          component_name[component], support.name,
                                                          std::get<std::string>(value), point.x(), point.y())});
    return 0.0;
  }

  /// Whether a rigid body does not turn already; of a support that is staged, by itself.
  static bool holds_rotation(const std::vector<Constraint>& constraints, int support, bool staged) {
    return std::any_of(constraints.begin(), constraints.end(), [&](const Constraint& constraint) {
      return constraint.rotation && (!staged || constraint.support == support);
    });
  }

  /// Outward normals at the nodes of a face.
  std::map<int, Vec2> normals_at(const model::Place& face, const std::vector<int>& nodes) const {
    const model::Body& body = model_.bodies[static_cast<std::size_t>(face.body)];
    if (model::has_divided_faces(body))
      return mesh::normals_of_face(mesh_.bodies[static_cast<std::size_t>(face.body)], face.index);
    std::map<int, Vec2> normals;  // without the rounding of the nodes near the scaling centre
    for (const int node : nodes) normals.emplace(node, model::side_face_normal(body, face.index));
    return normals;
  }

  /// A constraint at a point along axis 0 or 1 of a support; axes along x or y, in either sense, become x and y.
  /// `normal`: that of the face of a crack; without it, the one of the edge.
  Constraint constraint_along(const model::Support& support, int axis, const Vec2& point, int index, double value,
                              const Vec2* normal = nullptr) const {
    Constraint made{-1, point, axis, false, index, value};
    if (support.axes == model::SupportAxes::xy) return made;
    Vec2 first = support.along;
    if (normal != nullptr) {
      first = *normal;
    } else if (support.axes == model::SupportAxes::edge) {
      const model::Outline& outline = model_.bodies[static_cast<std::size_t>(support.on.body)].outline;
      first = geometry::foot_on(outline.edges[static_cast<std::size_t>(support.on.index)], point)->normal;
    }
    const Vec2 along = axis == 0 ? first : Vec2(-first.y(), first.x());
    for (int k = 0; k < 2; ++k)
      if (std::abs(along[1 - k]) < 1e-14) {
        made.component = k;
        made.value = std::copysign(1.0, along[k]) * value;
        return made;
      }
    made.component = -1;
    made.inclined << along, 0.0;
    return made;
  }

  /// Of a node on the axis of revolution, whose radius stays: whether the constraint says more, then of its motion
  /// along the axis.
  bool holds_along_axis(int body, int node, Constraint& made) {
    const Vec2 d = made.direction();
    if (std::abs(d.y()) > parallel) {
      made.component = 1;
      made.value /= d.y();
      return true;
    }
    if (made.value != 0.0 && reported_.insert({made.support, made.support}).second) {
      const model::Support& support = model_.supports[static_cast<std::size_t>(made.support)];
      const Vec2& x = mesh_.bodies[static_cast<std::size_t>(body)].nodes[static_cast<std::size_t>(node)];
      diagnostics_.push_back(
          {support.source, fmt::format("support '{}' moves the point ({:.6g}, {:.6g}) away from the axis "
                                       "of revolution, where the radius stays 0: let its edge end "
                                       "beside the axis",
                                       support.name, x.x(), x.y())});
    }
    return false;
  }

  /// Whether two constraints of a node along one direction say the same.
  bool agree(const Constraint& made, const Constraint& other) const {
    const double value = std::copysign(made.value, made.value * made.direction().dot(other.direction()));
    const bool both_zero = value == 0.0 && other.value == 0.0;
    return both_zero || (value == other.value && same_history(model_, made.support, other.support));
  }

  /// Whether the constraints of a node that last hold the motion of another one already; says so if they do otherwise.
  bool is_held(int body, int node, const Constraint& made) {
    const std::size_t part = dofs_.part_of(body);
    const std::vector<std::size_t>& others = held_by_[part][dofs_.of(body, node, 0)];
    const auto other = [&](std::size_t k) -> const Constraint& { return constraints_[part][others[k]]; };
    for (std::size_t k = 0; k < others.size(); ++k) {
      if (std::abs(cross(made.direction(), other(k).direction())) > parallel) continue;
      if (!agree(made, other(k))) report(body, node, made, other(k));
      return true;
    }
    if (others.size() < 2) return false;
    // It follows from the two.
    const Vec2 d = made.direction(), a = other(0).direction(), b = other(1).direction();
    const double of_a = cross(d, b) / cross(a, b), of_b = cross(a, d) / cross(a, b);
    const double follows = of_a * other(0).value + of_b * other(1).value;
    const double size = std::abs(of_a * other(0).value) + std::abs(of_b * other(1).value) + std::abs(made.value);
    const bool same = std::abs(follows - made.value) <= 1e-12 * size &&
                      (size == 0.0 || (same_history(model_, made.support, other(0).support) &&
                                       same_history(model_, made.support, other(1).support)));
    if (!same) report(body, node, made, other(0));
    return true;
  }

  /// Adds a constraint of a node, unless others hold it already.
  void add(int body, int node, Constraint made) {
    const std::size_t part = dofs_.part_of(body);
    if (dofs_.is_on_axis(part, made.point) && !holds_along_axis(body, node, made)) return;
    const int first = dofs_.of(body, node, 0);
    made.dof = first + std::max(made.component, 0);
    if (is_held(body, node, made)) return;
    made.point = Vec2::Zero();
    if (model_.supports[static_cast<std::size_t>(made.support)].is_staged()) return add_staged(body, node, made);
    std::vector<std::size_t>& others = held_by_[part][first];
    const auto component_of = [&](std::size_t k) {
      return plane_components.component_of(constraints_[part][others[k]].dof);
    };
    const int place = others.empty() ? std::max(made.component, 0) : 1 - component_of(0);
    if (made.component != place) {
      made.inclined << made.direction(), 0.0;
      made.component = -1;
    }
    made.dof = first + place;
    others.push_back(constraints_[part].size());
    constraints_[part].push_back(made);
  }

  /// Of a support that begins or ends: another one like it that is there at all its times holds the node for both.
  void add_staged(int body, int node, const Constraint& made) {
    const std::size_t part = dofs_.part_of(body);
    const model::Support& support = model_.supports[static_cast<std::size_t>(made.support)];
    std::vector<std::size_t>& others = staged_by_[part][dofs_.of(body, node, 0)];
    for (const std::size_t k : others) {
      const Constraint& other = staged_[part][k];
      const model::Support& by = model_.supports[static_cast<std::size_t>(other.support)];
      if (std::abs(cross(made.direction(), other.direction())) > parallel || !by.meets(support)) continue;
      if (!agree(made, other)) return report(body, node, made, other);
      if (by.covers(support)) return;
    }
    others.push_back(staged_[part].size());
    staged_[part].push_back(made);
  }

  void report(int body, int node, const Constraint& made, const Constraint& other) {
    if (!reported_.insert({made.support, other.support}).second)
      return;  // one message, also where edges share many nodes
    const model::Support& support = model_.supports[static_cast<std::size_t>(made.support)];
    const model::Support& with = model_.supports[static_cast<std::size_t>(other.support)];
    const Vec2& x = mesh_.bodies[static_cast<std::size_t>(body)].nodes[static_cast<std::size_t>(node)];
    diagnostics_.push_back(
        {support.source,
         fmt::format("support '{}' prescribes {} at ({:.6g}, {:.6g}), where support '{}' (line {}) prescribes "
                     "another value: give both the same value there, or move one of them",
                     support.name,
                     made.component < 0
                         ? fmt::format("the displacement along ({:.4g}, {:.4g})", made.inclined.x(), made.inclined.y())
                         : component_name[made.component],
                     x.x(), x.y(), with.name, with.source.line)});
  }

  static constexpr double parallel = 1e-6;  // sine of the angle between directions that count as one
  const model::Model& model_;
  const mesh::Mesh& mesh_;
  const Dofs& dofs_;
  std::vector<std::vector<Constraint>> constraints_, staged_;
  /// Per node, by its first degree of freedom: those of `constraints_`, and of `staged_`.
  std::vector<std::map<int, std::vector<std::size_t>>> held_by_, staged_by_;
  std::set<std::array<int, 2>> reported_;                // pairs of supports
  std::set<const model::PointFormula*> without_number_;  // reported
  std::vector<Diagnostic> diagnostics_;
};

/// Those that last, then those that begin or end, each after all that cover it.
std::vector<int> order_of(const std::vector<model::Support>& supports) {
  std::vector<int> order(supports.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key_of = [&](int i) {
    const model::Support& support = supports[static_cast<std::size_t>(i)];
    const int last = support.removed < 0 ? std::numeric_limits<int>::max() : support.removed;
    return std::tuple(support.is_staged(), support.added, -last);
  };
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return key_of(i) < key_of(j); });
  return order;
}

ConstraintCollector::Found all_constraints(const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs) {
  ConstraintCollector collector(model, mesh, dofs);
  for (const int s : order_of(model.supports)) collector.add(s);
  return collector.finish();
}

}  // namespace

std::vector<std::vector<Constraint>> constraints_of(const model::Model& model, const mesh::Mesh& mesh,
                                                    const Dofs& dofs) {
  return all_constraints(model, mesh, dofs).constraints;
}

std::vector<std::vector<Constraint>> staged_constraints_of(const model::Model& model, const mesh::Mesh& mesh,
                                                           const Dofs& dofs) {
  return all_constraints(model, mesh, dofs).staged;
}

std::vector<std::vector<Constraint>> constraints_of_support(const model::Model& model, const mesh::Mesh& mesh,
                                                            const Dofs& dofs, std::size_t support) {
  ConstraintCollector collector(model, mesh, dofs);
  collector.add(static_cast<int>(support));
  auto found = collector.finish();
  return model.supports[support].is_staged() ? std::move(found.staged) : std::move(found.constraints);
}

}  // namespace scabo::system
