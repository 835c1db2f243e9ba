// Displacements and rotations of bodies in space that contradict the theory of small displacements, by the rules of the
// plane (diagnostics/large_rotations.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scabo/base/types.hpp"
#include "scabo/mesh/space/solid_mesh.hpp"

namespace scabo::analysis {

/// How a body moves: the rigid motion nearest to the displacements of its nodes, and the rest.
struct SolidMotion {
  double rotation = 0.0;      ///< rad
  double displacement = 0.0;  ///< the largest one of a node
  double deformed = 0.0;      ///< what is left of it without the rigid motion
  double size = 0.0;          ///< twice the largest distance of a node from the centroid
};

/// `u`: three numbers for each node.
SolidMotion motion_of(const mesh::SolidMesh& mesh, const Vector& u);

struct LargeMotion {
  int body = -1;
  SolidMotion motion;

  /// A sentence about `body` of this name.
  std::string text(const std::string& name) const;
};

/// The body that turns most, if that is by more than 0.1 rad; else the first one that is not `rigid` whose
/// displacements exceed a tenth of its size.
std::optional<LargeMotion> large_motion_of(const std::vector<SolidMotion>& motions, const std::vector<bool>& rigid);

}  // namespace scabo::analysis
