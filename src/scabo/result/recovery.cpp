#include "scabo/result/recovery.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "scabo/element/interior_field.hpp"
#include "scabo/element/line_basis.hpp"
#include "scabo/element/plane_element8.hpp"
#include "scabo/result/probe.hpp"

namespace scabo::result {

namespace {

constexpr int ring_count = 10, inner_rings = 6;

double zz_of(const analysis::StaticSolution& solution, int material, const element::Vec3& stress, double temperature) {
  return element::stress_zz(stress, solution.model.materials[static_cast<std::size_t>(material)],
                            solution.model.analysis.plane, temperature);
}

// Points and cells

/// Position of a point of a ring.
Vec2 on_ring(const mesh::BodyMesh& body, int node, double xi) {
  const Vec2 &centre = body.super_elements.front().centre, &x = body.nodes[static_cast<std::size_t>(node)];
  return xi == 1.0 ? x : Vec2(centre + xi * (x - centre));
}

/// Rings from the boundary inwards, then the centre: quadrilaterals between the rings, triangles at the centre. For an
/// unbounded domain, rings from the boundary outwards.
void add_super_element(Grid& grid, const mesh::BodyMesh& body, const RingSampling& sampling, std::int32_t number) {
  const auto first = static_cast<std::int32_t>(grid.point_count());
  const auto n = static_cast<std::int32_t>(sampling.nodes.size());
  for (const double xi : sampling.levels)
    for (const int node : sampling.nodes) grid.add_point(on_ring(body, node, xi), number);
  const bool unbounded = sampling.levels.back() > 1.0;
  if (!unbounded)
    for (int c = 0; c <= sampling.centre.back(); ++c) grid.add_point(body.super_elements.front().centre, number);
  const auto rings = static_cast<std::int32_t>(sampling.levels.size());
  for (std::int32_t ring = 0; ring < rings; ++ring) {
    const std::int32_t outer = first + ring * n, inner = outer + n;
    for (std::size_t e = 0; e < sampling.points.size(); ++e)
      for (std::size_t i = 0; i + 1 < sampling.points[e].size(); ++i) {
        const std::int32_t a = sampling.points[e][i], b = sampling.points[e][i + 1];
        if (ring + 1 < rings && unbounded)
          grid.add_cell(CellType::quad, std::array{outer + a, inner + a, inner + b, outer + b}, number);
        else if (ring + 1 < rings)
          grid.add_cell(CellType::quad, std::array{inner + a, outer + a, outer + b, inner + b}, number);
        else if (!unbounded)
          grid.add_cell(CellType::triangle, std::array{inner + sampling.centre[e], outer + a, outer + b}, number);
      }
  }
}

void add_finite_elements(Grid& grid, const mesh::BodyMesh& body, std::int32_t number) {
  const auto first = static_cast<std::int32_t>(grid.point_count());
  for (const Vec2& node : body.nodes) grid.add_point(node, number);
  for (mesh::PlaneElement8 element : body.elements) {
    for (int& node : element) node += first;
    grid.add_cell(CellType::quadratic_quad, element, number);
  }
}

/// The outline as a polygon, arcs in pieces of at most 3 degrees.
std::vector<Vec2> polygon_of(const model::Outline& outline) {
  constexpr double largest_turn = 3.0 / 180.0 * 3.14159265358979323846;
  std::vector<Vec2> points;
  for (const model::Edge& edge : outline.edges) {
    const int pieces =
        edge.arc ? std::max(1, static_cast<int>(std::ceil(std::abs(edge.arc->sweep) / largest_turn))) : 1;
    for (int i = 0; i < pieces; ++i) points.push_back(edge.at(static_cast<double>(i) / pieces));
  }
  return points;
}

RigidBody add_rigid(Grid& grid, const model::Outline& outline, std::int32_t number) {
  std::vector<std::size_t> cell;
  RigidBody body;
  const Vec2 centroid = outline.centroid();
  for (const Vec2& x : polygon_of(outline)) {
    cell.push_back(grid.point_count());
    grid.add_point(x, number);
    body.arms.push_back(x - centroid);
  }
  grid.add_cell(CellType::polygon, cell, number);
  return body;
}

// Values

/// Stresses of every point of the ring at xi: the mean of the boundary elements that meet at it.
Eigen::Matrix3Xd ring_stresses(const analysis::SolvedSuperElement& super_element, const RingSampling& sampling,
                               const element::RadialField::Values& values, const mesh::BodyMesh& mesh, double xi,
                               const element::LinearField& temperature) {
  Eigen::Matrix3Xd stresses = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(sampling.nodes.size()));
  for (const RingSampling::Sample& sample : sampling.samples) {
    const auto point = static_cast<std::size_t>(sample.point);
    const std::vector<int>& nodes = super_element.ring.elements[sample.element].nodes;
    element::Vec3 strain = -super_element.sectors.unit_strain_of(sample.element) *
                           temperature.at(on_ring(mesh, sampling.nodes[point], xi));
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto local = static_cast<Eigen::Index>(2 * i), global = static_cast<Eigen::Index>(2 * nodes[i]);
      strain.noalias() += sample.B1.middleCols<2>(local) * values.u_xi.segment<2>(global);
      strain.noalias() += sample.B2.middleCols<2>(local) * values.u_part.segment<2>(global);
    }
    stresses.col(sample.point) += sample.weight * (super_element.sectors.D.of(sample.element) * strain);
  }
  return stresses;
}

