#include "scabo/system/body_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "scabo/element/plane/stiffness.hpp"
#include "scabo/system/loads.hpp"
#include "scabo/system/structure.hpp"
#include "theory/rings.hpp"

namespace scabo::system {
namespace {

using namespace test;

Constraint hold(int node, int component, double value = 0.0) {
  Constraint constraint;
  constraint.dof = 2 * node + component;
  constraint.component = component;
  constraint.value = value;
  return constraint;
}

Constraint hold_rigid(const Vec2& point, int component, double value = 0.0) {
  Constraint constraint;
  constraint.point = point;
  constraint.component = component;
  constraint.value = value;
  return constraint;
}

const std::vector<Vec2> square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};

TEST(RigidMotions, DirectionsAreShownWithoutRounding) {
  EXPECT_EQ(describe_motion({1.0, -4.688e-9, 2e-9}, Vec2::Zero(), 1.0), "translation along (1, 0)");
  EXPECT_EQ(describe_motion({-3e-8, 2.0, 0.0}, Vec2::Zero(), 1.0), "translation along (0, 1)");
  EXPECT_EQ(describe_motion({1.0, 1e-3, 0.0}, Vec2::Zero(), 1.0), "translation along (1, 0.001)");
  EXPECT_EQ(describe_motion({4e-8, -2.0, 1.0}, Vec2::Zero(), 1.0), "rotation about (2, 0)");
}

TEST(FreeMotions, ThreeWithoutSupportsNoneWhenIsostatic) {
  Vec2 reference;
  double lever = 0.0;
  EXPECT_EQ(free_motions(square, {}, {}, reference, lever).cols(), 3);
  EXPECT_EQ(reference, Vec2(1, 1));
  EXPECT_DOUBLE_EQ(lever, std::sqrt(2.0));
  EXPECT_EQ(free_motions(square, {hold(0, 0), hold(0, 1), hold(1, 1)}, {}, reference, lever).cols(), 0);
  EXPECT_EQ(free_motions(square, {hold(0, 0), hold(0, 1), hold(1, 0)}, {}, reference, lever).cols(), 1);
}

TEST(FreeMotions, AreDescribedByWhatTheyDo) {
  Vec2 reference;
  double lever = 0.0;
  Matrix motion = free_motions(square, {hold(0, 1), hold(1, 1)}, {}, reference, lever);  // a roller along the bottom
  ASSERT_EQ(motion.cols(), 1);
  EXPECT_THAT(describe_motion(motion.col(0), reference, lever),
              testing::AnyOf("translation along (1, 0)", "translation along (-1, 0)"));
  motion = free_motions(square, {hold(1, 0), hold(1, 1)}, {}, reference, lever);  // a hinge
  ASSERT_EQ(motion.cols(), 1);
  EXPECT_EQ(describe_motion(motion.col(0), reference, lever), "rotation about (2, 0)");
}

TEST(FreeMotions, MoveNoConstraint) {
  const std::vector<Constraint> held = {hold(0, 0), hold(2, 1)};  // x at (0, 0), y at (2, 2): pole (2, 0)
  Vec2 reference;
  double lever = 0.0;
  const Matrix motion = free_motions(square, held, {}, reference, lever);
  ASSERT_EQ(motion.cols(), 1);
  for (const Constraint& constraint : held) {
    const Vec2 moved = rigid_point(square[static_cast<std::size_t>(constraint.dof / 2)], reference, lever) * motion;
    EXPECT_NEAR(moved[constraint.dof % 2], 0.0, 1e-15);
  }
  EXPECT_EQ(describe_motion(motion.col(0), reference, lever), "rotation about (2, 0)");
}

/// A bar of 4 x 1 along x, E = 100, nu = 0.25, thickness 0.5, as one super-element or as 8-node elements.
struct Bar {
  double length = 4.0, height = 1.0, young = 100.0, poisson = 0.25, thickness = 0.5;
  element::Ring ring = rectangle_ring(4.0, 1.0, 4, 1, 2);
  std::shared_ptr<const Matrix> K =
      std::make_shared<const Matrix>(element::solve_super_element(ring, elasticity(100.0, 0.25), 0.5).K);

