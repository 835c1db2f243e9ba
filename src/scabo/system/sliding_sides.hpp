// Normals of sides along which a body slides or rolls that contact alone holds.
//
// Two arcs, or an arc and a straight edge, press along lines through one point, or parallel ones (mesh/plane/rays.hpp).
// Without friction a body that may turn about that point, or move across, is not held against this motion. The normals
// of pairs have that property only as exactly as nodes are opposite each other, and those weighted like the forces of a
// pressure (mesh/plane/interface.hpp) only as exactly as elements are arcs. However small their deviations are, the
// motion would then be determined by them alone: equilibrium along it asks that the contact forces times the deviations
// vanish, for which the body would move by the depth of the contact over the size of the deviations, and the forces
// would be others by as much as they are.
#pragma once

#include "scabo/system/structure.hpp"

namespace scabo::system {

/// Directs the normals of such pairs, those of elastic sides without bond, strength or so much friction that pairs
/// stick and carry what the deviations leave, along the lines through the common point and the
/// node of the body that moves about it: exactly, but for rounding. Where both bodies may, through the point halfway
/// between the two nodes. Sides that touch all along and share a node with another contact keep their normals.
///
/// Loads on a body that may turn about the common point keep no moment about it that the division of its arcs explains
/// and friction might not carry: up to the part that the area between arcs and elements is of the body, where the
/// coefficient is less than that part. The weight of a disc of straight elements acts through their centroid, which is
/// beside its centre, and nothing could balance that.
void let_slide(Structure& structure, const model::Model& model, mesh::Mesh& mesh);

/// Adds to the forces on a part, on those that are not zero, what changes their resultants along the columns of `rigid`
/// by `resultants`.
void add_resultants(const Matrix& rigid, const Vector& resultants, Vector& forces);

}  // namespace scabo::system
