// Division of an outline into line elements: the boundary of one super-element, closed, or open from side face to side
// face. The boundary is run counter-clockwise around the scaling centre, also where the body lies outside it; the edges
// of a BodyMesh keep the outline's direction.
//
// Unless a division says otherwise (division.hpp), every edge is divided into n equal elements, none longer than `size`
// and none turning by more than 60 degrees, with nodes at the Gauss-Lobatto-Legendre points of the edge's arc length.
// Between the nodes of an arc the boundary is the interpolating polynomial, so it must be checked anew that the scaling
// centre sees all of it: |J| = x y,eta - y x,eta > 0, x and y relative to the centre.
#pragma once

#include <string>
#include <vector>

#include "scabo/mesh/division.hpp"

namespace scabo::mesh {

/// Elements along an edge of `length` when none may be longer than `size`; a whole number, at least 1. A
/// double, because a mistyped size can ask for more than an int holds.
double elements_along(double length, double size);

/// Nodes that divide_boundary would make.
double count_boundary_nodes(const model::Body& body);

/// Every edge in equal elements of the body's order, as above.
BodyDivision uniform_division(const model::Body& body);

/// The body as one super-element.
BodyMesh divide_boundary(const model::Body& body);
BodyMesh divide_boundary(const model::Body& body, const BodyDivision& division);

/// One mistake for every edge that is not seen from the scaling centre as divided.
std::vector<Diagnostic> unseen_edges(const model::Body& body, const BodyMesh& mesh);

/// `upper.bottom`, by the name that the user gave where there is one.
std::string edge_name(const model::Body& body, int edge);

}  // namespace scabo::mesh
