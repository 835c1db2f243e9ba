#include "scabo/contact/solve.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/decompositions.hpp"
#include "unit/contact/problems.hpp"

namespace scabo::contact {
namespace {

using namespace test;

/// Every combination of open, stick and slip in either sense: the forces of those that meet all conditions.
std::vector<Vector> trial_and_error(const Problem& problem) {
  const int N = problem.pairs();
  std::vector<Vector> solutions;
  for (int combination = 0; combination < 1 << (2 * N); ++combination) {
    Matrix A = Matrix::Identity(2 * N, 2 * N);  // rows: force zero, motion zero or slip at the bound
    Vector b = Vector::Zero(2 * N);
    for (int i = 0; i < N; ++i) {
      const int state = combination >> (2 * i) & 3;  // 0 open, 1 stick, 2 slip with p_t = mu p_n, 3 with - mu p_n
      if (state == 0) continue;
      A.row(2 * i) = problem.W.dense().row(2 * i);
      b[2 * i] = -problem.q[2 * i];
      if (state == 1) {
        A.row(2 * i + 1) = problem.W.dense().row(2 * i + 1);
        b[2 * i + 1] = -problem.q[2 * i + 1];
      } else {
        A(2 * i + 1, 2 * i) = state == 2 ? -problem.mu[i] : problem.mu[i];
      }
    }
    const Vector p = least_squares(A, b);
    if (violation(problem, p, Vector()) < 1e-10) solutions.push_back(p);
  }
  return solutions;
}

TEST(Solve, FindsWhatTrialAndErrorFinds) {
  std::mt19937 random(31);
  int unique = 0;
  for (int k = 0; k < 120; ++k) {
    const Problem problem = held_problem(random, 1 + k % 4 + (k % 12 == 0), 0.5);
    const std::vector<Vector> expected = trial_and_error(problem);
    ASSERT_FALSE(expected.empty()) << "problem " << k;
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::solved) << "problem " << k << ": " << solution.reason;
    EXPECT_LT(solution.certificate.worst(), 1e-10);
    double distance = HUGE_VAL;
    for (const Vector& p : expected) distance = std::min(distance, (p - solution.p).cwiseAbs().maxCoeff());
    EXPECT_LT(distance, 1e-9) << "problem " << k;
    unique += expected.size() == 1;
  }
  EXPECT_GT(unique, 90);
}

/// These are the states of the solution, and of its forces with a `change` within the tolerance.
template <typename Change>
void expect_states_of(const Problem& problem, const std::vector<ContactState>& states, const Change& change) {
  SolverOptions options;
  options.tolerance = 1e-9;
  const Solution exact = solve(problem, {}, options);
  ASSERT_EQ(exact.status, Status::solved);
  EXPECT_EQ(exact.states, states);

  Vector p = exact.p;
  change(p);
  const auto nearly = with_forces(exact, p, problem, {}, options);
  ASSERT_TRUE(nearly.has_value());
  EXPECT_EQ(nearly->states, states);
}

// Interior points leave a little force in open pairs and a little room below the bound of pairs that slip, within the
// tolerance: these are open and slip all the same.
TEST(Solve, StatesAreThoseOfTheLargerOfForceAndMotion) {
  Problem problem;  // stick, open, slip
  problem.W = Matrix(Matrix::Identity(6, 6));
  problem.q = Vector::Zero(6);
  problem.q << -1.0, -0.1, 1.0, 0.3, -1.0, -2.0;
  problem.mu = Vector::Constant(3, 0.5);
  const std::vector<ContactState> states = {ContactState::stick, ContactState::open, ContactState::slip};
  expect_states_of(problem, states, [](Vector& p) { p[0] += 3e-10, p[2] = 3e-10, p[5] *= 1.0 - 3e-10; });
}

// Without contact a load would move the first pair by 1e6, on a soft spring; the second slips by 1e-3.
TEST(Solve, SlipsCountBesidePairsThatAreHeldSoftly) {
  Problem problem;
  Vector flexibility(4);
  flexibility << 1e6, 1e6, 1.0, 1.0;
  problem.W = Matrix(flexibility.asDiagonal());
  problem.q = Vector::Zero(4);
  problem.q << -1e6, 0.0, -1.0, -0.501;
  problem.mu = Vector::Constant(2, 0.5);
  const std::vector<ContactState> states = {ContactState::stick, ContactState::slip};
  expect_states_of(problem, states, [](Vector& p) { p[3] *= 1.0 - 3e-10; });
}

TEST(Solve, AgreesWithGaussSeidel) {
  std::mt19937 random(32);
  for (int k = 0; k < 50; ++k) {
    const Problem problem = held_problem(random, whole(random, 1, 8), 0.3);
    const Vector p = swept_forces(problem, 20000);
    if (violation(problem, p, Vector()) > 1e-9) continue;
    EXPECT_LT((solve(problem).p - p).cwiseAbs().maxCoeff(), 1e-8) << "problem " << k;
  }
}

TEST(Solve, StatesAndMotionsBelongToTheForces) {
  std::mt19937 random(33);
  for (int k = 0; k < 50; ++k) {
    const Problem problem = held_problem(random, 10, 0.6);
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::solved);
    const Vector motion = problem.q + problem.W * solution.p;
    for (Eigen::Index i = 0; i < 10; ++i) {
      EXPECT_EQ(solution.gap[i], motion[2 * i]);
      EXPECT_EQ(solution.slip_increment[i], motion[2 * i + 1]);
      const double pn = solution.p[2 * i], pt = solution.p[2 * i + 1], bound = problem.mu[i] * pn;
      switch (solution.states[static_cast<std::size_t>(i)]) {
        case ContactState::open:
          EXPECT_LT(pn, 1e-12);
          break;
        case ContactState::stick:
          EXPECT_GT(pn, 0.0);
          EXPECT_LT(std::abs(solution.slip_increment[i]), 1e-9);
          break;
        case ContactState::slip:
          EXPECT_GT(pn, 0.0);
          EXPECT_NEAR(std::abs(pt), bound, 1e-9);
          EXPECT_LE(pt * solution.slip_increment[i], 1e-12);
          break;
      }
    }
  }
}

