#include "scabo/analysis/state/discretisation.hpp"

#include <algorithm>
#include <utility>

#include "scabo/analysis/state/outside.hpp"
#include "scabo/base/stopwatch.hpp"
#include "scabo/element/alike_cells.hpp"
#include "scabo/system/contact_system.hpp"
#include "scabo/system/sliding_sides.hpp"

namespace scabo::analysis {

namespace {

double largest_load(const system::Structure& structure) {
  double largest = 0.0;
  for (const std::vector<Vector>& load : structure.loads)
    for (const Vector& forces : load)
      if (forces.size() > 0) largest = std::max(largest, forces.lpNorm<Eigen::Infinity>());
  return largest;
}

/// Parts with their loads; pairs get the normals along which bodies may roll.
std::shared_ptr<const system::Structure> make_systems(Discretisation& of, Timing& timing) {
  const auto structure = std::make_shared<system::Structure>(timed(timing.factorise, [&] {
    return system::make_structure(of.model, of.mesh, of.cells, of.threads, of.ranks, of.like.get());
  }));
  timing.factorise -= structure->assembly_seconds;
  timing.assemble += structure->assembly_seconds;
  const Stopwatch stopwatch(timing.assemble);
  system::add_loads(*structure, of.model, of.mesh, of.cells);
  system::let_slide(*structure, of.model, of.mesh);
  return structure;
}

}  // namespace

void discretise(Discretisation& of, const std::vector<element::SolvedCells>& before, const OnStage& on_stage,
                Timing& timing) {
  const auto stage = [&](const char* what) {
    if (on_stage) on_stage(what);
  };
  stage("super-elements");
  const std::vector<element::SolvedCells> like = std::move(of.cells);
  of.cells = timed(timing.super_elements, [&] {
    std::vector<element::SolvedCells> cells = element::solve_cells(
        of.model, of.mesh, of.threads, system::divided_bodies(of.ranks, of.model, of.mesh), before);
    if (!like.empty()) element::take_alike(cells, of.mesh, like);
    return cells;
  });
  stage("factorisation");
  of.structure = make_systems(of, timing);
  stage("condensation to the contact pairs");
  const Stopwatch stopwatch(timing.condense);
  of.pairs = std::make_shared<system::ContactSystem>(system::condense(*of.structure, of.model, of.mesh, of.threads));
  of.force_scale = largest_load(*of.structure);
  of.references = references_of(of.model, of.mesh, of.cells, of.structure->dofs);
}

Discretisation remesh(const Discretisation& before, mesh::Mesh mesh, Timing& timing) {
  Discretisation after;
  after.model = before.model;
  after.mesh = std::move(mesh);
  after.threads = before.threads;
  after.ranks = before.ranks;
  discretise(after, before.cells, {}, timing);
  return after;
}

void replace(Discretisation& of, Discretisation by) {
  by.model = std::move(of.model);
  of = std::move(by);
}

void drop_systems(Discretisation& of) {
  of.pairs.reset();
  of.structure.reset();
  of.like.reset();
  of.references.clear();
}

}  // namespace scabo::analysis
