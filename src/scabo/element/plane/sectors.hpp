// Materials of a super-element: every boundary element spans a sector of its own.
#pragma once

#include "scabo/element/facet/radial_load.hpp"

namespace scabo::element {

/// One entry for all boundary elements, or one for each.
struct Sectors {
  std::vector<int> materials;  // indices into Model::materials
  Elasticity D;
  std::vector<Vec3> unit_strain;  // free strain [xx, yy, xy] per unit of temperature

  int material_of(std::size_t element) const { return materials[materials.size() == 1 ? 0 : element]; }
  const Vec3& unit_strain_of(std::size_t element) const { return unit_strain[unit_strain.size() == 1 ? 0 : element]; }
};

Sectors sectors_of(const model::Model& model, const mesh::Cell& cell);

}  // namespace scabo::element
