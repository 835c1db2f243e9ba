// Interfaces match by themselves: a step from mesh to mesh, before anything is solved, that gives the two sides of
// every contact and tie between elastic bodies the same nodes and elements, and divides the elastic side of a contact
// where its rigid side ends.
//
// The ends of edges come first, for all contacts at once (edge_ends.hpp).
// Break points (ends of elements) of each side are seen from the other along the rays of rays.hpp. Within the overlap
// both sides get the union of them:
//  - A break point that sees one of the other side nearer than 1/10 of the adjacent elements does not make a new one:
//    the two become opposite each other. Ends of edges, crack mouths, nodes that other contacts already pair, and nodes
//    at which materials meet or a support or load is placed (`near`) stay, and the other point moves to them; otherwise
//    both move to the ray halfway between. Two points that both have to stay are two break points, however near.
//  - Elsewhere the element is divided. Ends of the shorter edge thereby become break points of the longer one.
//  - Of two opposite elements the lower order is raised to the higher one. This is also done where all nodes coincide:
//    an element of order 2 has the nodes of two of order 1, but other displacements between them.
// New and moved nodes lie on the exact edge, line or arc, at the Gauss-Lobatto-Legendre points of their element,
// measured along the rays: opposite nodes are on the same ray. Elements that match already keep their nodes, and a mesh
// whose contacts all match is not changed at all. Nothing depends on which side is A.
//
// A finite element of which a side is divided or raised becomes a super-element with its scaling centre at the
// centroid. Nodes of one contact may lie in the overlap of another one; contacts are therefore treated in rounds until
// all match, in an order that follows from the sizes of the sides: nothing depends on the order of contacts or bodies.
#pragma once

#include <optional>
#include <vector>

#include "scabo/mesh/plane/interface.hpp"

namespace scabo::mesh {

/// The bodies (those of a Mesh) with sides that match, as far as this is possible; nothing if no body changes.
/// add_interfaces (interface.hpp) says what does not match, if anything does not. Contacts whose sides are refined
/// alike are left alone. Sides are divided as they face each other in the placement; nodes stay where their bodies are
/// at the start.
std::optional<std::vector<BodyMesh>> match_sides(const model::Model& model, const std::vector<BodyMesh>& bodies,
                                                 const Placement& placement = {});

}  // namespace scabo::mesh
