#include "scabo/element/plane/sectors.hpp"

#include "scabo/element/plane/elasticity.hpp"

namespace scabo::element {

Sectors sectors_of(const model::Model& model, const mesh::Cell& cell) {
  Sectors sectors;
  sectors.materials = cell.materials;
  std::vector<Mat3> D;
  for (const int index : sectors.materials) {
    const model::Material& material = model.materials[static_cast<std::size_t>(index)];
    D.push_back(elasticity_matrix(material, model.analysis.plane));
    sectors.unit_strain.push_back(thermal_strain(material, model.analysis.plane));
  }
  sectors.D = Elasticity(std::move(D));
  return sectors;
}

}  // namespace scabo::element
