#include "scabo/system/thermal_energy.hpp"

#include <algorithm>
#include <array>

#include "scabo/base/components.hpp"
#include "scabo/element/plane/finite_element.hpp"
#include "scabo/element/plane/initial_stress.hpp"
#include "scabo/element/sbfem/modal_solution.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/system/loads.hpp"

namespace scabo::system {

namespace {

using element::InteriorLoads;
using element::LinearField;
using element::TemperatureRemainder;

/// Of a polygon, the part where s . x >= least (sign 1) or <= least (sign -1); parts that only a line of no width joins
/// stay joined by it.
std::vector<Vec2> clipped(const std::vector<Vec2>& polygon, const Vec2& s, double least, double sign) {
  std::vector<Vec2> inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double from = sign * (s.dot(a) - least), to = sign * (s.dot(b) - least);
    if (from >= 0.0) inside.push_back(a);
    if ((from < 0.0 && to > 0.0) || (from > 0.0 && to < 0.0)) inside.push_back(a + from / (from - to) * (b - a));
  }
  return inside;
}

/// Integral over a polygon of a function that is quadratic in it, by the middles of the sides of triangles.
template <typename Quadratic>
double integral_over(const std::vector<Vec2>& polygon, const Quadratic& f) {
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec2 &a = polygon.front(), &b = polygon[i], &c = polygon[i + 1];
    const double area = 0.5 * cross(Vec2(b - a), Vec2(c - a));
    if (area != 0.0) sum += area / 3.0 * (f(0.5 * (a + b)) + f(0.5 * (b + c)) + f(0.5 * (c + a)));
  }
  return sum;
}

/// Integral of the product of two remainders over a polygon, piece by piece of both.
double product_of(const TemperatureRemainder& one, const TemperatureRemainder& other,
                  const std::vector<Vec2>& polygon) {
  const auto product = [&](const Vec2& x) { return one.at(x) * other.at(x); };
  const auto in_pieces = [](const TemperatureRemainder& r, const std::vector<Vec2>& whole, const auto& visit) {
    const std::vector<double>& s = r.places();
    for (std::size_t k = 0; k + 1 < s.size(); ++k) {
      std::vector<Vec2> piece = whole;  // the first and the last piece reach as far as the polygon
      if (k > 0) piece = clipped(piece, r.direction(), s[k], 1.0);
      if (k + 2 < s.size()) piece = clipped(piece, r.direction(), s[k + 1], -1.0);
      if (piece.size() > 2) visit(piece);
    }
  };
  double sum = 0.0;
  in_pieces(one, polygon, [&](const std::vector<Vec2>& piece) {
    in_pieces(other, piece, [&](const std::vector<Vec2>& part) { sum += integral_over(part, product); });
  });
  return sum;
}

/// Of a linear field of absolute (x, y), that relative to `centre`.
LinearField about(const LinearField& field, const Vec2& centre) { return {field.at(centre), field.per_x, field.per_y}; }

/// a'D a + E3 alpha3^2.
double heat_of(const element::Mat3& D, const element::Vec3& unit_strain, const model::Material& material,
               model::Plane plane) {
  return unit_strain.dot(D * unit_strain) + element::heat_across(material, plane);
}

class OfSuperElement {
 public:
  OfSuperElement(const model::Model& model, const element::SolvedSuperElement& cell, const Vec2& centre)
      : model_(model), cell_(cell), centre_(centre) {
    const element::Sectors& sectors = cell.sectors;
    for (std::size_t e = 0; e < sectors.materials.size(); ++e)
      heat_.push_back(heat_of(sectors.D.of(e), sectors.unit_strain_of(e),
                              model.materials[static_cast<std::size_t>(sectors.materials[e])], model.analysis.plane));
    for (const Vec2& x : cell.ring.nodes) nodes_.push_back(centre + x);
  }

  /// Eqs. (3) and (4).
  double between(const InteriorLoads& one, const InteriorLoads& other) const {
    double sum = element::integral_of_product(cell_.ring, about(one.temperature, centre_),
                                              about(other.temperature, centre_), heat_, cell_.thickness);
    if (moves_inside(one) && moves_inside(other)) sum -= element::work_inside(cell_.solution(), one.loads, other.loads);
    if (one.remainders.empty() && other.remainders.empty()) return sum;
    const Vector u = particular(one), u_other = particular(other);
    sum += u.dot(forces(other, u_other)) + u_other.dot(forces(one, u)) - u.dot(cell_.K() * u_other);
    const element::Mat3& D = cell_.sectors.D.of(0);
    const element::Vec3& strain = cell_.sectors.unit_strain_of(0);
    const double across = element::heat_across(
        model_.materials[static_cast<std::size_t>(cell_.sectors.materials.front())], model_.analysis.plane);
    const auto stress_of = [&](const TemperatureRemainder& r) {
      return element::particular_stress(D, strain, r.direction(), r.motion());
    };
    for (const TemperatureRemainder& r : one.remainders)
      for (const TemperatureRemainder& r_other : other.remainders)
        sum += cell_.thickness * product_of(r, r_other, polygon()) *
               (stress_of(r).dot(D.llt().solve(stress_of(r_other))) + across);
    return sum;
  }

