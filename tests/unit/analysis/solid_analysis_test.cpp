// Bodies of tetrahedra, wedges and hexahedra in contact on faces that do not match, where statics or a constant stress
// gives the answer.
#include "scabo/analysis/space/solid_analysis.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "scabo/system/solid_part.hpp"
#include "support/solid_blocks.hpp"

namespace scabo::analysis {
namespace {

constexpr double steel = 200e9, density_weight = 77e3;  // Pa, N/m3
const Eigen::Vector3d upwards(0, 0, 1);

/// All nodes of a coordinate plane held along these axes.
void hold_plane(SolidBody& body, int axis, double value, const std::vector<int>& axes, double displacement = 0.0) {
  for (const int node : test::nodes_at(body.mesh, axis, value))
    for (const int along : axes) {
      body.supports.push_back(system::held_along_axis(node, along, displacement));
      body.supports.back().support = 0;
    }
}

/// All increments that are made.
std::vector<SolidIncrement> increments_of(const SolidModel& model, const std::vector<SolidFactors>& factors,
                                          SolidOptions options = {}) {
  std::vector<SolidIncrement> made;
  options.on_increment = [&, also = options.on_increment](const SolidIncrement& one, const SolidState& state) {
    made.push_back(one);
    if (also) also(one, state);
  };
  solve_solids(model, factors, options);
  return made;
}

/// Nodes of the cells of the lower and the upper block.
struct Kinds {
  Kinds(int of_both) : lower(of_both), upper(of_both) {}
  Kinds(int of_lower, int of_upper) : lower(of_lower), upper(of_upper) {}
  int lower, upper;
};

/// A block on another one; the lower one is 2 x 2 x 1, the upper one of size `size` in the middle of it.
struct Stack {
  explicit Stack(const Kinds& kinds, double size = 2.0, double moved = 0.2) {
    const double low = 1.0 - 0.5 * size, high = 1.0 + 0.5 * size;
    model.bodies.push_back(with_super_elements(
        {test::solid_block({0, 0, -1}, {2, 2, 0}, {3, 3, 2}, kinds.lower, moved, 1), steel, 0.3, {}}));
    model.bodies.push_back(with_super_elements(
        {test::solid_block({low, low, 0}, {high, high, 1}, {4, 4, 2}, kinds.upper, moved, 2), steel, 0.3, {}}));
    SolidContact contact;
    contact.a = {0, test::facets_at(model.bodies[0].mesh, {0, 0, 0}, upwards)};
    contact.b = {1, test::facets_at(model.bodies[1].mesh, {0, 0, 0}, -upwards)};
    model.contacts.push_back(contact);
  }
  void swap_sides() { std::swap(model.contacts[0].a, model.contacts[0].b); }
  std::vector<mesh::SolidFacet> top() const { return test::facets_at(model.bodies[1].mesh, {0, 0, 1}, upwards); }
  /// Adds a load on the upper block.
  void load(Vector forces) { model.loads.push_back({Vector(), std::move(forces)}); }

  std::vector<SolidIncrement> solve(const std::vector<Vector>& factors) const {
    std::vector<SolidFactors> increments;
    for (const Vector& of_loads : factors) increments.push_back({of_loads, Vector::Ones(1)});
    return increments_of(model, increments);
  }

  SolidModel model;
};

Eigen::Vector3d total_force(const SolidIncrement& increment) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const SolidPair& pair : increment.pairs) sum += pair.force;
  return sum;
}

class Stacks : public testing::TestWithParam<Kinds> {};
class MixedStacks : public testing::TestWithParam<Kinds> {};

