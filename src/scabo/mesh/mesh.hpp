// Model -> Mesh: nodes, cells, named places, matched contact pairs.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "scabo/base/components.hpp"
#include "scabo/base/types.hpp"
#include "scabo/model/model.hpp"

namespace scabo::mesh {

/// A boundary element of polynomial order p: p + 1 node indices at the Gauss-Lobatto-Legendre points, counter-clockwise
/// around the body.
struct LineElement {
  std::vector<int> nodes;
};

enum class CellKind { superelement, finite_element };

/// How supports hold the two side faces of an open super-element, each as a whole: 0 is the first face, 1 the last.
struct HeldFaces {
  /// Unit vectors along which a face is held: none, one, or two at right angles.
  std::array<std::vector<Vec2>, 2> along;
  /// The face that lies on a line of symmetry: it is held along its normal, at 0, and nothing else acts on it, and the
  /// other face is free; -1: none.
  int mirror = -1;
  bool operator==(const HeldFaces&) const = default;
};

/// A part of a body whose stiffness is computed as a whole, from its boundary. A super-element has a boundary of any
/// number of line elements of any order. A finite element has three or four sides of order 1 or 2, and no other nodes.
///
/// An open super-element extends from side face to side face, so that its last node is not its first; at the mouth of a
/// crack the two nodes have the same position.
struct Cell {
  CellKind kind = CellKind::superelement;
  Vec2 centre = Vec2::Zero();                  ///< scaling centre, from which the whole boundary is visible
  std::vector<LineElement> boundary;           ///< counter-clockwise; each begins where the one before ends
  std::vector<int> materials;                  ///< indices into Model::materials: one, or one for each boundary element
  std::shared_ptr<const HeldFaces> held = {};  ///< open super-element: null if no support holds its side faces
  /// Size relative to the body, where the cell is what rings have left of a body that was one super-element
  /// (tip_rings.hpp).
  double scale = 1.0;

  bool is_open() const { return boundary.front().nodes.front() != boundary.back().nodes.back(); }
  /// Numbers in the body of the cell's own nodes 0, 1, 2 ...: those along its boundary, each once.
  std::vector<int> nodes() const;
};

/// The mesh of one elastic body; a rigid body has no nodes. A body that is one super-element has one cell, whose own
/// node numbers are those of the body.
struct BodyMesh {
  std::vector<Vec2> nodes;
  std::vector<Cell> cells;
  /// The elements of every edge of the outline, in its order and direction; none for a side face. The two elements at
  /// the mouth of a crack have different nodes there.
  std::vector<std::vector<LineElement>> edges;
  /// The elements of the two faces of every crack between cells, face 2 k on the right of crack k and 2 k + 1 on its
  /// left; they run as a boundary does, the left face along the path of the crack and the right one against it.
  /// (crack_faces.hpp) Of a body that is one super-element: its side faces 0 and 1, if something holds them
  /// (tip_rings.hpp), otherwise none.
  std::vector<std::vector<LineElement>> faces;
  std::vector<int> corners;          ///< node of every corner of the outline; -1 at the scaling centre
  std::array<int, 2> mouth{-1, -1};  ///< the nodes of an open super-element at its first and last side face

  int count(CellKind kind) const;
};

/// Two points that face each other. Sign convention: n points out of A towards B.
struct ContactPair {
  int node_a = -1;  ///< node of the body of A; -1 if A is rigid
  int node_b = -1;  ///< node of the body of B; -1 if B is rigid
  Vec2 point_a = Vec2::Zero();
  Vec2 point_b = Vec2::Zero();
  Vec2 normal = Vec2::Zero();  ///< unit, out of A; swapping A and B reverses it exactly
  double gap = 0.0;            ///< geometric gap plus the `gap` of the contact
};

/// The pairs of one contact, in their order along the interface from the end with the smaller x (if x is equal: y) to
/// the other. The order does not change if A and B are swapped.
struct Interface {
  int contact = -1;
  std::vector<ContactPair> pairs;
};

/// The nodes of a place, without repetition.
struct PlaceNodes {
  std::vector<int> nodes;             ///< node numbers of the body; empty for a rigid body
  std::vector<LineElement> elements;  ///< of an edge or the face of a crack; empty otherwise
};

/// How far the two sides of every contact with large slip have moved along it when its pairs are found, since the
/// start: [contact][0: A, 1: B], zero for all other contacts. Empty: nothing has moved. Nodes of bodies are where the
/// bodies are at the start; points of pairs are moved by these translations.
using Placement = std::vector<std::array<Vec2, 2>>;

struct Mesh {
  std::vector<BodyMesh> bodies;       ///< one for each body of the model
  std::vector<Interface> interfaces;  ///< one for each contact of the model
  std::vector<Interface> ties;        ///< one for each tie: nodes that are one; gaps are rounding, `contact` is -1
  Placement placement;
  int dimension = 2;  ///< of the nodes: 2 in the plane, 3 in space
  int nodes() const;  ///< number of nodes of all bodies
  /// How degrees of freedom are numbered on it.
  Components components() const { return {dimension}; }
  /// Number of degrees of freedom of all bodies, supported ones included.
  int dofs() const { return static_cast<int>(components().count(nodes())); }
  /// Where the point of a pair on side 0 (A) or 1 (B) is in its body at the start.
  Vec2 point_of(int contact, const ContactPair& pair, int side) const;
};

/// Divides every body and matches the two sides of every contact and tie. Throws InputError, with file and lines of the
/// model, for contacts and ties whose nodes do not match and for meshes that are too large.
Mesh make_mesh(const model::Model& model);

/// The bodies of a valid model, each divided by itself: before the sides of contacts are matched.
std::vector<BodyMesh> divided_bodies(const model::Model& model);

/// Divides the sides of divided bodies anew, as they face each other in a placement, or says what is wrong with it. A
/// contact with large slip whose sides have left each other has no pairs.
std::variant<Mesh, std::vector<Diagnostic>> pair_in(const model::Model& model, std::vector<BodyMesh> bodies,
                                                    Placement placement);

/// The nodes of `place`.
PlaceNodes nodes_of(const model::Place& place, const Mesh& mesh);

}  // namespace scabo::mesh
