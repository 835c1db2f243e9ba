// The loads of a model as nodal forces and as loads inside bodies.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scabo/base/components.hpp"
#include "scabo/element/plane/finite_element.hpp"
#include "scabo/element/sbfem/modal_solution.hpp"
#include "scabo/mesh/plane/crack_faces.hpp"
#include "scabo/system/assembly.hpp"
#include "scabo/system/loads.hpp"
#include "scabo/system/pore_pressure.hpp"
#include "scabo/system/structure.hpp"

namespace scabo::system {

namespace {

/// One load on one body.
class Applied {
 public:
  Applied(const model::Model& model, const mesh::Mesh& mesh, const std::vector<element::SolvedCells>& cells,
          const BodySystem& part, std::size_t body, const model::Place* place)
      : model_(model),
        mesh_(mesh),
        part_(part),
        number_(static_cast<int>(body)),
        body_(model.bodies[body]),
        body_mesh_(mesh.bodies[body]),
        cells_(cells[body]),
        place_(place) {}

  Vector nodal = Vector();      // in the numbering of the body
  double outward = 0.0;         // Structure::outward
  element::CellLoads interior;  // empty: none
  element::InitialStress initial;

  void operator()(const model::Force& force) {
    if (body_.rigid) {
      nodal = Vector::Zero(3);
      const std::vector<Vec2> points = rigid_points(*place_, body_);
      for (const Vec2& point : points) add_to_rigid(point, force.value / static_cast<double>(points.size()));
      return;
    }
    const mesh::PlaceNodes at = mesh::nodes_of(*place_, mesh_);
    if (!at.elements.empty()) {
      const Vec2 traction = force.value / area_of(at.elements, body_mesh_.nodes, extent());
      return apply_traction(at, [&](const Vec2&, const Vec2&) { return traction; });
    }
    nodal = Vector::Zero(size());
    nodal.segment<2>(place_of(at.nodes.front())) = force.value;
  }

  void operator()(const model::Traction& traction) {
    if (body_.rigid) return apply_to_rigid({[&](const Vec2&, const Vec2&) { return traction.value; }, {}});
    apply_traction(mesh::nodes_of(*place_, mesh_), [&](const Vec2&, const Vec2&) { return traction.value; });
    add_at_tips([&](const Vec2&) { return traction.value; });
  }

  void operator()(const model::Pressure& pressure) {
    const auto along_normal = [&](const Vec2& n) { return Vec2(-pressure.value * n); };
    if (body_.rigid) return apply_to_rigid({[&](const Vec2&, const Vec2& n) { return along_normal(n); }, {}});
    apply_traction(mesh::nodes_of(*place_, mesh_), [&](const Vec2&, const Vec2& n) { return along_normal(n); });
    add_at_tips(along_normal);
  }

  void operator()(const model::EdgeTable& table) { apply(varying_traction(table, edge())); }

  void operator()(const model::Water& water) { apply(varying_traction(water)); }
  /// A load that moves, at a place along its edge.
  void at_place(const model::Load& load, double place) {
    if (const auto* force = std::get_if<model::Force>(&load.kind)) {
      if (!body_.rigid) {
        nodal = forces_at_place(mesh::nodes_of(*place_, mesh_).elements, body_mesh_.nodes, edge(), place, force->value);
        return;
      }
      nodal = Vector::Zero(3);
      if (place >= 0.0 && place <= edge().length()) add_to_rigid(edge().at(place / edge().length()), force->value);
      return;
    }
    auto table = std::get<model::EdgeTable>(load.kind);
    for (model::EdgeTable::Point& point : table.points) point.at += place;
    (*this)(table);
  }
  /// A load at factor 1: one that moves in the middle of its edge.
  void operator()(const model::Load& load) {
    if (!load.moving) return std::visit(*this, load.kind);
    const auto* table = std::get_if<model::EdgeTable>(&load.kind);
    const double middle = table ? 0.5 * (table->points.front().at + table->points.back().at) : 0.0;
    at_place(load, 0.5 * edge().length() - middle);
  }

