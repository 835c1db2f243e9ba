#include "scabo/analysis/space/solid_places.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "scabo/analysis/space/solid_bars.hpp"
#include "scabo/mesh/space/imported_solid.hpp"

namespace scabo::analysis {

void SolidPlaces::add_body(const SolidBody& body, std::map<std::string, std::vector<mesh::SolidFacet>> of_shape) {
  boundaries_.push_back(of_shape.empty() ? mesh::boundary_facets(body.mesh) : std::vector<mesh::SolidFacet>{});
  of_shapes_.push_back(std::move(of_shape));
}

/// Those of a face that is named, or of the whole boundary.
std::vector<mesh::SolidFacet> SolidPlaces::named_facets(const model::SpaceFace& face) const {
  const auto& of_shape = of_shapes_[static_cast<std::size_t>(face.body)];
  if (!face.of_shape.empty()) return of_shape.at(face.of_shape);
  if (face.side_set >= 0)
    return mesh::facets_of_sides(mesh_of(face), file_of(face).side_sets[static_cast<std::size_t>(face.side_set)].sides);
  if (face.node_set >= 0) return facets_of_set(face);
  std::vector<mesh::SolidFacet> all = boundary(face);
  for (const auto& [name, facets] : of_shape) all.insert(all.end(), facets.begin(), facets.end());
  return all;
}

std::vector<mesh::SolidFacet> SolidPlaces::facets(const model::SpaceFace& face) {
  std::vector<mesh::SolidFacet> found = named_facets(face);
  const mesh::SolidMesh& mesh = mesh_of(face);
  const bool any = !found.empty();
  if (face.normal)
    std::erase_if(found, [&](const mesh::SolidFacet& facet) {
      const Matrix x = mesh::nodes_of(mesh, facet);
      const bool triangle = mesh::corners_of(facet) == 3;
      const Eigen::Vector3d a = x.col(triangle ? 1 : 2) - x.col(0),
                            b = triangle ? x.col(2) - x.col(0) : x.col(3) - x.col(1), area = a.cross(b);
      return area.dot(*face.normal) < std::sqrt(0.75) * area.norm();
    });
  if (any && found.empty())
    refuse(face, "has no element whose outward normal is within 30 degrees of this direction: correct it");
  if (!any) refuse(face, "has no outer side of an element: name a surface, or a set with all nodes of a face");
  return found;
}

std::vector<mesh::SolidFacet> SolidPlaces::facets_of_set(const model::SpaceFace& set) const {
  return mesh::facets_among(boundary(set), set_of_nodes(set));
}

const std::vector<int>& SolidPlaces::set_of_nodes(const model::SpaceFace& at) const {
  return file_of(at).node_sets[static_cast<std::size_t>(at.node_set)].nodes;
}

std::vector<mesh::SolidEdge> SolidPlaces::edges(const model::SpaceFace& edge) {
  const mesh::SolidMesh& mesh = mesh_of(edge);
  if (edge.node_set >= 0)
    return mesh::edges_among(boundary(edge), set_of_nodes(edge), static_cast<int>(file_of(edge).nodes.cols()));
  std::vector<mesh::SolidEdge> found =
      edge.line_set >= 0
          ? mesh::edges_with_ends(mesh, file_of(edge).line_sets[static_cast<std::size_t>(edge.line_set)].edges)
          : mesh::edges_between(facets(edge.meeting[0]), facets(edge.meeting[1]));
  if (found.empty() && edge.line_set >= 0) refuse(edge, "has no edge of an element of this body: name another curve");
  if (found.empty() && edge.line_set < 0)
    refuse(edge,
           fmt::format("is no edge: the faces '{}' and '{}' do not meet", edge.meeting[0].text, edge.meeting[1].text));
  return edge.near ? mesh::piece_nearest(mesh, found, *edge.near) : found;
}

std::vector<int> SolidPlaces::single_nodes(const model::SpaceFace& at) {
  if (at.node_set >= 0) return set_of_nodes(at);
  const mesh::SolidMesh& mesh = mesh_of(at);
  if (at.meeting.empty()) return {node_nearest(mesh, *at.near)};
  std::vector<std::vector<mesh::SolidFacet>> faces;
  for (const model::SpaceFace& face : at.meeting) faces.push_back(facets(face));
  std::vector<int> found = mesh::corners_between(faces);
  if (found.empty()) refuse(at, "is no point: these three faces do not meet in one");
  if (found.size() > 1 && !at.near)
    refuse(at, fmt::format("is {} points, in all of which these faces meet: choose one of them by 'near', a point "
                           "[x, y, z] beside it",
                           found.size()));
  if (found.size() > 1 && at.near)
    found = {*std::min_element(found.begin(), found.end(), [&](int a, int b) {
      return (mesh.nodes.col(a) - *at.near).squaredNorm() < (mesh.nodes.col(b) - *at.near).squaredNorm();
    })};
  return found;
}

std::set<int> SolidPlaces::held_nodes(const model::SpaceFace& at) {
  std::set<int> nodes;
  if (at.is_point() || at.is_set_of_nodes())
    for (const int node : single_nodes(at)) nodes.insert(node);
  if (at.is_edge())
    for (const int node : mesh::nodes_of_edges(edges(at))) nodes.insert(node);
  if (at.is_point() || at.is_edge()) return nodes;
  for (const mesh::SolidFacet& facet : at.is_set_of_nodes() ? facets_of_set(at) : facets(at))
    nodes.insert(facet.begin(), facet.end());
  return nodes;
}

SolidPlaceOfAction SolidPlaces::place_of_action(const model::SpaceFace& on) {
  if (on.is_body()) return {};  // of a rigid body as a whole
  if (on.is_point()) return {on.body, {}, single_nodes(on), {}};
  if (on.is_edge()) {
    std::vector<mesh::SolidEdge> of_edge = edges(on);
    std::vector<int> nodes = mesh::nodes_of_edges(of_edge);
    return {on.body, {}, std::move(nodes), std::move(of_edge)};
  }
  if (!on.is_set_of_nodes()) return {on.body, facets(on), {}, {}};
  return {on.body, facets_of_set(on), set_of_nodes(on), {}};
}

}  // namespace scabo::analysis
