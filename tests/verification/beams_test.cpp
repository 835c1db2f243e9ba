// The double cantilever beam of Zhu et al. (2017) on finer meshes, against what three other codes and meshes converge
// to (normal force 53.66936 kN for every coefficient of friction, contact from x = 5.1514 m to the free end).
#include <fmt/format.h>

#include <cmath>
#include <iostream>

#include "models.hpp"
#include "run.hpp"

namespace scabo::verification {
namespace {

constexpr double converged_force = double_cantilever_force, converged_end = 5.1514;

std::string refined_beams(double size, double friction) {
  return double_cantilever(fmt::format("size: {}", size), fmt::format("size: {}", size), friction);
}

/// The last open and the first closed pair; all pairs left of the one are open, all right of the other are closed.
struct EndOfContact {
  double open_to = 0.0, closed_from = 6.0;
};
EndOfContact end_of_contact(const analysis::ContactResult& joint) {
  EndOfContact end;
  for (const analysis::PairResult& pair : joint.pairs)
    if (pair.state == contact::ContactState::open)
      end.open_to = std::max(end.open_to, pair.position.x());
    else
      end.closed_from = std::min(end.closed_from, pair.position.x());
  return end;
}

// Second order in the size of the elements, with an error of 130 N/m2 h^2 at most (nodes fall on the end of contact or
// beside it, so that single errors are much smaller); the end of contact lies within an element, and on the finer
// meshes between the last open and the first closed node.
TEST(DoubleCantilever, ForceAndZoneConvergeToThoseOfOtherCodes) {
  for (const double size : {0.1875, 0.09375, 0.046875}) {
    const auto solution = run(refined_beams(size, 0.2));
    const analysis::ContactResult& joint = last(solution).contacts.front();
    const EndOfContact end = end_of_contact(joint);
    std::cout << size << ": " << fmt::format("{:.3f}", joint.normal_force) << " N, open to " << end.open_to
              << ", closed from " << end.closed_from << "\n";
    EXPECT_NEAR(joint.normal_force, converged_force, 130.0 * size * size) << size;
    EXPECT_LT(end.open_to, end.closed_from) << size;  // one zone
    EXPECT_NEAR(end.closed_from - end.open_to, 0.5 * size, 1e-12) << size;
    EXPECT_NEAR(end.open_to, converged_end, size) << size;
    EXPECT_NEAR(end.closed_from, converged_end, size) << size;
    if (size < 0.05) {
      EXPECT_LT(end.open_to, converged_end);
      EXPECT_GT(end.closed_from, converged_end);
    }
  }
}

// Equal beams: the normal problem does not depend on friction, and everything in contact slips.
TEST(DoubleCantilever, EverythingInContactSlipsWhateverTheFriction) {
  double frictionless = 0.0;
  for (const double mu : {0.0, 0.2, 0.5}) {
    const auto solution = run(refined_beams(0.09375, mu));
    const analysis::ContactResult& joint = last(solution).contacts.front();
    EXPECT_NEAR(joint.normal_force, converged_force, 130.0 * 0.09375 * 0.09375) << mu;
    EXPECT_EQ(joint.stick, 0) << mu;
    EXPECT_GT(joint.slip, 10) << mu;
    EXPECT_NEAR(std::abs(joint.tangential_force), mu * joint.normal_force, 1e-9 * joint.normal_force) << mu;
    for (const analysis::PairResult& pair : joint.pairs)
      EXPECT_NEAR(std::abs(pair.tangential_force), mu * pair.normal_force, 1e-9 * joint.normal_force) << mu;
    if (mu == 0.0) frictionless = joint.normal_force;
    EXPECT_NEAR(joint.normal_force, frictionless, 1e-8 * frictionless) << mu;
  }
}

}  // namespace
}  // namespace scabo::verification