  void operator()(const model::Gravity& gravity) {
    if (body_.rigid) {
      nodal = Vector::Zero(3);
      const double mass =
          body_.density.value_or(0.0) * body_.outline.area() * extent().at(body_.outline.centroid().x());
      add_to_rigid(body_.outline.centroid(), mass * gravity.value);
      for (const model::PointMass& point : model::point_masses_on(model_, number_))
        add_to_rigid(rigid_points(*point.on, body_).front(), point.mass * gravity.value);
      return;
    }
    const auto density_of = [&](int material) {
      return model_.materials[static_cast<std::size_t>(material)].density.value_or(0.0);
    };
    for_each_cell(
        [&](const element::SolvedSuperElement& cell, const Vec2&, element::InteriorLoads& loads) {
          std::vector<double> density;
          for (const int material : cell.sectors.materials) density.push_back(density_of(material));
          loads.loads =
              element::body_force_loads(cell.ring, {gravity.value.x()}, {gravity.value.y()}, thickness(), density);
        },
        [&](const element::FiniteElement& cell, const model::Material& material, element::InteriorLoads&) {
          const Vec2 f = material.density.value_or(0.0) * gravity.value;
          return element::finite_element_body_force(cell, {f.x()}, {f.y()}, extent());
        });
    for (const model::PointMass& point : model::point_masses_on(model_, number_))
      nodal.segment<2>(place_of(mesh::nodes_of(*point.on, mesh_).nodes.front())) += point.mass * gravity.value;
  }

  void operator()(const model::Spin& spin) {
    for_each_cell([](const auto&...) {},
                  [&](const element::FiniteElement& cell, const model::Material& material, element::InteriorLoads&) {
                    return element::finite_element_spin_force(cell, material.density.value_or(0.0), spin.value,
                                                              extent());
                  });
  }

  void operator()(const model::FaceTraction& traction) {
    const auto face = place_->index == 0 ? element::Face::first : element::Face::last;
    for_each_cell(
        [&](const element::SolvedSuperElement& cell, const Vec2&, element::InteriorLoads& loads) {
          if (!cell.ring.is_open()) return;
          for (const model::FaceTraction::Term& term : traction.terms) {
            const Vec2 value =
                traction.pressure ? Vec2(-term.value.x() * element::face_normal(cell.ring, face)) : term.value;
            element::add_radial_loads(loads.loads,
                                      {element::face_load(cell.ring, face, term.power,
                                                          std::pow(cell.scale, term.power) * value, thickness())},
                                      1.0);
          }
        },
        no_force);
    if (body_mesh_.faces.empty()) return;
    // Where the super-element is divided into rings, it acts on the elements of its face.
    const Vec2& centre = body_mesh_.cells.front().centre;
    const auto end = static_cast<std::size_t>(body_mesh_.mouth[static_cast<std::size_t>(place_->index)]);
    const double length = (body_mesh_.nodes[end] - centre).norm();
    const auto at = [&](const Vec2& x, const Vec2& n) {
      Vec2 sum = Vec2::Zero();
      for (const model::FaceTraction::Term& term : traction.terms)
        sum += std::pow((x - centre).norm() / length, term.power) *
               (traction.pressure ? Vec2(-term.value.x() * n) : term.value);
      return sum;
    };
    nodal += traction_forces(body_mesh_.faces[static_cast<std::size_t>(place_->index)], body_mesh_.nodes, thickness(),
                             at, {[](const Vec2&) { return 0.0; }, {}});
  }

  void operator()(const model::BodyForce& force) {
    for_each_cell(
        [&](const element::SolvedSuperElement& cell, const Vec2& centre, element::InteriorLoads& loads) {
          loads.loads =
              element::body_force_loads(cell.ring, about(centre, force.x), about(centre, force.y), thickness());
        },
        [&](const element::FiniteElement& cell, const model::Material&, element::InteriorLoads&) {
          return element::finite_element_body_force(cell, linear(force.x), linear(force.y), extent());
        });
  }

  void operator()(const model::Temperature& temperature) {
    if (temperature.table) return apply(*temperature.table);
    const model::Linear& change = temperature.change;
    for_each_cell(
        [&](const element::SolvedSuperElement& cell, const Vec2& centre, element::InteriorLoads& loads) {
          loads.temperature = linear(change);
          loads.loads = element::thermal_loads(cell.ring, cell.sectors.D, cell.sectors.unit_strain,
                                               about(centre, change), thickness());
        },
        [&](const element::FiniteElement& cell, const model::Material& material, element::InteriorLoads& loads) {
          loads.temperature = linear(change);
          return element::finite_element_thermal_force(cell, element::section_law(material, model_.analysis.plane),
                                                       loads.temperature, extent());
        });
  }

