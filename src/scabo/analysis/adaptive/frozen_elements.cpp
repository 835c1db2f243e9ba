#include "scabo/analysis/adaptive/frozen_elements.hpp"

#include <algorithm>
#include <map>

#include "scabo/analysis/adaptive/error_estimate.hpp"
#include "scabo/analysis/adaptive/refinement.hpp"
#include "scabo/mesh/plane/crack_faces.hpp"

namespace scabo::analysis {

namespace {

/// Fraction of the largest nodal force below which a reaction is rounding.
constexpr double some_reaction = 1e-6;

std::size_t boundary_elements(const mesh::BodyMesh& mesh) {
  std::size_t count = 0;
  for (const mesh::Cell& cell : mesh.cells) count += cell.boundary.size();
  return count;
}

/// Largest reaction of every support over all increments, and the largest force on a node.
struct Reactions {
  std::vector<double> largest;
  double scale = 0.0;
};
Reactions reactions_of(const StaticSolution& solution) {
  Reactions reactions;
  reactions.largest.assign(solution.model.supports.size(), 0.0);
  for (const IncrementResult& increment : solution.increments) {
    for (std::size_t i = 0; i < increment.reactions.size(); ++i) {
      reactions.largest[i] = std::max(reactions.largest[i], increment.reactions[i].norm());
      reactions.scale = std::max(reactions.scale, increment.reactions[i].norm());
    }
    for (std::size_t b = 0; b < solution.cells.size(); ++b)
      for (std::size_t c = 0; c < solution.cells[b].size(); ++c)
        if (const auto& cell = solution.cells[b][c]) {
          const Vector forces = cell->K() * displacement_of(solution, increment, b, c);
          reactions.scale = std::max(reactions.scale, forces.lpNorm<Eigen::Infinity>());
        }
  }
  return reactions;
}

/// Point forces, and similar places with infinite stress (adaptive.hpp).
std::vector<model::Place> singular_places(const StaticSolution& solution) {
  std::vector<model::Place> places;
  for (const model::Load& load : solution.model.loads)
    if (load.on && is_point(*load.on) && std::holds_alternative<model::Force>(load.kind)) places.push_back(*load.on);
  for (const model::Spring& spring : solution.model.springs)
    if (is_point(spring.on)) places.push_back(spring.on);
  for (const model::Bar& bar : solution.model.bars)
    for (const model::Bar::End& end : bar.between)
      if (end.on && is_point(*end.on)) places.push_back(*end.on);
  const Reactions reactions = reactions_of(solution);
  for (std::size_t i = 0; i < solution.model.supports.size(); ++i) {
    const model::Place& place = solution.model.supports[i].on;
    if (place.kind == model::Place::Kind::near ||
        (place.kind == model::Place::Kind::corner && reactions.largest[i] > some_reaction * reactions.scale))
      places.push_back(place);
  }
  return places;
}

/// Elements of the faces of cracks that face each other are frozen together where tip rings are added.
void freeze_faces_alike(const model::Model& model, const mesh::Mesh& mesh, std::size_t body,
                        std::vector<bool>& frozen) {
  const std::vector<int> cracks = mesh::cracks_with_tractions(model, static_cast<int>(body));
  if (cracks.empty() || frozen.empty()) return;
  std::map<std::vector<int>, std::size_t>
      number;  // of an element, by its nodes; faces run as the boundaries of cells do
  for (const mesh::Cell& cell : mesh.bodies[body].cells)
    for (const mesh::LineElement& element : cell.boundary) number.emplace(element.nodes, number.size());
  for (const int crack : cracks) {
    const auto& right = mesh.bodies[body].faces[static_cast<std::size_t>(2 * crack)];
    const auto& left = mesh.bodies[body].faces[static_cast<std::size_t>(2 * crack + 1)];
    for (std::size_t k = 0; k < left.size(); ++k) {
      const std::size_t a = number.at(left[k].nodes), b = number.at(right[right.size() - 1 - k].nodes);
      frozen[a] = frozen[b] = frozen[a] || frozen[b];
    }
  }
}

/// frozen_elements() with the places beside which elements are frozen.
Flags frozen_elements(const model::Model& model, const mesh::Mesh& mesh, const std::vector<model::Place>& singular) {
  Flags frozen(mesh.bodies.size());
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b)
    frozen[b].assign(boundary_elements(mesh.bodies[b]), false);  // none of a rigid body
  for (const model::Place& place : singular) {
    const auto b = static_cast<std::size_t>(place.body);
    if (frozen[b].empty()) continue;
    const std::vector<int> nodes = mesh::nodes_of(place, mesh).nodes;
    std::size_t place_in_body = 0;
    for (const mesh::Cell& cell : mesh.bodies[b].cells)
      for (const mesh::LineElement& element : cell.boundary) {
        for (const int node : element.nodes)
          if (std::find(nodes.begin(), nodes.end(), node) != nodes.end()) frozen[b][place_in_body] = true;
        ++place_in_body;
      }
  }
  const mesh::PairedElements paired = mesh::paired_elements(model, mesh);
  const auto flag = [&](const mesh::EdgeElement& at) -> std::vector<bool>::reference {
    const auto b = static_cast<std::size_t>(at.body);
    return frozen[b][static_cast<std::size_t>(mesh::boundary_element(mesh.bodies[b], at.edge, at.element))];
  };
  for (const mesh::EdgeElement& at : paired.alone)
    if (!frozen[static_cast<std::size_t>(at.body)].empty()) flag(at) = true;
  for (const auto& [a, b] : paired.alike) {
    const bool divided_a = !frozen[static_cast<std::size_t>(a.body)].empty(),
               divided_b = !frozen[static_cast<std::size_t>(b.body)].empty();
    if (divided_a != divided_b)
      flag(divided_a ? a : b) = true;  // the other body is rigid
    else if (divided_a && (flag(a) || flag(b)))
      flag(a) = flag(b) = true;
  }
  for (std::size_t b = 0; b < frozen.size(); ++b) freeze_faces_alike(model, mesh, b, frozen[b]);
  return frozen;
}

}  // namespace