/// Uniform pressure on blocks of one material, the sides free: sigma_zz = -p everywhere, and every pair has the
/// pressure p, whatever the friction.
void expect_constant_stress(const Kinds& kinds) {
  constexpr double p = 1e6;
  for (const std::optional<double> friction : {std::optional(0.0), std::optional(0.4), std::optional<double>()}) {
    Stack stack(kinds);
    stack.model.contacts[0].law.bond = !friction;
    stack.model.contacts[0].law.friction = friction.value_or(0.0);
    hold_plane(stack.model.bodies[0], 2, -1.0, {2});
    for (SolidBody& body : stack.model.bodies) hold_plane(body, 0, 0.0, {0}), hold_plane(body, 1, 0.0, {1});
    stack.load(system::pressure_forces(stack.model.bodies[1].mesh, stack.top(), p));
    const std::vector<SolidIncrement> increments = stack.solve({Vector::Ones(1)});
    ASSERT_EQ(increments.back().status, contact::Status::solved) << increments.back().reason;
    EXPECT_GE(increments.back().pairs.size(), 16);
    double largest = 0.0;  // force of a pair, to whose rounding all are known
    for (const SolidPair& pair : increments.back().pairs) largest = std::max(largest, pair.force.norm());
    for (const SolidPair& pair : increments.back().pairs) {
      EXPECT_NEAR(pair.normal_force(), p * pair.area, 1e-10 * largest);
      EXPECT_LT((pair.force - pair.normal_force() * pair.normal).norm(), 1e-10 * largest);
    }
    for (std::size_t b = 0; b < 2; ++b) {
      const Matrix& x = stack.model.bodies[b].mesh.nodes;
      for (Eigen::Index i = 0; i < x.cols(); ++i) {
        const Eigen::Vector3d exact = p / steel * Eigen::Vector3d(0.3 * x(0, i), 0.3 * x(1, i), -(x(2, i) + 1.0));
        EXPECT_LT((increments.back().u[b].segment<3>(3 * i) - exact).norm(), 1e-10 * p / steel);
      }
    }
  }
}

TEST_P(Stacks, PassAConstantStressThroughFacesThatDoNotMatch) { expect_constant_stress(GetParam()); }
TEST_P(MixedStacks, PassAConstantStressThroughFacesThatDoNotMatch) { expect_constant_stress(GetParam()); }

INSTANTIATE_TEST_SUITE_P(OfTwoKinds, MixedStacks,
                         testing::Values(Kinds(10, 20), Kinds(20, 10), Kinds(15, 20), Kinds(20, 15), Kinds(10, 15),
                                         Kinds(15, 10), Kinds(4, 20), Kinds(20, 4)));

/// The block is pressed on by its weight and pushed: no sliding below mu N, and no equilibrium above.
TEST_P(Stacks, SlideWhereThePushExceedsFriction) {
  constexpr double mu = 0.3;
  Stack stack(GetParam(), 1.2);
  stack.model.contacts[0].law.friction = mu;
  hold_plane(stack.model.bodies[0], 2, -1.0, {0, 1, 2});
  const mesh::SolidMesh& block = stack.model.bodies[1].mesh;
  const double weight = density_weight * 1.2 * 1.2;
  stack.load(system::volume_forces(block, {0, 0, -density_weight}));
  const Eigen::Vector3d direction(0.6, 0.8, 0.0);
  stack.load(system::volume_forces(block, direction * mu * density_weight));  // mu N at factor 1
  const std::vector<SolidIncrement> increments =
      stack.solve({Vector::Unit(2, 0), Vector(Eigen::Vector2d(1, 0.5)), Vector(Eigen::Vector2d(1, 0.99)),
                   Vector(Eigen::Vector2d(1, 1.01))});
  ASSERT_EQ(increments.size(), 4);
  for (std::size_t k = 0; k < 3; ++k) {
    ASSERT_EQ(increments[k].status, contact::Status::solved) << increments[k].reason;
    const Eigen::Vector3d expected = weight * (upwards - increments[k].factors.loads[1] * mu * direction);
    EXPECT_LT((total_force(increments[k]) - expected).norm(), 1e-9 * weight);
  }
  EXPECT_NE(increments[3].status, contact::Status::solved);
}