void recover_super_element(Fields& fields, std::size_t point, const analysis::StaticSolution& solution,
                           const analysis::IncrementResult& increment, std::size_t body, const RingSampling& sampling) {
  const analysis::SolvedSuperElement& super_element = *solution.super_elements[body];
  const mesh::BodyMesh& mesh = solution.mesh.bodies[body];
  const Vector& boundary = increment.displacements[body];
  const element::InteriorLoads& interior = increment.interior[body];
  const element::RadialField field(super_element.solution, super_element.modes(), boundary, interior.loads);
  const auto stresses_at = [&](double xi, const element::RadialField::Values& values) {
    return ring_stresses(super_element, sampling, values, mesh, xi, interior.temperature);
  };
  for (const double xi : sampling.levels) {
    const element::RadialField::Values values = field.at(xi);
    const Vector& u = xi == 1.0 ? boundary : values.u;
    const Eigen::Matrix3Xd stresses = stresses_at(xi, values);
    for (std::size_t i = 0; i < sampling.nodes.size(); ++i) {
      const element::Vec3 stress = stresses.col(static_cast<Eigen::Index>(i));
      fields.set(point++, u.segment<2>(2 * sampling.nodes[i]), stress,
                 zz_of(solution, super_element.sectors.material_of(sampling.sectors[i]), stress,
                       interior.temperature.at(on_ring(mesh, sampling.nodes[i], xi))));
    }
  }
  if (super_element.domain.unbounded) return;
  const element::RadialField::Values values = field.at(0.0);
  const Eigen::Matrix3Xd stresses = stresses_at(0.0, values);
  for (int c = 0; c <= sampling.centre.back(); ++c) {  // the mean of the sectors of one material
    element::Vec3 stress = element::Vec3::Zero();
    int count = 0, material = 0;
    for (std::size_t e = 0; e < sampling.points.size(); ++e) {
      if (sampling.centre[e] != c) continue;
      material = super_element.sectors.material_of(e);
      for (const int i : sampling.points[e]) stress += stresses.col(i), ++count;
    }
    stress /= count;
    fields.set(point++, values.u.head<2>(), stress,
               zz_of(solution, material, stress, interior.temperature.at(mesh.super_elements.front().centre)));
  }
}

