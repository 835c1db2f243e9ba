// The end of a run, from which another run may start: `restart` of a model. Two files of a results directory
// (model/restart_files.hpp):
//
//   end.state  the state of every body and contact by name, and digests of what the two models must have in common
//   end.yaml   factors of loads and supports, which the reader of the other model needs for its steps, and the time and
//              the velocity of the ground of a run that ended in motion
//
// Displacements at rest are not kept: they follow from the factors, the contact forces and the rigid motions, as those
// of a checkpoint do, if bodies, supports, springs, contacts and the loads that act are the same. Digests tell whether
// they are. Bodies that are absent at the end (stages.hpp) may be left out of the other model, and it may have others
// that are added later. Laws of contacts may change: a joint keeps its forces, its slip and whether it is broken. Of
// contacts with large slip (large_slip.hpp) the end tells where their sides were when their pairs were found: the other
// run divides them there before anything is compared.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scabo/analysis/state/continuation.hpp"

namespace scabo::analysis {

struct EndState {
  /// What the models must have in common: `body 'upper'`, and the digest of all that describes it.
  struct Agreement {
    std::string what, digest;
  };
  /// What belongs to a contact or to a part of the lasting fields of the state (fields.hpp), by their names: entries of
  /// its pairs, of its rigid motions or of itself, in their order.
  struct Of {
    std::string name;  ///< of the contact; of the first body of the part
    std::map<std::string, std::vector<double>> fields;
  };
  /// Of a part what supports hold: points of those that begin or end (system/held_points.hpp), then the others.
  struct Held {
    std::string name;                                   ///< of the first body of the part
    std::vector<double> constraints;                    ///< six numbers for each (restart_points.hpp)
    std::vector<double> u;                              ///< displacement of the part
    std::map<std::string, std::vector<double>> fields;  ///< of the pairs that they are, or would be
  };
  struct Factor {
    std::string name;
    double value = 0.0;
  };
  std::string version;  ///< of the program
  std::vector<Agreement> agreements;
  std::vector<Of> contacts, bars, parts;
  std::vector<Held> held;
  std::vector<Factor> loads, supports;
  std::vector<Factor> placed;     ///< supports that have begun and stay: Support::placed in a run that goes on
  std::vector<Factor> tightened;  ///< bars with preload: Bar::tightened in a run that goes on from here
  std::vector<Factor> motion;     ///< time and ground_x, ground_y; empty: at rest
  std::map<std::string, std::vector<double>> whole;  ///< lasting fields of the state itself
};

/// `now`: at the stage of the state.
EndState end_state(const Prepared& now, const State& state);

/// Files of another run are read and written with its directory; throws std::runtime_error if they cannot be written.
void write_end_state(const std::filesystem::path& directory, EndState end);

/// Where the sides of contacts with large slip are at the start of a model with `restart`; empty if all are where they
/// are drawn. Throws InputError as state_of_restart().
mesh::Placement placement_of_restart(const model::Model& model);

/// The state from which the first step of a model with `restart` starts; its mesh is in placement_of_restart(). Throws
/// InputError, at the place of `restart` in the file, if the other run cannot be read or does not agree with the model.
State state_of_restart(const Prepared& now);

}  // namespace scabo::analysis
