// Which rank gets which cells, and the messages that bring them there.
#include <algorithm>
#include <numeric>

#include "scabo/element/finite_element.hpp"
#include "share.hpp"

namespace scabo::mpi {

namespace {

/// Cells of a part, one body after another, by the part's nodes.
struct CellsOfPart {
  std::vector<std::size_t> first;          // of each body; the last entry is the number of cells
  std::vector<std::vector<int>> nodes;     // of each cell
  std::vector<std::vector<int>> cells_at;  // of each node
};

CellsOfPart cells_of(const mesh::Mesh& mesh, const system::Dofs& dofs, std::size_t part) {
  CellsOfPart all;
  all.first.push_back(0);
  all.cells_at.resize(dofs.nodes(part).size());
  for (const int body : dofs.bodies_of(part)) {
    for (const mesh::Cell& cell : mesh.bodies[static_cast<std::size_t>(body)].cells) {
      std::vector<int> nodes = cell.nodes();
      for (int& node : nodes) {
        node = dofs.of(body, node, 0) / 2;
        all.cells_at[static_cast<std::size_t>(node)].push_back(static_cast<int>(all.nodes.size()));
      }
      all.nodes.push_back(std::move(nodes));
    }
    all.first.push_back(all.nodes.size());
  }
  return all;
}

/// Rank of every cell.
std::vector<int> divided(const CellsOfPart& all, int ranks) {
  const std::size_t count = all.nodes.size();
  std::vector<PetscInt> start{0}, neighbours;
  for (std::size_t cell = 0; cell < count; ++cell) {
    std::vector<int> near;  // once for each node in common
    for (const int node : all.nodes[cell])
      for (const int other : all.cells_at[static_cast<std::size_t>(node)])
        if (other != static_cast<int>(cell)) near.push_back(other);
    std::sort(near.begin(), near.end());
    for (std::size_t i = 0; i + 1 < near.size(); ++i)
      if (near[i] == near[i + 1] && (i == 0 || near[i - 1] != near[i])) neighbours.push_back(near[i]);
    start.push_back(static_cast<PetscInt>(neighbours.size()));
  }
  // PETSc frees these arrays.
  PetscInt *i = nullptr, *j = nullptr, *weights = nullptr;
  check(PetscMalloc1(start.size(), &i));
  check(PetscMalloc1(std::max<std::size_t>(neighbours.size(), 1), &j));
  check(PetscMalloc1(count, &weights));
  std::copy(start.begin(), start.end(), i);
  std::copy(neighbours.begin(), neighbours.end(), j);
  for (std::size_t cell = 0; cell < count; ++cell) weights[cell] = static_cast<PetscInt>(all.nodes[cell].size());
  OwnedMat graph;
  const auto n = static_cast<PetscInt>(count);
  check(MatCreateMPIAdj(PETSC_COMM_SELF, n, n, i, j, nullptr, graph.out()));
  OwnedPartitioning partitioning;
  check(MatPartitioningCreate(PETSC_COMM_SELF, partitioning.out()));
  check(MatPartitioningSetAdjacency(partitioning, graph));
  check(MatPartitioningSetVertexWeights(partitioning, weights));
  check(MatPartitioningSetType(partitioning, MATPARTITIONINGPTSCOTCH));
  check(MatPartitioningSetNParts(partitioning, ranks));
  OwnedIS parts;
  check(MatPartitioningApply(partitioning, parts.out()));
  const PetscInt* of_cell = nullptr;
  check(ISGetIndices(parts, &of_cell));
  std::vector<int> result(of_cell, of_cell + count);
  check(ISRestoreIndices(parts, &of_cell));
  return result;
}

}  // namespace

Division divide_cells(const mesh::Mesh& mesh, const system::Dofs& dofs, std::size_t part, int ranks) {
  const CellsOfPart all = cells_of(mesh, dofs, part);
  const std::vector<int> rank_of = divided(all, ranks);
  Division division;
  for (std::size_t b = 0; b + 1 < all.first.size(); ++b)
    division.rank_of.emplace_back(rank_of.begin() + static_cast<std::ptrdiff_t>(all.first[b]),
                                  rank_of.begin() + static_cast<std::ptrdiff_t>(all.first[b + 1]));
  const std::size_t nodes = all.cells_at.size();
  std::vector<int> owner(nodes, 0);
  division.first.assign(static_cast<std::size_t>(ranks) + 1, 0);
  for (std::size_t node = 0; node < nodes; ++node) {
    int least = ranks;
    for (const int cell : all.cells_at[node]) least = std::min(least, rank_of[static_cast<std::size_t>(cell)]);
    owner[node] = least < ranks ? least : 0;
    ++division.first[static_cast<std::size_t>(owner[node]) + 1];
  }
  std::partial_sum(division.first.begin(), division.first.end(), division.first.begin());
  std::vector<int> next(division.first.begin(), division.first.end() - 1);
  division.number.resize(nodes);
  for (std::size_t node = 0; node < nodes; ++node)
    division.number[node] = next[static_cast<std::size_t>(owner[node])]++;
  return division;
}

Bytes pack_share(const mesh::Mesh& mesh, const system::Dofs& dofs, std::size_t part, const Division& division, int rank,
                 int threads) {
  Packer packer;
  packer.add(threads);
  packer.add_list(division.first);
  const std::vector<int>& bodies = dofs.bodies_of(part);
  packer.add_list(bodies);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const mesh::BodyMesh& body = mesh.bodies[static_cast<std::size_t>(bodies[k])];
    std::vector<int> cells, nodes;
    for (std::size_t c = 0; c < body.cells.size(); ++c) {
      if (division.rank_of[k][c] != rank) continue;
      cells.push_back(static_cast<int>(c));
      const std::vector<int> of_cell = body.cells[c].nodes();
      nodes.insert(nodes.end(), of_cell.begin(), of_cell.end());
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    std::vector<int> place(body.nodes.size(), -1), numbers;
    std::vector<double> positions;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto node = static_cast<std::size_t>(nodes[i]);
      place[node] = static_cast<int>(i);
      positions.insert(positions.end(), {body.nodes[node].x(), body.nodes[node].y()});
      numbers.push_back(division.number[static_cast<std::size_t>(dofs.of(bodies[k], nodes[i], 0) / 2)]);
    }
    packer.add_list(cells);
    packer.add_list(nodes);
    packer.add_list(numbers);
    packer.add_list(positions);
    for (const int c : cells) {
      const mesh::Cell& cell = body.cells[static_cast<std::size_t>(c)];
      packer.add(static_cast<int>(cell.kind));
      packer.add(cell.centre.x());
      packer.add(cell.centre.y());
      packer.add_list(cell.materials);
      packer.add(cell.scale);
      std::vector<double> held;  // face, x and y of every direction
      for (const std::size_t face : {0u, 1u})
        for (const Vec2& along : cell.held ? cell.held->along[face] : std::vector<Vec2>{})
          held.insert(held.end(), {static_cast<double>(face), along.x(), along.y()});
      packer.add_list(held);
      packer.add(cell.held ? cell.held->mirror : -1);
      packer.add(cell.boundary.size());
      for (const mesh::LineElement& element : cell.boundary) {
        std::vector<int> own = element.nodes;
        for (int& node : own) node = place[static_cast<std::size_t>(node)];
        packer.add_list(own);
      }
    }
  }
  return std::move(packer).take();
}

