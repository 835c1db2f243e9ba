#include "scabo/analysis/space/body_mesh.hpp"

#include <fmt/format.h>

#include "scabo/element/space/solid_cell.hpp"
#include "scabo/mesh/extruded_solid.hpp"
#include "scabo/mesh/space/imported_solid.hpp"
#include "scabo/model/limits.hpp"

namespace scabo::analysis {

std::variant<mesh::ShapedSolid, std::string> mesh_of_body(const model::SpaceBody& of) {
  if (!of.shape) {
    mesh::ShapedSolid of_file;
    of_file.mesh = mesh::solid_mesh_of(*of.mesh);
    return of_file;
  }
  const auto* extrusion = std::get_if<model::SolidExtrusion>(&*of.shape);
  const double nodes = extrusion ? mesh::count_nodes(*extrusion, of.sizes) : mesh::count_nodes(*of.shape, of.sizes);
  if (nodes > model::limits::model_nodes)
    return fmt::format("its mesh would have {:.2g} nodes, and at most {:.2g} are possible: give it a larger 'size'",
                       nodes, model::limits::model_nodes);
  if (!extrusion) return mesh::solid_of_shape(*of.shape, of.sizes);
  auto extruded = mesh::extruded_solid(*extrusion, of.sizes, model::limits::model_nodes);
  if (const auto* wrong = std::get_if<Diagnostic>(&extruded)) return wrong->message;
  return std::get<mesh::ShapedSolid>(std::move(extruded));
}

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
