#include "scabo/result/probe.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/result/solutions.hpp"

namespace scabo::result {
namespace {

using namespace scabo::test;

const Mat2 probe_gradient = (Mat2() << 1.1e-3, -0.4e-3, 0.7e-3, -0.9e-3).finished();

void expect_linear_field(const Probe& probe, const Vec2& x, model::Plane plane, double tolerance) {
  const auto values = probe.at(x);
  ASSERT_TRUE(values) << x.transpose();
  const UniformStress expected = stress_of(probe_gradient, plane);
  EXPECT_LT((values->displacement - linear_field(probe_gradient)(x)).norm(), 1e-12) << x.transpose();
  EXPECT_LT((values->stress - expected.in_plane).norm(), tolerance * expected.in_plane.norm()) << x.transpose();
}

TEST(Probe, LinearFieldIsExactInASuperElement) {
  for (const model::Plane plane : {model::Plane::stress, model::Plane::strain}) {
    const auto solution = solution_of(model_of({elastic("body", pentagon(), 0.7, 3)}, plane));
    const auto increment = increment_of(solution, linear_field(probe_gradient));
    const Probe probe(solution, increment.fields, 0);
    const Vec2 centre = solution.mesh.bodies[0].cells[0].centre;
    for (const Vec2& x : {Vec2(0.1, 0.0), Vec2(1.0, 1.0), Vec2(2.0, 1.5), Vec2(-0.3, 1.05), Vec2(1.2, 0.2)})
      expect_linear_field(probe, x, plane, 1e-10);
    expect_linear_field(probe, centre, plane, 1e-8);  // digits lost to 1 / xi
    for (const double distance : {1e-9, 1e-6})
      expect_linear_field(probe, centre + Vec2(distance, -0.3 * distance), plane, 1e-8);
    for (const double distance : {1e-3, 0.1})
      expect_linear_field(probe, centre + Vec2(distance, -0.3 * distance), plane, 1e-10);
  }
}

TEST(Probe, LinearFieldIsExactInFiniteElements) {
  const auto solution =
      solution_of(model_of({finite_elements("body", {1.0, -2.0}, {3.0, 1.0}, 0.4)}, model::Plane::strain));
  const auto increment = increment_of(solution, linear_field(probe_gradient));
  const Probe probe(solution, increment.fields, 0);
  for (const Vec2& x : {Vec2(1.0, -2.0), Vec2(2.345, -1.111), Vec2(4.0, -1.0), Vec2(3.9, -1.95)})
    expect_linear_field(probe, x, model::Plane::strain, 1e-12);
}

TEST(Probe, OutsideIsNothing) {
  const model::Outline disc = outline({arc("lower", {9.0, 0.0}, 0.5, pi, pi), arc("upper", {9.0, 0.0}, 0.5, 0.0, pi)});
  const auto solution = solution_of(
      model_of({elastic("a", pentagon(), 0.7), finite_elements("b", {5.0, 0.0}, {1.0, 1.0}, 0.5), rigid("c", disc)},
               model::Plane::stress));
  const auto increment = increment_of(solution, linear_field(probe_gradient), {1.0, 2.0, 0.1});
  EXPECT_FALSE(value_at(solution, increment.fields, 0, {3.0, 1.7}));
  EXPECT_FALSE(value_at(solution, increment.fields, 0, {0.0, 0.0}));
  EXPECT_FALSE(value_at(solution, increment.fields, 1, {4.99, 0.5}));
  EXPECT_FALSE(value_at(solution, increment.fields, 2, {9.51, 0.0}));
  const auto punch = value_at(solution, increment.fields, 2, {9.3, 0.2});
  ASSERT_TRUE(punch);
  EXPECT_NEAR(punch->displacement.x(), 1.0 - 0.1 * 0.2, 1e-14);
  EXPECT_NEAR(punch->displacement.y(), 2.0 + 0.1 * 0.3, 1e-14);
  EXPECT_TRUE(value_at(solution, increment.fields, 2, {9.5, 0.0}));
}

}  // namespace
}  // namespace scabo::result
