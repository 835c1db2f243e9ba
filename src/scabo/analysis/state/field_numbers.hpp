// Values of fields as numbers, and how an entry of a list of fields is made (fields.hpp).
#pragma once

#include <stdexcept>

#include "scabo/analysis/state/fields.hpp"

namespace scabo::analysis {

using Numbers = std::vector<double>;

inline Numbers numbers_of(const Vector& values) { return {values.begin(), values.end()}; }
inline void assign(const Numbers& from, Vector& to) {
  to = Eigen::Map<const Vector>(from.data(), static_cast<Eigen::Index>(from.size()));
}

inline Numbers numbers_of(const Numbers& values) { return values; }
inline void assign(const Numbers& from, Numbers& to) { to = from; }

inline Numbers numbers_of(double value) { return {value}; }
inline void assign(const Numbers& from, double& to) { to = from.at(0); }

inline void assign(const Numbers& from, int& to) { to = static_cast<int>(from.at(0)); }

inline Numbers numbers_of(const Energy& energy) {
  return {energy.external, energy.elastic, energy.friction,   energy.friction_error, energy.kinetic,
          energy.damping,  energy.impact,  energy.projection, energy.massless};
}
inline void assign(const Numbers& from, Energy& to) {
  to = {from.at(0), from.at(1), from.at(2), from.at(3), from.at(4), from.at(5), from.at(6), from.at(7), from.at(8)};
}

inline Numbers numbers_of(const std::vector<Vec2>& points) {
  Numbers to;
  for (const Vec2& point : points) to.insert(to.end(), point.begin(), point.end());
  return to;
}
inline void assign(const Numbers& from, std::vector<Vec2>& to) {
  to.clear();
  for (std::size_t k = 0; k < from.size(); k += 2) to.emplace_back(from.at(k), from.at(k + 1));
}

inline Numbers numbers_of(const mesh::Placement& placement) {
  Numbers to;
  for (const std::array<Vec2, 2>& sides : placement)
    for (const Vec2& by : sides) to.insert(to.end(), by.begin(), by.end());
  return to;
}
inline void assign(const Numbers& from, mesh::Placement& to) {
  to.clear();
  for (std::size_t k = 0; k < from.size(); k += 4)
    to.push_back({Vec2(from.at(k), from.at(k + 1)), Vec2(from.at(k + 2), from.at(k + 3))});
}

inline Numbers numbers_of(const contact::History& history) {
  Numbers to;
  for (const contact::PairHistory& pair : history)
    to.insert(to.end(), {pair.slip, 1.0 * pair.broken, 1.0 * pair.slipped});
  return to;
}
inline void assign(const Numbers& from, contact::History& to) {
  to.clear();
  for (std::size_t k = 0; k < from.size(); k += 3)
    to.push_back({from.at(k), from.at(k + 1) != 0.0, from.at(k + 2) != 0.0});
}

inline Numbers numbers_of(const std::vector<contact::ContactState>& states) {
  Numbers to;
  for (const contact::ContactState state : states) to.push_back(static_cast<double>(state));
  return to;
}
inline void assign(const Numbers& from, std::vector<contact::ContactState>& to) {
  to.clear();
  for (const double state : from) to.push_back(static_cast<contact::ContactState>(static_cast<int>(state)));
}

/// Of each part how many numbers it has, and these.
inline Numbers numbers_of(const std::vector<Vector>& of_parts) {
  Numbers to;
  for (const Vector& values : of_parts) {
    to.push_back(static_cast<double>(values.size()));
    to.insert(to.end(), values.begin(), values.end());
  }
  return to;
}
inline void assign(const Numbers& from, std::vector<Vector>& to) {
  to.clear();
  for (std::size_t k = 0; k < from.size();) {
    const auto count = static_cast<std::size_t>(from[k++]);
    if (count > from.size() - k) throw std::out_of_range("a field of a state is too short");
    to.emplace_back(Eigen::Map<const Vector>(from.data() + k, static_cast<Eigen::Index>(count)));
    k += count;
  }
}

enum class Kept { lasts, in_this_run };

/// `of`: the member, of a state S or of a const one.
template <typename S, typename Of>
constexpr FieldOf<S> field_of(const char* name, Owner owner, int count, Kept kept, Of) {
  return {name,
          owner,
          count,
          kept == Kept::lasts,
          false,
          [](const S& state) { return numbers_of(Of{}(state)); },
          [](S& state, const Numbers& numbers) { assign(numbers, Of{}(state)); }};
}

/// One that is empty where the model has nothing that needs it.
template <typename S, typename Of>
constexpr FieldOf<S> optional_field_of(const char* name, Owner owner, int count, Kept kept, Of of) {
  FieldOf<S> made = field_of<S>(name, owner, count, kept, of);
  made.optional = true;
  return made;
}

}  // namespace scabo::analysis
