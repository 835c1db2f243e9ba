#include "scabo/analysis/space/wrong_cell.hpp"

#include <fmt/format.h>

#include "scabo/element/space/solid_cell.hpp"

namespace scabo::analysis {

std::optional<std::string> wrong_cell(const model::SpaceBody& of, const mesh::SolidMesh& mesh) {
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const double least = element::least_of_cell(mesh::nodes_of(mesh, mesh.cells[c]));
    if (least > 0.0) continue;
    if (!of.mesh || of.made_of_shape) return "its curved face folds elements of this size: give it a smaller 'size'";
    if (mesh::is_super_element(mesh.cells[c].size()))
      return fmt::format(
          "element {} of its mesh file is so distorted that a part of its sides cannot be seen from its "
          "middle: correct its nodes, or leave out 'kind'",
          of.mesh->cells[c].number);
    return fmt::format(
        "element {} of its mesh file has a Jacobian of {:.3g}, which must be positive everywhere: "
        "correct its nodes",
        of.mesh->cells[c].number, least);
  }
  const auto cells = of.mesh && !of.made_of_shape ? mesh::overlapping_cells(mesh) : std::nullopt;
  if (!cells) return {};
  return fmt::format(
      "elements {} and {} of its mesh file lie on the same side of a face that both have: leave one of them out",
      of.mesh->cells[static_cast<std::size_t>((*cells)[0])].number,
      of.mesh->cells[static_cast<std::size_t>((*cells)[1])].number);
}

}  // namespace scabo::analysis