  Stiffness dense() const { return {K, {}}; }
  Stiffness sparse() const { return {nullptr, K->sparseView()}; }
  std::vector<int> nodes_at(double x) const {
    std::vector<int> found;
    for (std::size_t i = 0; i < ring.nodes.size(); ++i)
      if (std::abs(ring.nodes[i].x() - x) < 1e-9) found.push_back(static_cast<int>(i));
    return found;
  }
  int corner() const { return 0; }  // lower left
  Vector pulled(double traction) const {
    const std::vector<mesh::LineElement> end = {ring.elements[4]};
    return traction_forces(end, ring.nodes, thickness, [=](const Vec2&, const Vec2& n) { return Vec2(traction * n); });
  }
};

class BarBySolver : public testing::TestWithParam<bool> {
 protected:
  Bar bar;
  Stiffness stiffness() const { return GetParam() ? bar.dense() : bar.sparse(); }
};

TEST_P(BarBySolver, StretchesAndItsReactionsBalance) {
  std::vector<Constraint> constraints = {hold(bar.corner(), 1)};
  for (int node : bar.nodes_at(-2.0)) constraints.push_back(hold(node, 0));
  const auto body = elastic_body(stiffness(), bar.ring.nodes, constraints);
  EXPECT_EQ(body->rigid_motions().cols(), 0);
  const double traction = 3.0;
  const Vector f = bar.pulled(traction), none = Vector::Zero(static_cast<Eigen::Index>(constraints.size()));
  const Vector u = body->displacement(f, none);
  const Vector exact = at_nodes(bar.ring.nodes, [&](const Vec2& x) {
    return Vec2(traction / bar.young * (x.x() + 2.0), -bar.poisson * traction / bar.young * (x.y() + 0.5));
  });
  EXPECT_LT(largest(u - exact), 1e-14);
  const Vector reactions = body->reactions(u, f);
  const double force = traction * bar.height * bar.thickness;
  EXPECT_NEAR(reactions[0], 0.0, 1e-13);
  EXPECT_NEAR(reactions.sum(), -force, 1e-13);
  EXPECT_LT(body->imbalance(u, f), 1e-13 * force);
  EXPECT_NEAR(body->elastic_energy(u), 0.5 * force * traction / bar.young * bar.length, 1e-14);
  // An unbalanced state says so.
  Vector wrong = u;
  wrong[2 * bar.nodes_at(2.0).front()] += 1e-3;
  EXPECT_GT(body->imbalance(wrong, f), 1e-3);
}

TEST_P(BarBySolver, PrescribedDisplacementsPullIt) {
  std::vector<Constraint> constraints = {hold(bar.corner(), 1)};
  for (int node : bar.nodes_at(-2.0)) constraints.push_back(hold(node, 0));
  const std::size_t left = constraints.size();
  for (int node : bar.nodes_at(2.0)) constraints.push_back(hold(node, 0, 0.08));
  const auto body = elastic_body(stiffness(), bar.ring.nodes, constraints);
  Vector prescribed(static_cast<Eigen::Index>(constraints.size()));
  for (std::size_t c = 0; c < constraints.size(); ++c) prescribed[static_cast<Eigen::Index>(c)] = constraints[c].value;
  const Vector f = Vector::Zero(body->size()), u = body->displacement(f, prescribed);
  const Vector reactions = body->reactions(u, f);
  const double force = bar.young * 0.08 / bar.length * bar.height * bar.thickness;
  EXPECT_NEAR(reactions.tail(static_cast<Eigen::Index>(constraints.size() - left)).sum(), force, 1e-13);
  EXPECT_NEAR(reactions.sum(), 0.0, 1e-13);
  EXPECT_LT(body->imbalance(u, f), 1e-13);
}

TEST_P(BarBySolver, FlexibilityIsTheInverseOnTheFreeDegreesOfFreedom) {
  const std::vector<Constraint> constraints = {hold(0, 0), hold(0, 1), hold(3, 1)};
  const auto body = elastic_body(stiffness(), bar.ring.nodes, constraints);
  const std::vector<int> dofs = {0, 7, 12, 13, 30, 1};  // two of them held
  const Matrix A = body->flexibility(dofs);
  const Vector none = Vector::Zero(3);
  for (std::size_t j = 0; j < dofs.size(); ++j) {
    Vector f = Vector::Zero(body->size());
    f[dofs[j]] = 1.0;
    const Vector u = body->displacement(f, none);
    EXPECT_LT(largest(A.col(static_cast<Eigen::Index>(j)) - Vector(u(dofs))), 1e-13 * largest(A));
  }
  EXPECT_LT(largest(A - A.transpose()), 1e-15 * largest(A));
}

TEST_P(BarBySolver, AFloatingBarIsSolvedUpToItsRigidMotions) {
  const auto body = elastic_body(stiffness(), bar.ring.nodes, {});
  ASSERT_EQ(body->rigid_motions().cols(), 3);
  EXPECT_LT(largest(*bar.K * body->rigid_motions()), 1e-12 * largest(*bar.K));
  Vector f = bar.pulled(3.0);  // balanced by the same at the other end
  f += traction_forces({bar.ring.elements[9]}, bar.ring.nodes, bar.thickness,
                       [](const Vec2&, const Vec2& n) { return Vec2(3.0 * n); });
  EXPECT_LT(largest(body->rigid_motions().transpose() * f), 1e-14);
  const Vector u = body->displacement(f, Vector());
  EXPECT_LT(body->imbalance(u, f), 1e-12);
  EXPECT_EQ(body->reactions(u, f).size(), 0);
  const std::vector<int> right = bar.nodes_at(2.0), left = bar.nodes_at(-2.0);
  double stretch = 0.0;
  for (std::size_t i = 0; i < right.size(); ++i) stretch += (u[2 * right[i]] - u[2 * left[i]]) / 3.0;
  EXPECT_NEAR(stretch, 3.0 / bar.young * bar.length, 1e-13);
}

TEST_P(BarBySolver, AHingedBarKeepsOneRotation) {
  const auto body = elastic_body(stiffness(), bar.ring.nodes, {hold(0, 0), hold(0, 1)});
  ASSERT_EQ(body->rigid_motions().cols(), 1);
  EXPECT_EQ(body->rigid_motions().row(0).norm() + body->rigid_motions().row(1).norm(), 0.0);
  EXPECT_EQ(describe_motion(body->rigid_coordinates().col(0), body->reference(), body->lever()),
            "rotation about (-2, -0.5)");
}

INSTANTIATE_TEST_SUITE_P(DenseAndSparse, BarBySolver, testing::Bool(),
                         [](const auto& info) { return info.param ? "dense" : "sparse"; });

TEST(RigidBody, MovesWithItsSupportsAndTheirReactionsBalance) {
  std::string contradiction;
  // Held in x and y at (0, 0) and in y at (2, 0), which is pushed down by 0.1: a rotation.
  const auto body = rigid_body({1, 1}, 2.0, {hold_rigid({0, 0}, 0), hold_rigid({0, 0}, 1), hold_rigid({2, 0}, 1, -0.1)},
                               {}, contradiction);
  EXPECT_EQ(contradiction, "");
  EXPECT_EQ(body->size(), 3);
  EXPECT_EQ(body->rigid_motions().cols(), 0);
  const Vector f = rigid_point({1, 2}, {1, 1}, 2.0).transpose() * Vec2(0.0, -10.0);
  const Vector u = body->displacement(f, Eigen::Vector3d(0, 0, -0.1));
  EXPECT_LT(largest(rigid_point({2, 0}, {1, 1}, 2.0) * u - Vec2(0.0, -0.1)), 1e-15);
  EXPECT_LT(largest(rigid_point({0, 2}, {1, 1}, 2.0) * u - Vec2(0.1, 0.0)), 1e-15);
  const Vector reactions = body->reactions(u, f);
  EXPECT_LT(largest(reactions - Eigen::Vector3d(0, 5, 5)), 1e-14);
  EXPECT_LT(body->imbalance(u, f), 1e-14);
  EXPECT_EQ(body->elastic_energy(u), 0.0);
  EXPECT_EQ(largest(body->flexibility({0, 1, 2})), 0.0);
}

TEST(RigidBody, KeepsTheMotionsThatNothingHolds) {
  std::string contradiction;
  EXPECT_EQ(rigid_body({1, 1}, 2.0, {}, {}, contradiction)->rigid_motions().cols(), 3);
  const auto roller = rigid_body({1, 1}, 2.0, {hold_rigid({0, 0}, 1), hold_rigid({2, 0}, 1)}, {}, contradiction);
  ASSERT_EQ(roller->rigid_motions().cols(), 1);
  EXPECT_THAT(describe_motion(roller->rigid_coordinates().col(0), roller->reference(), roller->lever()),
              testing::HasSubstr("translation along"));
  EXPECT_GT(roller->imbalance(Vector::Zero(3), Eigen::Vector3d(1, 0, 0)), 0.9);
  EXPECT_LT(roller->imbalance(Vector::Zero(3), Eigen::Vector3d(0, 1, 0)), 1e-14);
}

TEST(RigidBody, FindsSupportsThatContradictEachOther) {
  std::string contradiction;
  rigid_body({1, 1}, 2.0, {hold_rigid({0, 0}, 0, 0.1), hold_rigid({2, 0}, 0, 0.2)}, {},
             contradiction);  // it would stretch
  EXPECT_NE(contradiction, "");
  contradiction.clear();
  rigid_body({1, 1}, 2.0, {hold_rigid({0, 0}, 0, 0.1), hold_rigid({2, 0}, 0, 0.1)}, {}, contradiction);
  EXPECT_EQ(contradiction, "");
}

/// A lattice girder of springs, two rows of `count` nodes one apart; stiffness `k` of a spring of length 1.
ElasticPart girder(int count, double k, const Vec2& at) {
  ElasticPart part;
  std::vector<Vec2> nodes;
  for (int i = 0; i < 2 * count; ++i) nodes.push_back(at + Vec2(i / 2, i % 2));
  std::vector<Eigen::Triplet<double>> entries;
  for (int a = 0; a < 2 * count; ++a)
    for (int b = a + 1; b < std::min(2 * count, a - a % 2 + 4); ++b) {
      const Vec2 along = nodes[static_cast<std::size_t>(b)] - nodes[static_cast<std::size_t>(a)];
      const Vec2 unit = along.normalized();
      const Eigen::Vector4d row(-unit.x(), -unit.y(), unit.x(), unit.y());
      const int dofs[4] = {2 * a, 2 * a + 1, 2 * b, 2 * b + 1};
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) entries.emplace_back(dofs[i], dofs[j], k / along.norm() * row[i] * row[j]);
    }
  part.nodes = nodes;
  part.stiffness.sparse.resize(4 * count, 4 * count);
  part.stiffness.sparse.setFromTriplets(entries.begin(), entries.end());
  for (int dof = 0; dof < 4; ++dof) part.constraints.push_back(hold(dof / 2, dof % 2));
  for (int i = 4; i < count; i += 4) part.constraints.push_back(hold(2 * i, 1));  // well-conditioned
  return part;
}

