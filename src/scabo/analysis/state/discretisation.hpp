// What one mesh gives: cells, the systems of all bodies, and their condensation to the pairs of the contacts.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "scabo/analysis/state/timing.hpp"
#include "scabo/element/cell_library.hpp"
#include "scabo/mesh/mesh.hpp"
#include "scabo/model/model.hpp"

namespace scabo::system {
class Ranks;           // ranks.hpp
struct Structure;      // structure.hpp
struct ContactSystem;  // contact_system.hpp
}  // namespace scabo::system

namespace scabo::analysis {

/// Of bodies that contacts and ties join, one of them unbounded with a reference point, if no support determines where
/// they are.
struct Reference {
  int body = 0;            ///< the unbounded one
  Matrix N;                ///< 2 x n: displacement of the point by those of the nodes of the body
  std::vector<int> parts;  ///< of all these bodies
};

/// A value. `model` and `mesh` are given, everything else follows from them (discretise()). Systems do not refer to the
/// model, the mesh or the cells from which they were made, but pairs do to the structure.
struct Discretisation {
  model::Model model;
  mesh::Mesh mesh;
  std::vector<element::SolvedCells> cells;  ///< [body][cell]; null for finite elements
  // What increments need besides; absent before and after them:
  std::shared_ptr<const system::Structure> structure;
  std::shared_ptr<const system::ContactSystem> pairs;
  /// Largest nodal force of any load at factor 1: the scale for judging forces, also while all loads are zero.
  double force_scale = 0.0;
  std::vector<Reference> references;

  int threads = 1;                 ///< for its systems; worthwhile for its fields as well
  system::Ranks* ranks = nullptr;  ///< processes among which large bodies are divided; null: this one alone
};

using OnStage = std::function<void(const std::string&)>;

/// Solves the super-elements of the mesh, factorises the parts and condenses them to the pairs. `on_stage` may be
/// empty.
void discretise(Discretisation& of, const OnStage& on_stage, Timing& timing);

/// The model on another mesh, or with longer cracks. Super-elements and elastic parts that are the same before to the
/// last bit keep their solutions and factors. `like`: cells and, if it has one, structure of a mesh that differs
/// little, or null: super-elements that differ from its own by rounding take their solutions, and large parts are
/// solved by its factors.
Discretisation remesh(const Discretisation& before, model::Model model, mesh::Mesh mesh, Timing& timing,
                      const Discretisation* like = nullptr);

/// Goes on with another mesh of the same model. References into the model stay valid.
void replace(Discretisation& of, Discretisation by);

/// Frees what only increments need.
void drop_systems(Discretisation& of);

}  // namespace scabo::analysis
