#include "scabo/system/pore_pressure.hpp"

#include "scabo/system/loads.hpp"
#include "scabo/system/tributary_lengths.hpp"

namespace scabo::system {

double pressure_at(const model::PorePressure& pores, const Vec2& x) {
  // Against a normal along x.
  const auto of = [&](const VaryingTraction& varying) { return -varying.traction(x, Vec2::UnitX()).x(); };
  if (const auto* table = std::get_if<model::EdgeTable>(&pores.value)) return of(varying_traction(*table, {}));
  if (const auto* water = std::get_if<model::Water>(&pores.value)) return of(varying_traction(*water));
  return std::get<double>(pores.value);
}

Vector pore_forces(const model::PorePressure& pores, int contact, const model::Model& model, const mesh::Mesh& mesh) {
  const mesh::Interface& interface = mesh.interfaces[static_cast<std::size_t>(contact)];
  const std::vector<double> lengths = tributary_lengths(contact, model, mesh);
  Vector forces(static_cast<Eigen::Index>(lengths.size()));
  for (std::size_t i = 0; i < lengths.size(); ++i)
    forces[static_cast<Eigen::Index>(i)] =
        pressure_at(pores, interface.pairs[i].point_a) * lengths[i] * model.analysis.thickness;
  return forces;
}

}  // namespace scabo::system
