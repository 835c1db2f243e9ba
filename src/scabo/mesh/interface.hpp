// Matching of the two sides of a contact: which points face each other, along which normal, how far apart.
//
// Both sides elastic (node to node). At a node i of A and a node j of B
//
//     n = (n_A - n_B) / |n_A - n_B|,   t = n turned by -90 degrees,   g = (x_B - x_A) . n
//
// with the nodal normals n_A, n_B of contact_side.hpp; swapping A and B gives -n and the same g exactly. The
// nodes match when x_B - x_A lies along n: |(x_B - x_A) . t| <= 1e-6 element lengths. Where the two sides are
// apart and not parallel (a disc and a plane divided equally), nodes that belong together are not
// exactly opposite: x_B - x_A may then also point anywhere between the normals of the two sides, divided or
// true. Curved edges of nearly equal curvature (a cylinder in a wider ring) may be off by 1/50 of the node
// spacing as long as that is at most half of g. On parallel straight faces only the first rule is left.
//
// Partners are found from the closest pair outwards, node by node along both edges. A node whose foot on the
// other edge lies beyond that edge's ends is outside the overlap and stays alone; so does one that
// faces another way (by more than 60 degrees), which only arcs have. All others must have a partner.
//
// One side rigid. Every node of the elastic edge that has its foot on the rigid edge is paired with that
// foot; n is the exact normal of the rigid edge there, turned to point out of A. Only the edge named counts,
// not its neighbours.
//
// g < 0 is an overlap, treated as an interference.
#pragma once

#include <variant>

#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {

/// The interface of contact `contact`, or what is wrong with it. `bodies` are those of Mesh.
std::variant<Interface, Diagnostic> match_interface(const model::Model& model, int contact,
                                                    const std::vector<BodyMesh>& bodies);

}  // namespace scabo::mesh
