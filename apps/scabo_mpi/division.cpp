// Which rank gets which cells, and the messages that bring them there.
#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "scabo/linalg/elimination_order.hpp"
#include "share.hpp"

namespace scabo::mpi {

namespace {

/// Lists one after another: list i is values[starts[i]] to values[starts[i + 1] - 1].
struct Lists {
  std::vector<std::size_t> starts{0};
  std::vector<int> values;
  std::size_t count() const { return starts.size() - 1; }
  std::span<const int> operator[](std::size_t i) const {
    return {values.data() + starts[i], values.data() + starts[i + 1]};
  }
};

/// list[k]: in which lists k stands, ascending.
Lists turned_round(const Lists& lists, std::size_t count) {
  Lists result;
  result.starts.assign(count + 1, 0);
  for (const int value : lists.values) ++result.starts[static_cast<std::size_t>(value) + 1];
  std::partial_sum(result.starts.begin(), result.starts.end(), result.starts.begin());
  result.values.resize(lists.values.size());
  std::vector<std::size_t> next(result.starts.begin(), result.starts.end() - 1);
  for (std::size_t i = 0; i < lists.count(); ++i)
    for (const int value : lists[i]) result.values[next[static_cast<std::size_t>(value)]++] = static_cast<int>(i);
  return result;
}

/// Cells of a part, one body after another, by the part's nodes.
struct CellsOfPart {
  std::vector<std::size_t> first;  // of each body; the last entry is the number of cells
  Lists nodes;                     // of each cell
  Lists cells_at;                  // of each node
};

CellsOfPart cells_of(const mesh::Mesh& mesh, const system::Dofs& dofs, std::size_t part) {
  CellsOfPart all;
  all.first.push_back(0);
  for (const int body : dofs.bodies_of(part)) {
    for (const mesh::Cell& cell : mesh.bodies[static_cast<std::size_t>(body)].cells) {
      for (const int node : cell.nodes()) all.nodes.values.push_back(dofs.node_in_part(body, node));
      all.nodes.starts.push_back(all.nodes.values.size());
    }
    all.first.push_back(all.nodes.count());
  }
  all.cells_at = turned_round(all.nodes, dofs.nodes(part).size());
  return all;
}

/// Rank of every cell.
std::vector<int> divided(const CellsOfPart& all, int ranks) {
  const std::size_t count = all.nodes.count();
  std::vector<PetscInt> start{0}, neighbours;
  std::vector<int> in_common(count, 0), near;  // nodes in common with a cell, of those that are near
  for (std::size_t cell = 0; cell < count; ++cell) {
    near.clear();
    for (const int node : all.nodes[cell])
      for (const int other : all.cells_at[static_cast<std::size_t>(node)])
        if (++in_common[static_cast<std::size_t>(other)] == 2 && other != static_cast<int>(cell)) near.push_back(other);
    std::sort(near.begin(), near.end());
    neighbours.insert(neighbours.end(), near.begin(), near.end());
    for (const int node : all.nodes[cell])
      for (const int other : all.cells_at[static_cast<std::size_t>(node)])
        in_common[static_cast<std::size_t>(other)] = 0;
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

/// Nested dissection by position of the graph of nodes that have a cell in common.
std::vector<int> elimination_steps(const CellsOfPart& all, const std::vector<Vec2>& positions) {
  const auto n = static_cast<Eigen::Index>(positions.size());
  std::vector<int> starts{0}, neighbours, last_at(positions.size(), -1);
  for (std::size_t node = 0; node < positions.size(); ++node) {
    const auto first = static_cast<std::ptrdiff_t>(neighbours.size());
    for (const int cell : all.cells_at[node])
      for (const int other : all.nodes[static_cast<std::size_t>(cell)])
        if (std::exchange(last_at[static_cast<std::size_t>(other)], static_cast<int>(node)) != static_cast<int>(node))
          neighbours.push_back(other);
    std::sort(neighbours.begin() + first, neighbours.end());
    starts.push_back(static_cast<int>(neighbours.size()));
  }
  std::vector<double> values(neighbours.size(), 1.0);
  const linalg::SparseMatrix graph = Eigen::Map<const linalg::SparseMatrix>(
      n, n, static_cast<Eigen::Index>(neighbours.size()), starts.data(), neighbours.data(), values.data());
  const std::vector<std::int64_t> order =
      linalg::elimination_order(graph, linalg::Ordering::dissection_by_position, positions);
  std::vector<int> steps(positions.size());
  for (std::size_t k = 0; k < order.size(); ++k) steps[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
  return steps;
}

}  // namespace

Division divide_cells(const mesh::Mesh& mesh, const system::Dofs& dofs, std::size_t part, int ranks) {
  const CellsOfPart all = cells_of(mesh, dofs, part);
  const std::vector<int> rank_of = divided(all, ranks);
  Division division;
  for (std::size_t b = 0; b + 1 < all.first.size(); ++b)
    division.rank_of.emplace_back(rank_of.begin() + static_cast<std::ptrdiff_t>(all.first[b]),
                                  rank_of.begin() + static_cast<std::ptrdiff_t>(all.first[b + 1]));
  const std::size_t nodes = all.cells_at.count();
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
  division.step = elimination_steps(all, dofs.nodes(part));
  return division;
}

SharePacker::SharePacker(const mesh::Mesh& mesh, const system::Dofs& dofs, std::size_t part, const Division& division,
                         int threads)
    : mesh_(mesh), dofs_(dofs), part_(part), division_(division), threads_(threads) {
  std::size_t most = 0;
  for (const std::vector<int>& rank_of : division.rank_of) {
    std::vector<std::size_t>& first = first_.emplace_back(division.first.size(), 0);
    for (const int rank : rank_of) ++first[static_cast<std::size_t>(rank) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<int>& cells = cells_.emplace_back(rank_of.size());
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for (std::size_t c = 0; c < rank_of.size(); ++c)
      cells[next[static_cast<std::size_t>(rank_of[c])]++] = static_cast<int>(c);
  }
  for (const int body : dofs.bodies_of(part))
    most = std::max(most, mesh.bodies[static_cast<std::size_t>(body)].nodes.size());
  place_.assign(most, -1);
}

Bytes SharePacker::of(int rank) {
  Packer packer;
  packer.add(threads_);
  packer.add_list(division_.first);
  const std::vector<int>& bodies = dofs_.bodies_of(part_);
  packer.add_list(bodies);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const mesh::BodyMesh& body = mesh_.bodies[static_cast<std::size_t>(bodies[k])];
    const auto first = cells_[k].begin() + static_cast<std::ptrdiff_t>(first_[k][static_cast<std::size_t>(rank)]),
               last = cells_[k].begin() + static_cast<std::ptrdiff_t>(first_[k][static_cast<std::size_t>(rank) + 1]);
    const std::vector<int> cells(first, last);
    std::vector<int> nodes, numbers;
    std::vector<double> positions;
    for (const int c : cells)
      for (const int node : body.cells[static_cast<std::size_t>(c)].nodes()) {
        int& place = place_[static_cast<std::size_t>(node)];
        if (place < 0) place = 0, nodes.push_back(node);
      }
    std::sort(nodes.begin(), nodes.end());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto node = static_cast<std::size_t>(nodes[i]);
      place_[node] = static_cast<int>(i);
      positions.insert(positions.end(), {body.nodes[node].x(), body.nodes[node].y()});
      numbers.push_back(division_.number[static_cast<std::size_t>(dofs_.node_in_part(bodies[k], nodes[i]))]);
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
        for (int& node : own) node = place_[static_cast<std::size_t>(node)];
        packer.add_list(own);
      }
    }
    for (const int node : nodes) place_[static_cast<std::size_t>(node)] = -1;
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
