#include "scabo/result/probe.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/foot_points.hpp"

namespace scabo::result {

namespace {

/// Points on the boundary belong to the body.
bool inside(const model::Outline& outline, const Vec2& x) {
  return geometry::encloses(outline, x) || geometry::distance_to(outline, x) <= 1e-12 * geometry::outline_size(outline);
}

}  // namespace

Vec2 rigid_displacement(const Vector& motion, const Vec2& arm) {
  return {motion[0] - motion[2] * arm.y(), motion[1] + motion[2] * arm.x()};
}

FiniteElementState finite_element_state(const mesh::BodyMesh& mesh, const mesh::PlaneElement8& element,
                                        const Vector& u) {
  FiniteElementState state;
  for (std::size_t i = 0; i < element.size(); ++i) {
    state.x[i] = mesh.nodes[static_cast<std::size_t>(element[i])];
    state.u.segment<2>(static_cast<Eigen::Index>(2 * i)) = u.segment<2>(2 * element[i]);
  }
  return state;
}

std::optional<Vec2> natural_coordinates(const element::Corners8& corners, const Vec2& x) {
  constexpr double slack = 1e-9;  // points between two elements belong to one of them
  Vec2 low = corners[0], high = corners[0];
  for (const Vec2& corner : corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const Vec2 size = high - low;
  // Curved sides may extend beyond the bounding box of their nodes by less than a quarter of its size.
  if (((x - low).array() < -0.25 * size.array()).any() || ((x - high).array() > 0.25 * size.array()).any())
    return std::nullopt;
  // Position and its gradient are computed like a displacement field whose nodal values are the coordinates.
  element::Vector16 nodal;
  for (std::size_t i = 0; i < 8; ++i) nodal.segment<2>(static_cast<Eigen::Index>(2 * i)) = corners[i];
  const auto position = [&](const Vec2& at) {
    return element::plane_element8_values(element::plane_element8_nodes, nodal, element::Mat3::Zero(), at.x(), at.y())
        .displacement;
  };
  Vec2 natural = Vec2::Zero();
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Vec2 miss = x - position(natural);
    if (miss.norm() <= 1e-14 * size.norm()) break;
    constexpr double h = 1e-3;  // position is quadratic along r and along s: central differences are exact
    Mat2 J;
    J.col(0) = (position(natural + Vec2(h, 0.0)) - position(natural - Vec2(h, 0.0))) / (2.0 * h);
    J.col(1) = (position(natural + Vec2(0.0, h)) - position(natural - Vec2(0.0, h))) / (2.0 * h);
    natural += J.inverse() * miss;
    if (!(natural.lpNorm<Eigen::Infinity>() < 3.0)) return std::nullopt;
  }
  if (natural.lpNorm<Eigen::Infinity>() > 1.0 + slack) return std::nullopt;
  return natural;
}

Probe::Probe(const analysis::StaticSolution& solution, const analysis::IncrementResult& increment, int body)
    : solution_(solution),
      body_(static_cast<std::size_t>(body)),
      u_(increment.displacements[body_]),
      reference_displacement_(increment.reference_displacement),
      interior_(increment.interior[body_]) {
  const auto& super_element = solution.super_elements[body_];
  if (!super_element) return;
  field_.emplace(super_element->solution, super_element->modes(), u_, interior_.loads);
}

void Probe::expect_many() {
  if (field_ && !table_) table_.emplace(*field_, element::fastest_of(solution_.super_elements[body_]->modes()));
}

std::optional<element::PointValues> Probe::at(const Vec2& x) const {
  const model::Body& body = solution_.model.bodies[body_];
  if (body.rigid) {
    if (!inside(body.outline, x)) return std::nullopt;
    element::PointValues values;
    values.displacement = rigid_displacement(u_, x - body.outline.centroid()) - reference_displacement_;
    return values;
  }
  if (!field_) return in_finite_elements(x);
  const analysis::SolvedSuperElement& super_element = *solution_.super_elements[body_];
  const Vec2& centre = solution_.mesh.bodies[body_].super_elements.front().centre;
  const auto place = element::locate(super_element.ring, x - centre, super_element.domain.unbounded);
  if (!place) return std::nullopt;
  return at(x, *place);
}

element::PointValues Probe::at(const Vec2& x, const element::ScaledPoint& place) const {
  ensure(field_.has_value(), "only super-elements have scaled boundary coordinates");
  const analysis::SolvedSuperElement& super_element = *solution_.super_elements[body_];
  const element::Vec3 free =
      super_element.sectors.unit_strain_of(static_cast<std::size_t>(place.element)) * interior_.temperature.at(x);
  element::PointValues values =
      element::point_values(super_element.ring, table_ ? table_->at(place.xi) : field_->at(place.xi),
                            super_element.sectors.D, place.element, place.eta, free);
  values.displacement -= reference_displacement_;
  return values;
}

std::optional<element::PointValues> Probe::in_finite_elements(const Vec2& x) const {
  const mesh::BodyMesh& mesh = solution_.mesh.bodies[body_];
  const auto material = static_cast<std::size_t>(solution_.model.bodies[body_].material);
  for (const mesh::PlaneElement8& element : mesh.elements) {
    const FiniteElementState state = finite_element_state(mesh, element, u_);
    if (const auto natural = natural_coordinates(state.x, x)) {
      element::PointValues values = element::plane_element8_values(
          state.x, state.u,
          element::elasticity_matrix(solution_.model.materials[material], solution_.model.analysis.plane), natural->x(),
          natural->y());
      values.displacement -= reference_displacement_;
      return values;
    }
  }
  return std::nullopt;
}

std::optional<element::PointValues> value_at(const analysis::StaticSolution& solution,
                                             const analysis::IncrementResult& increment, int body, const Vec2& x) {
  return Probe(solution, increment, body).at(x);
}

}  // namespace scabo::result
