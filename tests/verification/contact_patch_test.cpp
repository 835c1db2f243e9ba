// Closed form: two blocks pressed on each other carry a uniform pressure, whatever the matching interface between them.
#include <cmath>

#include "run.hpp"

namespace scabo::verification {
namespace {

const char* const blocks = R"(
scabo: 1
materials: {stiff: {young: 30e9, poisson: 0.2}, soft: {young: 10e9, poisson: 0.3}}
bodies:
  lower: {material: stiff, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.25}}
  upper: {material: soft, shape: {rectangle: {corner: [0, 1], size: [2, 1.5]}}, mesh: {size: 0.25}}
supports:
  - {on: lower.bottom, fix: [y]}
  - {on: lower.bottom_left, fix: [x]}
loads:
  weight: {on: upper.top, pressure: 1e6}
contacts:
  joint: {between: [lower.top, upper.bottom], friction: 0.0}
)";

void expect_uniform(const analysis::StaticSolution& solution, double pressure) {
  const analysis::ContactResult& contact = last(solution).contacts.front();
  EXPECT_EQ(contact.open, 0);
  for (const analysis::PairResult& pair : contact.pairs) EXPECT_NEAR(pair.pressure, pressure, 1e-9 * pressure);
}

struct Variant {
  std::string name;
  std::vector<std::string> settings;
};
void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.name; }

class ContactPatch : public testing::TestWithParam<Variant> {};

TEST_P(ContactPatch, UniformPressure) {
  const auto solution = run(blocks, GetParam().settings);
  expect_uniform(solution, 1e6);
  EXPECT_NEAR(last(solution).contacts.front().normal_force, 2e6, 2e-4);
  EXPECT_NEAR(last(solution).reactions[0].y(), 2e6, 2e-4);
}

std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const char* swapped : {"", "swapped"}) {
    std::vector<std::string> base;
    if (*swapped) base.push_back("contacts.joint.between=[upper.bottom, lower.top]");
    for (int order = 1; order <= 4; ++order) {
      auto settings = base;
      for (const char* body : {"lower", "upper"})
        settings.push_back(std::string("bodies.") + body + ".mesh.order=" + std::to_string(order));
      all.push_back({"order" + std::to_string(order) + swapped, settings});
    }
    auto fem = base;
    fem.push_back("bodies.lower.mesh.kind=fem");
    all.push_back({std::string("fem_below") + swapped, fem});
    fem.push_back("bodies.upper.mesh.kind=fem");
    all.push_back({std::string("fem") + swapped, fem});
    auto strain = base;
    strain.push_back("analysis.plane=strain");
    all.push_back({std::string("plane_strain") + swapped, strain});
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Variants, ContactPatch, testing::ValuesIn(variants()),
                         [](const auto& parameter) { return parameter.param.name; });

TEST(ContactPatchWithFriction, EqualMaterialsStickUnderUniformPressure) {
  expect_uniform(run(blocks, {"bodies.lower.material=soft", "contacts.joint.friction=0.3"}), 1e6);
}

// A uniaxial stress state crosses any interface that friction keeps from sliding.
TEST(ContactPatchWithFriction, InclinedInterface) {
  const auto solution = run(R"(
scabo: 1
materials: {m: {young: 10e9, poisson: 0.3}}
bodies:
  lower: {material: m, shape: {polygon: {vertices: [[0, 0], [2, 0], [2, 1.4], [0, 1]]}}, mesh: {size: 0.25}}
  upper: {material: m, shape: {polygon: {vertices: [[0, 1], [2, 1.4], [2, 2.5], [0, 2.5]]}}, mesh: {size: 0.25}}
supports:
  - {on: lower.edge_1, fix: [y]}
  - {on: lower.vertex_1, fix: [x]}
loads:
  weight: {on: upper.edge_3, pressure: 1e6}
contacts:
  joint: {between: [lower.edge_3, upper.edge_1], friction: 0.3}
)");
  const double cosine = 2.0 / std::hypot(2.0, 0.4), sine = 0.4 / std::hypot(2.0, 0.4);
  const analysis::ContactResult& contact = last(solution).contacts.front();
  for (const analysis::PairResult& pair : contact.pairs) {
    EXPECT_NEAR(pair.pressure, 1e6 * cosine * cosine, 1e-3);
    EXPECT_NEAR(std::abs(pair.shear), 1e6 * sine * cosine, 1e-3);
  }
}

TEST(ContactPatchWithFriction, CurvedInterface) {
  const auto solution = run(R"(
scabo: 1
materials: {m: {young: 10e9, poisson: 0.3}}
bodies:
  lower:
    material: m
    shape:
      outline:
        - {line: {from: [-1, -1], to: [1, -1]}, name: bottom}
        - {line: {to: [1, 0]}}
        - {arc: {to: [-1, 0], centre: [0, -3], direction: counter_clockwise}, name: top}
        - {line: {to: [-1, -1]}}
    mesh: {size: 0.25}
  upper:
    material: m
    shape:
      outline:
        - {arc: {from: [-1, 0], to: [1, 0], centre: [0, -3], direction: clockwise}, name: bottom}
        - {line: {to: [1, 1.5]}}
        - {line: {to: [-1, 1.5]}, name: top}
        - {line: {to: [-1, 0]}}
    mesh: {size: 0.25}
supports:
  - {on: lower.bottom, fix: [y]}
  - {on: {body: lower, near: [-1, -1]}, fix: [x]}
loads:
  weight: {on: upper.top, pressure: 1e6}
contacts:
  joint: {between: [lower.top, upper.bottom], friction: 1.0}
)");
  const analysis::IncrementResult& increment = last(solution);
  const auto& pairs = increment.contacts.front().pairs;
  Vec2 total = Vec2::Zero();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(pairs[i].state, contact::ContactState::stick);
    const Vec2 n = solution.mesh.interfaces.front().pairs[i].normal;
    const Vec2 force = pairs[i].normal_force * n + pairs[i].tangential_force * tangent_of(n);
    EXPECT_NEAR(force.x(), 0.0, 1e-4) << "the stress is uniaxial: no node is pushed aside";
    total += force;
  }
  EXPECT_NEAR(total.y(), 2e6, 1e-3);
  EXPECT_NEAR(increment.reactions[0].y(), 2e6, 1e-3);
}

}  // namespace
}  // namespace scabo::verification
