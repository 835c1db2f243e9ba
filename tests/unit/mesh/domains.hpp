// Domains for tests of meshers of many cells, and what must hold for every mesh of polygons.
#pragma once

#include <string>
#include <vector>

#include "scabo/mesh/plane/domain.hpp"

namespace scabo::test {

/// `facets` equal facets from a to b.
mesh::DomainLine straight(const Vec2& a, const Vec2& b, int facets, int left = 0, int right = -1);

/// `facets` equal facets of an arc (angles in radians, counter-clockwise positive).
mesh::DomainLine arc(const Vec2& centre, double radius, double start, double sweep, int facets, int left = 0,
                     int right = -1);

/// A closed chain of straight lines through the corners, with facets of about `size` at their middles.
std::vector<mesh::DomainLine> loop(const std::vector<Vec2>& corners, const std::function<double(const Vec2&)>& size,
                                   int left = 0, int right = -1);

mesh::Domain domain_of(const std::vector<Vec2>& corners, double size);

/// The domain with all lengths multiplied by `factor`.
mesh::Domain scaled(const mesh::Domain& domain, double factor);

struct MeshFigures {
  double visibility = 1e9;  ///< least 2 area / length^2 of a side and the centre of its cell
  double shortest = 1e9;    ///< shortest side inside over the wanted size there
  int euler = 0;            ///< nodes - sides + cells, centres and side faces of open cells included
};

/// Expects (GoogleTest) all that a mesh of polygons owes its domain: cells counter-clockwise, simple and visible from
/// their centres, areas of regions, sides shared or on lines, nodes on lines as given.
MeshFigures expect_valid(const mesh::Domain& domain, const mesh::PolygonMesh& mesh, const std::string& name);

}  // namespace scabo::test
