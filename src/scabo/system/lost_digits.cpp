#include "scabo/system/lost_digits.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/element/plane/conditioning.hpp"
#include "scabo/element/plane/elasticity.hpp"
#include "scabo/model/materials_of.hpp"

namespace scabo::system {

namespace {

/// A node that no cell has moves without resistance.
std::string free_nodes(const model::Body& body, const mesh::BodyMesh& mesh) {
  std::vector<bool> in_cell(mesh.nodes.size(), false);
  for (const mesh::Cell& cell : mesh.cells)
    for (const mesh::LineElement& side : cell.boundary)
      for (const int node : side.nodes) in_cell[static_cast<std::size_t>(node)] = true;
  const auto first = std::find(in_cell.begin(), in_cell.end(), false);
  if (first == in_cell.end()) return "";
  const Vec2& at = mesh.nodes[static_cast<std::size_t>(first - in_cell.begin())];
  return fmt::format("{} of its nodes belong to no cell of body '{}', first at ({:.6g}, {:.6g})",
                     std::count(in_cell.begin(), in_cell.end(), false), body.name, at.x(), at.y());
}

}  // namespace

std::string why_digits_are_lost(const model::Model& model, const mesh::Mesh& mesh, const std::vector<int>& bodies,
                                double springs, double stiffest) {
  element::Conditioning found;
  std::vector<element::Mat3> D;
  for (const int b : bodies) {
    const model::Body& body = model.bodies[static_cast<std::size_t>(b)];
    const mesh::BodyMesh& of = mesh.bodies[static_cast<std::size_t>(b)];
    if (const std::string free = free_nodes(body, of); !free.empty()) return free;
    const element::Conditioning own = element::measured(of);
    found.slenderness = std::max(found.slenderness, own.slenderness);
    found.sizes = std::max(found.sizes, own.sizes);
    for (const int material : model::materials_of(model, body))
      D.push_back(
          element::elasticity_matrix(model.materials[static_cast<std::size_t>(material)], model.analysis.plane));
  }
  element::measure(D, found);
  if (springs > 0.0 && stiffest > 0.0) found.springs = std::max(springs / stiffest, stiffest / springs);
  return element::causes_in_words(found);
}

}  // namespace scabo::system
