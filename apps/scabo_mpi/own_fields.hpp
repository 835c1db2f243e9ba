// Fields of the cells that a rank has.
#pragma once

#include <memory>
#include <vector>

#include "scabo/analysis/state/discretisation.hpp"
#include "scabo/result/recovery.hpp"

namespace scabo::mpi {

/// What a rank needs of the state: everything of its own cells and nodes.
struct Wanted {
  std::vector<int> bodies;                     // that are divided
  std::vector<std::vector<int>> cells, nodes;  // [place in bodies]: among those of the whole body
};

/// The cells of this rank as a discretisation of their own.
struct OwnFields {
  analysis::Discretisation discretisation;
  std::vector<char> divided;  // [body]
  std::vector<std::vector<int>> numbers,
      node_numbers;                          // [body]: own nodes among all ranks and in the body, of divided ones
  std::vector<std::vector<char>> is_shared;  // [body][own node]: other ranks have it as well
  std::unique_ptr<const result::Recovery> recovery;
  std::vector<Wanted> of_ranks;  // on rank 0
};

}  // namespace scabo::mpi
