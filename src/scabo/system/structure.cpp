#include "scabo/system/structure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "scabo/base/stopwatch.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/linalg/symmetric_positive_solver.hpp"
#include "scabo/mesh/plane/crack_faces.hpp"
#include "scabo/model/side_faces.hpp"
#include "scabo/system/assembly.hpp"
#include "scabo/system/loads.hpp"
#include "scabo/system/lost_digits.hpp"

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
      : model_(model), mesh_(mesh), dofs_(dofs), constraints_(dofs.parts()), held_by_(dofs.parts()) {}

  void add(int index) {
    const model::Support& support = model_.supports[static_cast<std::size_t>(index)];
    const auto body = static_cast<std::size_t>(support.on.body);
    const std::size_t part = dofs_.part_of(support.on.body);
    if (support.rotation)
      constraints_[part].push_back(
          {-1, Vec2::Zero(), 0, true, index, *support.rotation * half_size(model_.bodies[body].outline), Vec2::Zero()});
    for (int component = 0; component < 2; ++component) {
      const auto value = support.displacement[static_cast<std::size_t>(component)];
      if (!value) continue;
      if (model_.bodies[body].rigid) {
        const std::vector<Vec2> points =
            support.at ? std::vector<Vec2>{*support.at} : rigid_points(support.on, model_.bodies[body]);
        for (const Vec2& point : points)
          constraints_[part].push_back(constraint_along(support, component, point, index, *value));
        if (!support.rotation && support.on.kind == model::Place::Kind::body && !dofs_.revolved() &&
            !holds_rotation(part))
          constraints_[part].push_back({-1, Vec2::Zero(), component, true, index, 0.0, Vec2::Zero()});
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

  std::vector<std::vector<Constraint>> finish() {
    if (!diagnostics_.empty()) throw InputError(model_.file, std::move(diagnostics_));
    return std::move(constraints_);
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

  bool holds_rotation(std::size_t part) const {
    for (const Constraint& constraint : constraints_[part])
      if (constraint.rotation) return true;
    return false;
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
    Constraint made{-1, point, axis, false, index, value, Vec2::Zero()};
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
    made.inclined = along;
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

  /// Adds a constraint of a node, unless others hold it already.
  void add(int body, int node, Constraint made) {
    const std::size_t part = dofs_.part_of(body);
    if (dofs_.is_on_axis(part, made.point) && !holds_along_axis(body, node, made)) return;
    const int first = dofs_.of(body, node, 0);
    std::vector<std::size_t>& others = held_by_[part][first];
    const auto other = [&](std::size_t k) -> const Constraint& { return constraints_[part][others[k]]; };
    for (std::size_t k = 0; k < others.size(); ++k) {
      if (std::abs(cross(made.direction(), other(k).direction())) > parallel) continue;
      const double value = std::copysign(made.value, made.value * made.direction().dot(other(k).direction()));
      const bool both_zero = value == 0.0 && other(k).value == 0.0;
      const bool same = both_zero || (value == other(k).value && same_history(model_, made.support, other(k).support));
      if (!same) report(body, node, made, other(k));
      return;
    }
    if (others.size() == 2) {  // it follows from the two
      const Vec2 d = made.direction(), a = other(0).direction(), b = other(1).direction();
      const double of_a = cross(d, b) / cross(a, b), of_b = cross(a, d) / cross(a, b);
      const double follows = of_a * other(0).value + of_b * other(1).value;
      const double size = std::abs(of_a * other(0).value) + std::abs(of_b * other(1).value) + std::abs(made.value);
      const bool same = std::abs(follows - made.value) <= 1e-12 * size &&
                        (size == 0.0 || (same_history(model_, made.support, other(0).support) &&
                                         same_history(model_, made.support, other(1).support)));
      if (!same) report(body, node, made, other(0));
      return;
    }
    const int place = others.empty() ? std::max(made.component, 0) : 1 - plane_components.component_of(other(0).dof);
    if (made.component != place) made.inclined = made.direction(), made.component = -1;
    made.dof = first + place;
    made.point = Vec2::Zero();
    others.push_back(constraints_[part].size());
    constraints_[part].push_back(made);
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
  std::vector<std::vector<Constraint>> constraints_;
  std::vector<std::map<int, std::vector<std::size_t>>> held_by_;  // per node, by its first degree of freedom
  std::set<std::array<int, 2>> reported_;                         // pairs of supports
  std::set<const model::PointFormula*> without_number_;           // reported
  std::vector<Diagnostic> diagnostics_;
};

std::unique_ptr<BodySystem> make_rigid_body(const model::Model& model, const model::Body& body,
                                            std::vector<Constraint> constraints, const Springs& springs) {
  std::string contradiction;
  const int last_support = constraints.empty() ? -1 : constraints.back().support;
  auto system = rigid_body(body.outline.centroid(), half_size(body.outline), std::move(constraints), springs,
                           contradiction, model.analysis.revolved());
  if (!contradiction.empty())
    throw InputError(model.file, {{model.supports[static_cast<std::size_t>(last_support)].source,
                                   fmt::format("the supports of rigid body '{}' contradict each other: a rigid body "
                                               "can only {}",
                                               body.name,
                                               model.analysis.revolved() ? "move along the axis as a whole"
                                                                         : "translate and rotate as a whole")}});
  return system;
}

/// For each part: whether it has a contact with pairs, or a bar, other than with itself.
std::vector<bool> in_contact(const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs) {
  std::vector<bool> found(dofs.parts(), false);
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    if (!mesh.interfaces[c].pairs.empty() &&
        dofs.part_of(model.contacts[c].a.body) != dofs.part_of(model.contacts[c].b.body))
      for (const int body : {model.contacts[c].a.body, model.contacts[c].b.body}) found[dofs.part_of(body)] = true;
  for (const model::Bar& bar : model.bars) {
    const auto part = [&](const model::Bar::End& end) {
      return end.on ? dofs.part_of(end.on->body) : PairSide::ground;
    };
    const std::size_t a = part(bar.between[0]), b = part(bar.between[1]);
    for (const std::size_t p : {a, b})
      if (a != b && p != PairSide::ground) found[p] = true;
  }
  return found;
}

}  // namespace

double half_size(const model::Outline& outline) {
  Vec2 low = outline.edges.front().start, high = low;
  for (const model::Edge& edge : outline.edges)
    for (double t : {0.0, 0.5}) low = low.cwiseMin(edge.at(t)), high = high.cwiseMax(edge.at(t));
  return 0.5 * (high - low).norm();
}

std::vector<Vec2> rigid_points(const model::Place& place, const model::Body& body) {
  const auto index = static_cast<std::size_t>(place.index);
  switch (place.kind) {
    case model::Place::Kind::body:
      return {body.outline.centroid()};
    case model::Place::Kind::edge:
      return {body.outline.edges[index].start, body.outline.edges[index].end};
    case model::Place::Kind::corner:
      return {body.outline.corners[index].position};
    case model::Place::Kind::near:
      return {place.near};
    case model::Place::Kind::face:
    case model::Place::Kind::mouth:
      break;  // only for elastic bodies
  }
  return {};
}

std::vector<std::vector<Constraint>> constraints_of(const model::Model& model, const mesh::Mesh& mesh,
                                                    const Dofs& dofs) {
  ConstraintCollector collector(model, mesh, dofs);
  for (std::size_t s = 0; s < model.supports.size(); ++s) collector.add(static_cast<int>(s));
  return collector.finish();
}

void check_supports(const model::Model& model, const mesh::Mesh& mesh) {
  const Dofs dofs(model, mesh);
  const auto constraints = constraints_of(model, mesh, dofs);
  const ModelSprings springs = springs_of(model, mesh, dofs);
  const std::vector<bool> touched = in_contact(model, mesh, dofs);
  std::vector<Diagnostic> diagnostics;
  for (std::size_t p = 0; p < dofs.parts(); ++p) {
    const std::vector<int>& bodies = dofs.bodies_of(p);
    const model::Body& body = model.bodies[static_cast<std::size_t>(bodies.front())];
    if (dofs.is_unbounded(p) || touched[p]) continue;
    Vec2 reference;
    double lever = 0.0;
    Matrix free;
    if (body.rigid) {
      const auto system = make_rigid_body(model, body, constraints[p], springs.of_part[p]);
      reference = system->reference();
      lever = system->lever();
      free = system->rigid_coordinates();
    } else {
      free =
          free_motions(dofs.nodes(p), constraints[p], springs.of_part[p].directions, reference, lever, dofs.revolved());
    }
    if (free.cols() == 0) continue;
    std::string motions;
    for (Eigen::Index k = 0; k < free.cols(); ++k)
      motions += (k > 0 ? ", " : "") + describe_motion(free.col(k), reference, lever);
    const std::string what = bodies.size() == 1 ? "this body is insufficiently supported: it is"
                                                : dofs.name_of(p, model) + " are insufficiently supported: they are";
    diagnostics.push_back(
        {body.source,
         fmt::format("{} free to move by {}; add a support or springs that prevent this motion, or a contact", what,
                     motions)});
  }
  if (!diagnostics.empty()) throw InputError(model.file, std::move(diagnostics));
}

namespace {

/// Degrees of freedom of every elastic part that belong to pairs and bars, ascending.
std::vector<std::vector<int>> dofs_in_contacts(const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs,
                                               const std::vector<BarSystem>& bars) {
  std::vector<std::vector<int>> of_part(dofs.parts());
  const auto add = [&](int body, int node) {
    if (node < 0) return;  // of a rigid body
    std::vector<int>& list = of_part[dofs.part_of(body)];
    for (int k = 0; k < dofs.components().dimension; ++k) list.push_back(dofs.of(body, node, k));
  };
  for (std::size_t c = 0; c < mesh.interfaces.size(); ++c)
    for (const mesh::ContactPair& pair : mesh.interfaces[c].pairs) {
      add(model.contacts[c].a.body, pair.node_a);
      add(model.contacts[c].b.body, pair.node_b);
    }
  for (const BarSystem& bar : bars)
    for (const PairSide* side : {&bar.a, &bar.b})
      for (const PairSide::Node& node : side->nodes)
        for (int k = 0; k < dofs.components().dimension; ++k)
          of_part[side->part].push_back(static_cast<int>(dofs.components().of(node.node, k)));
  for (std::vector<int>& list : of_part) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return of_part;
}

}  // namespace

Structure make_structure(const model::Model& model, const mesh::Mesh& mesh,
                         const std::vector<element::SolvedCells>& cells, int threads, Ranks* ranks) {
  Structure structure;
  structure.dofs = Dofs(model, mesh);
  const Dofs& dofs = structure.dofs;
  linalg::SparseOptions options;
  if (model.solver.factorisation == model::Factorisation::mumps) options.library = linalg::SparseLibrary::mumps;
  if (ranks && options.library == linalg::SparseLibrary::mumps)
    throw InputError(model.file, {{{0, 0, "solver.factorisation"},
                                   "with several ranks MUMPS factorises the bodies that are divided among them, and "
                                   "CHOLMOD the others, without being asked: leave this key out"}});
  if (!linalg::is_built_in(options.library))
    throw InputError(model.file, {{{0, 0, "solver.factorisation"},
                                   "the library of MUMPS was not found: write cholmod, "
                                   "or install libmumps-seq-dev"}});
  auto constraints = constraints_of(model, mesh, dofs);
  structure.springs = springs_of(model, mesh, dofs);
  structure.bars = bars_of(model, mesh, dofs);
  structure.parts.resize(dofs.parts());
  const auto body_of = [&](std::size_t p) -> const model::Body& {
    return model.bodies[static_cast<std::size_t>(dofs.bodies_of(p).front())];
  };
  std::vector<std::size_t> elastic;
  std::vector<ElasticPart> parts;
  std::vector<double> stiffest;  // of those on springs
  std::vector<std::vector<int>> contact_dofs = dofs_in_contacts(model, mesh, dofs, structure.bars);
  for (std::size_t p = 0; p < dofs.parts(); ++p) {
    if (body_of(p).rigid) {
      structure.parts[p] = make_rigid_body(model, body_of(p), std::move(constraints[p]), structure.springs.of_part[p]);
      continue;
    }
    elastic.push_back(p);
    Stiffness stiffness = timed(structure.assembly_seconds, [&] {
      if (!is_divided(ranks, model, mesh, dofs, p)) return part_stiffness(model, mesh, cells, dofs, p, threads);
      Stiffness divided;
      divided.divided = ranks->stiffness(model, mesh, dofs, p, threads);
      divided.rounding = std::max(divided.rounding, divided.divided->rounding());
      return divided;
    });
    stiffness.springs = structure.springs.of_part[p];
    stiffest.push_back(stiffness.springs.none() || stiffness.divided ? 0.0 : stiffness.largest_diagonal());
    parts.push_back({std::move(stiffness), dofs.nodes(p), std::move(constraints[p]), std::move(contact_dofs[p])});
  }
  try {
    auto bodies = elastic_bodies(std::move(parts), threads, options);
    for (std::size_t k = 0; k < elastic.size(); ++k) structure.parts[elastic[k]] = std::move(bodies[k]);
  } catch (const NotPositiveDefinitePart& failed) {
    const std::size_t part = elastic[failed.part];
    const Springs& springs = structure.springs.of_part[part];
    const double stiffness_of_springs = springs.none() ? 0.0 : Vector(springs.matrix.diagonal()).maxCoeff();
    throw InputError(model.file, {{body_of(part).source,
                                   fmt::format("its stiffness matrix is not positive definite to working precision: {}",
                                               why_digits_are_lost(model, mesh, dofs.bodies_of(part),
                                                                   stiffness_of_springs, stiffest[failed.part]))}});
  }
  return structure;
}

}  // namespace scabo::system
