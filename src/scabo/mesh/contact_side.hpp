// The nodes of one elastic edge, as contact sees them.
#pragma once

#include <vector>

#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {

struct ContactSide {
  ContactSide(const model::Edge& edge, const std::vector<LineElement>& elements, const std::vector<Vec2>& nodes);

  int size() const { return static_cast<int>(nodes.size()); }

  const model::Edge* edge;
  std::vector<LineElement> elements;  ///< nodes are places in the lists below

  // Without repetition, in the direction of the body's boundary:
  std::vector<int> nodes;    ///< of the body
  std::vector<Vec2> points;  ///< where they are
  /// Unit normals out of the body, weighted as nodal forces are: the direction of the integral of N_i n over
  /// the elements of this edge. A uniform pressure acts along them exactly.
  std::vector<Vec2> normals;
  std::vector<Vec2> true_normals;  ///< those of the line or arc before it was divided

  bool closed = false;    ///< one edge is the whole boundary: the last node is followed by the first
  double element_length;  ///< of the shortest element
  double spacing;         ///< smallest distance between neighbouring nodes
};

/// Finds the nearest of the points of a curve, given in order, by a tree of boxes around runs of them. The
/// boxes lie along the chord of the curve, so that far from a straight edge, in any direction, a search still
/// takes only a logarithmic number of steps.
class NearestPoint {
 public:
  explicit NearestPoint(const std::vector<Vec2>& curve);
  int operator()(const Vec2& to) const;  ///< index into `curve`

 private:
  struct Run {
    int first = 0, last = 0;                       // points first ... last - 1
    Vec2 low = Vec2::Zero(), high = Vec2::Zero();  // their bounding box
    int half = -1;  // runs_[half] and runs_[half + 1] are its halves; -1: too short to be halved
  };
  struct Found {
    int point = 0;
    double squared_distance;
  };
  void divide(int run);
  void search(int run, const Vec2& to, Found& best) const;

  Mat2 frame_;                // rows: along the chord, across it
  std::vector<Vec2> points_;  // in this frame
  std::vector<Run> runs_;     // runs_[0] holds all
};

}  // namespace scabo::mesh
