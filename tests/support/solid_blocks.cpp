#include "support/solid_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "scabo/base/cell_topology.hpp"
#include "support/random.hpp"

namespace scabo::test {

namespace {

/// Adds the middle nodes of all cells.
void make_quadratic(mesh::SolidMesh& mesh) {
  std::map<std::array<int, 2>, int> middle_of;
  std::vector<Eigen::Vector3d> middles;
  const Eigen::Index corners = mesh.nodes.cols();
  for (std::vector<int>& cell : mesh.cells)
    for (const auto& edge : CellTopology::of(cell.size()).edges) {
      const int i = cell[edge[0]], j = cell[edge[1]];
      const auto [at, added] = middle_of.emplace(std::array{std::min(i, j), std::max(i, j)},
                                                 static_cast<int>(corners) + static_cast<int>(middles.size()));
      if (added) middles.push_back(0.5 * (mesh.nodes.col(i) + mesh.nodes.col(j)));
      cell.push_back(at->second);
    }
  mesh.nodes.conservativeResize(3, corners + static_cast<Eigen::Index>(middles.size()));
  for (std::size_t k = 0; k < middles.size(); ++k) mesh.nodes.col(corners + static_cast<Eigen::Index>(k)) = middles[k];
}

}  // namespace

mesh::SolidMesh solid_block(const Eigen::Vector3d& low, const Eigen::Vector3d& high, const std::array<int, 3>& n,
                            int nodes_of_cell, double moved, unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&](const std::array<int, 3>& at) { return (at[2] * (n[1] + 1) + at[1]) * (n[0] + 1) + at[0]; };
  mesh::SolidMesh mesh;
  mesh.nodes.resize(3, (n[0] + 1) * (n[1] + 1) * (n[2] + 1));
  std::array<int, 3> at{};
  for (at[2] = 0; at[2] <= n[2]; ++at[2])
    for (at[1] = 0; at[1] <= n[1]; ++at[1])
      for (at[0] = 0; at[0] <= n[0]; ++at[0])
        for (int k = 0; k < 3; ++k) {
          const auto axis = static_cast<std::size_t>(k);
          const bool inside = at[axis] > 0 && at[axis] < n[axis];
          const double place = at[axis] + (inside ? uniform(random, -moved, moved) : 0.0);
          mesh.nodes(k, number(at)) = low[k] + place * (high[k] - low[k]) / n[axis];
        }
  const auto add_cell = [&](const std::array<int, 3>& brick, const std::vector<std::array<int, 3>>& corners) {
    std::vector<int> cell;
    for (const std::array<int, 3>& c : corners)
      cell.push_back(number({brick[0] + c[0], brick[1] + c[1], brick[2] + c[2]}));
    mesh.cells.push_back(cell);
  };
  for (at[2] = 0; nodes_of_cell > 10 && at[2] < n[2]; ++at[2])
    for (at[1] = 0; at[1] < n[1]; ++at[1])
      for (at[0] = 0; at[0] < n[0]; ++at[0]) {
        if (nodes_of_cell == 20)
          add_cell(at, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}});
        else
          add_cell(at, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}}),
              add_cell(at, {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {0, 1, 1}});
      }
  // Along each order of the axes from one corner of a brick to the opposite one (Kuhn).
  constexpr std::array<std::array<int, 3>, 6> orders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (at[2] = 0; nodes_of_cell <= 10 && at[2] < n[2]; ++at[2])
    for (at[1] = 0; at[1] < n[1]; ++at[1])
      for (at[0] = 0; at[0] < n[0]; ++at[0])
        for (std::size_t order = 0; order < orders.size(); ++order) {
          std::array<int, 3> corner = at;
          std::vector<int> cell{number(corner)};
          for (const int axis : orders[order]) ++corner[static_cast<std::size_t>(axis)], cell.push_back(number(corner));
          if (order >= 3) std::swap(cell[1], cell[2]);
          mesh.cells.push_back(cell);
        }
  if (nodes_of_cell >= 10) make_quadratic(mesh);
  return mesh;
}

std::vector<int> nodes_at(const mesh::SolidMesh& mesh, int axis, double value) {
  std::vector<int> nodes;
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i)
    if (std::abs(mesh.nodes(axis, i) - value) < 1e-9) nodes.push_back(static_cast<int>(i));
  return nodes;
}

std::vector<mesh::SolidFacet> facets_at(const mesh::SolidMesh& mesh, const Eigen::Vector3d& point,
                                        const Eigen::Vector3d& normal) {
  return mesh::facets_in_plane(mesh, mesh::boundary_facets(mesh), point, normal, 1e-9);
}

}  // namespace scabo::test
