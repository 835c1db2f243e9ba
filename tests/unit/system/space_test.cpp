// Tetrahedra in space, entered by nodes, stiffness and constraints: a point of a facet in contact.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numeric>

#include "scabo/contact/laws/coulomb.hpp"
#include "scabo/contact/solve.hpp"
#include "scabo/mesh/mesh.hpp"
#include "scabo/system/contact_system.hpp"
#include "support/decompositions.hpp"

namespace scabo::system {
namespace {

constexpr double modulus = 2.0;  // and Poisson's ratio 0: direct strains do not interact, G = E/2
constexpr Components space{3};

/// Stiffness of a linear tetrahedron, 12 x 12: V B'D B.
Matrix tetrahedron_stiffness(const Matrix& nodes) {
  Eigen::Matrix4d shape;  // rows [1, x, y, z] of the nodes; columns of its inverse are the shape functions
  shape << Eigen::Vector4d::Ones(), nodes.transpose();
  const Eigen::Matrix<double, 3, 4> gradient = shape.inverse().bottomRows<3>();
  Eigen::Matrix<double, 6, 12> B = Eigen::Matrix<double, 6, 12>::Zero();  // [xx, yy, zz, xy, yz, zx]
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      B(k, space.of(i, k)) = gradient(k, i);
      B(3 + k, space.of(i, k)) = gradient(next, i);
      B(3 + k, space.of(i, next)) = gradient(k, i);
    }
  Eigen::Matrix<double, 6, 1> D;
  D << Eigen::Vector3d::Constant(modulus), Eigen::Vector3d::Constant(0.5 * modulus);
  return std::abs(shape.determinant()) / 6.0 * B.transpose() * D.asDiagonal() * B;
}

Constraint held_in_space(int node, int axis, double value = 0.0) {
  Constraint constraint;
  constraint.dof = static_cast<int>(space.of(node, axis));
  constraint.component = axis;
  constraint.value = value;
  return constraint;
}

ElasticPart tetrahedron(const Matrix& nodes, std::vector<Constraint> constraints) {
  Stiffness stiffness;
  stiffness.sparse = tetrahedron_stiffness(nodes).sparseView();
  return {std::move(stiffness), Positions(nodes), std::move(constraints)};
}

/// Facet 0, 1, 2 on top, at z = 0, on node 3 below node 0. Held at node 3, node 0 along x and y, and node 1 along y: no
/// rigid motion is left, and the six strains are free.
ElasticPart lower() {
  Matrix nodes(3, 4);
  nodes << 0, 1, 0, 0,  //
      0, 0, 1, 0,       //
      0, 0, 0, -1;
  return tetrahedron(nodes, {held_in_space(3, 0), held_in_space(3, 1), held_in_space(3, 2), held_in_space(0, 0),
                             held_in_space(0, 1), held_in_space(1, 1)});
}

/// Node 0 below, over the middle of that facet; the three others, above, move by `moved`.
ElasticPart upper(const Eigen::Vector3d& moved) {
  Matrix nodes(3, 4);
  nodes << 0, 0, 1, 0,  //
      0, 0, 0, 1,       //
      0, 1, 1, 1;
  nodes.topRows<2>().array() += 1.0 / 3.0;
  std::vector<Constraint> held;
  for (int node = 1; node < 4; ++node)
    for (int axis = 0; axis < 3; ++axis) held.push_back(held_in_space(node, axis, moved[axis]));
  return tetrahedron(nodes, std::move(held));
}

/// Normal z, out of the lower part, tangents x and y.
PairPoints::Directions upwards() {
  PairPoints::Directions directions(3, 3);
  directions << 0, 1, 0,  //
      0, 0, 1,            //
      1, 0, 0;
  return directions;
}

Structure structure_of_parts(std::vector<ElasticPart> parts) {
  Structure structure;
  structure.parts = elastic_bodies(std::move(parts), 1);
  return structure;
}

contact::JointLaws coulomb(double mu, int pairs) {
  return {std::vector<std::shared_ptr<const contact::Law>>(static_cast<std::size_t>(pairs),
                                                           std::make_shared<contact::Coulomb>(mu, mu)),
          Vector::Ones(pairs)};
}

/// The contact problem of the parts under the values of their constraints and these forces.
contact::Problem problem_of(const ContactSystem& system, const Structure& structure, double mu,
                            const std::vector<Vector>& forces) {
  contact::Problem problem;
  problem.dimension = system.components.dimension;
  problem.W = system.W;
  problem.G = system.G;
  problem.mu = Vector::Constant(system.gap.size(), mu);
  problem.q = Vector::Zero(system.components.count(system.gap.size()));
  problem.f = Vector::Zero(system.rigid_motions());
  for (Eigen::Index i = 0; i < system.gap.size(); ++i) problem.q[system.components.of(i)] = system.gap[i];
  for (std::size_t p = 0; p < structure.parts.size(); ++p) {
    const BodySystem& part = *structure.parts[p];
    Vector prescribed(static_cast<Eigen::Index>(part.constraints().size()));
    for (std::size_t c = 0; c < part.constraints().size(); ++c)
      prescribed[static_cast<Eigen::Index>(c)] = part.constraints()[c].value;
    problem.q += system.motion[p] * part.displacement(forces[p], prescribed);
    problem.f.segment(system.first_rigid[p], part.rigid_motions().cols()) =
        part.rigid_motions().transpose() * forces[p];
  }
  return problem;
}

/// Node 3 along three directions that are not at right angles, node 0 along two, node 1 along one, against the saddle
/// system of stiffness and constraints.
TEST(HeldAlongDirections, AreThoseOfMultipliers) {
  Matrix nodes(3, 4);
  nodes << 0, 1, 0, 0.2,  //
      0, 0.1, 1, 0,       //
      0.1, 0, 0, -1;
  std::vector<Constraint> held;
  const auto hold = [&](int node, int place, const Eigen::Vector3d& along, double value) {
    Constraint constraint = held_in_space(node, place, value);
    constraint.component = -1;
    constraint.inclined = along.normalized();
    held.push_back(constraint);
  };
  hold(3, 0, {1, 0.3, -0.2}, 0.01);
  hold(3, 2, {0.2, 0.5, 1}, -0.02);
  hold(3, 1, {-0.4, 1, 0.1}, 0.03);
  hold(0, 2, {0.3, -0.2, 1}, 0.0);
  held.push_back(held_in_space(0, 1, 0.015));
  hold(1, 0, {0.6, 0.8, 0.5}, -0.01);
  const Matrix K = tetrahedron_stiffness(nodes);
  const auto count = static_cast<Eigen::Index>(held.size());
  Matrix saddle = Matrix::Zero(12 + count, 12 + count);
  saddle.topLeftCorner(12, 12) = K;
  Vector values(count);
  for (Eigen::Index c = 0; c < count; ++c) {
    const Constraint& of = held[static_cast<std::size_t>(c)];
    const Eigen::Vector3d along = of.direction_in_space();
    saddle.block<3, 1>(space.first_of_node(of.dof), 12 + c) = -along;
    saddle.block<1, 3>(12 + c, space.first_of_node(of.dof)) = along.transpose();
    values[c] = of.value;
  }
  const Eigen::PartialPivLU<Matrix> multipliers(saddle);
  const auto body = std::move(elastic_bodies(
                                  [&] {
                                    std::vector<ElasticPart> parts;
                                    parts.push_back(tetrahedron(nodes, held));
                                    return parts;
                                  }(),
                                  1)
                                  .front());
  EXPECT_EQ(body->rigid_motions().cols(), 0);
  Vector right = Vector::Zero(12 + count);
  for (Eigen::Index i = 0; i < 12; ++i) right[i] = std::sin(1.0 + 2.0 * static_cast<double>(i));
  right.tail(count) = values;
  const Vector expected = multipliers.solve(right), f = right.head(12), u = body->displacement(f, values);
  EXPECT_LT((u - expected.head(12)).norm(), 1e-13 * expected.head(12).norm());
  EXPECT_LT((body->reactions(u, f) - expected.tail(count)).norm(), 1e-13 * expected.tail(count).norm());
  EXPECT_LT(body->imbalance(u, f), 1e-13 * f.norm());
  std::vector<int> dofs(12);
  std::iota(dofs.begin(), dofs.end(), 0);
  const Matrix unit = Matrix::Identity(12 + count, 12), A = multipliers.solve(unit).topRows(12);
  EXPECT_LT((body->flexibility(dofs) - A).norm(), 1e-13 * A.norm());
  EXPECT_LT((body->flexed(dofs, f) - A * f).norm(), 1e-13 * (A * f).norm());
  const FreeStiffness free = body->free_stiffness();
  const Matrix map(free.map), along = map * Matrix(free.K).inverse() * map.transpose();
  EXPECT_LT((along - A).norm(), 1e-13 * A.norm());
}

/// By hand, with V = 1/6. The middle of the lower facet is at r = (1/3, 1/3, 1) from node 3, where with the constraints
/// u = ((e_xx + g_xy) / 3, e_yy / 3, (g_zx + g_yz) / 3 + e_zz), so that W = sum of squares of these factors over V
/// times the modulus: 1/E (2, 2/3, 26/3) along x, y, z. The upper node moves by h where the strains are (0, 0, -h_z, 0,
/// -h_y, -h_x): 1/E (12, 12, 6).
const Eigen::Vector3d flexibility = Eigen::Vector3d(26.0 / 3.0 + 6.0, 14.0, 38.0 / 3.0) / modulus;  // along n, x, y

class PointOfAFacet : public testing::Test {
 protected:
  static constexpr double gap = 0.01, mu = 0.5;

