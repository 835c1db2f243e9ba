// Division of an outline into line elements, which form the boundary of one super-element: closed, or open from side
// face to side face. The boundary runs counter-clockwise around the scaling centre, also if the body lies outside it;
// the edges of a BodyMesh keep the direction of the outline.
//
// Unless a Division (division.hpp) specifies otherwise, every edge is divided into n equal elements, none longer than
// `size` and none turning by more than 60 degrees; with mesh.refine into elements of graded lengths (graded_edge.hpp).
// Nodes are at the Gauss-Lobatto-Legendre points of the arc length of the edge. Between the nodes of an arc the
// boundary is the interpolating polynomial. The visibility of the whole boundary from the scaling centre must therefore
// be checked again: |J| = x y,eta - y x,eta > 0, with x and y relative to the
// centre.
#pragma once

#include <string>
#include <vector>

#include "scabo/mesh/plane/division.hpp"

namespace scabo::mesh {

/// Number of elements along an edge of `length` if none may be longer than `size`; a whole number, at least 1. A
/// double, because a mistyped size can give more than an int can hold.
double elements_along(double length, double size);

/// Number of nodes that divide_boundary would create.
double count_boundary_nodes(const model::Body& body);

/// The division of every edge into elements of the body's order, as described above.
BodyDivision initial_division(const model::Body& body);

/// The body as one super-element.
BodyMesh divide_boundary(const model::Body& body);
BodyMesh divide_boundary(const model::Body& body, const BodyDivision& division);

/// One mistake for every edge that, as divided, is not entirely visible from the scaling centre.
std::vector<Diagnostic> unseen_edges(const model::Body& body, const BodyMesh& mesh);

/// `upper.bottom`, with the name given by the user if there is one.
std::string edge_name(const model::Body& body, int edge);

}  // namespace scabo::mesh
