// Outward normals of a face at its nodes.
//
// A face is divided into smooth parts, between whose facets it turns by 30 degrees or less at an edge. At a node each
// part has one normal, so that a node on an edge or in a corner of a body has several:
//
//     part                                     normal at x
//     plane                                    that of the plane through its nodes, by least squares
//     nodes on one quadric q(x) = 0            grad q, exact: spheres, cylinders, cones
//     any other                                mean over the facets of the body around x that go on smoothly
//
// Of a curved part the mean has an error that falls with the size of the facets, which would hold a shaft in a bearing
// against turning; the gradient has none.
#pragma once

#include <map>
#include <vector>

#include "scabo/mesh/space/solid_mesh.hpp"

namespace scabo::mesh {

constexpr double cosine_of_turn = 0.86602540378443865;  // of 30 degrees

struct NodeNormal {
  Eigen::Vector3d n;  ///< of length 1
  bool curved;        ///< whether its part is
};

/// By node; in the order of the parts. `face`: facets of `boundary`, which is that of the whole body.
std::map<int, std::vector<NodeNormal>> normals_of_face(const SolidMesh& mesh, const std::vector<SolidFacet>& face,
                                                       const std::vector<SolidFacet>& boundary);

}  // namespace scabo::mesh