/// Their corners.
std::set<int> open_pairs(const SolidIncrement& increment) {
  std::set<int> open;
  for (const SolidPair& pair : increment.pairs)
    if (pair.state == contact::ContactState::open) open.insert(pair.corner);
  return open;
}

/// The block is pressed, pushed back and forth and let go: from the state after any increment the others have the same
/// bits; stored energy and work of friction are together the work done.
TEST_P(Stacks, GoOnFromAnyStateWithTheSameBits) {
  Stack stack(GetParam(), 1.2);
  stack.model.contacts[0].law.friction = 0.3;
  hold_plane(stack.model.bodies[0], 2, -1.0, {0, 1, 2});
  hold_plane(stack.model.bodies[1], 0, 0.4, {0}, 2e-6);
  stack.load(system::pressure_forces(stack.model.bodies[1].mesh, stack.top(), 1e5));
  std::vector<SolidFactors> increments;
  for (const double ram : {0.0, 0.5, 1.0, -1.0, 0.2}) increments.push_back({Vector::Ones(1), Vector::Constant(1, ram)});
  std::vector<SolidState> states;
  SolidOptions options;
  options.on_increment = [&](const SolidIncrement&, const SolidState& state) { states.push_back(state); };
  const std::vector<SolidIncrement> whole = increments_of(stack.model, increments, options);
  ASSERT_EQ(whole.back().status, contact::Status::solved) << whole.back().reason;
  int compared = 0;
  for (std::size_t k = 0; k < whole.size(); ++k) {
    // Where pairs open or close within an increment, the balance is one of second order.
    if (open_pairs(whole[k]) != (k > 0 ? open_pairs(whole[k - 1]) : std::set<int>{})) continue;
    const Energy now = whole[k].energy, before = k > 0 ? whole[k - 1].energy : Energy{};
    EXPECT_NEAR(now.external - before.external, now.elastic + now.friction - before.elastic - before.friction,
                1e-9 * whole.back().energy.external);
    ++compared;
  }
  EXPECT_GE(compared, 3);
  EXPECT_GT(whole.back().energy.friction, 1.5 * whole[2].energy.friction);
  for (std::size_t k = 0; k + 1 < states.size(); ++k) {
    SolidOptions on;
    on.first = k + 1;
    on.from = &states[k];
    const std::vector<SolidIncrement> rest = increments_of(stack.model, increments, on);
    ASSERT_EQ(rest.size(), whole.size() - k - 1);
    EXPECT_EQ(rest.back().u[1], whole.back().u[1]);
    EXPECT_EQ(rest.back().energy.external, whole.back().energy.external);
    EXPECT_EQ(rest.back().energy.friction, whole.back().energy.friction);
    for (std::size_t i = 0; i < rest.back().pairs.size(); ++i)
      EXPECT_EQ(rest.back().pairs[i].force, whole.back().pairs[i].force);
  }
}

/// Sides swapped: the same forces, gaps and slips, with the opposite sign where it is that of a side.
TEST_P(Stacks, GiveTheSameWithTheirSidesSwapped) {
  Stack stack(GetParam(), 1.2);
  stack.model.contacts[0].law.friction = 0.3;
  stack.model.contacts[0].gap = 1e-6;
  hold_plane(stack.model.bodies[0], 2, -1.0, {0, 1, 2});
  const mesh::SolidMesh& block = stack.model.bodies[1].mesh;
  stack.load(system::volume_forces(block, {0.1 * density_weight, 0, -density_weight}));
  const SolidIncrement one = stack.solve({Vector::Ones(1)}).back();
  stack.swap_sides();
  const SolidIncrement other = stack.solve({Vector::Ones(1)}).back();
  ASSERT_EQ(one.status, contact::Status::solved) << one.reason;
  ASSERT_EQ(one.pairs.size(), other.pairs.size());
  const double largest = density_weight;
  for (std::size_t i = 0; i < one.pairs.size(); ++i) {
    EXPECT_LT((one.pairs[i].force + other.pairs[i].force).norm(), 1e-9 * largest);
    EXPECT_LT((one.pairs[i].normal + other.pairs[i].normal).norm(), 1e-12);
    EXPECT_NEAR(one.pairs[i].gap, other.pairs[i].gap, 1e-15);
    EXPECT_LT((one.pairs[i].slip + other.pairs[i].slip).norm(), 1e-15);
  }
}

