#include "scabo/system/pore_pressure.hpp"

#include <algorithm>
#include <map>

#include "scabo/base/components.hpp"
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
    const std::map<int, Vec2> forces = forces_of_side(place, paired, load, model.analysis.extent(), mesh);
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

}  // namespace scabo::system