  /// Uniform traction along an arc, whose moment about the centre of the arc is given.
  void twist(double moment, const mesh::PlaceNodes& at) {
    const Vec2& centre = edge().arc->centre;
    apply_traction(at, [&](const Vec2& x, const Vec2&) {
      const Vec2 arm = (x - centre).normalized();
      return Vec2(-arm.y(), arm.x());
    });
    double of_unit = 0.0;
    for (std::size_t node = 0; node < body_mesh_.nodes.size(); ++node)
      of_unit += cross(body_mesh_.nodes[node] - centre, nodal.segment<2>(place_of(node)));
    nodal *= moment / of_unit;
  }

  /// Normal traction linear along a straight edge, without a resultant; along an arc a tangential one.
  void operator()(const model::Moment& moment) {
    if (body_.rigid) {
      nodal = Vector::Unit(3, 2) * (moment.value / part_.lever());
      return;
    }
    const mesh::PlaceNodes at = mesh::nodes_of(*place_, mesh_);
    if (edge().arc) return twist(moment.value, at);
    const Vec2 start = edge().start, along = (edge().end - start) / edge().length();
    // Over the elements, between which the edge of an image may have gaps: length, first and second moment.
    double length = 0.0, first = 0.0, second = 0.0;
    for (const mesh::LineElement& element : at.elements) {
      const auto position = [&](int node) {
        return along.dot(body_mesh_.nodes[static_cast<std::size_t>(node)] - start);
      };
      const double from = position(element.nodes.front()), to = position(element.nodes.back());
      length += to - from;
      first += (to * to - from * from) / 2.0;
      second += (to * to * to - from * from * from) / 3.0;
    }
    const double slope = moment.value / (thickness() * (second - first * first / length));
    const Vec2 middle = start + first / length * along;
    // The normal is the direction of the edge turned clockwise.
    apply_traction(at, [&](const Vec2& x, const Vec2& n) { return Vec2(-slope * along.dot(x - middle) * n); });
  }

  void operator()(const model::PorePressure&) {}  // not of a body: add_pore_pressure()
  void operator()(const model::AtRest&) {}        // of the springs: add_loads()

  void operator()(const model::UniformStress& uniform) { apply(element::initial_stress(uniform)); }
  void operator()(const model::GroundStress& ground) { apply(element::initial_stress(ground)); }

 private:
  /// Every cell takes the nearest linear field; a super-element of one material, without side faces, also the
  /// remainder.
  void apply(const model::TemperatureTable& table) {
    for_each_cell(
        [&](const element::SolvedSuperElement& cell, const Vec2& centre, element::InteriorLoads& loads) {
          element::TableInCell in_cell = element::in_cell(table, polygon_of(cell, centre));
          loads.temperature = in_cell.linear;
          const element::LinearField& T = in_cell.linear;
          loads.loads = element::thermal_loads(cell.ring, cell.sectors.D, cell.sectors.unit_strain,
                                               {T.at(centre), T.per_x, T.per_y}, thickness());
          if (in_cell.r.empty() || cell.ring.is_open() || cell.sectors.materials.size() > 1) return;
          const Vec2 motion =
              element::particular_motion(cell.sectors.D.of(0), cell.sectors.unit_strain_of(0), table.along);
          loads.remainders.emplace_back(table.along, motion, std::move(in_cell.s), std::move(in_cell.r));
        },
        [&](const element::FiniteElement& cell, const model::Material& material, element::InteriorLoads& loads) {
          std::vector<Vec2> polygon;  // corners and, between them, the middles of the sides
          for (int corner = 0; corner < cell.corners(); ++corner) {
            polygon.push_back(cell.x[static_cast<std::size_t>(corner)]);
            if (cell.size() > cell.corners())
              polygon.push_back(cell.x[static_cast<std::size_t>(corner + cell.corners())]);
          }
          loads.temperature = element::in_cell(table, polygon).linear;
          return element::finite_element_thermal_force(cell, element::section_law(material, model_.analysis.plane),
                                                       loads.temperature, extent());
        });
    for (std::size_t c = 0; c < interior.size(); ++c)
      for (const element::TemperatureRemainder& remainder : interior[c].remainders)
        nodal(element::dofs_of(body_mesh_.cells[c])) += forces_of(remainder, *cells_[c], body_mesh_.cells[c].centre);
  }

