#include "scabo/contact/sliding_bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace scabo::contact {
namespace {

/// Bodies that only slide: pairs with p_n = 1, mu = 0.5, W = 1, so that r = 1. `between`: the motions of a pair, -1:
/// the ground; `slips`: u_t. Slipping pairs have their friction, the others 0.
struct Sliders {
  std::vector<std::array<int, 2>> between;
  std::vector<double> slips;
  std::vector<PairState> states;
  Vector f, p, H;

  std::vector<int> hold(const std::vector<int>& stayed = {}) {
    const auto N = static_cast<Eigen::Index>(slips.size());
    Problem problem;
    Eigen::SparseMatrix<double> W(2 * N, 2 * N), G(2 * N, f.size());
    W.setIdentity();
    p.resize(2 * N);
    problem.q.setZero(2 * N);
    states.clear();
    for (Eigen::Index i = 0; i < N; ++i) {
      const auto pair = static_cast<std::size_t>(i);
      for (int side = 0; side < 2; ++side)
        if (between[pair][side] >= 0) G.insert(2 * i + 1, between[pair][side]) = side == 0 ? 1.0 : -1.0;
      const double slope = slips[pair] > 0.0 ? -0.5 : slips[pair] < 0.0 ? 0.5 : 0.0;
      p[2 * i] = 1.0, p[2 * i + 1] = slope;
      problem.q[2 * i] = -1.0, problem.q[2 * i + 1] = slips[pair] - slope;
      states.push_back({true, slope == 0.0, slope});
    }
    G.makeCompressed();
    problem.W = Delassus(W);
    problem.G = RigidMap(G);
    problem.mu = Vector::Constant(N, 0.5);
    problem.f = f;
    const BDifferentiableEquations equations(problem, 1.0);
    const Residual at = equations.residual(p, Vector::Zero(f.size()));
    H = at.H;
    return SlidingBodies(equations).hold(p, at, states, H, stayed);
  }
};

// One body on the ground, friction 0.5 + 0.5 - 0.5 - 0.5 = 0. Pushed by f > 0 it moves until the second pair turns,
// which takes up to 1; then the first.
TEST(SlidingBodies, StickWhereTheirFrictionChangesItsSign) {
  Sliders body{{{0, -1}, {0, -1}, {0, -1}, {0, -1}}, {-3.0, -1.0, 0.5, 2.0}, {}, Vector::Constant(1, 0.3), {}, {}};
  EXPECT_TRUE(body.hold().empty());
  EXPECT_EQ(body.states[1], (PairState{true, true, 0.0}));
  EXPECT_EQ(body.states[0], (PairState{true, false, 0.5}));
  EXPECT_DOUBLE_EQ(body.H[3], -1.0);  // r u_t
  body.f[0] = 1.3;
  EXPECT_TRUE(body.hold().empty());
  EXPECT_EQ(body.states[0], (PairState{true, true, 0.0}));
  EXPECT_EQ(body.states[1], (PairState{true, false, -0.5}));
  EXPECT_DOUBLE_EQ(body.H[3], 1.0);  // p_t + mu p_n
  body.f[0] = -0.3;
  EXPECT_TRUE(body.hold().empty());
  EXPECT_EQ(body.states[2], (PairState{true, true, 0.0}));
  body.f[0] = 2.5;  // more than friction can hold
  body.hold();
  for (const PairState& state : body.states) EXPECT_FALSE(state.sticks);
  body.f[0] = 0.0;  // it stays where it is
  EXPECT_EQ(body.hold(), std::vector<int>{0});
  for (const PairState& state : body.states) EXPECT_FALSE(state.sticks);
}

// The second body rests on the first alone. Where their nearest pair is one between them, another one holds both.
TEST(SlidingBodies, ThatStickToEachOtherAreOneBody) {
  Sliders bodies{{{0, -1}, {0, -1}, {1, 0}, {1, 0}}, {-3.0, 4.0, 0.0, 0.0}, {}, Vector::Constant(2, 0.2), {}, {}};
  EXPECT_TRUE(bodies.hold().empty());
  EXPECT_TRUE(bodies.states[0].sticks);  // -3: both are pushed forward
  EXPECT_FALSE(bodies.states[1].sticks);
  bodies.slips = {-3.0, 4.0, -0.1, 0.2};
  EXPECT_TRUE(bodies.hold().empty());
  EXPECT_TRUE(bodies.states[3].sticks);
  EXPECT_TRUE(bodies.states[0].sticks);
  EXPECT_FALSE(bodies.states[1].sticks || bodies.states[2].sticks);
  bodies.slips = {-3.0, 0.0, -0.1, 0.2};  // the first one is held, and the second by it
  EXPECT_TRUE(bodies.hold().empty());
  EXPECT_TRUE(bodies.states[2].sticks);
  EXPECT_FALSE(bodies.states[0].sticks);
}

// Two bodies that stick to each other and balance on the ground, 0.5 - 0.5 + 0.2 - 0.2 = 0: one of them stays, and the
// other may move towards it.
TEST(SlidingBodies, ThatBalanceTogetherStayByOneMotion) {
  Sliders bodies{{{0, -1}, {1, -1}, {1, 0}}, {-1.0, 1.0, 0.0}, {}, Vector::Zero(2), {}, {}};
  bodies.f << 0.2, -0.2;
  EXPECT_EQ(bodies.hold().size(), 1u);
  EXPECT_FALSE(bodies.states[0].sticks || bodies.states[1].sticks);
}

// The first body lacks 0.2, the second, which nothing holds, `largest`. A pair turns by 2 mu p_n = 1.
TEST(SlidingBodies, ThatHaveStayedStayUntilTheirForceIsMostOfWhatIsLeft) {
  const auto stays = [](double lacks, double largest, const std::vector<int>& stayed) {
    Sliders bodies{{{0, -1}, {0, -1}, {1, -1}}, {-1.0, 1.0, 2.0}, {}, Vector::Zero(2), {}, {}};
    bodies.f << lacks, 0.5 + largest;
    const std::vector<int> staying = bodies.hold(stayed);
    const bool first = std::find(staying.begin(), staying.end(), 0) != staying.end();
    EXPECT_EQ(first, !bodies.states[0].sticks && !bodies.states[1].sticks);
    return first;
  };
  EXPECT_FALSE(stays(0.2, 1.0, {}));
  EXPECT_TRUE(stays(0.2, 1.0, {0}));
  EXPECT_FALSE(stays(0.4, 1.0, {0}));
  EXPECT_TRUE(stays(0.009, 1.0, {}));
  EXPECT_TRUE(stays(0.004, 0.01, {}));    // hardly a part of what the next pair would turn by
  EXPECT_FALSE(stays(0.004, 0.005, {}));  // but most of what is left
}

}  // namespace
}  // namespace scabo::contact
