// The ends of edges on the edges that they face: the first step of match_sides (match.hpp).
//
// Where a side ends within an element of the other side, this element is divided: only whole elements can pass on a
// pressure that ends there. This is done for the ends of all sides before anything else. From then on contacts that
// share an edge have elements of their own on it, so that what becomes of one does not depend on the others, nor on the
// order in which they are given. It is all that happens beside a rigid side, which has no elements.
#pragma once

#include <vector>

#include "scabo/mesh/plane/contact_side.hpp"
#include "scabo/mesh/plane/matched_side.hpp"
#include "scabo/mesh/plane/rays.hpp"

namespace scabo::mesh {

/// Where the end of another edge faces an edge.
struct FacedEnd {
  double t = 0.0;        ///< fraction of the length of the edge, between 0 and 1
  double element = 0.0;  ///< length of the element that ends there; infinite if the other edge is rigid
};

/// The ends of a rigid edge on an elastic one, along the normals of the rigid edge.
std::vector<FacedEnd> ends_of_rigid(const model::Edge& rigid, const model::Edge& elastic);

/// The ends of an elastic edge, with elements of these lengths at its start and its end, along the rays.
std::vector<FacedEnd> ends_of_elastic(const model::Edge& edge, const std::array<double, 2>& elements,
                                      const model::Edge& other, const Rays& rays);

/// Whether one of the ends is within an element.
bool are_within_elements(const std::vector<FacedEnd>& ends, const ContactSide& side);

/// Divides the elements of a side at the ends of others. A break point nearer than 1/10 of the adjacent elements moves
/// there instead, unless it is fixed. The nodes there are fixed. Whether anything has changed.
bool divide_at_ends(MatchedSide side, std::vector<FacedEnd> ends, std::vector<BodyMesh>& bodies, FixedNodes& fixed);

}  // namespace scabo::mesh
