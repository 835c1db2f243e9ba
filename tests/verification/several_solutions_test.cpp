// A leaning strut that friction jams: where mu is above K_tt / |K_tn|, tan of its angle from the normal, the
// quasi-static problem has several solutions (Klarbring, Ing.-Archiv 60 (1990) 529): its foot is stuck under thrust, or
// off the floor.
#include <algorithm>
#include <cmath>

#include "run.hpp"

namespace scabo::verification {
namespace {

/// Its head is moved to the left and a little up: apart from the floor if the foot is free, into thrust if it sticks.
std::string strut(double friction, const std::string& steps) {
  return R"(
scabo: 1
materials: {m: {young: 1e9, poisson: 0.2}}
bodies:
  strut:
    material: m
    shape: {polygon: {vertices: [[0, 0], [0.2, 0], [1.2, 3], [1, 3]], names: {foot: edge_1, head: edge_3}}}
    mesh: {size: 0.25}
  floor: {rigid: true, shape: {rectangle: {corner: [-2, -1], size: [5, 1]}}}
supports:
  - {on: floor, fix: [x, y]}
  - {on: strut.head, displacement: [null, 1e-4], name: up}
  - {on: strut.head, displacement: [-1e-3, null], name: left}
contacts:
  joint: {between: [floor.top, strut.foot], friction: )" +
         std::to_string(friction) + "}\nsteps: " + steps + "\n";
}

const char* const pressed_first =
    "[{name: press, loads: {up: -1}}, {name: drive, increments: 10, loads: {up: 1, left: 1}}]";

TEST(LeaningStrut, StaysOnTheBranchOfItsHistoryAndIsToldToHaveOthers) {
  const auto jammed = run(strut(1.0, pressed_first), {"solver.uniqueness=true"});
  const analysis::IncrementResult& end = last(jammed);
  EXPECT_GT(end.contacts.front().normal_force, 0.0);
  ASSERT_TRUE(end.uniqueness.has_value());
  EXPECT_EQ(end.uniqueness->verdict, "several found");
  EXPECT_GE(end.uniqueness->others, 2);
  EXPECT_TRUE(end.uniqueness->complete);
  EXPECT_EQ(end.uniqueness->index, 1);
  EXPECT_TRUE(std::any_of(jammed.warnings.begin(), jammed.warnings.end(),
                          [](const Warning& warning) { return warning.kind == WarningKind::several_solutions; }));
  double before = contact_of(increment_at(jammed, 0)).normal_force;
  double step = 0.0;  // the thrust goes on in equal steps: no jump to another branch
  for (std::size_t k = 1; k < jammed.increments.size(); ++k) {
    const double force = contact_of(increment_at(jammed, k)).normal_force;
    if (k > 1) EXPECT_NEAR(force - before, step, 1e-3 * std::abs(step)) << k;
    step = force - before;
    before = force;
  }
}

TEST(LeaningStrut, WithLittleFrictionItLetsGo) {
  const auto solution = run(strut(0.1, pressed_first), {"solver.uniqueness=true"});
  EXPECT_NEAR(last(solution).contacts.front().normal_force, 0.0, 1e-9);  // N; jammed: 1e5
  for (const analysis::IncrementResult& increment : solution.increments)
    EXPECT_NE(increment.uniqueness->verdict, "several found") << increment.increment;
  for (const std::string& warning : texts_of(solution.warnings))
    EXPECT_EQ(warning.find("other solutions"), std::string::npos) << warning;
}

}  // namespace
}  // namespace scabo::verification