  /// The nodes of a super-element along its boundary, with the scaling centre of an open one; absolute.
  static std::vector<Vec2> polygon_of(const element::SolvedSuperElement& cell, const Vec2& centre) {
    std::vector<Vec2> polygon;
    for (const mesh::LineElement& element : cell.ring.elements)
      for (std::size_t i = 0; i + 1 < element.nodes.size(); ++i)
        polygon.push_back(centre + cell.ring.node(element.nodes[i]));
    if (cell.ring.is_open()) {
      polygon.push_back(centre + cell.ring.node(cell.ring.last_node()));
      polygon.push_back(centre);
    }
    return polygon;
  }

  /// Equivalent nodal forces of a remainder, temperature_table.hpp (3).
  Vector forces_of(const element::TemperatureRemainder& remainder, const element::SolvedSuperElement& cell,
                   const Vec2& centre) const {
    std::vector<Vec2> nodes;
    for (const Vec2& x : cell.ring.nodes) nodes.push_back(centre + x);
    Vector u(places_of(nodes.size()));
    const Vec2 at_centre = remainder.displacement(centre);  // its own translation would only leave rounding
    for (std::size_t i = 0; i < nodes.size(); ++i)
      u.segment<2>(place_of(i)) = remainder.displacement(nodes[i]) - at_centre;
    const element::Vec3 stress = element::particular_stress(cell.sectors.D.of(0), cell.sectors.unit_strain_of(0),
                                                            remainder.direction(), remainder.motion());
    const Breaks breaks{[&](const Vec2& x) { return remainder.direction().dot(x); }, remainder.places()};
    return cell.K() * u -
           traction_forces(
               cell.ring.elements, nodes, thickness(),
               [&](const Vec2& x, const Vec2& n) { return Vec2(element::traction_of(stress, n) * remainder.at(x)); },
               breaks);
  }

  /// A stress in equilibrium with the weight that belongs to it does not deform a body on whose boundary the tractions
  /// act that it has there. What is not there acts as a load: -n sigma on the boundary. On the sides between cells the
  /// two cells cancel each other; they are left out.
  void apply(const element::InitialStress& stress) {
    initial = stress;
    nodal = Vector::Zero(size());
    const auto side = [](auto first, auto last) { return std::array{*first, *(first + 1), *(last - 1)}; };
    std::vector<std::array<int, 3>> sides;
    for (const mesh::Cell& cell : body_mesh_.cells)
      for (const mesh::LineElement& element : cell.boundary)
        sides.push_back(side(element.nodes.begin(), element.nodes.end()));
    std::sort(sides.begin(), sides.end());
    std::vector<mesh::LineElement> boundary;
    for (const mesh::Cell& cell : body_mesh_.cells)
      for (const mesh::LineElement& element : cell.boundary)
        if (!std::binary_search(sides.begin(), sides.end(), side(element.nodes.rbegin(), element.nodes.rend())))
          boundary.push_back(element);
    // The elements of an unbounded cell run around its hole, which has the normal out of the body on its other side.
    const double sign = body_.outside ? 1.0 : -1.0;
    const auto released = [&](const Vec2& x, const Vec2& n) {
      return Vec2(sign * element::traction_of(stress.at(x), n));
    };
    nodal += traction_forces(boundary, body_mesh_.nodes, extent(), released, {[](const Vec2&) { return 0.0; }, {}});
    release_side_faces(stress);
  }

  /// The same on the side faces of open cells, which have no elements: linear from the scaling centre to the boundary.
  void release_side_faces(const element::InitialStress& stress) {
    const double level = 1e-13 * (stress.constant.norm() +
                                  body_mesh_.nodes.front().norm() * (stress.per_x.norm() + stress.per_y.norm()));
    for (std::size_t c = 0; c < body_mesh_.cells.size(); ++c) {
      if (!cells_[c] || !cells_[c]->ring.is_open()) continue;
      const element::SolvedSuperElement& cell = *cells_[c];
      const Vec2& centre = body_mesh_.cells[c].centre;
      std::vector<element::RadialLoad> loads;
      for (const auto face : {element::Face::first, element::Face::last}) {
        const Vec2 n = element::face_normal(cell.ring, face);
        const int node = face == element::Face::first ? cell.ring.first_node() : cell.ring.last_node();
        const Vec2 end = centre + cell.ring.nodes[static_cast<std::size_t>(node)];
        const Vec2 at_centre = -element::traction_of(stress.at(centre), n),
                   change = -element::traction_of(stress.at(end), n) - at_centre;
        if (at_centre.norm() <= level && change.norm() <= level) continue;
        if (cell.domain.unbounded)
          throw InputError(model_.file,
                           {{body_.source, fmt::format("the stress of a field acts on the free surface of this body, "
                                                       "which reaches to infinity from ({:.6g}, {:.6g}): only a field "
                                                       "without traction there is possible, as of ground below its "
                                                       "surface",
                                                       end.x(), end.y())}});
        if (at_centre.norm() > level)
          element::add_radial_loads(loads, {element::face_load(cell.ring, face, 0.0, at_centre, thickness())}, 1.0);
        if (change.norm() > level)
          element::add_radial_loads(loads, {element::face_load(cell.ring, face, 1.0, change, thickness())}, 1.0);
      }
      if (loads.empty()) continue;
      interior.resize(body_mesh_.cells.size());
      nodal(element::dofs_of(body_mesh_.cells[c])) += element::equivalent_load(cell.solution(), loads);
      interior[c].loads = std::move(loads);
    }
  }