/// Turned by any rotation, far from the origin and in millimetres and meganewtons: the same forces, turned.
TEST_P(Stacks, GiveTheSameTurnedMovedAndInOtherUnits) {
  constexpr double millimetres = 1e3, meganewtons = 1e-6;
  Stack stack(GetParam(), 1.2);
  stack.model.contacts[0].law.friction = 0.3;
  hold_plane(stack.model.bodies[0], 2, -1.0, {0, 1, 2});
  const Eigen::Vector3d pushed(0.25 * density_weight, 0.1 * density_weight, -density_weight);
  stack.load(system::volume_forces(stack.model.bodies[1].mesh, pushed));
  const SolidIncrement one = stack.solve({Vector::Ones(1)}).back();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  for (SolidBody& body : stack.model.bodies) {
    body.mesh.nodes = millimetres * (turn * (body.mesh.nodes.colwise() + Eigen::Vector3d(20, -30, 10)));
    body.young *= meganewtons / (millimetres * millimetres);
    body = with_super_elements(std::move(body));
  }
  Vector& forces = stack.model.loads[0][1];
  forces = (meganewtons * (turn * forces.reshaped(3, forces.size() / 3))).eval().reshaped().eval();
  const SolidIncrement other = stack.solve({Vector::Ones(1)}).back();
  ASSERT_EQ(one.status, contact::Status::solved) << one.reason;
  ASSERT_EQ(other.status, contact::Status::solved) << other.reason;
  ASSERT_EQ(one.pairs.size(), other.pairs.size());
  double largest = 0.0;
  for (const SolidPair& pair : one.pairs) largest = std::max(largest, pair.force.norm());
  for (std::size_t i = 0; i < one.pairs.size(); ++i) {
    EXPECT_LT((turn * one.pairs[i].force - other.pairs[i].force / meganewtons).norm(), 1e-9 * largest);
    EXPECT_EQ(one.pairs[i].state, other.pairs[i].state);
  }
}

/// A tie carries tension and shear: the weight of the hanging block, at the sides of the lower one.
TEST_P(Stacks, HangOnATie) {
  Stack stack(GetParam(), 1.2);
  stack.model.contacts[0].law.bond = true;
  hold_plane(stack.model.bodies[0], 2, -1.0, {0, 1, 2});
  stack.load(system::volume_forces(stack.model.bodies[1].mesh, {3.0, 0, density_weight}));
  const std::vector<SolidIncrement> increments = stack.solve({Vector::Ones(1)});
  ASSERT_EQ(increments.back().status, contact::Status::solved) << increments.back().reason;
  const double volume = 1.2 * 1.2;
  EXPECT_LT((total_force(increments.back()) - Eigen::Vector3d(-3.0 * volume, 0, -density_weight * volume)).norm(),
            1e-9 * density_weight);
  Eigen::Vector3d reaction = Eigen::Vector3d::Zero();
  for (std::size_t c = 0; c < stack.model.bodies[0].supports.size(); ++c)
    reaction[stack.model.bodies[0].supports[c].component] +=
        increments.back().reactions[0][static_cast<Eigen::Index>(c)];
  EXPECT_LT((reaction - total_force(increments.back())).norm(), 1e-9 * density_weight);
}

INSTANTIATE_TEST_SUITE_P(OfOneKind, Stacks, testing::Values(Kinds(4), Kinds(10), Kinds(15), Kinds(20)));

/// Displacement and stress of a force in a body without end (Kelvin); E = 1, nu = 0.3.
struct PointForce {
  Eigen::Vector3d at{0.3, 0.4, 1.1}, force{1.0, 0.5, 8.0};

