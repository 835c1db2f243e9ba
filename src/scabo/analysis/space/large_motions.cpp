#include "scabo/analysis/space/large_motions.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "scabo/analysis/space/solid_mechanism.hpp"

namespace scabo::analysis {

namespace {

constexpr double largest_small_rotation = 0.1;      // rad, as of prescribed rotations, which may have just this size
constexpr double largest_small_displacement = 0.1;  // of the size of a body

bool turns_far(const SolidMotion& motion) { return motion.rotation > largest_small_rotation * (1.0 + 1e-9); }

}  // namespace

SolidMotion motion_of(const mesh::SolidMesh& mesh, const Vector& u) {
  const SolidBodyMotion rigid = motion_of_nodes(mesh, u);
  SolidMotion motion{rigid.rotation.norm(), rigid.largest, 0.0, 2.0 * rigid.size};
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i)
    motion.deformed = std::max(motion.deformed, (u.segment<3>(3 * i) - rigid.at(mesh.nodes.col(i))).norm());
  return motion;
}

std::string LargeMotion::text(const std::string& name) const {
  if (turns_far(motion))
    return fmt::format(
        "body '{}' turns by {:.3g} rad: the theory is valid for rotations of up to {:.3g} rad, and normals of contacts "
        "and directions of loads do not turn",
        name, motion.rotation, largest_small_rotation);
  const std::string how =
      motion.deformed < 0.1 * motion.displacement
          ? fmt::format("it moves as a whole, and deforms by {:.3g} only: draw it where it comes to rest",
                        motion.deformed)
          : fmt::format("{:.3g} of it are deformation", motion.deformed);
  return fmt::format(
      "displacements of body '{}' reach {:.3g}, more than a tenth of its size: the theory is valid for small ones "
      "only; "
      "{}",
      name, motion.displacement, how);
}

std::optional<LargeMotion> large_motion_of(const std::vector<SolidMotion>& motions, const std::vector<bool>& rigid) {
  const auto most = std::max_element(motions.begin(), motions.end(),
                                     [](const auto& a, const auto& b) { return a.rotation < b.rotation; });
  if (most != motions.end() && turns_far(*most)) return LargeMotion{static_cast<int>(most - motions.begin()), *most};
  for (std::size_t b = 0; b < motions.size(); ++b)
    if (!rigid[b] && motions[b].displacement > largest_small_displacement * motions[b].size)
      return LargeMotion{static_cast<int>(b), motions[b]};
  return std::nullopt;
}

}  // namespace scabo::analysis
