#include "scabo/system/ranks.hpp"

namespace scabo::system {

bool is_divided(const Ranks* ranks, const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs,
                std::size_t part) {
  if (!ranks || dofs.is_rigid(part) || dofs.is_unbounded(part)) return false;
  std::size_t cells = 0;
  for (const int body : dofs.bodies_of(part)) {
    if (model.bodies[static_cast<std::size_t>(body)].rigid) return false;
    cells += mesh.bodies[static_cast<std::size_t>(body)].cells.size();
  }
  return static_cast<double>(dofs.size(part)) >= ranks->divide_from() &&
         cells >= static_cast<std::size_t>(ranks->count());
}

std::vector<char> divided_bodies(const Ranks* ranks, const model::Model& model, const mesh::Mesh& mesh) {
  if (!ranks) return {};
  const Dofs dofs(model, mesh);
  std::vector<char> divided(model.bodies.size(), 0);
  for (std::size_t part = 0; part < dofs.parts(); ++part)
    if (is_divided(ranks, model, mesh, dofs, part))
      for (const int body : dofs.bodies_of(part)) divided[static_cast<std::size_t>(body)] = 1;
  return divided;
}

}  // namespace scabo::system
