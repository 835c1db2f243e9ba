// The commands of the program, one function for each. They throw the exceptions of the library, which main.cpp turns
// into messages and exit statuses.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "events.hpp"
#include "exit_status.hpp"
#include "scabo/model/model.hpp"

namespace scabo::app {

class Cluster;  // cluster.hpp

struct CheckOptions {
  std::string model;                  ///< the model file
  std::vector<std::string> settings;  ///< `path=value`, each replacing one value of the model file
  bool plot = false;                  ///< draws it, too
};

/// Under mpirun: smallest number of degrees of freedom of a body that is divided. From 5e4 on the larger of two ranks
/// has less memory than one process would, at 1e5 an eighth less; smaller bodies only wait for messages
/// (docs/clusters.md).
inline constexpr double default_divide_from = 100000.0;

struct RunOptions {
  std::string model;
  std::vector<std::string> settings;
  std::filesystem::path output;  ///< results directory; empty: `model.results` beside `model.yaml`
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));  ///< 1 or more
  bool quiet = false;                                                                 ///< only errors and warnings
  bool json_lines = false;     ///< events on standard output (events.hpp)
  bool ignore_memory = false;  ///< starts even if the estimated memory is not available
  bool report = false;         ///< ends with a page for the browser
  double divide_from = default_divide_from;
};

struct SweepOptions {
  std::string model;
  std::vector<std::string> vary;      ///< `path=values` (sweep_axes.hpp)
  std::vector<std::string> settings;  ///< of all runs
  std::filesystem::path output;       ///< empty: `model.sweep` beside `model.yaml`
  int jobs = 0;                       ///< runs at a time; 0: one for each processor
  int threads = 0;                    ///< of each run; 0: processors over jobs
  bool quiet = false;
  bool anew = false;  ///< replaces what the directory holds of another sweep
};

struct ResumeOptions {
  std::filesystem::path directory;  ///< results of a run that was interrupted
  std::string model;                ///< where the model file is now; empty: where it was
  int threads = 0;                  ///< 0: as before
  bool quiet = false;
  bool json_lines = false;  ///< events on standard output (events.hpp)
  double divide_from = default_divide_from;
};

struct ExponentsOptions {
  std::string model;
  std::vector<std::string> settings;
  bool json = false;
};

struct ContactOptions {
  std::string file;                         ///< a discrete problem: HDF5 in FCLIB's layout, or Siconos's text
  std::string solver = "b_differentiable";  ///< one of compare::method_names()
  double tolerance = 1e-10;                 ///< of natural-map residual and certificate, > 0
  int iterations = 0;                       ///< in one attempt, > 0; 0: default of the solver
  double time_limit = 0.0;                  ///< seconds of the solve, > 0; 0: none
  bool json = false;
  bool uniqueness = false;  ///< search for other solutions
  bool write_trace = false;
  std::string trace;  ///< empty: `file.trace.csv`
  std::string save;   ///< file for problem and solution; empty: none
};

struct ConvertOptions {
  std::string deck;              ///< of Abaqus or CalculiX
  std::filesystem::path output;  ///< model file; empty: `part.yaml` beside `part.inp`
  bool rigid_contact = false;    ///< leaves the stiffness of contact and sticking out, however small
  bool incomplete = false;       ///< writes the model even if something essential is lost
  bool force = false;            ///< replaces files
};

struct NewOptions {
  std::string kind;              ///< name of a StarterModel
  std::filesystem::path output;  ///< empty: `kind.yaml`
};

/// `cluster`: the other processes, or null.
ExitStatus run(const RunOptions& options, Cluster* cluster);
/// Continues a run from its checkpoint (analysis/state/checkpoint.hpp).
ExitStatus resume(const ResumeOptions& options, Cluster* cluster);
/// The end of a sentence on a run that was interrupted: the command that goes on, if it left a checkpoint.
std::string how_to_resume(const std::filesystem::path& directory);
/// `run` for a model with `type: modal` whose reading took `reading` seconds.
ExitStatus run_modal(const model::Model& model, const std::filesystem::path& directory, const RunOptions& options,
                     double reading, Events& events);
/// Runs a model with varied values, several at a time, and writes a table of the results.
ExitStatus sweep(SweepOptions options);
ExitStatus check(const CheckOptions& options);
ExitStatus print_exponents(const ExponentsOptions& options);
ExitStatus solve_contact(const ContactOptions& options);
ExitStatus print_schema();
/// Pictures by the program for them, with the words after `scabo plot`: of results in a directory, where it returns
/// only by an exception, or of a model file.
ExitStatus plot(const std::string& directory, const std::vector<std::string>& arguments);
/// A page for the browser in the same way, with the words after `scabo report`.
ExitStatus report(const std::vector<std::string>& arguments);
/// `scabo convert`: model and mesh, and what could not be taken.
ExitStatus convert_deck(const ConvertOptions& options);
/// `scabo new`. Throws InputError if the file exists.
ExitStatus write_new_model(const NewOptions& options);

}  // namespace scabo::app
