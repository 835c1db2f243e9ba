// Resultants over faces of bodies in space: force and moment of all that acts on a body through a face.
//
// They are sums over what is known to act there: loads at nodes, reactions, springs, and the forces of contacts and
// ties at the nodes of their side. What acts at sides of elements counts for the face that has these sides; what acts
// at nodes without sides (sets of nodes along an edge, or single ones) counts for every face that has the node. The
// nodes of a body are in balance to rounding, so that the sum over all faces of a body, with its volume forces, is 0.
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "scabo/analysis/space/solid_analysis.hpp"
#include "scabo/mesh/space/solid_edges.hpp"

namespace scabo::analysis {

struct FaceResultant {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();

  void add(const Eigen::Vector3d& at, const Eigen::Vector3d& acting) {
    force += acting;
    moment += at.cross(acting);
  }
};

/// Where something acts on a body: on sides of elements, or at nodes that have none.
struct SolidPlaceOfAction {
  int body = -1;
  std::vector<mesh::SolidFacet> facets;
  std::vector<int> nodes;  ///< all of an edge, or of a set, whether sides have them or not; of a face none
  std::vector<mesh::SolidEdge> edges = {};
};

/// What acts on a body through one of its faces.
class FaceActions {
 public:
  FaceActions(int body, const std::vector<mesh::SolidFacet>& facets, const Eigen::Vector3d& about);

  /// Which of its nodes count of what acts there: all, some, or none; nothing if only some of its sides are on the
  /// face.
  struct Share {
    bool all = false;
    std::vector<int> nodes;
  };
  std::optional<Share> share_of(const SolidPlaceOfAction& place) const;

  /// `forces`: of all nodes at factor 1.
  void add_load(std::size_t load, const mesh::SolidMesh& mesh, const Vector& forces, const Share& share);
  /// Of a support, also one that begins or ends in a step.
  void add_reactions(const SolidModel& model, int support, const Share& share);
  void add_springs(std::size_t springs, Share share);
  void add_contact(std::size_t contact, bool on_b);
  void add_bar(std::size_t bar, bool on_b, Share share);

  FaceResultant resultant(const SolidModel& model, const SolidIncrement& increment) const;

 private:
  int body_;
  Eigen::Vector3d about_;
  std::set<mesh::SolidFacet> facets_;  // by their nodes in ascending order
  std::set<int> nodes_;
  std::vector<std::pair<std::size_t, FaceResultant>> loads_;  // at factor 1
  std::vector<std::size_t> constraints_;                      // of the body
  std::vector<std::size_t> held_points_;                      // of the model
  std::vector<std::pair<std::size_t, Share>> springs_;
  std::vector<std::pair<std::size_t, bool>> contacts_;  // and whether it is side b
  struct EndOfBar {
    std::size_t bar;
    bool on_b;
    Share share;
  };
  std::vector<EndOfBar> bars_;
};

}  // namespace scabo::analysis
