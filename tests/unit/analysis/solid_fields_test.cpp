#include "scabo/analysis/space/solid_fields.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace scabo::analysis {
namespace {

/// Two pairs, a held one, three rigid motions, two bodies, a preload, a bar and a held point; every field has values of
/// its own.
SolidState full_solid_state() {
  SolidState state;
  state.factors.loads = Vector::LinSpaced(2, 1.0, 2.0);
  state.factors.supports = Vector::LinSpaced(1, 3.0, 3.0);
  state.factors.coefficients = Vector::LinSpaced(3, 0.1, 0.3);
  state.factors.fits = Vector::LinSpaced(1, 0.5, 0.5);
  state.factors.tightened = Vector::LinSpaced(1, 0.25, 0.25);
  state.factors.bars = Vector::LinSpaced(1, 0.5, 0.5);
  state.factors.step = 4;
  state.factors.presence = Vector::LinSpaced(2, 0.0, 1.0);
  state.factors.release = 0.75;
  state.slip = Vector::LinSpaced(4, 0.1, 0.4);
  state.gap = Vector::LinSpaced(2, 0.5, 0.6);
  state.p = Vector::LinSpaced(6, 1.0, 6.0);
  state.a = Vector::LinSpaced(3, 7.0, 9.0);
  state.shortening = Vector::LinSpaced(1, 1e-3, 1e-3);
  state.states = {contact::ContactState::slip, contact::ContactState::stick};
  state.history = {{0.1, true, false}, {0.2, false, true}};
  state.force_scale = 11.0;
  state.energy = {1.0, 2.0, 3.0, 4.0};
  state.offset = Vector::LinSpaced(6, -1.0, -6.0);
  state.held_offset = Vector::LinSpaced(3, -7.0, -9.0);
  state.released = {Vector(), Vector::LinSpaced(3, 5.0, 7.0)};
  state.released_points = Vector::LinSpaced(1, 12.0, 12.0);
  return state;
}

TEST(SolidFields, KeepEveryNumberOfAState) {
  const SolidState state = full_solid_state();
  SolidState copy;
  std::set<std::string> names;
  for (const SolidField& field : fields_of_solid_state()) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name;
    const std::vector<double> numbers = field.get(state);
    EXPECT_FALSE(numbers.empty()) << field.name;
    EXPECT_NE(numbers, field.get(copy)) << field.name;
    field.set(copy, numbers);
    EXPECT_EQ(numbers, field.get(copy)) << field.name;
  }
  EXPECT_EQ(copy.factors.step, 4);
  EXPECT_EQ(copy.history[1].slipped, true);
  EXPECT_EQ(copy.states[0], contact::ContactState::slip);
  EXPECT_EQ(copy.released[1], state.released[1]);
}

TEST(SolidFields, FollowTheirPairsAndBodiesToAnotherStage) {
  const SolidState moved = transfer(full_solid_state(), {{1, -1, 0}, {-1, 0}, {-1, 2}}, fields_of_solid_state());
  EXPECT_EQ(moved.p, (Vector(9) << 4, 5, 6, 0, 0, 0, 1, 2, 3).finished());
  EXPECT_EQ(moved.gap, (Vector(3) << 0.6, 0.0, 0.5).finished());
  EXPECT_EQ(moved.states,
            (std::vector{contact::ContactState::stick, contact::ContactState::open, contact::ContactState::slip}));
  EXPECT_EQ(moved.held_offset, (Vector(6) << 0, 0, 0, -7, -8, -9).finished());
  EXPECT_EQ(moved.a, (Vector(2) << 0, 9).finished());
  EXPECT_EQ(moved.factors.loads, full_solid_state().factors.loads);
}

}  // namespace
}  // namespace scabo::analysis