  /// Fills `interior` and adds what it is worth at the nodes, which `of_finite` returns for finite elements.
  template <typename OfSuperElement, typename OfFinite>
  void for_each_cell(const OfSuperElement& of_super_element, const OfFinite& of_finite) {
    nodal = Vector::Zero(size());
    interior.resize(body_mesh_.cells.size());
    for (std::size_t c = 0; c < interior.size(); ++c) {
      const mesh::Cell& cell = body_mesh_.cells[c];
      if (!cells_[c]) {
        const element::FiniteElement finite = element::finite_element_of(cell, body_mesh_.nodes);
        const model::Material& material = model_.materials[static_cast<std::size_t>(cell.materials.front())];
        nodal(element::dofs_of(finite)) += of_finite(finite, material, interior[c]);
        continue;
      }
      of_super_element(*cells_[c], cell.centre, interior[c]);
      if (!interior[c].loads.empty())
        nodal(element::dofs_of(cell)) += element::equivalent_load(cells_[c]->solution(), interior[c].loads);
    }
  }

  /// What a traction on the face of a crack is on the side faces of the cells around its tips: those have no elements,
  /// but take it exactly. `of_normal`: the traction where the face has this outward normal.
  template <typename OfNormal>
  void add_at_tips(const OfNormal& of_normal) {
    if (place_->kind != model::Place::Kind::face) return;
    for (const mesh::TipFace& tip : mesh::tip_faces(body_, body_mesh_)) {
      if (2 * tip.crack + (tip.left ? 1 : 0) != place_->index) continue;
      interior.resize(body_mesh_.cells.size());
      const element::SolvedSuperElement& cell = *cells_[tip.cell];
      const auto face = tip.last ? element::Face::last : element::Face::first;
      element::InteriorLoads& loads = interior[tip.cell];
      const Vec2 traction = of_normal(element::face_normal(cell.ring, face));
      element::add_radial_loads(loads.loads, {element::face_load(cell.ring, face, 0.0, traction, thickness())}, 1.0);
      nodal(element::dofs_of(body_mesh_.cells[tip.cell])) += element::equivalent_load(cell.solution(), loads.loads);
    }
  }

  static element::ElementVector no_force(const element::FiniteElement& cell, const model::Material&,
                                         element::InteriorLoads&) {
    return element::ElementVector::Zero(places_of(cell.size()));
  }

  static element::LinearField linear(const model::Linear& field) { return {field.constant, field.per_x, field.per_y}; }
  static element::LinearField about(const Vec2& centre, const model::Linear& field) {
    return {field.constant + field.per_x * centre.x() + field.per_y * centre.y(), field.per_x, field.per_y};
  }
  const model::Edge& edge() const { return body_.outline.edges[static_cast<std::size_t>(place_->index)]; }
  Eigen::Index size() const { return places_of(body_mesh_.nodes.size()); }
  double thickness() const { return model::thickness_of(model_, number_); }
  Extent extent() const { return model::extent_of(model_, number_); }
  void apply_traction(const mesh::PlaceNodes& at, const TractionField& traction) {
    nodal = traction_forces(at.elements, body_mesh_.nodes, extent(), traction);
  }