void recover_finite_elements(Fields& fields, std::size_t point, const analysis::StaticSolution& solution,
                             const analysis::IncrementResult& increment, std::size_t body) {
  const mesh::BodyMesh& mesh = solution.mesh.bodies[body];
  const Vector& u = increment.displacements[body];
  const element::Mat3 D = element::elasticity_matrix(
      solution.model.materials[static_cast<std::size_t>(solution.model.bodies[body].material)],
      solution.model.analysis.plane);
  Eigen::Matrix3Xd stresses = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(mesh.nodes.size()));
  std::vector<int> elements_at(mesh.nodes.size(), 0);
  for (const mesh::PlaneElement8& element : mesh.elements) {
    const FiniteElementState state = finite_element_state(mesh, element, u);
    for (std::size_t i = 0; i < element.size(); ++i) {
      const Vec2& natural = element::plane_element8_nodes[i];
      stresses.col(element[i]) += element::plane_element8_values(state.x, state.u, D, natural.x(), natural.y()).stress;
      ++elements_at[static_cast<std::size_t>(element[i])];
    }
  }
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    const auto i = static_cast<Eigen::Index>(node);
    const element::Vec3 stress = stresses.col(i) / elements_at[node];
    fields.set(point++, u.segment<2>(2 * i), stress,
               zz_of(solution, solution.model.bodies[body].material, stress, 0.0));
  }
}

}  // namespace

std::vector<double> ring_levels(const element::Ring& ring) {
  double length = 0.0, radius = 0.0;
  for (std::size_t i = 0; i < ring.nodes.size(); ++i) {
    length += (ring.nodes[(i + 1) % ring.nodes.size()] - ring.nodes[i]).norm();
    radius += ring.nodes[i].norm();
  }
  // Widths w, w g, w g^2 ... of `ring_count` rings add up to 1; g grows with the sum.
  const double width = std::clamp(length / radius, 0.02, 1.0 / ring_count);
  double low = 1.0, high = 2.0;
  for (int halving = 0; halving < 50; ++halving) {
    const double growth = 0.5 * (low + high);
    double sum = 0.0, next = width;
    for (int i = 0; i < ring_count; ++i, next *= growth) sum += next;
    (sum < 1.0 ? low : high) = growth;
  }
  std::vector<double> levels;
  double xi = 1.0, next = width;
  for (int i = 0; i < ring_count; ++i, xi -= next, next *= low) levels.push_back(xi);
  // Stresses may be unbounded towards the centre of an open super-element: each ring is at half the distance of the
  // previous one.
  if (ring.is_open())
    for (int i = 0; i < inner_rings; ++i) levels.push_back(0.5 * levels.back());
  return levels;
}

std::vector<double> outer_ring_levels() {
  std::vector<double> levels{1.0};
  constexpr int rings = 16;
  for (int i = 1; i <= rings; ++i) levels.push_back(std::pow(farthest, static_cast<double>(i) / rings));
  return levels;
}

namespace {

/// Points of the elements of a ring: where materials meet, one point for each of them.
void share_points(const element::Ring& ring, const element::Sectors& sectors, RingSampling& sampling) {
  const std::size_t count = ring.elements.size();
  std::vector<int> point_of(ring.nodes.size(), -1), material_at(ring.nodes.size(), -1);
  for (std::size_t node = 0; node < ring.nodes.size(); ++node) sampling.nodes.push_back(static_cast<int>(node));
  sampling.sectors.assign(ring.nodes.size(), 0);
  for (std::size_t e = 0; e < count; ++e) {
    const int material = sectors.material_of(e);
    const bool goes_on = e > 0 && sectors.material_of(e - 1) == material;
    sampling.centre.push_back(e == 0 ? 0 : sampling.centre.back() + (goes_on ? 0 : 1));
    std::vector<int>& points = sampling.points.emplace_back();
    for (const int node : ring.elements[e].nodes) {
      const auto i = static_cast<std::size_t>(node);
      if (material_at[i] == -1) {
        material_at[i] = material;
        point_of[i] = node;
        sampling.sectors[i] = e;
      } else if (material_at[i] != material) {
        point_of[i] = static_cast<int>(sampling.nodes.size());
        sampling.nodes.push_back(node);
        sampling.sectors.push_back(e);
        material_at[i] = material;
      }
      points.push_back(point_of[i]);
    }
  }
}

}  // namespace