TEST(Solve, ASolutionGivenAsTheStartNeedsNoIteration) {
  std::mt19937 random(34);
  for (int k = 0; k < 20; ++k) {
    const Problem problem = floating_problem(random, 8, 0.4);
    const Solution first = solve(problem);
    if (first.status != Status::solved) continue;
    const Solution again = solve(problem, {first.p, first.a});
    EXPECT_EQ(again.status, Status::solved);
    EXPECT_LE(again.iterations, 1);
    EXPECT_LT((again.p - first.p).cwiseAbs().maxCoeff(), 1e-9 * first.p.cwiseAbs().maxCoeff());
  }
}

TEST(Solve, TheAnswerDoesNotDependOnR) {
  std::mt19937 random(35);
  for (int k = 0; k < 20; ++k) {
    const Problem problem = k % 2 == 0 ? held_problem(random, 12, 0.3) : floating_problem(random, 12, 0.3);
    const Solution reference = solve(problem);
    if (reference.status == Status::mechanism) continue;
    ASSERT_EQ(reference.status, Status::solved);
    for (double factor : {1e-3, 1e-2, 0.1, 10.0, 1e2, 1e3}) {
      SolverOptions options;
      options.r_factor = factor;
      const Solution solution = solve(problem, {}, options);
      EXPECT_EQ(solution.status, Status::solved)
          << "problem " << k << ", r times " << factor << ": " << solution.reason;
      EXPECT_LT((solution.p - reference.p).cwiseAbs().maxCoeff(), 1e-8 * (1.0 + reference.p.cwiseAbs().maxCoeff()))
          << "problem " << k << ", r times " << factor;
    }
  }
}

TEST(Solve, UnitsChangeNeitherTheAnswerNorTheIterations) {
  std::mt19937 random(36);
  for (int k = 0; k < 60; ++k) {
    const Problem problem = k % 2 == 0 ? held_problem(random, 15, 0.8) : floating_problem(random, 15, 0.8);
    const Solution reference = solve(problem);
    for (const auto& [flexibility, force] :
         {std::pair(1e9, 1e-3), std::pair(1e-10, 1e5), std::pair(1.0, 1e6), std::pair(1e-6, 1.0)}) {
      Problem other = problem;  // motions are flexibility times force
      other.W = problem.W.scaled(flexibility);
      other.q *= flexibility * force;
      other.f *= force;
      const Solution solution = solve(other);
      EXPECT_EQ(solution.status, reference.status);
      EXPECT_EQ(solution.iterations, reference.iterations) << "problem " << k << ", " << flexibility << ", " << force;
      EXPECT_LT((solution.p / force - reference.p).cwiseAbs().maxCoeff(),
                1e-9 * (1.0 + reference.p.cwiseAbs().maxCoeff()));
    }
  }
}

// A and B swapped: n and t both turn round, so gaps, slips and the forces [p_n, p_t] stay as they are, and so
// does W; a mirror image turns only t.
TEST(Solve, AMirrorImageHasTheMirroredForces) {
  std::mt19937 random(37);
  for (int k = 0; k < 20; ++k) {
    const Problem problem = k % 2 == 0 ? held_problem(random, 9, 0.4) : floating_problem(random, 9, 0.4);
    Vector sign(18);
    for (int i = 0; i < 18; ++i) sign[i] = i % 2 == 0 ? 1.0 : -1.0;
    Problem mirrored = problem;
    mirrored.W = Matrix(sign.asDiagonal() * problem.W.dense() * sign.asDiagonal());
    mirrored.q = sign.asDiagonal() * problem.q;
    mirrored.G = sign.asDiagonal() * problem.G.dense();
    const Solution first = solve(problem), second = solve(mirrored);
    EXPECT_EQ(first.status, second.status);
    EXPECT_EQ(first.iterations, second.iterations);
    EXPECT_LT((Vector(sign.asDiagonal() * second.p) - first.p).cwiseAbs().maxCoeff(),
              1e-10 * (1.0 + first.p.cwiseAbs().maxCoeff()));
  }
}

