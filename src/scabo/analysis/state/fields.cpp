#include "scabo/analysis/state/fields.hpp"

#include "scabo/analysis/state/field_numbers.hpp"

namespace scabo::analysis {

namespace {

template <typename Of>
constexpr Field field(const char* name, Owner owner, int count, Kept kept, Of of) {
  return field_of<State>(name, owner, count, kept, of);
}

template <typename Of>
constexpr Field optional_field(const char* name, Owner owner, int count, Kept kept, Of of) {
  return optional_field_of<State>(name, owner, count, kept, of);
}

/// What is a part of the history in time only, and follows from the others at rest.
template <typename Of>
constexpr Field in_time(const char* name, Of) {
  return {name,
          Owner::vector_of_part,
          0,
          true,
          true,
          [](const State& state) { return state.velocity.empty() ? Numbers() : numbers_of(Of{}(state)); },
          [](State& state, const Numbers& numbers) {
            if (!numbers.empty()) assign(numbers, Of{}(state));
          }};
}

struct Table {
  using enum Owner;
  using enum Kept;
  static constexpr Field fields[] = {
      field(
          "load_factors", whole, 0, in_this_run, [](auto& state) -> auto& { return state.factors.loads; }),
      field(
          "support_factors", whole, 0, in_this_run, [](auto& state) -> auto& { return state.factors.supports; }),
      field(
          "coefficients_of_friction", whole, 0, in_this_run,
          [](auto& state) -> auto& { return state.factors.friction; }),
      field(
          "presence", whole, 0, in_this_run, [](auto& state) -> auto& { return state.factors.presence; }),
      field(
          "release", whole, 1, in_this_run, [](auto& state) -> auto& { return state.factors.release; }),
      field(
          "fits", whole, 0, in_this_run, [](auto& state) -> auto& { return state.factors.fits; }),
      field(
          "preloads", whole, 0, in_this_run, [](auto& state) -> auto& { return state.factors.preloads; }),
      field(
          "entered", whole, 0, in_this_run, [](auto& state) -> auto& { return state.factors.entered; }),
      field(
          "released", whole, 0, in_this_run, [](auto& state) -> auto& { return state.released; }),
      field(
          "released_reactions", whole, 0, in_this_run, [](auto& state) -> auto& { return state.released_reactions; }),
      field(
          "p", pair, 2, lasts, [](auto& state) -> auto& { return state.p; }),
      field(
          "gap", pair, 1, lasts, [](auto& state) -> auto& { return state.gap; }),
      field(
          "slip", pair, 1, lasts, [](auto& state) -> auto& { return state.slip; }),
      field(
          "history", pair, 3, lasts, [](auto& state) -> auto& { return state.history; }),
      field(
          "states", pair, 1, lasts, [](auto& state) -> auto& { return state.states; }),
      optional_field(
          "offset", pair, 2, lasts, [](auto& state) -> auto& { return state.offset; }),
      optional_field(
          "held_offset", held_pair, 2, lasts, [](auto& state) -> auto& { return state.held_offset; }),
      field(
          "rigid_motion", rigid_motion, 1, lasts, [](auto& state) -> auto& { return state.rigid_motion; }),
      optional_field(
          "referred", part, 2, lasts, [](auto& state) -> auto& { return state.referred; }),
      optional_field(
          "replaced/placement", contact, 4, lasts, [](auto& state) -> auto& { return state.replaced.placement; }),
      optional_field(
          "replaced/moved", part, 2, lasts, [](auto& state) -> auto& { return state.replaced.moved; }),
      optional_field(
          "replaced/offset", pair, 2, lasts, [](auto& state) -> auto& { return state.replaced.offset; }),
      optional_field(
          "replaced/slip_before", pair, 1, lasts, [](auto& state) -> auto& { return state.replaced.slip_before; }),
      field(
          "energy", whole, 9, lasts, [](auto& state) -> auto& { return state.energy; }),
      field(
          "largest_force", whole, 1, lasts, [](auto& state) -> auto& { return state.largest_force; }),
      field(
          "time", whole, 1, lasts, [](auto& state) -> auto& { return state.time; }),
      field(
          "largest_energy", whole, 1, lasts, [](auto& state) -> auto& { return state.largest_energy; }),
      optional_field(
          "velocity", vector_of_part, 0, lasts, [](auto& state) -> auto& { return state.velocity; }),
      optional_field(
          "internal", vector_of_part, 0, lasts, [](auto& state) -> auto& { return state.internal; }),
      optional_field(
          "internal_velocity", vector_of_part, 0, lasts, [](auto& state) -> auto& { return state.internal_velocity; }),
      in_time(
          "displacement", [](auto& state) -> auto& { return state.u; }),
      in_time(
          "reactions", [](auto& state) -> auto& { return state.reactions; }),
  };
};

}  // namespace

std::span<const Field> fields_of_state() { return Table::fields; }

std::vector<double> entries_at(const std::vector<double>& numbers, int count, const std::vector<Eigen::Index>& places) {
  Numbers entries;
  entries.reserve(places.size() * static_cast<std::size_t>(count));
  for (const Eigen::Index place : places)
    for (int k = 0; k < count; ++k)
      entries.push_back(place < 0 ? 0.0 : numbers.at(static_cast<std::size_t>(place * count + k)));
  return entries;
}

std::vector<double> selected(const std::vector<double>& from, const std::vector<Eigen::Index>& places, int count) {
  return from.empty() ? from : entries_at(from, count, places);
}

void put(const std::vector<double>& some, const std::vector<Eigen::Index>& places, int count, std::vector<double>& to,
         std::size_t size) {
  if (some.empty()) return;
  ensure(some.size() == static_cast<std::size_t>(count) * places.size(), "a contact or part has as many as before");
  if (to.empty()) to.resize(size, 0.0);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (int k = 0; k < count; ++k)
      to.at(static_cast<std::size_t>(places[i] * count + k)) =
          some[i * static_cast<std::size_t>(count) + static_cast<std::size_t>(k)];
}

State transfer(State state, const ParentMaps& maps) { return transfer(std::move(state), maps, fields_of_state()); }

}  // namespace scabo::analysis
