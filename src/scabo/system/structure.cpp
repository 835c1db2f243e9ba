#include "scabo/system/structure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/base/stopwatch.hpp"
#include "scabo/linalg/symmetric_positive_solver.hpp"
#include "scabo/system/assembly.hpp"
#include "scabo/system/held_points.hpp"
#include "scabo/system/loads.hpp"
#include "scabo/system/lost_digits.hpp"

namespace scabo::system {

namespace {

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

/// For each part: whether it has a contact with pairs, or a bar, other than with itself, or a support that begins or
/// ends in a step.
std::vector<bool> in_contact(const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs) {
  std::vector<bool> found(dofs.parts(), false);
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    if (!mesh.interfaces[c].pairs.empty() &&
        dofs.part_of(model.contacts[c].a.body) != dofs.part_of(model.contacts[c].b.body))
      for (const int body : {model.contacts[c].a.body, model.contacts[c].b.body}) found[dofs.part_of(body)] = true;
  for (const model::Support& support : model.supports)
    if (support.is_staged()) found[dofs.part_of(support.on.body)] = true;
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

linalg::SparseOptions sparse_options(const model::Model& model, const Ranks* ranks) {
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
  return options;
}

}  // namespace

Structure make_structure(const model::Model& model, const mesh::Mesh& mesh,
                         const std::vector<element::SolvedCells>& cells, int threads, Ranks* ranks,
                         const Structure* before, const Structure* like) {
  Structure structure;
  structure.dofs = Dofs(model, mesh);
  const Dofs& dofs = structure.dofs;
  const linalg::SparseOptions options = sparse_options(model, ranks);
  auto constraints = constraints_of(model, mesh, dofs);
  structure.springs = springs_of(model, mesh, dofs);
  structure.bars = bars_of(model, mesh, dofs);
  for (BarSystem& point : held_points_of(model, mesh, dofs)) structure.bars.push_back(std::move(point));
  structure.parts.resize(dofs.parts());
  const auto body_of = [&](std::size_t p) -> const model::Body& {
    return model.bodies[static_cast<std::size_t>(dofs.bodies_of(p).front())];
  };
  std::vector<std::size_t> elastic;
  std::vector<ElasticPart> parts;
  parts.reserve(dofs.parts());
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
    stiffness.sparse.markAsRValue();  // or Eigen copies what is moved
    ElasticPart& part = parts.emplace_back();
    part.stiffness = std::move(stiffness);
    part.nodes = dofs.nodes(p);
    part.constraints = std::move(constraints[p]);
    part.contact_dofs = std::move(contact_dofs[p]);
    if (!like || like->parts.size() != dofs.parts()) continue;
    part.like = like->parts[p].get();
    part.nodes_of_like = like->dofs.nodes(p);
  }
  try {
    auto bodies = elastic_bodies(std::move(parts), threads, options, before ? &before->parts : nullptr);
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
