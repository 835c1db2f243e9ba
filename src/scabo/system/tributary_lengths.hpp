// Tributary lengths: the part of the length of an edge that is assigned to a node.
//
// Contact acts from node to node. The traction that belongs to a force is the force over the node's tributary length
// (times the smaller thickness of the two bodies), both for displayed pressures and for comparison with strengths. For
// a node i of an edge
//
//     w_i = | sum over its elements of the Gauss-Lobatto weight of the node times x,eta |                      (1)
//
// On a straight quadratic element these are 1/6, 4/6 and 1/6 of its length. The sum is one of vectors: rotated by 90
// degrees it is the integral of N_i n, along which contact presses (mesh/plane/contact_side.hpp), so that a uniform
// pressure p has exactly the nodal forces p w_i, also on curved edges.
//
// Only the edges of the contact itself count, and of them only elements all of whose nodes take part: under the corner
// of a block that stands in the middle of a floor, the elements of the floor beside the block do not count. A node
// without such an element keeps the lengths of all its elements. If both sides are elastic, the mean of both is used.
// It does not change if the sides are swapped, and on matching elements both sides agree except for the gap between
// curved sides. Two rigid sides have two pairs, each with half of the length in which they face each other.
//
// Beside the tip of a crack whose faces are in contact, a length d of them is free of traction
// (mesh/plane/tip_rings.hpp), though the crack is closed there. What it would carry passes beside it, as at a crack of
// length d that a pressure p closes: at the distance r from the tip
//
//     p (r - d / 2) / sqrt(r (r - d)),                                                                       (2)
//
// so that w_i is the integral of N_i times this amplification, and p is the pressure of all pairs.
//
// Of bodies of revolution pairs have areas instead, around the axis:
//
//     A_i = | int N_i 2 pi r x,eta d eta |                                                                   (3)
//
// which on the axis is 0 at order 2: a pair there then has the area of the disc that is nearer to it than to the next
// pair. Pressure on the axis is extrapolated from the pairs beside it (analysis/state/describe.cpp).
#pragma once

#include <vector>

#include "scabo/mesh/mesh.hpp"

namespace scabo::system {

/// One for each pair of the interface of `contact` (index into Model::contacts); all are > 0.
std::vector<double> tributary_lengths(int contact, const model::Model& model, const mesh::Mesh& mesh);

/// Areas, likewise: lengths times the smaller thickness of the two bodies, or of bodies of revolution (3).
std::vector<double> tributary_areas(int contact, const model::Model& model, const mesh::Mesh& mesh);

/// Whether a pair lies on the axis of revolution.
bool is_on_axis(const mesh::ContactPair& pair, const mesh::Interface& interface, const model::Model& model);

}  // namespace scabo::system
