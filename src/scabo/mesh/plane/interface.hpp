// Matching of the two sides of a contact: which points face each other, along which normal, and at which distance.
//
// Both sides elastic (node-to-node contact). At a node i of A and a node j of B
//
//     n = (n_A - n_B) / |n_A - n_B|,   t = n turned by -90 degrees,   g = (x_B - x_A) . n
//
// with the nodal normals n_A, n_B of contact_side.hpp, which pass on a uniform pressure exactly. Two arcs that are not
// concentric, or an arc and a straight edge, touch in a narrow zone, and a body that rolls or slides along the other
// one must not meet the differences of those normals: n_A, n_B are the normals of the undivided edges there; and on
// concentric arcs with a gap or an overlap, or of bodies that are bonded or tied to others, and on arcs whose circle
// has another contact of this kind, where two contacts may have one point in common; and on arcs of which one is
// divided into chords, elements of order 1, but for the ends of all other arcs that touch. Swapping A and B gives -n
// and exactly the same g. The nodes match if x_B - x_A lies along n: |(x_B - x_A) . t| <= 1e-6 element lengths. Where
// the two sides are apart and not parallel (a disc and a plane with equal divisions), corresponding nodes are not
// exactly opposite: x_B - x_A may then also have any direction between the normals of the two sides, divided or exact.
// On curved edges of nearly equal curvature (a cylinder in a slightly larger ring) the offset may be up to 1/50 of the
// node spacing if that is at most half of g, and as much as half of g if both are on one ray (rays.hpp). On parallel
// straight edges only the first rule applies.
//
// Partners are searched from the closest pair outwards, node by node along both edges. A node whose foot on the other
// edge lies beyond the ends of that edge is outside the overlap and has no partner; neither has a node that faces
// another direction (by more than 60 degrees), which occurs only on arcs. All other nodes must have a partner.
//
// One side rigid. Every node of the elastic edge that has its foot on the rigid edge is paired with that foot; n is the
// exact normal of the rigid edge there, directed out of A. Only the named edge counts, not its neighbours.
//
// Both sides rigid. Along their bisector the two straight edges face each other in a stretch; its two ends are the
// pairs, and n is at right angles to the bisector. More pairs would only share the same resultant differently.
//
// g < 0 is an overlap, which is treated as an interference fit.
//
// The two faces of a crack have the same points (crack_faces.hpp).
#pragma once

#include <array>
#include <variant>

#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {

/// Two edges whose nodes are to be matched: those of a contact or of a tie. Refers to the model. With large slip the
/// edges face each other where they have moved (Placement).
struct Joint {
  const model::Place& a;
  const model::Place& b;
  double gap = 0.0;  ///< added to the geometric gap
  const Source& source;
  std::array<Vec2, 2> moved{Vec2::Zero(), Vec2::Zero()};  ///< translations of A and B

  bool has_moved() const { return !moved[0].isZero(0.0) || !moved[1].isZero(0.0); }
};
inline Joint joint_of(const model::Contact& contact) { return {contact.a, contact.b, contact.gap, contact.source}; }
inline Joint joint_of(const model::Tie& tie) { return {tie.a, tie.b, 0.0, tie.source}; }
/// All contacts, then all ties.
std::vector<Joint> joints_of(const model::Model& model, const Placement& placement = {});

/// The pairs of a joint, or what is wrong with them. `bodies` are those of the Mesh.
std::variant<Interface, Diagnostic> match_interface(const model::Model& model, const Joint& joint,
                                                    const std::vector<BodyMesh>& bodies);
/// The interface of contact number `contact`.
std::variant<Interface, Diagnostic> match_interface(const model::Model& model, int contact,
                                                    const std::vector<BodyMesh>& bodies,
                                                    const Placement& placement = {});

/// Gaps of pairs along their normals, `added` to the geometric ones, which are 0 within the rounding of coordinates.
void set_gaps(std::vector<ContactPair>& pairs, double added);

struct PairingFaults {
  std::vector<Diagnostic> mistakes;  ///< what is wrong with those that are not added
  /// Positions in joints_of() of those with nodes that match, but with elements that do not (node_matching.hpp), or
  /// with a rigid side that ends within an element (edge_ends.hpp).
  std::vector<std::size_t> unlike;
};

/// The interfaces of all contacts and ties, added to a mesh whose bodies are complete, in its placement. The sides of a
/// tie must lie on each other.
PairingFaults add_interfaces(const model::Model& model, Mesh& mesh);

}  // namespace scabo::mesh