  Eigen::Vector3d displacement(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d r = x - at;
    const double R = r.norm(), G = 0.5 / 1.3;
    return (1.8 * force / R + r * r.dot(force) / (R * R * R)) / (16.0 * std::numbers::pi * G * 0.7);
  }
  Eigen::Matrix3d stress(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d r = x - at;
    const double R = r.norm(), rp = r.dot(force);
    return -(0.4 * (r * force.transpose() + force * r.transpose() - rp * Eigen::Matrix3d::Identity()) / std::pow(R, 3) +
             3.0 * rp * r * r.transpose() / std::pow(R, 5)) /
           (8.0 * std::numbers::pi * 0.7);
  }
};

/// Two blocks tied on faces of 4 f and 5 f quadrilaterals along a side, under the tractions of a force above them: the
/// error of the pressures at inner corners, mean square, over the largest. `nodes` of a cell, 20: hexahedra as
/// super-elements, or 10: six tetrahedra for each.
double pressure_error(int f, int nodes = 20) {
  const PointForce field;
  SolidModel model;
  for (const bool upper : {false, true}) {
    const int n = (upper ? 5 : 4) * f;
    const double low = upper ? 0.0 : -0.5;
    SolidBody body{test::solid_block({0, 0, low}, {1, 1, low + 0.5}, {n, n, 2 * f}, nodes), 1.0, 0.3, {}};
    std::vector<mesh::SolidFacet> outer;
    for (const mesh::SolidFacet& facet : mesh::boundary_facets(body.mesh)) {
      const Matrix x = mesh::nodes_of(body.mesh, facet);
      if (x.row(2).cwiseAbs().maxCoeff() > 1e-9 && x.row(2).maxCoeff() > -0.5 + 1e-9) outer.push_back(facet);
    }
    for (const int node : upper ? std::vector<int>{} : test::nodes_at(body.mesh, 2, -0.5))
      for (int axis = 0; axis < 3; ++axis) {
        body.supports.push_back(
            system::held_along_axis(node, axis, field.displacement(body.mesh.nodes.col(node))[axis]));
        body.supports.back().support = 0;
      }
    Vector forces = system::varying_traction_forces(
        body.mesh, outer, [&](const Eigen::Vector3d& x, const Eigen::Vector3d& normal) -> Eigen::Vector3d {
          return field.stress(x) * normal;
        });
    model.loads.push_back({Vector(), Vector()});
    model.loads.back()[upper ? 1 : 0] = std::move(forces);
    model.bodies.push_back(nodes == 20 ? with_super_elements(std::move(body)) : std::move(body));
  }
  SolidContact tie;
  tie.law.bond = true;
  tie.a = {0, test::facets_at(model.bodies[0].mesh, {0, 0, 0}, upwards)};
  tie.b = {1, test::facets_at(model.bodies[1].mesh, {0, 0, 0}, -upwards)};
  model.contacts.push_back(tie);
  const SolidIncrement made = increments_of(model, {{Vector::Ones(2), Vector::Ones(1)}}).back();
  EXPECT_EQ(made.status, contact::Status::solved) << made.reason;
  double squares = 0.0, area = 0.0, largest = 0.0;
  for (const SolidPair& pair : made.pairs) {
    const Eigen::Vector3d x = model.bodies[pair.on_a ? 0 : 1].mesh.nodes.col(pair.corner);
    const double exact = -field.stress(x)(2, 2), error = pair.normal_force() / pair.area - exact;
    largest = std::max(largest, std::abs(exact));
    if (x.head<2>().minCoeff() < 1e-9 || x.head<2>().maxCoeff() > 1.0 - 1e-9) continue;
    squares += pair.area * error * error;
    area += pair.area;
  }
  return std::sqrt(squares / area) / largest;
}

TEST(TiedHexahedra, CarryThePressureOfAForceAboveThem) {
  const double coarse = pressure_error(1), fine = pressure_error(2);
  EXPECT_LT(coarse, 1.6e-2);
  EXPECT_LT(fine, 3.6e-3);
  EXPECT_LT(fine, coarse / 4.0);
}