  void apply(const VaryingTraction& varying) {
    if (body_.rigid) return apply_to_rigid(varying);
    nodal = traction_forces(mesh::nodes_of(*place_, mesh_).elements, body_mesh_.nodes, extent(), varying.traction,
                            varying.breaks);
  }
  /// Force and moment of a traction on the edge of a rigid body.
  void apply_to_rigid(const VaryingTraction& varying) {
    const EdgeElements at = elements_of(edge());
    const Vector forces = traction_forces(at.elements, at.nodes, extent(), varying.traction, varying.breaks);
    nodal = Vector::Zero(3);
    for (std::size_t i = 0; i < at.nodes.size(); ++i) add_to_rigid(at.nodes[i], forces.segment<2>(place_of(i)));
  }
  void add_to_rigid(const Vec2& point, const Vec2& force) {
    nodal += rigid_point(point, part_.reference(), part_.lever()).transpose() * force;
    outward += (point - part_.reference()).dot(force);
  }

  const model::Model& model_;
  const mesh::Mesh& mesh_;
  const BodySystem& part_;
  int number_;  // of the body
  const model::Body& body_;
  const mesh::BodyMesh& body_mesh_;
  const element::SolvedCells& cells_;
  const model::Place* place_;
};

}  // namespace

void add_loads(Structure& structure, const model::Model& model, const mesh::Mesh& mesh,
               const std::vector<element::SolvedCells>& cells) {
  const bool of_bodies =
      std::any_of(model.output.history.begin(), model.output.history.end(),
                  [](const model::HistoryItem& item) { return std::holds_alternative<model::EdgeResultant>(item.of); });
  for (const model::Load& load : model.loads) {
    if (of_bodies) structure.of_bodies.emplace_back(model.bodies.size());
    std::vector<Vector>& forces = structure.loads.emplace_back(structure.parts.size());
    structure.outward.emplace_back(structure.parts.size(), 0.0);
    std::vector<element::CellLoads>& interior = structure.interior.emplace_back(model.bodies.size());
    std::vector<element::InitialStress>& initial = structure.initial.emplace_back(model.bodies.size());
    std::vector<std::optional<double>>& pores = structure.pores.emplace_back();
    structure.entering.emplace_back();
    if (const auto* pressure = std::get_if<model::PorePressure>(&load.kind)) {
      pores.resize(model.contacts.size());
      add_pore_pressure(structure, *pressure, model, mesh, cells);
      continue;
    }
    const bool of_unbounded = std::holds_alternative<model::UniformStress>(load.kind) ||
                              std::holds_alternative<model::GroundStress>(load.kind);
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      // Without a place, the load acts on every elastic body, gravity on rigid ones that have a density; only a stress
      // on unbounded ones too.
      const bool weighs = std::holds_alternative<model::Gravity>(load.kind) && model.bodies[b].density;
      if (load.on ? load.on->body != static_cast<int>(b)
                  : (model.bodies[b].rigid && !weighs) || (model.bodies[b].outside && !of_unbounded))
        continue;
      const auto body = static_cast<int>(b);
      const std::size_t part = structure.dofs.part_of(body);
      Applied applied(model, mesh, cells, *structure.parts[part], b, load.on ? &*load.on : nullptr);
      applied(load);
      if (const auto* at_rest = std::get_if<model::AtRest>(&load.kind)) {
        const Vector& of_part = forces[part] = structure.springs.at_rest[static_cast<std::size_t>(at_rest->spring)];
        if (of_bodies) structure.of_bodies.back()[b] = structure.dofs.of_body(body, of_part);
        continue;
      }
      structure.dofs.add(body, applied.nodal, forces[part]);
      structure.outward.back()[part] += applied.outward;
      if (of_bodies) structure.of_bodies.back()[b] = applied.nodal;
      interior[b] = std::move(applied.interior);
      initial[b] = applied.initial;
    }
  }
  structure.thermal = thermal_energies(model, mesh, structure.dofs, cells, structure.interior);
}

std::vector<Vector> forces_of_moving_load(const Structure& structure, const model::Model& model, const mesh::Mesh& mesh,
                                          const std::vector<element::SolvedCells>& cells, std::size_t load,
                                          double time) {
  const model::Load& moves = model.loads[load];
  const int body = moves.on->body;
  const std::size_t part = structure.dofs.part_of(body);
  Applied applied(model, mesh, cells, *structure.parts[part], static_cast<std::size_t>(body), &*moves.on);
  applied.at_place(moves, moves.moving->place_at(time));
  std::vector<Vector> forces(structure.parts.size());
  structure.dofs.add(body, applied.nodal, forces[part]);
  return forces;
}

}  // namespace scabo::system
