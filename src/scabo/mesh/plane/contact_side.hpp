// The nodes of one elastic edge, as needed for contact.
#pragma once

#include <vector>

#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {

struct ContactSide {
  ContactSide(const model::Edge& edge, const std::vector<LineElement>& elements, const std::vector<Vec2>& nodes);

  int size() const { return static_cast<int>(nodes.size()); }

  const model::Edge* edge;
  std::vector<LineElement> elements;  ///< their nodes are positions in the lists below

  // Without repetition, in the direction of the boundary of the body; at the mouth of a crack the nodes of both sides:
  std::vector<int> nodes;    ///< node numbers of the body
  std::vector<Vec2> points;  ///< their positions
  /// Unit normals out of the body, weighted like nodal forces: each has the direction of the integral of N_i n over the
  /// elements of this edge. A uniform pressure acts exactly along them.
  std::vector<Vec2> normals;
  std::vector<Vec2> true_normals;  ///< normals of the undivided line or arc

  bool closed = false;    ///< the edge is the whole boundary, so that the first node follows the last
  double element_length;  ///< length of the shortest element
  double spacing;         ///< smallest distance between neighbouring nodes
};

/// Finds the nearest of the points of a curve, given in order, with a tree of bounding boxes around runs of points. The
/// boxes are aligned with the chord of the curve, so that a search takes a logarithmic number of steps even far from a
/// straight edge.
class NearestPoint {
 public:
  explicit NearestPoint(const std::vector<Vec2>& curve);
  int operator()(const Vec2& to) const;  ///< index into `curve`

 private:
  struct Run {
    int first = 0, last = 0;                       // points first ... last - 1
    Vec2 low = Vec2::Zero(), high = Vec2::Zero();  // their bounding box
    int half = -1;  // runs_[half] and runs_[half + 1] are its halves; -1: not divided further
  };
  struct Found {
    int point = 0;
    double squared_distance;
  };
  void divide(int run);
  void search(int run, const Vec2& to, Found& best) const;

  Mat2 frame_;                // rows: along the chord, across it
  std::vector<Vec2> points_;  // in this frame
  std::vector<Run> runs_;     // runs_[0] contains all points
};

}  // namespace scabo::mesh
