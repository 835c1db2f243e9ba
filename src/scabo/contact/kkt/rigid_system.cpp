#include "scabo/contact/kkt/rigid_system.hpp"

#include <utility>

#include "scabo/contact/kkt/joint_system.hpp"
#include "scabo/contact/kkt/motion_system.hpp"

namespace scabo::contact {

std::unique_ptr<RigidSystem> RigidSystem::of(const Problem& problem) {
  if (MotionSystem::is_of(problem)) return std::make_unique<MotionSystem>(problem);
  if (problem.dimension == 2) {
    if (auto joints = find_joints<2>(problem)) return std::make_unique<JointSystem<2>>(*std::move(joints));
  } else if (auto joints = find_joints<3>(problem)) {
    return std::make_unique<JointSystem<3>>(*std::move(joints));
  }
  return nullptr;
}

}  // namespace scabo::contact
