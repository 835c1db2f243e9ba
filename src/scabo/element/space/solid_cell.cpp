#include "scabo/element/space/solid_cell.hpp"

#include <cmath>
#include <cstdint>
#include <map>

#include "scabo/linalg/parallel.hpp"

namespace scabo::element {

namespace {

/// Shapes that are equal to this part of their size are one. Two halves of a rounding step apart they are solved twice,
/// which changes nothing but the time.
constexpr double most_apart_in_space = 1e-11;

std::vector<std::int64_t> shape_of_cell(const Matrix& nodes) {
  const Matrix from_first = nodes.colwise() - Eigen::Vector3d(nodes.col(0));
  const double step = std::exp2(std::ceil(std::log2(most_apart_in_space * from_first.cwiseAbs().maxCoeff())));
  std::vector<std::int64_t> shape{std::llround(std::log2(step)), nodes.cols()};
  for (const double x : from_first.reshaped()) shape.push_back(std::llround(x / step));
  return shape;
}

}  // namespace

SuperElements solve_super_elements(const mesh::SolidMesh& mesh, const Mat6& D, int threads) {
  std::map<std::vector<std::int64_t>, std::size_t> known;
  std::vector<std::size_t> first, which(mesh.cells.size());  // cells of every shape, shape of every cell
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    if (!mesh::is_super_element(mesh.cells[c].size())) continue;
    const auto [at, is_new] = known.try_emplace(shape_of_cell(mesh::nodes_of(mesh, mesh.cells[c])), first.size());
    if (is_new) first.push_back(c);
    which[c] = at->second;
  }
  if (first.empty()) return {};
  SuperElements shapes(first.size()), solved(mesh.cells.size());
  linalg::parallel_for(static_cast<int>(first.size()), threads, [&](int k) {
    const auto shape = static_cast<std::size_t>(k);
    shapes[shape] = std::make_shared<const SolidSuperElement>(mesh::nodes_of(mesh, mesh.cells[first[shape]]), D);
  });
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (mesh::is_super_element(mesh.cells[c].size())) solved[c] = shapes[which[c]];
  return solved;
}

double least_of_cell(const Matrix& nodes) {
  return mesh::is_super_element(static_cast<std::size_t>(nodes.cols())) ? least_visibility(nodes)
                                                                        : least_jacobian(nodes);
}

Matrix cell_stiffness(const Matrix& nodes, const Mat6& D, const SolidSuperElement* solved) {
  return solved ? solved->K() : tetrahedron_stiffness(nodes, D);
}

Vector cell_volume_weights(const Matrix& nodes) {
  return mesh::is_super_element(static_cast<std::size_t>(nodes.cols())) ? super_element_volume_weights(nodes)
                                                                        : volume_weights(nodes);
}

SolidCellLoads loads_in_cell(const Matrix& nodes, const SolidSuperElement& cell, const std::vector<int>& numbers,
                             const InsideCells& inside) {
  SolidCellLoads loads;
  if (!inside.per_volume.isZero(0.0)) loads.add(loads_of_volume_force(nodes, cell, inside.per_volume));
  if (inside.heated.size() > 0) loads.add(loads_of_stress(nodes, cell, inside.stress, inside.heated(numbers)));
  return loads;
}

}  // namespace scabo::element