TEST(TiedTetrahedra, CarryThePressureOfAForceAboveThem) {
  const double coarse = pressure_error(1, 10), fine = pressure_error(2, 10);
  EXPECT_LT(coarse, 0.02);
  EXPECT_LT(fine, coarse / 4.0);
}

/// Held at six degrees of freedom only: no stress, so no energy, and no reactions.
TEST(BlockInSpace, ExpandsFreelyUnderALinearTemperature) {
  SolidModel model;
  model.bodies.push_back({test::solid_block({0, 0, 0}, {2, 1, 1}, {2, 2, 2}, 10, 0.2), steel, 0.3, {}});
  SolidBody& block = model.bodies[0];
  block.expansion = 1e-5;
  const Eigen::Matrix3d held{{0, 2, 0}, {0, 0, 1}, {0, 0, 0}};  // corners: all axes, y and z, z
  for (int corner = 0; corner < 3; ++corner)
    for (Eigen::Index i = 0; i < block.mesh.nodes.cols(); ++i)
      for (int axis = corner; (block.mesh.nodes.col(i) - held.col(corner)).norm() < 1e-9 && axis < 3; ++axis) {
        block.supports.push_back(system::held_along_axis(static_cast<int>(i), axis));
        block.supports.back().support = 0;
      }
  ASSERT_EQ(block.supports.size(), 6);
  const Vector change = (block.mesh.nodes.transpose() * Eigen::Vector3d(3, -20, 11)).array() + 50.0;
  const element::Mat6 D = element::elasticity_in_space(steel, 0.3);
  model.loads.push_back({system::thermal_forces(block.mesh, D, block.expansion, change)});
  model.temperatures.push_back({change});
  const SolidIncrement increment = increments_of(model, {{Vector::Ones(1), Vector::Ones(1)}}).back();
  ASSERT_EQ(increment.status, contact::Status::solved) << increment.reason;
  EXPECT_LT(std::abs(increment.energy.elastic),
            1e-10 * system::held_thermal_energy(block.mesh, D, block.expansion, change));
  EXPECT_LT(increment.reactions[0].lpNorm<Eigen::Infinity>(), 1e-9 * model.loads[0][0].lpNorm<Eigen::Infinity>());
}

/// A bar between two supports that move apart: constant strain, and the force E A strain.
TEST(BarInSpace, IsInTension) {
  SolidModel model;
  model.bodies.push_back({test::solid_block({0, 0, 0}, {4, 1, 1}, {4, 2, 2}, 10, 0.2), steel, 0.3, {}});
  SolidBody& bar = model.bodies[0];
  hold_plane(bar, 0, 0.0, {0}), hold_plane(bar, 1, 0.0, {1}), hold_plane(bar, 2, 0.0, {2});
  const std::size_t held = bar.supports.size();
  hold_plane(bar, 0, 4.0, {0}, 4e-3);
  const SolidIncrement increment = increments_of(model, {{Vector(), Vector::Constant(1, 0.5)}}).back();
  ASSERT_EQ(increment.status, contact::Status::solved) << increment.reason;
  double force = 0.0;
  for (std::size_t c = held; c < bar.supports.size(); ++c)
    force += increment.reactions[0][static_cast<Eigen::Index>(c)];
  EXPECT_NEAR(force, steel * 0.5e-3, 1e-9 * steel * 1e-3);
  for (Eigen::Index i = 0; i < bar.mesh.nodes.cols(); ++i) {
    const Eigen::Vector3d x = bar.mesh.nodes.col(i);
    EXPECT_LT((increment.u[0].segment<3>(3 * i) - 0.5e-3 * Eigen::Vector3d(x.x(), -0.3 * x.y(), -0.3 * x.z())).norm(),
              1e-14);
  }
}

}  // namespace
}  // namespace scabo::analysis
