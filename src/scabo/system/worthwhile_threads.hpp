// The number of threads that is useful for a model. Threads that share small matrices wait for each other longer than
// they compute, and on a busy machine each wait lasts until the other thread is scheduled again
// (docs/decisions/0005-threads.md has the measurements).
#pragma once

#include "scabo/mesh/mesh.hpp"

namespace scabo::system {

/// Approximate number of operations of an analysis: 30 n^3 for super-elements of n degrees of freedom, those of one
/// size counted once; 1.5 k^3 for k contact components of a body; and 600 n^1.5 for n degrees of freedom in finite
/// elements, ordering included.
double dense_work(const model::Model& model, const mesh::Mesh& mesh);

/// `wanted` if dense_work takes more than about half a second on one processor, otherwise 1.
int worthwhile_threads(const model::Model& model, const mesh::Mesh& mesh, int wanted);

}  // namespace scabo::system