/// Nodes at integers far away give the same bits.
std::vector<ElasticPart> girders() {
  std::vector<ElasticPart> parts;
  parts.push_back(girder(30, 2.0, {0, 0}));
  parts.push_back(girder(30, 3.0, {0, 0}));    // another stiffness
  parts.push_back(girder(30, 2.0, {64, -8}));  // the first one elsewhere
  parts.push_back(girder(30, 2.0, {0, 0}));
  parts.back().constraints.pop_back();  // and with other supports
  parts.push_back(girder(40, 2.0, {0, 0}));
  return parts;
}

TEST(ElasticBodies, EqualOnesShareTheirFactor) {
  const auto bodies = elastic_bodies(girders(), 1);
  ASSERT_EQ(bodies.size(), 5u);
  EXPECT_EQ(bodies[0]->factor(), bodies[2]->factor());
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (i != 2 || j != 0) EXPECT_NE(bodies[i]->factor(), bodies[j]->factor()) << i << " and " << j;
}

TEST(ElasticBodies, KeepFactorsOfBodiesThatWereMadeBefore) {
  const auto before = elastic_bodies(girders(), 1), after = elastic_bodies(girders(), 1, {}, &before);
  const std::vector<int> dofs = {4, 9, 30, 46, 47, 1};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(after[i]->factor(), before[i]->factor());
    EXPECT_EQ(after[i]->flexibility(dofs), before[i]->flexibility(dofs));
  }
  const auto fresh = elastic_bodies(girders(), 1);
  EXPECT_NE(fresh[0]->factor(), before[0]->factor());
  std::vector<ElasticPart> elsewhere = girders();
  elsewhere[1] = girder(30, 3.0, {1, 0});  // its factor may have another order of elimination
  EXPECT_NE(elastic_bodies(std::move(elsewhere), 1, {}, &before)[1]->factor(), before[1]->factor());
  std::vector<ElasticPart> stiffer = girders();
  stiffer[3].stiffness.sparse.coeffRef(20, 20) *= 1.0 + 1e-15;
  const auto changed = elastic_bodies(std::move(stiffer), 1, {}, &before);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(changed[i]->factor() == before[i]->factor(), i != 3) << i;
}

