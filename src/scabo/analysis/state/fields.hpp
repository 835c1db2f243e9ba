// Every field of a state that is kept, declared once: its name, what it belongs to, and its values as numbers. Made
// from this list are checkpoints (checkpoint.hpp), the end of a run as the start of another (restart.hpp) and what is
// carried over where bodies come and go (transfer() below). What is not in it follows from it (complete()).
#pragma once

#include <span>
#include <vector>

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// What one entry of a field belongs to. `vector_of_part`: a part that has any count of numbers, which stands before
/// them; `whole`: the state itself.
enum class Owner { pair, held_pair, rigid_motion, contact, part, vector_of_part, whole };

struct Field {
  const char* name = "";
  Owner owner = Owner::whole;
  int count = 1;  ///< numbers of each owner, of all in their order. Of `vector_of_part` and `whole`: any
  /// Another run may start with it: it does not depend on the loads, steps and bodies that only this run has.
  bool lasts = false;
  bool optional = false;  ///< empty where the model has nothing that needs it
  std::vector<double> (*get)(const State&) = nullptr;
  /// Throws std::out_of_range for numbers that are none of this field.
  void (*set)(State&, const std::vector<double>&) = nullptr;
};

std::span<const Field> fields_of_state();

/// The entries of a field, `count` numbers each, at some places; zero at the place -1.
std::vector<double> entries_at(const std::vector<double>& numbers, int count, const std::vector<Eigen::Index>& places);

/// Where the entries of another structure's fields come from: of each its place before, or -1 if it is new.
struct ParentMaps {
  std::vector<Eigen::Index> pairs, held_pairs, rigid_motions;
};

/// The state on a structure with other pairs and rigid motions, of the same contacts and parts; what is new is zero,
/// and open. Fields that do not follow from the list are those of `state`.
State transfer(State state, const ParentMaps& maps);

}  // namespace scabo::analysis