Share unpack_share(const Bytes& message, std::size_t bodies) {
  Unpacker unpacker(message);
  Share share;
  share.threads = unpacker.get<int>();
  share.first = unpacker.get_list<int>();
  share.bodies = unpacker.get_list<int>();
  share.mesh.bodies.resize(bodies);
  share.cell_numbers.resize(bodies);
  share.node_numbers.resize(bodies);
  share.numbers.resize(bodies);
  for (const int b : share.bodies) {
    const auto body = static_cast<std::size_t>(b);
    mesh::BodyMesh& mesh = share.mesh.bodies[body];
    share.cell_numbers[body] = unpacker.get_list<int>();
    share.node_numbers[body] = unpacker.get_list<int>();
    share.numbers[body] = unpacker.get_list<int>();
    const std::vector<double> positions = unpacker.get_list<double>();
    for (std::size_t i = 0; i + 1 < positions.size(); i += 2) mesh.nodes.emplace_back(positions[i], positions[i + 1]);
    mesh.cells.resize(share.cell_numbers[body].size());
    for (mesh::Cell& cell : mesh.cells) {
      cell.kind = static_cast<mesh::CellKind>(unpacker.get<int>());
      cell.centre.x() = unpacker.get<double>();
      cell.centre.y() = unpacker.get<double>();
      cell.materials = unpacker.get_list<int>();
      cell.scale = unpacker.get<double>();
      const std::vector<double> directions = unpacker.get_list<double>();
      mesh::HeldFaces held;
      for (std::size_t i = 0; i + 2 < directions.size(); i += 3)
        held.along[directions[i] == 0.0 ? 0 : 1].emplace_back(directions[i + 1], directions[i + 2]);
      held.mirror = unpacker.get<int>();
      if (!directions.empty()) cell.held = std::make_shared<const mesh::HeldFaces>(held);
      cell.boundary.resize(unpacker.get<std::size_t>());
      for (mesh::LineElement& element : cell.boundary) element.nodes = unpacker.get_list<int>();
    }
  }
  return share;
}

}  // namespace scabo::mpi
