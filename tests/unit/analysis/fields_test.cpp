#include "scabo/analysis/state/fields.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string_view>

namespace scabo::analysis {
namespace {

/// Three pairs, a held one, two contacts, two parts with three rigid motions in all; every field has values of its own.
State full_state() {
  State state;
  state.factors = {{0.5, -1.0}, {2.0}, {0.3, 0.4}, {1.0, 0.0}, 0.25, {0.75}, {1.0, 0.5}, 0.5, {1.0, 0.0, 1.0}};
  state.p = Vector::LinSpaced(6, 1.0, 6.0);
  state.rigid_motion = Vector::LinSpaced(3, -1.0, 1.5);
  state.gap = Vector::LinSpaced(3, 0.1, 0.3);
  state.slip = Vector::LinSpaced(3, -0.2, 0.2);
  state.history = {{0.1, false, true}, {0.2, true, true}, {0.3, false, false}};
  state.states = {contact::ContactState::stick, contact::ContactState::open, contact::ContactState::slip};
  state.offset = Vector::LinSpaced(6, 7.0, 8.0);
  state.held_offset = Vector::LinSpaced(2, 9.0, 9.5);
  state.released = {Vector(), Vector::LinSpaced(4, 3.0, 4.0)};
  state.released_reactions = {5.0, 6.0, 7.0, 0.0, 0.0, 0.0};
  state.referred = {Vec2(0.1, 0.2), Vec2(0.3, 0.4)};
  state.largest_force = 11.0;
  state.energy = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0};
  state.time = 12.0;
  state.largest_energy = 13.0;
  state.velocity = {Vector::LinSpaced(2, 1.0, 2.0), Vector::LinSpaced(4, 3.0, 5.0)};
  state.internal = {Vector(), Vector::LinSpaced(4, -3.0, -5.0)};
  state.internal_velocity = {Vector(), Vector::LinSpaced(4, 6.0, 8.0)};
  state.u = {Vector::LinSpaced(2, 0.1, 0.2), Vector::LinSpaced(4, 0.3, 0.5)};
  state.reactions = {Vector(), Vector::LinSpaced(1, 4.0, 4.0)};
  state.replaced = {{{Vec2(1.0, 2.0), Vec2(3.0, 4.0)}, {Vec2(5.0, 6.0), Vec2(7.0, 8.0)}},
                    {Vec2(0.5, 0.6), Vec2(0.7, 0.8)},
                    Vector::LinSpaced(6, -1.0, -2.0),
                    Vector::LinSpaced(3, 5.0, 6.0)};
  return state;
}

TEST(FieldsOfAState, AreReadBackAsTheyWere) {
  const State state = full_state();
  State other;
  for (const Field& field : fields_of_state()) {
    EXPECT_FALSE(field.get(state).empty()) << field.name;
    field.set(other, field.get(state));
  }
  EXPECT_EQ(other.p, state.p);
  EXPECT_EQ(other.history, state.history);
  EXPECT_EQ(other.states, state.states);
  ASSERT_EQ(other.released.size(), 2u);
  EXPECT_EQ(other.released[0].size(), 0);
  EXPECT_EQ(other.released[1], state.released[1]);
  EXPECT_EQ(other.released_reactions, state.released_reactions);
  EXPECT_EQ(other.replaced.placement, state.replaced.placement);
  EXPECT_EQ(other.replaced.moved, state.replaced.moved);
  EXPECT_EQ(other.factors.release, 0.25);
  EXPECT_EQ(other.factors.entered, state.factors.entered);
  EXPECT_EQ(other.energy.friction_error, 4.0);
  EXPECT_EQ(other.energy.massless, 9.0);
  EXPECT_EQ(other.velocity, state.velocity);
  EXPECT_EQ(other.internal, state.internal);
  EXPECT_EQ(other.internal_velocity, state.internal_velocity);
  EXPECT_EQ(other.u, state.u);
  for (const Field& field : fields_of_state()) EXPECT_EQ(field.get(other), field.get(state)) << field.name;
}

TEST(FieldsOfAState, HaveTheNumbersThatTheyDeclare) {
  const State state = full_state();
  const auto owners = [](Owner owner) -> std::size_t {
    return owner == Owner::pair || owner == Owner::rigid_motion ? 3 : owner == Owner::held_pair ? 1 : 2;
  };
  for (const Field& field : fields_of_state()) {
    if (field.owner == Owner::whole || field.owner == Owner::vector_of_part) continue;
    EXPECT_EQ(field.get(state).size(), static_cast<std::size_t>(field.count) * owners(field.owner)) << field.name;
  }
}

TEST(FieldsOfAState, OfOtherNumbersAreRefused) {
  State state;
  for (const Field& field : fields_of_state()) {
    const std::string_view name = field.name;
    if (name != "released" && name != "history" && name != "energy") continue;
    EXPECT_THROW(field.set(state, {3.0, 1.0}), std::out_of_range) << field.name;
  }
}

TEST(Transfer, KeepsWhatWasThereAndWhatIsNewIsOpenAndZero) {
  const State before = full_state();
  const State after = transfer(before, {{2, -1, 0, -1}, {}, {1, -1, 2}});
  EXPECT_EQ(after.p, (Vector(8) << 5.0, 6.0, 0.0, 0.0, 1.0, 2.0, 0.0, 0.0).finished());
  EXPECT_EQ(after.slip, (Vector(4) << before.slip[2], 0.0, before.slip[0], 0.0).finished());
  EXPECT_EQ(after.states[0], contact::ContactState::slip);
  EXPECT_EQ(after.states[1], contact::ContactState::open);
  EXPECT_EQ(after.history[2], before.history[0]);
  EXPECT_EQ(after.history[3], contact::PairHistory());
  EXPECT_EQ(after.rigid_motion, (Vector(3) << before.rigid_motion[1], 0.0, before.rigid_motion[2]).finished());
  EXPECT_EQ(after.held_offset.size(), 0);
  EXPECT_EQ(after.energy.external, before.energy.external);
}

TEST(Transfer, FirstPairsOfAModelGetEveryFieldThatAllPairsHave) {
  State none;
  none.p = none.gap = none.slip = none.rigid_motion = Vector::Zero(0);
  const State after = transfer(none, {{-1, -1}, {}, {-1}});
  EXPECT_EQ(after.p, Vector::Zero(4));
  EXPECT_EQ(after.states.size(), 2u);
  EXPECT_EQ(after.offset.size(), 0);  // where no body ever comes or goes
}

}  // namespace
}  // namespace scabo::analysis
