// What a rank holds of a divided part: its cells and its rows of the stiffness.
//
// Nodes are numbered anew among all ranks: first those of rank 0, then those of rank 1 ... A node belongs to the first
// rank among those of its cells. Two degrees of freedom follow from each. A rank assembles the stiffness of its cells
// by itself; at nodes that it shares with others, PETSc adds what they have (MATIS, converted to MPIAIJ).
#pragma once

#include "petsc.hpp"
#include "process.hpp"
#include "scabo/element/cell_library.hpp"
#include "scabo/mesh/mesh.hpp"
#include "scabo/system/dofs.hpp"

namespace scabo::mpi {

/// Which rank has each cell of a part, and the numbers of its nodes. Only rank 0 needs it.
struct Division {
  std::vector<std::vector<int>> rank_of;  // [place in the part's bodies][cell]
  std::vector<int> number;                // [node of the part]: among all ranks
  std::vector<int> step;                  // [node of the part]: at which it is eliminated
  std::vector<int> first;                 // [rank]: its first node; the last entry is the number of nodes
};

/// Cells that share a side are neighbours; PETSc divides their graph by PT-SCOTCH.
Division divide_cells(const mesh::Mesh& mesh, const system::Dofs& dofs, std::size_t part, int ranks);

/// The messages for `Process::divide`: cells and nodes of each rank, one after another.
class SharePacker {
 public:
  SharePacker(const mesh::Mesh& mesh, const system::Dofs& dofs, std::size_t part, const Division& division,
              int threads);
  Bytes of(int rank);

 private:
  const mesh::Mesh& mesh_;
  const system::Dofs& dofs_;
  std::size_t part_;
  const Division& division_;
  int threads_;
  std::vector<std::vector<int>> cells_;          // [place in the part's bodies]: by rank, and ascending
  std::vector<std::vector<std::size_t>> first_;  // [place in the part's bodies][rank]: its first of these
  std::vector<int> place_;                       // [node of a body]: among those of a message; -1: not there
};

struct Share {
  int threads = 1;
  std::vector<int> first;                      // Division::first
  std::vector<int> bodies;                     // of the part
  mesh::Mesh mesh;                             // of all bodies of the model; only own cells and their nodes
  std::vector<std::vector<int>> cell_numbers;  // [body]: own cells among those of the whole body, ascending
  std::vector<std::vector<int>> node_numbers;  // [body]: own nodes among those of the whole body, ascending
  std::vector<std::vector<int>> numbers;       // [body]: own nodes among all ranks
  std::vector<element::SolvedCells> cells;     // [body]

  OwnedMat K;                                          // rows of own nodes
  OwnedVec x, y, at_root;                              // of K; all of x on rank 0
  OwnedScatter to_root;                                // x to at_root
  OwnedVec others;                                     // entries of x in other ranks' columns
  OwnedScatter to_others;                              // x to others
  Mat own_columns = nullptr, other_columns = nullptr;  // blocks of K, which owns them
  int nodes(int rank) const {
    return first[static_cast<std::size_t>(rank) + 1] - first[static_cast<std::size_t>(rank)];
  }
};

Share unpack_share(const Bytes& message, std::size_t bodies);

}  // namespace scabo::mpi