TEST(Solve, NothingInContactNoForces) {
  std::mt19937 random(38);
  Problem problem = held_problem(random, 6, 0.5);
  problem.q = Vector::Ones(12);
  Solution solution = solve(problem);
  EXPECT_EQ(solution.status, Status::solved);
  EXPECT_EQ(solution.p, Vector(Vector::Zero(12)));
  EXPECT_EQ(solution.iterations, 0);
  problem.q.setZero();  // touching at zero force
  solution = solve(problem);
  EXPECT_EQ(solution.status, Status::solved);
  EXPECT_EQ(solution.p, Vector(Vector::Zero(12)));
  for (ContactState state : solution.states) EXPECT_EQ(state, ContactState::open);

  Problem none;  // no pairs at all
  none.q.resize(0), none.mu.resize(0), none.G.resize(0, 0), none.f.resize(0);
  EXPECT_EQ(solve(none).status, Status::solved);
}

TEST(Certificate, SeesEveryViolation) {
  Problem problem;
  problem.W = Matrix(Matrix::Identity(2, 2));
  problem.q = Eigen::Vector2d(-1.0, 0.3);
  problem.mu = Vector::Constant(1, 0.5);
  problem.G.resize(2, 0);
  const Scales scales;
  const auto certificate = [&](double pn, double pt) {
    return certify(problem, Eigen::Vector2d(pn, pt), Vector(), scales);
  };
  EXPECT_EQ(certificate(1.0, -0.3).worst(), 0.0);  // sticks
  EXPECT_DOUBLE_EQ(certificate(0.75, 0.0).penetration, 0.25);
  EXPECT_DOUBLE_EQ(certificate(-0.1, 0.0).tension, 0.1);
  EXPECT_DOUBLE_EQ(certificate(1.0, -0.8).friction_excess, 0.3);
  EXPECT_DOUBLE_EQ(certificate(2.0, 0.0).complementarity, 2.0);
  EXPECT_DOUBLE_EQ(certificate(1.0, 0.0).slip_direction, 0.5 * 0.3);  // slips below the bound
  EXPECT_DOUBLE_EQ(certificate(1.0, 0.5).slip_direction, 0.5 * 0.8);  // friction pushes along
  problem.G = Matrix::Identity(2, 1);
  problem.f = Vector::Constant(1, -1.25);
  EXPECT_DOUBLE_EQ(certify(problem, Eigen::Vector2d(1.0, -0.3), Vector::Zero(1), scales).rigid_balance, 0.25);
}

// Every comparison with nan is false, so an unguarded check would let it through.
TEST(Solve, NeverCertifiesWhatIsNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Problem problem;
  problem.W = Matrix(Matrix::Identity(2, 2));
  problem.q = Vector::Constant(2, nan);
  problem.mu = Vector::Constant(1, 0.3);
  problem.G.resize(2, 0);
  EXPECT_NE(solve(problem).status, Status::solved);
  problem.q.setConstant(-1.0);
  EXPECT_EQ(solve(problem).status, Status::solved);
  EXPECT_GT(certify(problem, Vector::Constant(2, nan), Vector(), {}).worst(), 1.0);
}

// A pair that a support holds along the joint: its row and column of W are zero, and no force along the joint is
// needed.
TEST(Solve, APairHeldAlongTheJointTakesNoFrictionAndNoExtraIterations) {
  std::mt19937 random(5);
  for (int k = 0; k < 20; ++k) {
    Problem held = held_problem(random, 12, 0.0);
    Matrix W = held.W.dense();
    W.row(7).setZero();
    W.col(7).setZero();
    held.W = W;
    held.q[7] = 0.0;
    Problem slippery = held;  // the same with nothing to carry there
    slippery.mu[3] = 0.0;
    const Solution solution = solve(held), without = solve(slippery);
    ASSERT_EQ(solution.status, Status::solved) << "problem " << k << ": " << solution.reason;
    EXPECT_LT((solution.p - without.p).norm(), 1e-9 * without.p.norm()) << "problem " << k;
    EXPECT_LE(std::abs(solution.p[7]), 1e-12 * without.p.norm()) << "problem " << k;
    EXPECT_EQ(solution.iterations, without.iterations) << "problem " << k;
  }
}

}  // namespace
}  // namespace scabo::contact
