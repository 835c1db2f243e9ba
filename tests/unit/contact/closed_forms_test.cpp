// Small problems whose forces are known in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "scabo/contact/solve.hpp"

namespace scabo::contact {
namespace {

Problem problem_of(const Matrix& W, const Vector& q, const Vector& mu, int dimension = 2) {
  Problem problem;
  problem.dimension = dimension;
  problem.W = W;
  problem.q = q;
  problem.mu = mu;
  problem.G.resize(q.size(), 0);
  return problem;
}

// K = [2 -1; -1 1] with mu = 1.5 > K_tt / |K_tn| = 1 (Klarbring, Ing.-Archiv 60 (1990) 529): the same motion without
// contact, q = [0.1, 1], leaves the pair open, lets it stick with p = -K q, and lets it slip with p_t = -mu p_n.
TEST(OnePair, WithMoreFrictionThanItsStiffnessCouplesHasThreeSolutions) {
  Matrix K(2, 2);
  K << 2.0, -1.0, -1.0, 1.0;
  const Problem problem = problem_of(test::inverse(K), Eigen::Vector2d(0.1, 1.0), Vector::Constant(1, 1.5));
  struct Known {
    Eigen::Vector2d p;
    ContactState state;
  };
  for (const Known& known : {Known{{0.0, 0.0}, ContactState::open}, Known{{0.8, -0.9}, ContactState::stick},
                             Known{{0.2, -0.3}, ContactState::slip}}) {
    const Solution stays = solve(problem, {known.p, Vector()});  // from its own history
    ASSERT_EQ(stays.status, Status::solved);
    EXPECT_LT((stays.p - known.p).norm(), 1e-12);
    EXPECT_EQ(stays.states[0], known.state);
    EXPECT_LE(stays.certificate.worst(), 1e-12);
  }
  // From anywhere: one of the three, and certified.
  for (double p_n : {0.0, 0.1, 0.3, 0.5, 1.0, 2.0})
    for (double share : {-1.0, -0.7, 0.0, 0.5}) {
      const Solution solution = solve(problem, {Eigen::Vector2d(p_n, share * p_n), Vector()});
      ASSERT_EQ(solution.status, Status::solved);
      double distance = HUGE_VAL;
      for (const Eigen::Vector2d& p : {Eigen::Vector2d(0, 0), Eigen::Vector2d(0.8, -0.9), Eigen::Vector2d(0.2, -0.3)})
        distance = std::min(distance, (solution.p - p).norm());
      EXPECT_LT(distance, 1e-10);
    }
  // Below the limit there is one.
  Problem weaker = problem;
  weaker.mu[0] = 0.9;
  for (double p_n : {0.0, 0.5, 2.0})
    EXPECT_LT(solve(weaker, {Eigen::Vector2d(p_n, -0.9 * p_n), Vector()}).p.norm(), 1e-12);
}

// A wedge of half angle alpha pressed with F between two walls, each a spring of flexibility w in every direction: it
// sinks by delta; where mu >= cot(alpha) it sticks, p_t = p_n cot(alpha), otherwise it slips, and 2 p_n (sin + mu cos)
// = F.
TEST(Wedge, SticksOrSlipsBetweenItsWalls) {
  const double F = 12.0, w = 0.01;
  for (double alpha : {0.3, 0.6, 1.0})
    for (double factor : {0.0, 0.3, 0.999, 1.001, 1.5}) {
      const double c = std::cos(alpha), s = std::sin(alpha), mu = factor * c / s;
      Problem problem = problem_of(w * Matrix::Identity(4, 4), Vector::Zero(4), Vector::Constant(2, mu));
      problem.G = Vector{{s, c, s, -c}};  // up: the walls open, and slide
      problem.f = Vector::Constant(1, -F);
      const Solution solution = solve(problem);
      ASSERT_EQ(solution.status, Status::solved) << solution.reason;
      const double p_n = factor >= 1.0 ? 0.5 * F * s : 0.5 * F / (s + mu * c);
      const double p_t = factor >= 1.0 ? 0.5 * F * c : mu * p_n;
      EXPECT_NEAR(solution.p[0], p_n, 1e-9 * F);
      EXPECT_NEAR(solution.p[1], p_t, 1e-9 * F);
      EXPECT_NEAR(solution.p[3], -p_t, 1e-9 * F);
      EXPECT_NEAR(solution.a[0], -w * p_n / s, 1e-9 * F * w);
    }
}

// Two blocks of weights G_1 (lower), G_2 on a floor, pushed aside with P at the upper one: P passes both joints.
TEST(TwoBlocks, TheWeakerJointDecides) {
  const double weight_1 = 30.0, weight_2 = 10.0;
  const auto blocks = [&](double mu_1, double mu_2, double P) {
    Problem problem = problem_of(1e-3 * Matrix::Identity(4, 4), Vector::Zero(4), Eigen::Vector2d(mu_1, mu_2));
    Matrix G = Matrix::Zero(4, 4);  // [x_1, y_1, x_2, y_2]; pairs: floor to lower, lower to upper
    G(0, 1) = G(1, 0) = 1.0;
    G(2, 3) = G(3, 2) = 1.0;
    G(2, 1) = G(3, 0) = -1.0;
    problem.G = G;
    problem.f = Eigen::Vector4d(0.0, -weight_1, P, -weight_2);
    return solve(problem);
  };
  const Solution rests = blocks(0.2, 0.5, 4.9);  // limits: 8 below, 5 above
  ASSERT_EQ(rests.status, Status::solved) << rests.reason;
  EXPECT_LT((rests.p - Eigen::Vector4d(40.0, -4.9, 10.0, -4.9)).cwiseAbs().maxCoeff(), 1e-8);
  const Solution upper = blocks(0.2, 0.5, 5.1);
  ASSERT_EQ(upper.status, Status::mechanism);
  EXPECT_GT(upper.motion[2], 10.0 * std::abs(upper.motion[0]));  // the upper block alone
  const Solution both = blocks(0.1, 0.5, 4.5);                   // limits: 4 below, 5 above
  ASSERT_EQ(both.status, Status::mechanism);
  EXPECT_NEAR(both.motion[0], both.motion[2], 1e-6);
}

// A pair pressed with p_n, driven to and fro by A along a direction: it sticks for 2 w mu p_n after each turn, then
// slips. Loop 4 mu p_n (A - w mu p_n); at every increment work of the drive = elastic energy + what friction took.
TEST(CyclicLoad, HysteresisLoopAndEnergyBalance) {
  for (int d : {2, 3}) {
    const double w = 0.02, mu = 0.5, p_n = 100.0, yield = w * mu * p_n, A = 4.0 * yield;
    const Vector direction = d == 2 ? Vector(Vector::Ones(1)) : Vector(Eigen::Vector2d(0.6, -0.8));
    Problem problem = problem_of(w * Matrix::Identity(d, d), Vector::Zero(d), Vector::Constant(1, mu), d);
    Start start;
    Vector slip = Vector::Zero(d - 1), friction_before = Vector::Zero(d - 1), drive_before = Vector::Zero(d - 1);
    double work = 0.0, dissipated = 0.0, loop_start = 0.0;
    std::vector<double> path;
    for (int k = 1; k <= 4; ++k) path.push_back(k * yield);
    for (int cycle = 0; cycle < 3; ++cycle) {
      for (int k = 1; k <= 8; ++k) path.push_back(A - k * yield);
      for (int k = 1; k <= 8; ++k) path.push_back(-A + k * yield);
    }
    for (std::size_t k = 0; k < path.size(); ++k) {
      const Vector drive = path[k] * direction;
      problem.q[0] = -w * p_n;
      problem.q.tail(d - 1) = drive - slip;
      const Solution solution = solve(problem, start);
      ASSERT_EQ(solution.status, Status::solved) << solution.reason;
      const Vector friction = solution.p.tail(d - 1);
      // The drive pulls with -p_t; the spring between drive and pair is w.
      work -= 0.5 * (friction + friction_before).dot(drive - drive_before);
      dissipated -= friction.dot(solution.slip_increment);
      slip += solution.slip_increment;
      const double elastic = 0.5 * w * friction.squaredNorm();
      EXPECT_NEAR(work, elastic + dissipated, 1e-10 * mu * p_n * A) << "increment " << k;
      friction_before = friction;
      drive_before = drive;
      start.p = solution.p;
      if (k == 19) loop_start = dissipated;  // after the first whole cycle
      if (k == 35) EXPECT_NEAR(dissipated - loop_start, 4.0 * mu * p_n * (A - yield), 1e-10 * mu * p_n * A);
    }
  }
}

// Driven round a circle at the bound, in small steps: friction stays at the bound and opposes the motion.
TEST(CyclicLoad, RoundACircleInSpace) {
  const double w = 0.01, mu = 0.3, p_n = 50.0;
  Problem problem = problem_of(w * Matrix::Identity(3, 3), Vector::Zero(3), Vector::Constant(1, mu), 3);
  Start start;
  Eigen::Vector2d slip = Eigen::Vector2d::Zero();
  for (int k = 0; k <= 400; ++k) {
    const double angle = 0.05 * k;
    problem.q = Eigen::Vector3d(-w * p_n, 3.0 * std::cos(angle) - slip[0], 3.0 * std::sin(angle) - slip[1]);
    const Solution solution = solve(problem, start);
    ASSERT_EQ(solution.status, Status::solved) << k;
    const Eigen::Vector2d friction = solution.p.tail<2>(), step = solution.slip_increment;
    if (k > 0) {
      EXPECT_NEAR(friction.norm(), mu * p_n, 1e-9);
      EXPECT_NEAR(friction.dot(step), -friction.norm() * step.norm(), 1e-10);
    }
    slip += step;
    start.p = solution.p;
  }
}

}  // namespace
}  // namespace scabo::contact
