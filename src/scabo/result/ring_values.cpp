#include "scabo/result/ring_values.hpp"

#include "scabo/base/components.hpp"

namespace scabo::result {

Eigen::Matrix3Xd ring_stresses(const element::SolvedSuperElement& super_element, const RingSampling& sampling,
                               const element::RadialField::Values& values, const Vec2& centre, double xi,
                               const element::InteriorLoads& interior) {
  Eigen::Matrix3Xd stresses = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(sampling.size()));
  for (const RingSampling::Sample& sample : sampling.samples) {
    const auto point = static_cast<std::size_t>(sample.point);
    const std::vector<int>& nodes = super_element.ring.elements[sample.element].nodes;
    const Vec2 x = centre + xi * sampling.at(point, [&](int node) { return super_element.ring.node(node); });
    element::Vec3 strain = interior.particular_strain(x) -
                           super_element.sectors.unit_strain_of(sample.element) * interior.temperature_at(x);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto local = place_of(i), global = place_of(nodes[i]);
      strain.noalias() += sample.B1.middleCols<2>(local) * values.u_xi.segment<2>(global);
      strain.noalias() += sample.B2.middleCols<2>(local) * values.u_part.segment<2>(global);
    }
    stresses.col(sample.point) += sample.weight * (super_element.sectors.D.of(sample.element) * strain);
  }
  return stresses;
}

void values_inside(const element::SolvedSuperElement& super_element, const Vec2& centre, const RingSampling& sampling,
                   const element::RadialField& field, const element::InteriorLoads& interior, std::size_t first_level,
                   const SetValues& set) {
  std::vector<double> xis(sampling.levels.begin() + static_cast<std::ptrdiff_t>(first_level), sampling.levels.end());
  if (!super_element.domain.unbounded) xis.push_back(0.0);
  const std::vector<element::RadialField::Values> fields = field.at(xis);
  for (std::size_t level = first_level; level < sampling.levels.size(); ++level) {
    const double xi = sampling.levels[level];
    const element::RadialField::Values& values = fields[level - first_level];
    const Eigen::Matrix3Xd stresses = ring_stresses(super_element, sampling, values, centre, xi, interior);
    for (std::size_t i = 0; i < sampling.size(); ++i) {
      const Vec2 x = xi * sampling.at(i, [&](int node) { return super_element.ring.node(node); });
      const Vec2 u = sampling.at(i, [&](int node) { return Vec2(values.u.segment<2>(place_of(node))); });
      set(Vec2(u + interior.particular_displacement(centre + x)),
          element::Vec3(stresses.col(static_cast<Eigen::Index>(i))),
          super_element.sectors.material_of(sampling.sectors[i]), x);
    }
  }
  if (super_element.domain.unbounded) return;
  const element::RadialField::Values& values = fields.back();
  const Eigen::Matrix3Xd stresses = ring_stresses(super_element, sampling, values, centre, 0.0, interior);
  for (int c = 0; c <= sampling.centre.back(); ++c) {  // the mean of the sectors of one material
    element::Vec3 stress = element::Vec3::Zero();
    int count = 0, material = 0;
    for (std::size_t e = 0; e < sampling.points.size(); ++e) {
      if (sampling.centre[e] != c) continue;
      material = super_element.sectors.material_of(e);
      for (const int i : sampling.points[e]) stress += stresses.col(i), ++count;
    }
    stress /= count;
    set(Vec2(values.u.head<2>() + interior.particular_displacement(centre)), stress, material, Vec2::Zero());
  }
}

}  // namespace scabo::result