bool is_point(const model::Place& place) {
  return place.kind == model::Place::Kind::corner || place.kind == model::Place::Kind::near;
}

bool has_estimate(const Discretisation& discretisation, std::size_t body) {
  return !discretisation.cells[body].empty();
}

Flags left_out_cells(const StaticSolution& solution) {
  const mesh::Mesh& mesh = solution.mesh;
  Flags left_out(mesh.bodies.size());
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) left_out[b].assign(mesh.bodies[b].cells.size(), false);
  for (const model::Place& place : singular_places(solution)) {
    const auto b = static_cast<std::size_t>(place.body);
    const model::Body& body = solution.model.bodies[b];
    if (!has_estimate(solution, b) || !model::is_divided_inside(body)) continue;
    const double radius = body.mesh.tolerance ? spread_of_force * body.mesh.size : 0.0;
    for (const int node : mesh::nodes_of(place, mesh).nodes) {
      const Vec2 at = mesh.bodies[b].nodes[static_cast<std::size_t>(node)];
      for (std::size_t c = 0; c < left_out[b].size(); ++c)
        for (const mesh::LineElement& element : mesh.bodies[b].cells[c].boundary) {
          const int first = element.nodes.front();
          if (first == node || (mesh.bodies[b].nodes[static_cast<std::size_t>(first)] - at).norm() < radius)
            left_out[b][c] = true;
        }
    }
  }
  return left_out;
}

Flags frozen_elements(const StaticSolution& solution, bool at_singular_places) {
  return frozen_elements(solution.model, solution.mesh,
                         at_singular_places ? singular_places(solution) : std::vector<model::Place>{});
}

mesh::Mesh raised(const model::Model& model, const mesh::Mesh& mesh) {
  return mesh::enriched(model, mesh, frozen_elements(model, mesh, {}));
}

}  // namespace scabo::analysis
