// The loads of a model as nodal forces and as loads inside bodies.
#include "scabo/element/modal_solution.hpp"
#include "scabo/element/plane_element8.hpp"
#include "scabo/element/sectors.hpp"
#include "scabo/system/loads.hpp"
#include "scabo/system/structure.hpp"

namespace scabo::system {

namespace {

/// Nodal forces of a uniform body force on 8-node elements.
Vector uniform_body_force(const mesh::BodyMesh& mesh, double thickness, const Vec2& b) {
  Vector f = Vector::Zero(static_cast<Eigen::Index>(2 * mesh.nodes.size()));
  for (const mesh::PlaneElement8& element : mesh.elements) {
    element::Corners8 x;
    for (std::size_t i = 0; i < 8; ++i) x[i] = mesh.nodes[static_cast<std::size_t>(element[i])];
    const auto areas = element::plane_element8_areas(x);
    for (std::size_t i = 0; i < 8; ++i) f.segment<2>(2 * element[i]) += areas[i] * thickness * b;
  }
  return f;
}

/// One load on one body.
class Applied {
 public:
  Applied(const model::Model& model, const mesh::Mesh& mesh, const BodySystem& system, std::size_t body,
          const model::Place* place)
      : model_(model),
        mesh_(mesh),
        system_(system),
        body_(model.bodies[body]),
        body_mesh_(mesh.bodies[body]),
        place_(place) {}

  Vector nodal = Vector();
  element::InteriorLoads interior;

  void operator()(const model::Force& force) {
    if (body_.rigid) {
      nodal = Vector::Zero(3);
      const std::vector<Vec2> points = rigid_points(*place_, body_);
      for (const Vec2& point : points)
        nodal += rigid_point(point, system_.reference(), system_.lever()).transpose() * force.value /
                 static_cast<double>(points.size());
      return;
    }
    const mesh::PlaceNodes at = mesh::nodes_of(*place_, mesh_);
    if (!at.elements.empty()) {
      const Vec2 traction = force.value / (length_of(at.elements, body_mesh_.nodes) * thickness());
      apply_traction(at, [&](const Vec2&, const Vec2&) { return traction; });
    } else {
      nodal = Vector::Zero(system_.size());
      nodal.segment<2>(2 * at.nodes.front()) = force.value;
    }
  }

  void operator()(const model::Traction& traction) {
    apply_traction(mesh::nodes_of(*place_, mesh_), [&](const Vec2&, const Vec2&) { return traction.value; });
  }

  void operator()(const model::Pressure& pressure) {
    apply_traction(mesh::nodes_of(*place_, mesh_),
                   [&](const Vec2&, const Vec2& n) { return Vec2(-pressure.value * n); });
  }

  void operator()(const model::Gravity& gravity) {
    const auto density_of = [&](int material) {
      return model_.materials[static_cast<std::size_t>(material)].density.value_or(0.0);
    };
    if (body_mesh_.super_elements.empty()) {
      nodal = uniform_body_force(body_mesh_, thickness(), density_of(body_.material) * gravity.value);
      return;
    }
    std::vector<double> density;
    for (const int material : element::sectors_of(model_, body_, body_mesh_).materials)
      density.push_back(density_of(material));
    interior.loads = element::body_force_loads(ring(), {gravity.value.x()}, {gravity.value.y()}, thickness(), density);
  }

  void operator()(const model::FaceTraction& traction) {
    const element::Ring ring = this->ring();
    const auto face = place_->index == 0 ? element::Face::first : element::Face::last;
    for (const model::FaceTraction::Term& term : traction.terms) {
      const Vec2 value = traction.pressure ? Vec2(-term.value.x() * element::face_normal(ring, face)) : term.value;
      element::add_radial_loads(interior.loads, {element::face_load(ring, face, term.power, value, thickness())}, 1.0);
    }
  }

  void operator()(const model::BodyForce& force) {
    interior.loads = element::body_force_loads(ring(), about_centre(force.x), about_centre(force.y), thickness());
  }

  void operator()(const model::Temperature& temperature) {
    const element::Sectors sectors = element::sectors_of(model_, body_, body_mesh_);
    const model::Linear& change = temperature.change;
    interior.temperature = {change.constant, change.per_x, change.per_y};
    interior.loads = element::thermal_loads(ring(), sectors.D, sectors.unit_strain, about_centre(change), thickness());
  }

 private:
  element::LinearField about_centre(const model::Linear& field) const {
    const Vec2& centre = body_mesh_.super_elements.front().centre;
    return {field.constant + field.per_x * centre.x() + field.per_y * centre.y(), field.per_x, field.per_y};
  }
  double thickness() const { return model_.analysis.thickness; }
  element::Ring ring() const { return element::ring_of(body_mesh_.super_elements.front(), body_mesh_.nodes); }
  void apply_traction(const mesh::PlaceNodes& at, const TractionField& traction) {
    nodal = traction_forces(at.elements, body_mesh_.nodes, thickness(), traction);
  }

  const model::Model& model_;
  const mesh::Mesh& mesh_;
  const BodySystem& system_;
  const model::Body& body_;
  const mesh::BodyMesh& body_mesh_;
  const model::Place* place_;
};

}  // namespace

void add_loads(Structure& structure, const model::Model& model, const mesh::Mesh& mesh,
               const std::vector<const element::SuperElementSolution*>& super_elements) {
  for (const model::Load& load : model.loads) {
    std::vector<Vector>& forces = structure.loads.emplace_back(model.bodies.size());
    std::vector<element::InteriorLoads>& interior = structure.interior.emplace_back(model.bodies.size());
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      // Without a place, the load acts on every bounded elastic body.
      if (load.on ? load.on->body != static_cast<int>(b) : model.bodies[b].rigid || model.bodies[b].outside) continue;
      Applied applied(model, mesh, *structure.bodies[b], b, load.on ? &*load.on : nullptr);
      std::visit(applied, load.kind);
      if (!applied.interior.loads.empty())
        applied.nodal = element::equivalent_load(*super_elements[b], applied.interior.loads);
      forces[b] = std::move(applied.nodal);
      interior[b] = std::move(applied.interior);
    }
  }
}

}  // namespace scabo::system