RingSampling ring_sampling(const element::Ring& ring, const element::Sectors& sectors, bool unbounded) {
  RingSampling sampling;
  share_points(ring, sectors, sampling);
  std::vector<int> elements_at(sampling.nodes.size(), 0);
  for (const std::vector<int>& points : sampling.points)
    for (const int point : points) ++elements_at[static_cast<std::size_t>(point)];
  for (std::size_t e = 0; e < ring.elements.size(); ++e) {
    const mesh::LineElement& element = ring.elements[e];
    const int order = static_cast<int>(element.nodes.size()) - 1;
    const element::LineBasis& basis = element::LineBasis::of_order(order);
    const std::vector<double> lobatto = mesh::lobatto_points(order);
    for (std::size_t i = 0; i < element.nodes.size(); ++i) {
      element::StrainMatrices strain =
          element::strain_matrices(ring, element, basis.values(lobatto[i]), basis.derivatives(lobatto[i]));
      const int point = sampling.points[e][i];
      sampling.samples.push_back(
          {point, 1.0 / elements_at[static_cast<std::size_t>(point)], e, std::move(strain.B1), std::move(strain.B2)});
    }
  }
  sampling.levels = unbounded ? outer_ring_levels() : ring_levels(ring);
  return sampling;
}

Recovery::Recovery(const analysis::StaticSolution& solution) {
  const std::size_t count = solution.model.bodies.size();
  for (std::size_t b = 0; b < count; ++b) {
    const mesh::BodyMesh& body = solution.mesh.bodies[b];
    const auto number = static_cast<std::int32_t>(b + 1);
    grid_.first_point.push_back(grid_.point_count());
    if (solution.model.bodies[b].rigid) {
      bodies_.push_back(add_rigid(grid_, solution.model.bodies[b].outline, number));
    } else if (body.super_elements.empty()) {
      add_finite_elements(grid_, body, number);
      bodies_.push_back(FiniteElementBody{});
    } else {
      ensure(body.super_elements.size() == 1, "results of bodies of many super-elements are not written yet");
      SuperElementBody made;
      for (std::size_t other = 0; other < b && !made.sampling; ++other)
        if (solution.super_elements[other] == solution.super_elements[b])
          made = std::get<SuperElementBody>(bodies_[other]);
      if (!made.sampling)
        made.sampling = std::make_shared<const RingSampling>(
            ring_sampling(solution.super_elements[b]->ring, solution.super_elements[b]->sectors,
                          solution.super_elements[b]->domain.unbounded));
      add_super_element(grid_, body, *made.sampling, number);
      bodies_.push_back(std::move(made));
    }
  }
  grid_.first_point.push_back(grid_.point_count());
}

Fields Recovery::fields(const analysis::StaticSolution& solution, const analysis::IncrementResult& increment) const {
  ensure(increment.converged, "only converged increments have fields");
  ensure(increment.displacements.size() == bodies_.size() && increment.interior.size() == bodies_.size(),
         "an increment has displacements and interior loads of every body");
  Fields fields(grid_.point_count());
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const std::size_t point = grid_.first_point[b];
    if (const auto* super_element = std::get_if<SuperElementBody>(&bodies_[b])) {
      recover_super_element(fields, point, solution, increment, b, *super_element->sampling);
    } else if (const auto* rigid = std::get_if<RigidBody>(&bodies_[b])) {
      for (std::size_t i = 0; i < rigid->arms.size(); ++i)
        fields.set(point + i, rigid_displacement(increment.displacements[b], rigid->arms[i]), element::Vec3::Zero(),
                   0.0);
    } else {
      recover_finite_elements(fields, point, solution, increment, b);
    }
  }
  for (std::size_t point = 0; point < grid_.point_count(); ++point)
    for (std::size_t k = 0; k < 2; ++k)
      fields.displacement[3 * point + k] -= increment.reference_displacement[static_cast<Eigen::Index>(k)];
  return fields;
}

}  // namespace scabo::result
