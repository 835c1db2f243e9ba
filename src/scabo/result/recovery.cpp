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

constexpr int ring_count = 10;

double zz_of(const analysis::StaticSolution& solution, std::size_t body, const element::Vec3& stress) {
  const model::Body& owner = solution.model.bodies[body];
  return element::stress_zz(stress, solution.model.materials[static_cast<std::size_t>(owner.material)],
                            solution.model.analysis.plane);
}

// Points and cells

/// Rings from the boundary inwards, then the centre: quadrilaterals between the rings, triangles at the
/// centre.
void add_super_element(Grid& grid, const mesh::BodyMesh& body, const std::vector<double>& levels,
                       std::int32_t number) {
  const mesh::SuperElement& super_element = body.super_elements.front();
  const auto first = static_cast<std::int32_t>(grid.point_count());
  const auto n = static_cast<std::int32_t>(body.nodes.size());
  for (const double xi : levels)
    for (const Vec2& node : body.nodes)
      grid.add_point(xi == 1.0 ? node : Vec2(super_element.centre + xi * (node - super_element.centre)),
                     number);
  grid.add_point(super_element.centre, number);
  const auto rings = static_cast<std::int32_t>(levels.size());
  for (std::int32_t ring = 0; ring < rings; ++ring) {
    const std::int32_t outer = first + ring * n, inner = outer + n;
    for (const mesh::LineElement& element : super_element.boundary)
      for (std::size_t i = 0; i + 1 < element.nodes.size(); ++i) {
        const std::int32_t a = element.nodes[i], b = element.nodes[i + 1];
        if (ring + 1 < rings)
          grid.add_cell(CellType::quad, std::array{inner + a, outer + a, outer + b, inner + b}, number);
        else
          grid.add_cell(CellType::triangle, std::array{inner, outer + a, outer + b}, number);
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

/// Strains of every node of a ring: the mean of the boundary elements that meet at it.
Eigen::Matrix3Xd ring_strains(const RingSampling& sampling, const element::RadialField::Values& values,
                              Eigen::Index nodes) {
  Eigen::Matrix3Xd strains = Eigen::Matrix3Xd::Zero(3, nodes);
  for (const RingSampling::Sample& sample : sampling.samples) {
    element::Vec3 strain = element::Vec3::Zero();
    for (std::size_t i = 0; i < sample.nodes.size(); ++i) {
      const auto local = static_cast<Eigen::Index>(2 * i),
                 global = static_cast<Eigen::Index>(2 * sample.nodes[i]);
      strain.noalias() += sample.B1.middleCols<2>(local) * values.u_xi.segment<2>(global);
      strain.noalias() += sample.B2.middleCols<2>(local) * values.u_part.segment<2>(global);
    }
    strains.col(sample.node) += sample.weight * strain;
  }
  return strains;
}

void recover_super_element(Fields& fields, std::size_t point, const analysis::StaticSolution& solution,
                           const analysis::IncrementResult& increment, std::size_t body,
                           const RingSampling& sampling) {
  const analysis::SolvedSuperElement& super_element = *solution.super_elements[body];
  const Vector& boundary = increment.displacements[body];
  const auto n = static_cast<Eigen::Index>(super_element.ring.nodes.size());
  const element::RadialField field(
      super_element.solution, super_element.modes(), boundary,
      body_force_load(sampling.body_load_weights, increment.body_forces[body], super_element.thickness));
  for (const double xi : sampling.levels) {
    const element::RadialField::Values values = field.at(xi);
    const Vector& u = xi == 1.0 ? boundary : values.u;
    const Eigen::Matrix3Xd stresses = super_element.D * ring_strains(sampling, values, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const element::Vec3 stress = stresses.col(i);
      fields.set(point++, u.segment<2>(2 * i), stress, zz_of(solution, body, stress));
    }
  }
  const element::RadialField::Values centre = field.at(0.0);
  const element::Vec3 stress = super_element.D * ring_strains(sampling, centre, n).rowwise().mean();
  fields.set(point, centre.u.head<2>(), stress, zz_of(solution, body, stress));
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
      stresses.col(element[i]) +=
          element::plane_element8_values(state.x, state.u, D, natural.x(), natural.y()).stress;
      ++elements_at[static_cast<std::size_t>(element[i])];
    }
  }
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    const auto i = static_cast<Eigen::Index>(node);
    const element::Vec3 stress = stresses.col(i) / elements_at[node];
    fields.set(point++, u.segment<2>(2 * i), stress, zz_of(solution, body, stress));
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
  return levels;
}

RingSampling ring_sampling(const element::Ring& ring) {
  RingSampling sampling;
  std::vector<int> elements_at(ring.nodes.size(), 0);
  for (const mesh::LineElement& element : ring.elements)
    for (const int node : element.nodes) ++elements_at[static_cast<std::size_t>(node)];
  for (const mesh::LineElement& element : ring.elements) {
    const int order = static_cast<int>(element.nodes.size()) - 1;
    const element::LineBasis& basis = element::LineBasis::of_order(order);
    const std::vector<double> points = mesh::lobatto_points(order);
    for (std::size_t i = 0; i < element.nodes.size(); ++i) {
      element::StrainMatrices strain =
          element::strain_matrices(ring, element, basis.values(points[i]), basis.derivatives(points[i]));
      const int node = element.nodes[i];
      sampling.samples.push_back({node, 1.0 / elements_at[static_cast<std::size_t>(node)], element.nodes,
                                  std::move(strain.B1), std::move(strain.B2)});
    }
  }
  sampling.levels = ring_levels(ring);
  sampling.body_load_weights = element::body_load_weights(ring);
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
        made.sampling = std::make_shared<const RingSampling>(ring_sampling(solution.super_elements[b]->ring));
      add_super_element(grid_, body, made.sampling->levels, number);
      bodies_.push_back(std::move(made));
    }
  }
  grid_.first_point.push_back(grid_.point_count());
}

Fields Recovery::fields(const analysis::StaticSolution& solution,
                        const analysis::IncrementResult& increment) const {
  ensure(increment.converged, "only converged increments have fields");
  ensure(increment.displacements.size() == bodies_.size() && increment.body_forces.size() == bodies_.size(),
         "an increment has displacements and body forces of every body");
  Fields fields(grid_.point_count());
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const std::size_t point = grid_.first_point[b];
    if (const auto* super_element = std::get_if<SuperElementBody>(&bodies_[b])) {
      recover_super_element(fields, point, solution, increment, b, *super_element->sampling);
    } else if (const auto* rigid = std::get_if<RigidBody>(&bodies_[b])) {
      for (std::size_t i = 0; i < rigid->arms.size(); ++i)
        fields.set(point + i, rigid_displacement(increment.displacements[b], rigid->arms[i]),
                   element::Vec3::Zero(), 0.0);
    } else {
      recover_finite_elements(fields, point, solution, increment, b);
    }
  }
  return fields;
}

}  // namespace scabo::result
