// Which directions of the nodes of elastic bodies, and which motions of rigid ones, supports hold in space.
//
// Supports that meet at a node hold it along the span of their directions. A direction that lies in the span of others
// adds nothing: its displacement follows from theirs, and must be the one that is prescribed. Normals of curved faces
// that go on smoothly into each other differ by the error of the mesh; two of them count as one.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "scabo/analysis/space/solid_analysis.hpp"

namespace scabo::analysis {

/// Numbers of the supports: those that last, then those that begin or end, each after all that cover it.
std::vector<std::size_t> order_of_supports(const model::SpaceModel& model);

/// Along what a support holds a node, and the displacement at factor 1.
struct SupportedDirection {
  enum class Kind { given, normal_of_plane, normal_of_curved_face };
  Eigen::Vector3d direction;  ///< of length 1
  double value = 0.0;
  Kind kind = Kind::given;
};

class HeldNodes {
 public:
  /// Adds constraints and held points to `posed`.
  HeldNodes(const model::SpaceModel& model, SolidModel& posed) : model_(model), posed_(posed) {}

  /// By a support, unless others do so at its times. Or gives one that prescribes another displacement. Supports come
  /// in their order.
  std::optional<std::size_t> hold(std::size_t support, int node, const SupportedDirection& along);
  /// The same of a motion of a rigid body (system::held_motion), by this at factor 1; or gives another one that holds
  /// it too.
  std::optional<std::size_t> hold_motion(std::size_t support, int motion, double value);
  /// Whether a node is held along a direction that is not at right angles to this one.
  bool resists(int body, int node, const Eigen::Vector3d& direction) const;

 private:
  struct Held {
    std::size_t support;
    SupportedDirection along;
    int place;  // of its constraint among those of the node
  };
  struct Follows {
    double value, size;  // what others hold along a direction, and the sum of the absolute values of its parts
    bool has_factor;     // one of another support, if either has a name: factors of steps may then differ
    std::size_t first;   // the support with the largest part
    bool is(double wanted) const;  // but for rounding
  };
  /// What `others` make of a direction of this support; nothing: it is not in their span.
  std::optional<Follows> follows(const std::vector<const Held*>& others, std::size_t support,
                                 const SupportedDirection& along) const;
  void add(std::size_t support, int node, const SupportedDirection& along);

  void take(std::size_t support, system::Constraint constraint);

  const model::SpaceModel& model_;
  SolidModel& posed_;
  std::map<std::pair<int, int>, std::vector<Held>> held_;  // by body and node
  /// By rigid body and motion: supports and their displacements.
  std::map<std::pair<int, int>, std::vector<std::pair<std::size_t, double>>> motions_;
};

}  // namespace scabo::analysis
