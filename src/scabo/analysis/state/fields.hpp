// Every field of a state that is kept, declared once: its name, what it belongs to, and its values as numbers. Made
// from this list are checkpoints (checkpoint.hpp), the end of a run as the start of another (restart.hpp) and what is
// carried over where bodies come and go (transfer() below). What is not in it follows from it (complete()).
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// What one entry of a field belongs to. `vector_of_part`: a part that has any count of numbers, which stands before
/// them; `whole`: the state itself.
enum class Owner { pair, held_pair, rigid_motion, contact, part, vector_of_part, whole };

template <typename S>
struct FieldOf {
  const char* name = "";
  Owner owner = Owner::whole;
  int count = 1;  ///< numbers of each owner, of all in their order. Of `vector_of_part` and `whole`: any
  /// Another run may start with it: it does not depend on the loads, steps and bodies that only this run has.
  bool lasts = false;
  bool optional = false;  ///< empty where the model has nothing that needs it
  std::vector<double> (*get)(const S&) = nullptr;
  /// Throws std::out_of_range for numbers that are none of this field.
  void (*set)(S&, const std::vector<double>&) = nullptr;
};
using Field = FieldOf<State>;

std::span<const Field> fields_of_state();

/// The entries of a field, `count` numbers each, at some places; zero at the place -1.
std::vector<double> entries_at(const std::vector<double>& numbers, int count, const std::vector<Eigen::Index>& places);

/// The same; nothing if there are none.
std::vector<double> selected(const std::vector<double>& from, const std::vector<Eigen::Index>& places, int count);

/// Puts entries to their places in a field, `size` numbers in all; nothing if there are none.
void put(const std::vector<double>& some, const std::vector<Eigen::Index>& places, int count, std::vector<double>& to,
         std::size_t size);

/// Where the entries of another structure's fields come from: of each its place before, or -1 if it is new.
struct ParentMaps {
  std::vector<Eigen::Index> pairs, held_pairs, rigid_motions;
};

/// The state on a structure with other pairs and rigid motions, of the same contacts and parts; what is new is zero,
/// and open. Fields that do not follow from the list are those of `state`.
template <typename S>
S transfer(S state, const ParentMaps& maps, std::span<const FieldOf<S>> fields) {
  for (const FieldOf<S>& field : fields) {
    const std::vector<Eigen::Index>* places = field.owner == Owner::pair           ? &maps.pairs
                                              : field.owner == Owner::held_pair    ? &maps.held_pairs
                                              : field.owner == Owner::rigid_motion ? &maps.rigid_motions
                                                                                   : nullptr;
    if (!places) continue;
    const std::vector<double> before = field.get(state);
    if (!before.empty() || !field.optional) field.set(state, entries_at(before, field.count, *places));
  }
  return state;
}
State transfer(State state, const ParentMaps& maps);

}  // namespace scabo::analysis