  contact::Solution solved(const Eigen::Vector3d& moved) {
    std::vector<ElasticPart> parts;
    parts.push_back(lower());
    parts.push_back(upper(moved));
    const Structure structure = structure_of_parts(std::move(parts));
    PairPoints pair;
    pair.a = {0, {{0, 1.0 / 3.0}, {1, 1.0 / 3.0}, {2, 1.0 / 3.0}}};
    pair.b = {1, {{0, 1.0}}};
    pair.directions = upwards();
    pair.gap = gap;
    const ContactSystem system = condense(structure, {pair}, coulomb(mu, 1));
    EXPECT_EQ(system.rigid_motions(), 0);
    const Matrix W = system.W.dense();
    EXPECT_LT((W - Matrix(flexibility.asDiagonal())).lpNorm<Eigen::Infinity>(), 1e-14 * flexibility.maxCoeff());
    return contact::solve(problem_of(system, structure, mu, {Vector::Zero(12), Vector::Zero(12)}));
  }
};

TEST_F(PointOfAFacet, IsOpenAboveIt) {
  const contact::Solution solution = solved({0.003, 0.0, -0.5 * gap});
  ASSERT_EQ(solution.status, contact::Status::solved);
  EXPECT_EQ(solution.states[0], contact::ContactState::open);
  EXPECT_NEAR(solution.gap[0], 0.5 * gap, 1e-16);
}

TEST_F(PointOfAFacet, Sticks) {
  const double p_n = 0.03;
  const Eigen::Vector3d p(p_n, -0.3 * mu * p_n, 0.4 * mu * p_n), u = flexibility.cwiseProduct(p);
  const contact::Solution solution = solved({-u[1], -u[2], -(gap + u[0])});
  ASSERT_EQ(solution.status, contact::Status::solved) << solution.reason;
  EXPECT_EQ(solution.states[0], contact::ContactState::stick);
  EXPECT_LT((solution.p - p).lpNorm<Eigen::Infinity>(), 1e-14);
}

/// Slip along (3, 4) / 5, which friction opposes; the free motion is then not along it, since W differs by the
/// direction.
TEST_F(PointOfAFacet, SlipsInBothDirections) {
  const double p_n = 0.03, slip = 0.02;
  const Eigen::Vector3d p(p_n, -0.6 * mu * p_n, -0.8 * mu * p_n), u = flexibility.cwiseProduct(p);
  const contact::Solution solution = solved({0.6 * slip - u[1], 0.8 * slip - u[2], -(gap + u[0])});
  ASSERT_EQ(solution.status, contact::Status::solved) << solution.reason;
  EXPECT_EQ(solution.states[0], contact::ContactState::slip);
  EXPECT_LT((solution.p - p).lpNorm<Eigen::Infinity>(), 1e-12);
}

/// Three nodes of a free tetrahedron on points of the facet, under a force on the fourth: the normal forces follow from
/// the equilibrium of six rigid motions, and the tangential ones add up to the force along x.
TEST(FreeTetrahedron, StandsOnThreePoints) {
  Matrix nodes(3, 4);
  nodes << 0.1, 0.5, 0.1, 0.2,  //
      0.1, 0.1, 0.5, 0.3,       //
      0, 0, 0, 0.4;
  std::vector<ElasticPart> parts;
  parts.push_back(lower());
  parts.push_back(tetrahedron(nodes, {}));
  const Structure structure = structure_of_parts(std::move(parts));
  const BodySystem& free = *structure.parts[1];
  ASSERT_EQ(free.rigid_motions().cols(), 6);
  EXPECT_LT((tetrahedron_stiffness(nodes) * free.rigid_motions()).lpNorm<Eigen::Infinity>(), 1e-15);
  EXPECT_GT(test::determinant(free.rigid_motions().transpose() * free.rigid_motions()), 1e-3);

  std::vector<PairPoints> pairs;
  for (int i = 0; i < 3; ++i) {
    const double x = nodes(0, i), y = nodes(1, i);
    pairs.push_back({{0, {{0, 1.0 - x - y}, {1, x}, {2, y}}}, {1, {{i, 1.0}}}, upwards(), 0.0});
  }
  const double weight = 0.01, across = 0.0005;
  Vector forces = Vector::Zero(12);
  forces[space.of(3, 0)] = across;
  forces[space.of(3, 2)] = -weight;
  const ContactSystem system = condense(structure, pairs, coulomb(0.9, 3));
  const contact::Solution solution = contact::solve(problem_of(system, structure, 0.9, {Vector::Zero(12), forces}));
  ASSERT_EQ(solution.status, contact::Status::solved) << solution.reason;
  // Moments about the edges of the triangle 0, 1, 2: arms .1 and .2 of .4 for the weight, .4 of .4 for the force
  // across.
  const double of_1 = weight * 0.25 + across, of_2 = weight * 0.5, of_0 = weight - of_1 - of_2;
  EXPECT_NEAR(solution.p[0], of_0, 1e-12);
  EXPECT_NEAR(solution.p[3], of_1, 1e-12);
  EXPECT_NEAR(solution.p[6], of_2, 1e-12);
  EXPECT_NEAR(solution.p[1] + solution.p[4] + solution.p[7], -across, 1e-12);
  EXPECT_NEAR(solution.p[2] + solution.p[5] + solution.p[8], 0.0, 1e-12);
}

}  // namespace
}  // namespace scabo::system
