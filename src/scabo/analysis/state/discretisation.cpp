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
std::shared_ptr<const system::Structure> make_systems(Discretisation& of, const Discretisation* before,
                                                      const Discretisation* like, Timing& timing) {
  const auto structure_of = [](const Discretisation* one) { return one ? one->structure.get() : nullptr; };
  const auto structure = std::make_shared<system::Structure>(timed(timing.factorise, [&] {
    return system::make_structure(of.model, of.mesh, of.cells, of.threads, of.ranks, structure_of(before),
                                  structure_of(like));
  }));
  timing.factorise -= structure->assembly_seconds;
  timing.assemble += structure->assembly_seconds;
  const Stopwatch stopwatch(timing.assemble);
  system::add_loads(*structure, of.model, of.mesh, of.cells);
  system::let_slide(*structure, of.model, of.mesh);
  return structure;
}

/// `before` and `like`: as of remesh(), or null.
void discretise(Discretisation& of, const Discretisation* before, const Discretisation* like, const OnStage& on_stage,
                Timing& timing) {
  const auto stage = [&](const char* what) {
    if (on_stage) on_stage(what);
  };
  stage("super-elements");
  of.cells = timed(timing.super_elements, [&] {
    std::vector<element::SolvedCells> cells =
        element::solve_cells(of.model, of.mesh, of.threads, system::divided_bodies(of.ranks, of.model, of.mesh),
                             before ? before->cells : std::vector<element::SolvedCells>());
    if (like) element::take_alike(cells, of.mesh, like->cells);
    return cells;
  });
  stage("factorisation");
  of.structure = make_systems(of, before, like, timing);
  stage("condensation to the contact pairs");
  const Stopwatch stopwatch(timing.condense);
  of.pairs = std::make_shared<system::ContactSystem>(system::condense(*of.structure, of.model, of.mesh, of.threads));
  of.force_scale = largest_load(*of.structure);
  of.references = references_of(of.model, of.mesh, of.cells, of.structure->dofs);
}

}  // namespace

void discretise(Discretisation& of, const OnStage& on_stage, Timing& timing) {
  discretise(of, nullptr, nullptr, on_stage, timing);
}

Discretisation remesh(const Discretisation& before, model::Model model, mesh::Mesh mesh, Timing& timing,
                      const Discretisation* like) {
  Discretisation after;
  after.model = std::move(model);
  after.mesh = std::move(mesh);
  after.threads = before.threads;
  after.ranks = before.ranks;
  discretise(after, &before, like, {}, timing);
  return after;
}

void replace(Discretisation& of, Discretisation by) {
  by.model = std::move(of.model);
  of = std::move(by);
}

void drop_systems(Discretisation& of) {
  of.pairs.reset();
  of.structure.reset();
  of.references.clear();
}

}  // namespace scabo::analysis
