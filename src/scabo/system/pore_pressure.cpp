#include "scabo/system/pore_pressure.hpp"

#include <algorithm>
#include <map>

#include "scabo/base/components.hpp"
#include "scabo/mesh/plane/crack_faces.hpp"
#include "scabo/system/assembly.hpp"
#include "scabo/system/loads.hpp"
#include "scabo/system/tributary_lengths.hpp"

namespace scabo::system {

namespace {

/// As a traction against the normal.
VaryingTraction traction_of(const model::PorePressure& pores) {
  if (const auto* table = std::get_if<model::EdgeTable>(&pores.value)) return varying_traction(*table, {});
  if (const auto* water = std::get_if<model::Water>(&pores.value)) return varying_traction(*water);
  const double p = std::get<double>(pores.value);
  return {[p](const Vec2&, const Vec2& n) -> Vec2 { return -p * n; }, {[](const Vec2&) { return 0.0; }, {}}};
}

/// Eq. (1) on one elastic side, by its nodes; without those of which it does not hold.
std::map<int, Vec2> forces_of_side(const model::Place& place, const std::vector<int>& paired,
                                   const VaryingTraction& load, const Extent& extent, const mesh::Mesh& mesh) {
  const std::vector<Vec2>& nodes = mesh.bodies[static_cast<std::size_t>(place.body)].nodes;
  std::map<int, int> pairs_of;
  for (const int node : paired) ++pairs_of[node];
  std::vector<mesh::LineElement> covered;
  for (const mesh::LineElement& element : mesh::nodes_of(place, mesh).elements)
    if (std::all_of(element.nodes.begin(), element.nodes.end(), [&](int node) { return pairs_of.contains(node); }))
      covered.push_back(element);
  const Vector forces = traction_forces(covered, nodes, extent, load.traction, load.breaks);
  std::map<int, Vec2> of_nodes;
  for (const mesh::LineElement& element : covered)
    for (const int node : element.nodes)
      if (pairs_of[node] == 1) of_nodes[node] = forces.segment<2>(place_of(node));
  return of_nodes;
}

}  // namespace

double pressure_at(const model::PorePressure& pores, const Vec2& x) {
  return -traction_of(pores).traction(x, Vec2::UnitX()).x();
}

Vector pore_forces(const model::PorePressure& pores, int contact, const model::Model& model, const mesh::Mesh& mesh) {
  const model::Contact& named = model.contacts[static_cast<std::size_t>(contact)];
  const std::vector<mesh::ContactPair>& pairs = mesh.interfaces[static_cast<std::size_t>(contact)].pairs;
  const std::vector<double> areas = tributary_areas(contact, model, mesh);
  const VaryingTraction load = traction_of(pores);
  Vector sum = Vector::Zero(static_cast<Eigen::Index>(pairs.size()));
  std::vector<int> sides(pairs.size(), 0);
  for (const bool on_b : {false, true}) {
    const model::Place& place = on_b ? named.b : named.a;
    if (model.bodies[static_cast<std::size_t>(place.body)].rigid) continue;
    std::vector<int> paired;
    for (const mesh::ContactPair& pair : pairs) paired.push_back(on_b ? pair.node_b : pair.node_a);
    const std::map<int, Vec2> forces = forces_of_side(place, paired, load, model::extent_between(model, named), mesh);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto found = forces.find(paired[i]);
      if (found == forces.end()) continue;
      sum[static_cast<Eigen::Index>(i)] += (on_b ? 1.0 : -1.0) * found->second.dot(pairs[i].normal);
      ++sides[i];
    }
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    double& force = sum[static_cast<Eigen::Index>(i)];
    force = sides[i] > 0 ? force / sides[i] : pressure_at(pores, pairs[i].point_a) * areas[i];
  }
  return sum;
}

void add_pore_pressure(Structure& structure, const model::PorePressure& pores, const model::Model& model,
                       const mesh::Mesh& mesh, const std::vector<element::SolvedCells>& cells) {
  std::vector<Vector>& forces = structure.loads.back();
  for (const int c : pores.contacts) {
    const model::Contact& contact = model.contacts[static_cast<std::size_t>(c)];
    const std::vector<mesh::ContactPair>& pairs = mesh.interfaces[static_cast<std::size_t>(c)].pairs;
    const Vector of_pairs = pore_forces(pores, c, model, mesh);
    if (pores.enters) {
      structure.entering.back().push_back({c, of_pairs});
      continue;
    }
    const auto add = [&](int body, int node, const Vec2& point, const Vec2& force) {
      const std::size_t p = structure.dofs.part_of(body);
      if (forces[p].size() == 0) forces[p] = Vector::Zero(structure.dofs.size(p));
      if (node >= 0)
        forces[p].segment<2>(structure.dofs.of(body, node, 0)) += force;
      else {
        const BodySystem& part = *structure.parts[p];
        forces[p] += rigid_point(point, part.reference(), part.lever()).transpose() * force;
        structure.outward.back()[p] += (point - part.reference()).dot(force);
      }
    };
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const Vec2 force = of_pairs[static_cast<Eigen::Index>(i)] * pairs[i].normal;
      add(contact.b.body, pairs[i].node_b, pairs[i].point_b, force);
      add(contact.a.body, pairs[i].node_a, pairs[i].point_a, -force);
    }
    std::optional<double>& sum = structure.pores.back()[static_cast<std::size_t>(c)];
    sum = sum.value_or(0.0) + of_pairs.sum();
    if (contact.a.kind != model::Place::Kind::face) continue;
    const auto b = static_cast<std::size_t>(contact.a.body);
    for (const mesh::TipFace& tip : mesh::tip_faces(model.bodies[b], mesh.bodies[b])) {
      if (tip.crack != contact.a.index / 2) continue;
      const mesh::Cell& cell = mesh.bodies[b].cells[tip.cell];
      const element::SolvedSuperElement& solved = *cells[b][tip.cell];
      const auto face = tip.last ? element::Face::last : element::Face::first;
      const Vec2 traction = -pressure_at(pores, cell.centre) * element::face_normal(solved.ring, face);
      const std::vector<element::RadialLoad> loads = {
          element::face_load(solved.ring, face, 0.0, traction, solved.thickness)};
      element::CellLoads& interior = structure.interior.back()[b];
      interior.resize(mesh.bodies[b].cells.size());
      element::add_radial_loads(interior[tip.cell].loads, loads, 1.0);
      Vector nodal = Vector::Zero(places_of(mesh.bodies[b].nodes.size()));
      nodal(element::dofs_of(cell)) += element::equivalent_load(solved.solution(), loads);
      structure.dofs.add(contact.a.body, nodal, forces[structure.dofs.part_of(contact.a.body)]);
      if (structure.of_bodies.empty()) continue;
      Vector& of_body = structure.of_bodies.back()[b];
      of_body = of_body.size() == 0 ? nodal : Vector(of_body + nodal);
    }
  }
}

}  // namespace scabo::system
