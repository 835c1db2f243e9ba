#include "scabo/contact/questions/smoothest_forces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace scabo::contact {
namespace {

/// Three blocks in bond that meet in a point: the left one A and the right one B side by side, C on both. Pairs: A to B
/// with this force (n = +x), A to C and B to C (n = +y); all of friction 0.6, sticking but for the first, which
/// touches.
Vector smoothest_at_a_meeting_point(double normal_force, double tangential_force, ContactState first,
                                    double motion = 0.0) {
  Problem problem;
  problem.mu = Vector::Constant(3, 0.6);
  Solution solution;
  solution.p.resize(6);
  solution.p << normal_force, tangential_force, 0.0190, 0.0016, 0.0087, 0.0027;
  solution.gap = solution.slip_increment = Vector::Constant(3, motion);
  problem.q.setZero(6);
  Eigen::SparseMatrix<double> G(6, 1);
  for (int row = 0; row < 6; ++row) G.insert(row, 0) = 1.0;
  problem.G = RigidMap(G);
  solution.a = Vector::Ones(1);
  solution.states = {first, ContactState::stick, ContactState::stick};
  ActionOfPairs action;
  action.normal = {Vec2(1.0, 0.0), Vec2(0.0, 1.0), Vec2(0.0, 1.0)};
  action.area = Vector::Constant(3, 0.25);
  action.first_row = {0, 2, 4};
  action.is_point = {1, 1, 1};
  action.on_bodies.resize(6, 6);
  const int sides[3][2] = {{0, 1}, {0, 2}, {1, 2}};
  for (int i = 0; i < 3; ++i) {
    const Vec2 n = action.normal[static_cast<std::size_t>(i)], t(n.y(), -n.x());
    for (int k = 0; k < 2; ++k) {
      action.on_bodies.insert(2 * sides[i][0] + k, 2 * i) = -n[k];
      action.on_bodies.insert(2 * sides[i][1] + k, 2 * i) = n[k];
      action.on_bodies.insert(2 * sides[i][0] + k, 2 * i + 1) = -t[k];
      action.on_bodies.insert(2 * sides[i][1] + k, 2 * i + 1) = t[k];
    }
  }
  return smoothest_forces(problem, solution, action, {1.0, 1e-6}).p;
}

// The bed presses A by 0.0190 and B by 0.0087 where the joint between them carries nothing. One stress would be nearer
// if this joint carried a force d, by 2 d_y; it may, within its cone, whatever the last digit of the force was that the
// solver ended with. (A tensile one of 1e-21 was kept as that of a joint that is pulled: twins of a wall differed by a
// thousandth of the largest force.)
TEST(SmoothestForces, DoNotDependOnTheLastDigitOfAJointWithoutForce) {
  const Vector at_rest = smoothest_at_a_meeting_point(0.0, 0.0, ContactState::stick);
  EXPECT_GT(at_rest[0], 1e-3);
  EXPECT_NEAR(std::abs(at_rest[1]), 0.6 * at_rest[0], 1e-15);  // it would carry more
  EXPECT_LT(at_rest[2] - at_rest[4], 0.0103 - 1e-3);
  for (const double rounding : {-7e-22, 7e-22, -1e-18})
    for (const ContactState state : {ContactState::open, ContactState::stick, ContactState::slip})
      EXPECT_LT((smoothest_at_a_meeting_point(rounding, 0.5 * rounding, state) - at_rest).cwiseAbs().maxCoeff(), 1e-14);
}

// Where blocks move far, the last digits of their motion are gaps and slips, of any sign: 2e-16 of 1.
TEST(SmoothestForces, DoNotDependOnTheLastDigitOfTheMotionOfBlocks) {
  const Vector at_rest = smoothest_at_a_meeting_point(1e-3, 0.6e-3, ContactState::slip);
  for (const double motion : {2e-16, -2e-16})
    for (const ContactState state : {ContactState::open, ContactState::stick, ContactState::slip})
      EXPECT_LT((smoothest_at_a_meeting_point(1e-3, 0.6e-3, state, motion) - at_rest).cwiseAbs().maxCoeff(), 1e-14);
}

// A solver may leave forces beyond the cone by as much as its tolerance.
TEST(SmoothestForces, AreWithinTheConesToRounding) {
  for (const double beyond : {1e-9, 1e-11}) {
    const Vector p = smoothest_at_a_meeting_point(2e-3, -1.2e-3 - beyond, ContactState::stick);
    for (int pair = 0; pair < 3; ++pair) {
      EXPECT_GE(p[2 * pair], 0.0) << pair;
      EXPECT_LE(std::abs(p[2 * pair + 1]), 0.6 * p[2 * pair] + 1e-16) << pair;
    }
  }
}

}  // namespace
}  // namespace scabo::contact
