// The end of a run as it is kept, by names, in the plane and in space. Two files of a results directory
// (model/restart_files.hpp):
//
//   end.state  the state of every body and contact by name, and digests of what the two models must have in common
//   end.yaml   factors of loads and supports, which the reader of the other model needs for its steps, and the time and
//              the velocity of the ground of a run that ended in motion
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scabo/model/model.hpp"

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
  std::string version;    ///< of the program
  bool in_space = false;  ///< of a model in space
  std::vector<Agreement> agreements;
  std::vector<Of> contacts, bars, parts;
  std::vector<Held> held;
  std::vector<Factor> loads, supports;
  std::vector<Factor> placed;     ///< supports that have begun and stay: Support::placed in a run that goes on
  std::vector<Factor> tightened;  ///< bars with preload: Bar::tightened in a run that goes on from here
  std::vector<Factor> motion;     ///< time and ground_x, ground_y; empty: at rest
  std::map<std::string, std::vector<double>> whole;  ///< lasting fields of the state itself
};

/// Files of another run are read and written with its directory; throws std::runtime_error if they cannot be written.
void write_end_state(const std::filesystem::path& directory, EndState end);

/// Of the run from which the model of `file` starts. Throws InputError, at the place of `restart` in the file.
EndState read_end_state(const std::string& file, const model::Restart& restart, bool space);

/// Throws InputError with these messages at the place of `restart` in the file; without messages, nothing.
void refuse_restart(const std::string& file, const model::Restart& restart, std::vector<std::string> messages);

/// What of two lists of agreements differs, in sentences; `depends_on`: what the state depends on, for people.
std::vector<std::string> disagreements(const std::vector<EndState::Agreement>& there,
                                       const std::vector<EndState::Agreement>& here, const std::string& directory,
                                       const char* depends_on);

/// What is kept under a name; null if nothing is.
const EndState::Of* find(const std::vector<EndState::Of>& list, const std::string& name);

/// Numbers that are kept under a name; none if there are none.
const std::vector<double>& kept(const std::map<std::string, std::vector<double>>& of, const std::string& name);

}  // namespace scabo::analysis
