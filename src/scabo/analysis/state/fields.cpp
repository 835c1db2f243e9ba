#include "scabo/analysis/state/fields.hpp"

#include <stdexcept>

namespace scabo::analysis {

namespace {

using Numbers = std::vector<double>;

Numbers numbers_of(const Vector& values) { return {values.begin(), values.end()}; }
void assign(const Numbers& from, Vector& to) {
  to = Eigen::Map<const Vector>(from.data(), static_cast<Eigen::Index>(from.size()));
}

Numbers numbers_of(const Numbers& values) { return values; }
void assign(const Numbers& from, Numbers& to) { to = from; }

Numbers numbers_of(double value) { return {value}; }
void assign(const Numbers& from, double& to) { to = from.at(0); }

Numbers numbers_of(const Energy& energy) {
  return {energy.external, energy.elastic, energy.friction,   energy.friction_error, energy.kinetic,
          energy.damping,  energy.impact,  energy.projection, energy.massless};
}
void assign(const Numbers& from, Energy& to) {
  to = {from.at(0), from.at(1), from.at(2), from.at(3), from.at(4), from.at(5), from.at(6), from.at(7), from.at(8)};
}

Numbers numbers_of(const std::vector<Vec2>& points) {
  Numbers to;
  for (const Vec2& point : points) to.insert(to.end(), point.begin(), point.end());
  return to;
}
void assign(const Numbers& from, std::vector<Vec2>& to) {
  to.clear();
  for (std::size_t k = 0; k < from.size(); k += 2) to.emplace_back(from.at(k), from.at(k + 1));
}

Numbers numbers_of(const mesh::Placement& placement) {
  Numbers to;
  for (const std::array<Vec2, 2>& sides : placement)
    for (const Vec2& by : sides) to.insert(to.end(), by.begin(), by.end());
  return to;
}
void assign(const Numbers& from, mesh::Placement& to) {
  to.clear();
  for (std::size_t k = 0; k < from.size(); k += 4)
    to.push_back({Vec2(from.at(k), from.at(k + 1)), Vec2(from.at(k + 2), from.at(k + 3))});
}

Numbers numbers_of(const contact::History& history) {
  Numbers to;
  for (const contact::PairHistory& pair : history)
    to.insert(to.end(), {pair.slip, 1.0 * pair.broken, 1.0 * pair.slipped});
  return to;
}
void assign(const Numbers& from, contact::History& to) {
  to.clear();
  for (std::size_t k = 0; k < from.size(); k += 3)
    to.push_back({from.at(k), from.at(k + 1) != 0.0, from.at(k + 2) != 0.0});
}

Numbers numbers_of(const std::vector<contact::ContactState>& states) {
  Numbers to;
  for (const contact::ContactState state : states) to.push_back(static_cast<double>(state));
  return to;
}
void assign(const Numbers& from, std::vector<contact::ContactState>& to) {
  to.clear();
  for (const double state : from) to.push_back(static_cast<contact::ContactState>(static_cast<int>(state)));
}

/// Of each part how many numbers it has, and these.
Numbers numbers_of(const std::vector<Vector>& of_parts) {
  Numbers to;
  for (const Vector& values : of_parts) {
    to.push_back(static_cast<double>(values.size()));
    to.insert(to.end(), values.begin(), values.end());
  }
  return to;
}
void assign(const Numbers& from, std::vector<Vector>& to) {
  to.clear();
  for (std::size_t k = 0; k < from.size();) {
    const auto count = static_cast<std::size_t>(from[k++]);
    if (count > from.size() - k) throw std::out_of_range("a field of a state is too short");
    to.emplace_back(Eigen::Map<const Vector>(from.data() + k, static_cast<Eigen::Index>(count)));
    k += count;
  }
}

enum class Kept { lasts, in_this_run };

/// `of`: the member, of a State or of a const State.
template <typename Of>
constexpr Field field(const char* name, Owner owner, int count, Kept kept, Of) {
  return {name,
          owner,
          count,
          kept == Kept::lasts,
          false,
          [](const State& state) { return numbers_of(Of{}(state)); },
          [](State& state, const Numbers& numbers) { assign(numbers, Of{}(state)); }};
}

template <typename Of>
constexpr Field optional_field(const char* name, Owner owner, int count, Kept kept, Of of) {
  Field made = field(name, owner, count, kept, of);
  made.optional = true;
  return made;
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

State transfer(State state, const ParentMaps& maps) {
  for (const Field& field : fields_of_state()) {
    const std::vector<Eigen::Index>* places = field.owner == Owner::pair           ? &maps.pairs
                                              : field.owner == Owner::held_pair    ? &maps.held_pairs
                                              : field.owner == Owner::rigid_motion ? &maps.rigid_motions
                                                                                   : nullptr;
    if (!places) continue;
    const Numbers before = field.get(state);
    if (!before.empty() || !field.optional) field.set(state, entries_at(before, field.count, *places));
  }
  return state;
}

}  // namespace scabo::analysis
