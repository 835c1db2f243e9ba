#include "scabo/result/probe.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/plane/foot_points.hpp"

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

FiniteElementState::FiniteElementState(const analysis::Discretisation& discretisation,
                                       const analysis::FieldState& state, std::size_t body, std::size_t cell)
    : interior_(element::loads_in(state.interior[body], cell)) {
  const mesh::BodyMesh& mesh = discretisation.mesh.bodies[body];
  element_ = element::finite_element_of(mesh.cells[cell], mesh.nodes);
  u_ = state.displacements[body](element::dofs_of(element_));
  const model::Material& material =
      discretisation.model.materials[static_cast<std::size_t>(mesh.cells[cell].materials.front())];
  law_ = element::section_law(material, discretisation.model.analysis.plane);
  revolved_ = discretisation.model.analysis.revolved();
}

element::PointValues FiniteElementState::at(const Vec2& natural) const {
  const double temperature =
      interior_.is_zero() ? 0.0 : interior_.temperature_at(element::position_in(element_, natural));
  return element::finite_element_values(element_, u_, law_, natural, temperature, revolved_);
}

struct Probe::CellField {
  CellField(const element::SolvedSuperElement& cell, Vector displacement, const element::InteriorLoads& interior)
      : u(std::move(displacement)), radial(cell.solution(), cell.modes(), u, interior.loads, interior.motion) {}
  Vector u;
  element::RadialField radial;
  std::optional<element::RadialTable> table;
};

Probe::Probe(const analysis::Discretisation& discretisation, const analysis::FieldState& state, int body)
    : discretisation_(discretisation),
      state_(state),
      body_(static_cast<std::size_t>(body)),
      u_(state.displacements[body_]),
      reference_displacement_(state.reference_displacement(body_)),
      interior_(state.interior[body_]) {}

Probe::~Probe() = default;

const CellLocator& Probe::locator() const {
  if (!locator_) locator_.emplace(discretisation_.mesh.bodies[body_], discretisation_.cells[body_]);
  return *locator_;
}

Probe::CellField& Probe::field_of(std::size_t cell) const {
  std::unique_ptr<CellField>& field = fields_[cell];
  if (!field) {
    const element::SolvedSuperElement& super_element = *discretisation_.cells[body_][cell];
    const std::vector<int> dofs = element::dofs_of(discretisation_.mesh.bodies[body_].cells[cell]);
    const element::InteriorLoads& loads = element::loads_in(interior_, cell);
    const Vec2& centre = discretisation_.mesh.bodies[body_].cells[cell].centre;
    field = std::make_unique<CellField>(super_element, loads.without_particular(super_element.ring, centre, u_(dofs)),
                                        loads);
    if (many_) field->table.emplace(field->radial, element::fastest_of(super_element.modes()));
  }
  return *field;
}

void Probe::expect_many() {
  many_ = true;
  fields_.clear();
}

std::optional<element::PointValues> Probe::at(const Vec2& x) const {
  const model::Body& body = discretisation_.model.bodies[body_];
  if (body.rigid) {
    if (!inside(body.outline, x)) return std::nullopt;
    element::PointValues values;
    values.displacement = rigid_displacement(u_, x - body.outline.centroid()) - reference_displacement_;
    return values;
  }
  const auto place = locator().find(x);
  if (!place) return std::nullopt;
  return at(x, *place);
}

element::PointValues Probe::at(const Vec2& x, const CellPlace& place) const {
  element::PointValues values;
  if (const auto& super_element = discretisation_.cells[body_][place.cell]) {
    CellField& field = field_of(place.cell);
    const element::ScaledPoint& at = place.scaled;
    const element::InteriorLoads& loads = element::loads_in(interior_, place.cell);
    const element::Vec3 free = super_element->sectors.unit_strain_of(static_cast<std::size_t>(at.element)) *
                               loads.temperature_at(x),
                        particular = loads.particular_strain(x);
    values = element::point_values(super_element->ring, field.table ? field.table->at(at.xi) : field.radial.at(at.xi),
                                   super_element->sectors.D, at.element, at.eta, free - particular);
    values.strain += particular;
    values.displacement += loads.particular_displacement(x);
  } else {
    values = FiniteElementState(discretisation_, state_, body_, place.cell).at(place.natural);
  }
  values.stress += state_.initial_of(body_).at(x);
  values.displacement -= reference_displacement_;
  return values;
}

std::optional<element::PointValues> value_at(const analysis::Discretisation& discretisation,
                                             const analysis::FieldState& state, int body, const Vec2& x) {
  return Probe(discretisation, state, body).at(x);
}

}  // namespace scabo::result
