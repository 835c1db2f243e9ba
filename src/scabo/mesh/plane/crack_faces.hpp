// The two faces of cracks between cells, which carry loads and contacts.
//
// A crack of a body of many cells is a line along which cells have nodes of their own on either side. Its faces are
// lists of boundary elements (BodyMesh::faces): the left one in the direction of its path, the right one against it, as
// the boundary of a body runs. Opposite nodes have the same position, so that they are the pairs of a contact:
//
//  - The normal of a pair is that of the segments that meet there, weighted like nodal forces: at a kink their mean.
//  - Where other cracks begin, end or cross, every crack has a pair of its own for each two nodes that face each other.
//  - Pairs end where a tip's cell begins, because a tip is the scaling centre of an open cell, which has no nodes on
//  its
//    side faces. tip_rings.hpp takes the pairs further towards the tip.
#pragma once

#include <map>
#include <vector>

#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {

/// Opposite nodes of the two faces of a crack.
struct FacePair {
  int left = -1, right = -1;
  /// Integral of N ds n over the elements that have both nodes, n out of the left face: its direction is the
  /// normal of the pair, its length the tributary length away from tips (system/tributary_lengths.hpp).
  Vec2 normal = Vec2::Zero();
};

/// In the direction of the path; without nodes that both faces share. The two faces have the same elements.
std::vector<FacePair> face_pairs(const BodyMesh& mesh, int crack);

/// The pairs of a contact between the two faces of a crack.
Interface crack_interface(const model::Model& model, int contact, const std::vector<BodyMesh>& bodies);

/// A side face of the open cell around a tip, part of the face of a crack.
struct TipFace {
  std::size_t cell = 0;
  int crack = -1;
  bool at_end = false;  ///< the tip is the last point of the path, otherwise the first
  bool last = false;    ///< the side face at the end of the cell's boundary, otherwise at its start
  bool left = false;    ///< it belongs to the left face of the crack
};

/// Both side faces of every cell at a tip; also those of a body that was one super-element before it was divided into
/// rings (tip_rings.hpp), as of crack 0, where its side face 1 is the left one.
std::vector<TipFace> tip_faces(const model::Body& body, const BodyMesh& mesh);

/// Where only one face of a crack is divided at a point, the other one is divided there too. `cracks`: of which cracks.
void divide_faces_alike(BodyMesh& mesh, const std::vector<int>& cracks);

/// Outward unit normals at the nodes of a face; at a kink the mean, as of pairs.
std::map<int, Vec2> normals_of_face(const BodyMesh& mesh, int face);

/// The cracks of a body whose faces are in contact with each other.
std::vector<int> cracks_in_contact(const model::Model& model, int body);
/// The cracks of a body that may grow in the last step: the energy that this releases needs nodes that face each other.
std::vector<int> growing_cracks(const model::Model& model, int body);
/// The cracks of a body of which a face is held by a support.
std::vector<int> cracks_held(const model::Model& model, int body);
/// The cracks of a body whose faces carry tractions that are not known before: in contact, held, or on springs. Their
/// faces have nodes up to the tips (tip_rings.hpp).
std::vector<int> cracks_with_tractions(const model::Model& model, int body);

}  // namespace scabo::mesh
