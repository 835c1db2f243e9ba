#include "scabo/system/structure.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <set>

#include "scabo/base/stopwatch.hpp"
#include "scabo/linalg/symmetric_positive_solver.hpp"
#include "scabo/system/assembly.hpp"
#include "scabo/system/loads.hpp"

namespace scabo::system {

namespace {

constexpr const char* component_name[2] = {"x", "y"};

/// Whether the two supports have the same motion in every step.
bool same_history(const model::Model& model, int a, int b) {
  for (const model::Step& step : model.steps)
    if (step.support_factors[static_cast<std::size_t>(a)] != step.support_factors[static_cast<std::size_t>(b)])
      return false;
  return true;
}

double half_size(const model::Outline& outline) {
  Vec2 low = outline.edges.front().start, high = low;
  for (const model::Edge& edge : outline.edges)
    for (double t : {0.0, 0.5}) low = low.cwiseMin(edge.at(t)), high = high.cwiseMax(edge.at(t));
  return 0.5 * (high - low).norm();
}

class ConstraintCollector {
 public:
  ConstraintCollector(const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs)
      : model_(model), mesh_(mesh), dofs_(dofs), constraints_(dofs.parts()), held_by_(dofs.parts()) {}

  void add(int index) {
    const model::Support& support = model_.supports[static_cast<std::size_t>(index)];
    const auto body = static_cast<std::size_t>(support.on.body);
    const std::size_t part = dofs_.part_of(support.on.body);
    for (int component = 0; component < 2; ++component) {
      const auto value = support.displacement[static_cast<std::size_t>(component)];
      if (!value) continue;
      if (model_.bodies[body].rigid) {
        for (const Vec2& point : rigid_points(support.on, model_.bodies[body]))
          constraints_[part].push_back({-1, point, component, false, index, *value});
        if (support.on.kind == model::Place::Kind::body && !holds_rotation(part))
          constraints_[part].push_back({-1, Vec2::Zero(), component, true, index, 0.0});
        continue;
      }
      for (int node : mesh::nodes_of(support.on, mesh_).nodes) add_dof(support.on.body, node, component, index, *value);
    }
  }

  std::vector<std::vector<Constraint>> finish() {
    if (!diagnostics_.empty()) throw InputError(model_.file, std::move(diagnostics_));
    return std::move(constraints_);
  }

 private:
  bool holds_rotation(std::size_t part) const {
    for (const Constraint& constraint : constraints_[part])
      if (constraint.rotation) return true;
    return false;
  }

  void add_dof(int body, int node, int component, int index, double value) {
    const std::size_t part = dofs_.part_of(body);
    const int dof = dofs_.of(body, node, component);
    const auto [at, added] = held_by_[part].emplace(dof, constraints_[part].size());
    if (added) {
      constraints_[part].push_back({dof, Vec2::Zero(), component, false, index, value});
      return;
    }
    const Constraint& other = constraints_[part][at->second];
    const bool both_zero = value == 0.0 && other.value == 0.0;
    if (both_zero || (value == other.value && same_history(model_, index, other.support))) return;
    if (!reported_.insert({index, other.support}).second) return;  // one message, also where edges share many nodes
    const model::Support& support = model_.supports[static_cast<std::size_t>(index)];
    const Vec2& x = mesh_.bodies[static_cast<std::size_t>(body)].nodes[static_cast<std::size_t>(node)];
    diagnostics_.push_back(
        {support.source,
         fmt::format("support '{}' prescribes {} at ({:.6g}, {:.6g}), where support '{}' (line {}) prescribes "
                     "another value: give both the same value there, or move one of them",
                     support.name, component_name[component], x.x(), x.y(),
                     model_.supports[static_cast<std::size_t>(other.support)].name,
                     model_.supports[static_cast<std::size_t>(other.support)].source.line)});
  }