 private:
  /// Not of one temperature in one material.
  bool moves_inside(const InteriorLoads& loads) const {
    return !loads.loads.empty() &&
           (cell_.sectors.materials.size() > 1 || loads.temperature.per_x != 0.0 || loads.temperature.per_y != 0.0);
  }

  /// u_p at the nodes, without its translation, which would leave rounding alone.
  Vector particular(const InteriorLoads& loads) const {
    Vector u = Vector::Zero(places_of(nodes_.size()));
    const Vec2 at_centre = loads.particular_displacement(centre_);
    if (!loads.remainders.empty())
      for (std::size_t i = 0; i < nodes_.size(); ++i)
        u.segment<2>(place_of(i)) = loads.particular_displacement(nodes_[i]) - at_centre;
    return u;
  }

  /// All nodal forces, as in apply_loads.cpp.
  Vector forces(const InteriorLoads& loads, const Vector& u) const {
    Vector f = element::equivalent_load(cell_.solution(), loads.loads) + cell_.K() * u;
    for (const TemperatureRemainder& r : loads.remainders) {
      const element::Vec3 stress =
          element::particular_stress(cell_.sectors.D.of(0), cell_.sectors.unit_strain_of(0), r.direction(), r.motion());
      f -=
          traction_forces(cell_.ring.elements, nodes_, cell_.thickness,
                          [&](const Vec2& x, const Vec2& n) { return Vec2(element::traction_of(stress, n) * r.at(x)); },
                          {[&](const Vec2& x) { return r.direction().dot(x); }, r.places()});
    }
    return f;
  }

  /// Tables act in closed cells alone.
  std::vector<Vec2> polygon() const {
    std::vector<Vec2> points;
    for (const mesh::LineElement& element : cell_.ring.elements)
      for (std::size_t i = 0; i + 1 < element.nodes.size(); ++i)
        points.push_back(nodes_[static_cast<std::size_t>(element.nodes[i])]);
    return points;
  }

  const model::Model& model_;
  const element::SolvedSuperElement& cell_;
  Vec2 centre_;
  std::vector<double> heat_;  // one for all boundary elements or one for each
  std::vector<Vec2> nodes_;   // absolute
};

}  // namespace

std::vector<ThermalEnergy> thermal_energies(const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs,
                                            const std::vector<element::SolvedCells>& cells,
                                            const std::vector<std::vector<element::CellLoads>>& interior) {
  std::vector<ThermalEnergy> energies(dofs.parts());
  bool any = false;
  for (std::size_t p = 0; p < energies.size(); ++p) {
    ThermalEnergy& energy = energies[p];
    for (std::size_t load = 0; load < model.loads.size(); ++load) {
      const auto& bodies = dofs.bodies_of(p);
      if (std::holds_alternative<model::Temperature>(model.loads[load].kind) &&
          std::any_of(bodies.begin(), bodies.end(),
                      [&](int b) { return !interior[load][static_cast<std::size_t>(b)].empty(); }))
        energy.loads.push_back(static_cast<int>(load));
    }
    const auto count = static_cast<Eigen::Index>(energy.loads.size());
    energy.Q = Matrix::Zero(count, count);
    any = any || count > 0;
    for (const int b : dofs.bodies_of(p)) {
      const auto body = static_cast<std::size_t>(b);
      for (std::size_t c = 0; count > 0 && c < mesh.bodies[body].cells.size(); ++c) {
        const mesh::Cell& cell = mesh.bodies[body].cells[c];
        const auto in_cell = [&](Eigen::Index k) -> const InteriorLoads& {
          const auto load = static_cast<std::size_t>(energy.loads[static_cast<std::size_t>(k)]);
          return element::loads_in(interior[load][body], c);
        };
        const auto add = [&](const auto& between) {
          for (Eigen::Index i = 0; i < count; ++i)
            for (Eigen::Index j = 0; j <= i; ++j) {
              if (in_cell(i).is_zero() || in_cell(j).is_zero()) continue;
              energy.Q(i, j) += between(in_cell(i), in_cell(j));
              energy.Q(j, i) = energy.Q(i, j);
            }
        };
        if (cells[body][c]) {
          const OfSuperElement of_cell(model, *cells[body][c], cell.centre);
          add([&](const InteriorLoads& one, const InteriorLoads& other) { return of_cell.between(one, other); });
          continue;
        }
        const element::FiniteElement finite = element::finite_element_of(cell, mesh.bodies[body].nodes);
        const model::Material& material = model.materials[static_cast<std::size_t>(cell.materials.front())];
        const element::SectionLaw law = element::section_law(material, model.analysis.plane);
        const double heat =
            law.unit_strain.dot(law.D * law.unit_strain) + element::heat_across(material, model.analysis.plane);
        add([&](const InteriorLoads& one, const InteriorLoads& other) {
          return heat * element::finite_element_product(finite, one.temperature, other.temperature,
                                                        model::extent_of(model, b));
        });
      }
    }
  }
  if (!any) energies.clear();
  return energies;
}

}  // namespace scabo::system