/// However they are factorised: alone, together, on two threads, by another library.
TEST(ElasticBodies, AreThoseThatAreMadeAlone) {
  std::vector<linalg::SparseOptions> libraries(1);
  if (linalg::is_built_in(linalg::SparseLibrary::mumps)) libraries.push_back({linalg::SparseLibrary::mumps});
  for (const linalg::SparseOptions& library : libraries)
    for (const int threads : {1, 2}) {
      const auto bodies = elastic_bodies(girders(), threads, library);
      std::vector<ElasticPart> parts = girders();
      for (std::size_t p = 0; p < parts.size(); ++p) {
        const auto alone = elastic_body(parts[p].stiffness, parts[p].nodes, parts[p].constraints);
        const std::vector<int> dofs = {4, 9, 30, 46, 47, 1};
        const Matrix A = alone->flexibility(dofs), same = bodies[p]->flexibility(dofs);
        EXPECT_LT(largest(A - same), 1e-12 * largest(A));
        if (library.library == linalg::SparseLibrary::cholmod) EXPECT_EQ(A, same);
        Vector f = Vector::Zero(alone->size());
        f[46] = 1.0;
        const Vector none = Vector::Zero(static_cast<Eigen::Index>(parts[p].constraints.size()));
        const Vector u = alone->displacement(f, none);
        EXPECT_LT(largest(u - bodies[p]->displacement(f, none)), 1e-12 * largest(u));
        EXPECT_NEAR(u[46], A(3, 3), 1e-12 * A(3, 3));
        EXPECT_EQ(A(5, 5), 0.0);  // held
      }
    }
}

TEST(ElasticBodies, TheFirstThatIsNotPositiveDefiniteIsNamed) {
  std::vector<ElasticPart> parts = girders();
  for (const std::size_t wrong : {4u, 1u}) parts[wrong].stiffness.sparse.coeffRef(20, 20) = -1.0;
  for (const int threads : {1, 2}) try {
      elastic_bodies(parts, threads);
      FAIL() << "nothing was thrown";
    } catch (const NotPositiveDefinitePart& failure) {
      EXPECT_EQ(failure.part, 1u);
    }
}

}  // namespace
}  // namespace scabo::system
