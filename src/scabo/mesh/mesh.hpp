// Model -> Mesh: nodes, super-elements or finite elements, named places, matched contact pairs.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "scabo/base/types.hpp"
#include "scabo/model/model.hpp"

namespace scabo::mesh {

/// A piece of boundary of polynomial order p: p + 1 node indices at the Gauss-Lobatto-Legendre points, run
/// counter-clockwise around the body.
struct LineElement {
  std::vector<int> nodes;
};

/// A super-element. Its boundary nodes are the body's nodes 0, 1, 2 ... counter-clockwise around the centre. Open, from
/// side face to side face, where the last is not the first again; at a crack's mouth the two lie in the same place.
struct SuperElement {
  Vec2 centre = Vec2::Zero();         ///< scaling centre, sees the whole boundary
  std::vector<LineElement> boundary;  ///< counter-clockwise
};

/// 8-node serendipity element: four corners counter-clockwise, then the middles of sides 12, 23, 34, 41.
using PlaneElement8 = std::array<int, 8>;

/// The mesh of one elastic body; a rigid body has no nodes.
struct BodyMesh {
  std::vector<Vec2> nodes;
  std::vector<SuperElement> super_elements;  ///< one, or none for a FE mesh
  std::vector<PlaneElement8> elements;       ///< of a FE mesh
  /// For every edge of the outline, in its order and direction; none for a side face. Two elements beside a crack's
  /// mouth have different nodes there.
  std::vector<std::vector<LineElement>> edges;
  std::vector<int> corners;    ///< node of every corner of the outline; -1 at the scaling centre
  std::vector<int> materials;  ///< of every boundary element, index into Model::materials; empty: the body's
};

/// Two points that face each other. The signs are those of the design: n out of A, towards B.
struct ContactPair {
  int node_a = -1;  ///< of the body of A; -1 when A is rigid
  int node_b = -1;  ///< of the body of B; -1 when B is rigid
  Vec2 point_a = Vec2::Zero();
  Vec2 point_b = Vec2::Zero();
  Vec2 normal = Vec2::Zero();  ///< unit, out of A; the same line of action when A and B are swapped
  double gap = 0.0;            ///< geometric gap plus the contact's `gap`
};

/// The pairs of one contact, in the order in which they follow each other along the interface, from the end
/// with the smaller x (upright: y) to the other. The order is the same when A and B are swapped.
struct Interface {
  int contact = -1;
  std::vector<ContactPair> pairs;
};

/// Nodes meant by a place, without repetition.
struct PlaceNodes {
  std::vector<int> nodes;             ///< of the place's body; empty for a rigid body
  std::vector<LineElement> elements;  ///< of an edge; empty otherwise
};

struct Mesh {
  std::vector<BodyMesh> bodies;       ///< one for each body of the model
  std::vector<Interface> interfaces;  ///< one for each contact of the model
  int nodes() const;                  ///< in all bodies
};

/// Divides every body and matches the two sides of every contact. Throws InputError (with the model's file
/// and lines) for contacts whose nodes do not match and for meshes too large to be meant.
Mesh make_mesh(const model::Model& model);

/// The nodes of `place`.
PlaceNodes nodes_of(const model::Place& place, const Mesh& mesh);

/// Gauss-Lobatto-Legendre points of order p on [-1, 1], p + 1 of them, ascending.
std::vector<double> lobatto_points(int order);

}  // namespace scabo::mesh
