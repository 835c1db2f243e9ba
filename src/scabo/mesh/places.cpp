#include <limits>
#include <numeric>

#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {

namespace {

int nearest_boundary_node(const BodyMesh& body, const Vec2& point) {
  int nearest = -1;
  double shortest = std::numeric_limits<double>::max();
  for (const std::vector<LineElement>& edge : body.edges) {
    for (const LineElement& element : edge) {
      for (const int node : element.nodes) {
        const double distance = (body.nodes[node] - point).squaredNorm();
        if (distance >= shortest) continue;
        shortest = distance;
        nearest = node;
      }
    }
  }
  return nearest;
}

std::vector<int> nodes_along(const std::vector<LineElement>& elements) {
  std::vector<int> nodes{elements.front().nodes.front()};
  for (const LineElement& element : elements) {
    if (element.nodes.front() != nodes.back()) nodes.push_back(element.nodes.front());  // beyond the mouth of a crack
    nodes.insert(nodes.end(), element.nodes.begin() + 1, element.nodes.end());
  }
  if (nodes.back() == nodes.front()) nodes.pop_back();  // an edge that is the whole boundary
  return nodes;
}

}  // namespace

PlaceNodes nodes_of(const model::Place& place, const Mesh& mesh) {
  const BodyMesh& body = mesh.bodies.at(place.body);
  if (body.nodes.empty()) return {};  // rigid
  PlaceNodes found;
  switch (place.kind) {
    case model::Place::Kind::body:
      found.nodes.resize(body.nodes.size());
      std::iota(found.nodes.begin(), found.nodes.end(), 0);
      break;
    case model::Place::Kind::edge:
      found.elements = body.edges.at(place.index);
      found.nodes = nodes_along(found.elements);
      break;
    case model::Place::Kind::corner:
      found.nodes = {body.corners.at(place.index)};
      break;
    case model::Place::Kind::face:
      if (body.faces.empty()) break;  // a side face is not divided
      found.elements = body.faces.at(static_cast<std::size_t>(place.index));
      if (!found.elements.empty()) found.nodes = nodes_along(found.elements);
      break;
    case model::Place::Kind::mouth:
      found.nodes = {body.mouth.at(static_cast<std::size_t>(place.index))};
      break;
    case model::Place::Kind::near:
      found.nodes = {nearest_boundary_node(body, place.near)};
      break;
  }
  return found;
}

}  // namespace scabo::mesh
