#include "scabo/element/facet/radial_load.hpp"

#include <algorithm>

#include "scabo/base/components.hpp"
#include "scabo/geometry/line_basis.hpp"

namespace scabo::element {

namespace {

/// Calls visit(element index, N, N_eta, weight) at every point of every boundary element's rule.
template <typename Visit>
void for_each_rule_point(const Ring& ring, Visit visit) {
  for (std::size_t e = 0; e < ring.elements.size(); ++e) {
    const geometry::LineBasis& basis =
        geometry::LineBasis::of_order(static_cast<int>(ring.elements[e].nodes.size()) - 1);
    for (std::size_t q = 0; q < basis.rule().points.size(); ++q) {
      const auto row = static_cast<Eigen::Index>(q);
      visit(e, Vector(basis.values_at_rule().row(row)), Vector(basis.derivatives_at_rule().row(row)),
            basis.rule().weights[q]);
    }
  }
}

Vector zero_of(const Ring& ring) { return Vector::Zero(places_of(ring.nodes.size())); }

}  // namespace

std::vector<RadialLoad> body_force_loads(const Ring& ring, const LinearField& b_x, const LinearField& b_y,
                                         double thickness, const std::vector<double>& density) {
  RadialLoad at_centre{2.0, zero_of(ring), {}}, growing{3.0, zero_of(ring), {}};  // b = b(0) + xi grad b . x_b
  for_each_rule_point(ring, [&](std::size_t e, const Vector& N, const Vector& N_eta, double weight) {
    const mesh::LineElement& element = ring.elements[e];
    const BoundaryPoint point = boundary_point(ring, element, N, N_eta);
    const Vec2 constant(b_x.constant, b_y.constant);
    const Vec2 linear = Vec2(b_x.at(point.x), b_y.at(point.x)) - constant;
    for (std::size_t i = 0; i < element.nodes.size(); ++i) {
      const double share = N[static_cast<Eigen::Index>(i)] * point.jacobian() * weight * thickness *
                           density[density.size() == 1 ? 0 : e];
      at_centre.g.segment<2>(place_of(element.nodes[i])) += share * constant;
      growing.g.segment<2>(place_of(element.nodes[i])) += share * linear;
    }
  });
  std::vector<RadialLoad> loads;
  if (!at_centre.g.isZero(0.0)) loads.push_back(std::move(at_centre));
  if (!growing.g.isZero(0.0)) loads.push_back(std::move(growing));
  return loads;
}

RadialLoad face_load(const Ring& ring, Face face, double power, const Vec2& value, double thickness) {
  ensure(ring.is_open() && power > -1.0, "side faces belong to open super-elements; their tractions are integrable");
  const int node = face == Face::first ? ring.first_node() : ring.last_node();
  RadialLoad load{power + 1.0, zero_of(ring), {}};
  load.g.segment<2>(place_of(node)) = ring.nodes[static_cast<std::size_t>(node)].norm() * thickness * value;  // eq. (3)
  return load;
}

Vec2 face_normal(const Ring& ring, Face face) {
  const int node = face == Face::first ? ring.first_node() : ring.last_node();
  const Vec2 ray = ring.nodes[static_cast<std::size_t>(node)].normalized();
  return face == Face::first ? Vec2(ray.y(), -ray.x()) : Vec2(-ray.y(), ray.x());
}

std::vector<RadialLoad> thermal_loads(const Ring& ring, const Elasticity& D, const std::vector<Vec3>& unit_strain,
                                      const LinearField& temperature, double thickness) {
  RadialLoad at_centre{1.0, zero_of(ring), zero_of(ring)}, growing{2.0, zero_of(ring), zero_of(ring)};
  for_each_rule_point(ring, [&](std::size_t e, const Vector& N, const Vector& N_eta, double weight) {
    const mesh::LineElement& element = ring.elements[e];
    const StrainMatrices strain = strain_matrices(ring, element, N, N_eta);
    const Vec3 stress = D.of(e) * unit_strain[unit_strain.size() == 1 ? 0 : e] * (strain.J * weight * thickness);
    const double linear = temperature.at(boundary_point(ring, element, N, N_eta).x) - temperature.constant;
    const Vector c = strain.B1.transpose() * stress, g = strain.B2.transpose() * stress;  // eq. (4)
    for (std::size_t i = 0; i < element.nodes.size(); ++i) {
      const auto local = place_of(i), global = place_of(element.nodes[i]);
      at_centre.c.segment<2>(global) += temperature.constant * c.segment<2>(local);
      at_centre.g.segment<2>(global) += temperature.constant * g.segment<2>(local);
      growing.c.segment<2>(global) += linear * c.segment<2>(local);
      growing.g.segment<2>(global) += linear * g.segment<2>(local);
    }
  });
  std::vector<RadialLoad> loads;
  for (RadialLoad* load : {&at_centre, &growing})
    if (!load->g.isZero(0.0) || !load->c.isZero(0.0)) loads.push_back(std::move(*load));
  return loads;
}

double integral_of_product(const Ring& ring, const LinearField& one, const LinearField& other,
                           const std::vector<double>& per_product, double thickness) {
  double sum = 0.0;
  for_each_rule_point(ring, [&](std::size_t e, const Vector& N, const Vector& N_eta, double weight) {
    const BoundaryPoint point = boundary_point(ring, ring.elements[e], N, N_eta);
    const double a = one.constant, b = other.constant, to_a = one.at(point.x) - a, to_b = other.at(point.x) - b;
    // The integral of (a + xi to_a) (b + xi to_b) xi from 0 to 1.
    sum += (a * b / 2.0 + (a * to_b + b * to_a) / 3.0 + to_a * to_b / 4.0) * point.jacobian() * weight * thickness *
           per_product[per_product.size() == 1 ? 0 : e];
  });
  return sum;
}

double InteriorLoads::temperature_at(const Vec2& x) const {
  double T = temperature.at(x);
  for (const TemperatureRemainder& remainder : remainders) T += remainder.at(x);
  return T;
}

Vec2 InteriorLoads::particular_displacement(const Vec2& x) const {
  Vec2 u = Vec2::Zero();
  for (const TemperatureRemainder& remainder : remainders) u += remainder.displacement(x);
  return u;
}

Vec3 InteriorLoads::particular_strain(const Vec2& x) const {
  Vec3 strain = Vec3::Zero();
  for (const TemperatureRemainder& remainder : remainders) strain += remainder.strain(x);
  return strain;
}

Vector InteriorLoads::without_particular(const Ring& ring, const Vec2& centre, Vector u) const {
  if (remainders.empty()) return u;
  for (std::size_t i = 0; i < ring.nodes.size(); ++i)
    u.segment<2>(place_of(i)) -= particular_displacement(centre + ring.nodes[i]);
  return u;
}

void add(InteriorLoads& to, const InteriorLoads& loads, double factor) {
  add_radial_loads(to.loads, loads.loads, factor);
  to.temperature.constant += factor * loads.temperature.constant;
  to.temperature.per_x += factor * loads.temperature.per_x;
  to.temperature.per_y += factor * loads.temperature.per_y;
  if (factor == 0.0) return;
  for (const TemperatureRemainder& remainder : loads.remainders) to.remainders.push_back(remainder.times(factor));
}

const InteriorLoads& loads_in(const CellLoads& loads, std::size_t cell) {
  static const InteriorLoads none;
  return loads.empty() ? none : loads[cell];
}

void add_radial_loads(std::vector<RadialLoad>& to, const std::vector<RadialLoad>& loads, double factor) {
  if (factor == 0.0) return;
  for (const RadialLoad& load : loads) {
    auto same = std::find_if(to.begin(), to.end(), [&](const RadialLoad& other) { return other.power == load.power; });
    if (same == to.end()) same = to.insert(to.end(), {load.power, Vector::Zero(load.g.size()), {}});
    same->g += factor * load.g;
    if (load.c.size() == 0) continue;
    if (same->c.size() == 0) same->c = Vector::Zero(load.c.size());
    same->c += factor * load.c;
  }
}

}  // namespace scabo::element