  const model::Model& model_;
  const mesh::Mesh& mesh_;
  const Dofs& dofs_;
  std::vector<std::vector<Constraint>> constraints_;
  std::vector<std::map<int, std::size_t>> held_by_;
  std::set<std::array<int, 2>> reported_;  // pairs of supports
  std::vector<Diagnostic> diagnostics_;
};

std::unique_ptr<BodySystem> make_rigid_body(const model::Model& model, const model::Body& body,
                                            std::vector<Constraint> constraints) {
  std::string contradiction;
  const int last_support = constraints.empty() ? -1 : constraints.back().support;
  auto system = rigid_body(body.outline.centroid(), half_size(body.outline), std::move(constraints), contradiction);
  if (!contradiction.empty())
    throw InputError(model.file, {{model.supports[static_cast<std::size_t>(last_support)].source,
                                   fmt::format("the supports of rigid body '{}' contradict each other: a rigid body "
                                               "can only translate and rotate as a whole",
                                               body.name)}});
  return system;
}

/// For each part: whether it has a contact with pairs, other than with itself.
std::vector<bool> in_contact(const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs) {
  std::vector<bool> found(dofs.parts(), false);
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    if (!mesh.interfaces[c].pairs.empty() &&
        dofs.part_of(model.contacts[c].a.body) != dofs.part_of(model.contacts[c].b.body))
      for (const int body : {model.contacts[c].a.body, model.contacts[c].b.body}) found[dofs.part_of(body)] = true;
  return found;
}

}  // namespace

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
      const auto system = make_rigid_body(model, body, constraints[p]);
      reference = system->reference();
      lever = system->lever();
      free = system->rigid_coordinates();
    } else {
      free = free_motions(dofs.nodes(p), constraints[p], reference, lever);
    }
    if (free.cols() == 0) continue;
    std::string motions;
    for (Eigen::Index k = 0; k < free.cols(); ++k)
      motions += (k > 0 ? ", " : "") + describe_motion(free.col(k), reference, lever);
    const std::string what = bodies.size() == 1 ? "this body is insufficiently supported: it is"
                                                : dofs.name_of(p, model) + " are insufficiently supported: they are";
    diagnostics.push_back(
        {body.source,
         fmt::format("{} free to move by {}; add a support that prevents this motion, or a contact", what, motions)});
  }
  if (!diagnostics.empty()) throw InputError(model.file, std::move(diagnostics));
}

Structure make_structure(const model::Model& model, const mesh::Mesh& mesh,
                         const std::vector<element::SolvedCells>& cells, int threads) {
  Structure structure;
  structure.dofs = Dofs(model, mesh);
  const Dofs& dofs = structure.dofs;
  linalg::SparseOptions options;
  if (model.solver.factorisation == model::Factorisation::mumps) options.library = linalg::SparseLibrary::mumps;
  if (!linalg::is_built_in(options.library))
    throw InputError(model.file, {{{0, 0, "solver.factorisation"},
                                   "the library of MUMPS was not found: write cholmod, "
                                   "or install libmumps-seq-dev"}});
  auto constraints = constraints_of(model, mesh, dofs);
  structure.parts.resize(dofs.parts());
  const auto body_of = [&](std::size_t p) -> const model::Body& {
    return model.bodies[static_cast<std::size_t>(dofs.bodies_of(p).front())];
  };
  std::vector<std::size_t> elastic;
  std::vector<ElasticPart> parts;
  for (std::size_t p = 0; p < dofs.parts(); ++p) {
    if (body_of(p).rigid) {
      structure.parts[p] = make_rigid_body(model, body_of(p), std::move(constraints[p]));
      continue;
    }
    elastic.push_back(p);
    Stiffness stiffness =
        timed(structure.assembly_seconds, [&] { return part_stiffness(model, mesh, cells, dofs, p, threads); });
    parts.push_back({std::move(stiffness), dofs.nodes(p), std::move(constraints[p])});
  }
  try {
    auto bodies = elastic_bodies(std::move(parts), threads, options);
    for (std::size_t k = 0; k < elastic.size(); ++k) structure.parts[elastic[k]] = std::move(bodies[k]);
  } catch (const NotPositiveDefinitePart& failed) {
    throw InputError(model.file, {{body_of(elastic[failed.part]).source,
                                   "its stiffness matrix is not positive definite to working precision: the body is "
                                   "too slender (3000:1 or more), or its material constants (by a factor of about "
                                   "1e12) or its element sizes differ too much"}});
  }
  return structure;
}

}  // namespace scabo::system
