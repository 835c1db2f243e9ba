// Sizes of a model, before anything is solved.
#pragma once

#include <string>
#include <vector>

#include "scabo/mesh/mesh.hpp"

namespace scabo::run {

struct Sizes {
  int bodies = 0;
  int nodes = 0;
  int dofs = 0;  ///< two for each node, supported ones included
  int super_elements = 0;
  int finite_elements = 0;
  int contact_pairs = 0;
};

/// Number of pairs of every contact, without those that supports hold on both sides, which cannot move.
std::vector<int> moving_pairs(const model::Model& model, const mesh::Mesh& mesh);

Sizes sizes_of(const model::Model& model, const mesh::Mesh& mesh);

/// `2 bodies, 160 nodes, 320 degrees of freedom, 2 super-elements, 32 contact pairs`
std::string describe_sizes(const Sizes& sizes);

/// Increments of all steps together.
int increments_of(const model::Model& model);

/// How many problems are solved: increments, of steps in time the time steps.
double solutions_of(const model::Model& model, const mesh::Mesh& mesh);

}  // namespace scabo::run
