// One of the processes of a run (a rank). The first one, rank 0, runs the program; the others wait for what it asks
// all of them to do. Each function of `Process` is called by all at the same time, with equal ids; what only rank 0
// knows is passed by pointers, which are null elsewhere.
//
// Failures. What a process does alone before it works with the others may throw: all then agree about it, and rank 0
// throws what the first of them threw. Within PETSc and MUMPS the others may be waiting for one that has failed: it
// reports itself and ends all (end_all).
#pragma once

#include <mpi.h>

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "message.hpp"
#include "scabo/analysis/static_analysis.hpp"
#include "scabo/linalg/symmetric_positive_solver.hpp"
#include "scabo/linalg/twofold.hpp"
#include "scabo/model/model.hpp"

namespace scabo::mpi {

/// A process other than this one could not go on; the text names it.
struct RankFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Share;       // share.hpp: cells and rows of a divided part on this rank
class MumpsFactor;  // mumps.hpp: its part of a factor
struct OwnFields;   // fields.cpp

/// The rows and columns to factorise (ranks.hpp), in the order of nodes among all ranks (Division).
struct FactorRequest {
  std::vector<char> solved;  // one for each degree of freedom
  struct Turned {
    int node;
    double M[4];  // by rows
  };
  std::vector<Turned> inclined;
  struct Entry {
    int row, column;
    double value;
  };
  std::vector<Entry> springs;
  std::vector<int> step;  // on rank 0: at which each solved one is eliminated, all distinct; those of `condensed` last
  std::vector<int> condensed;  // those whose flexibility contact needs, among the solved ones; ascending, distinct
};

/// What rank 0 is told after a part was divided or factorised.
struct ShareFacts {
  double entries = 0.0, largest_diagonal = 0.0, rounding = 0.0;
  double seconds_cells = 0.0, seconds_assembly = 0.0;  // of the slowest rank
};
struct FactorFacts {
  bool definite = true;
  linalg::FactorisationCosts costs;
};

class Process {
 public:
  explicit Process(MPI_Comm comm);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  int rank() const { return rank_; }
  int count() const { return count_; }
  MPI_Comm comm() const { return comm_; }
  /// Processes on this machine.
  int on_this_machine() const { return on_this_machine_; }

  /// The model of rank 0; the others read it themselves.
  void use(const model::Model& model) { of_root_ = &model; }
  void read_model(const std::string* file, const std::vector<std::string>* settings,
                  const std::filesystem::path* directory);
  /// `message`: what a rank gets, as SharePacker makes it; empty elsewhere.
  ShareFacts divide(int id, const std::function<Bytes(int)>& message);
  void release_share(int id);

  /// y = K u, or by the squares of the entries; vectors in the order of nodes among all ranks.
  void multiply(int share, const Vector* u, Vector* y);
  void multiply_squares(int share, const Vector* u, Vector* y);
  void multiply_twofold(int share, const linalg::TwofoldVector* u, linalg::TwofoldVector* y);

  FactorFacts factorise(int id, int share, const FactorRequest* request);
  /// The unknowns are the solved ones in their order among all ranks. `X`: right-hand sides, which become solutions.
  void solve(int factor, Matrix* X);
  /// On rank 0, alone: whether contact was condensed as the part was factorised, and then entries of the inverse at all
  /// pairs of some of the unknowns of FactorRequest::condensed.
  bool is_condensed(int factor);
  Matrix condensed_block(int factor, const std::vector<int>& indices);
  /// Without: entries of the inverse at all pairs of the `indices`, ascending and distinct.
  void inverse_block(int factor, const std::vector<int>* indices, Matrix* block);
  void release_factor(int id);

  /// Whether this rank has cells whose fields it writes.
  bool has_shares() const { return !shares_.empty(); }
  /// Writes the fields of this rank's cells; rank 0 also those of bodies that are not divided. Names of the files.
  std::vector<std::string> write_fields(const analysis::Discretisation* discretisation,
                                        const analysis::IncrementResult* increment,
                                        const std::filesystem::path* directory, const std::string* stem);

  /// Prints why this process failed, records it in the results, and ends all processes.
  [[noreturn]] void end_all(const std::string& why) const;

  /// The same values everywhere, from rank 0.
  Bytes broadcast(const Bytes* from_root) const;
  /// What each rank gets from rank 0, which makes one message after another; `message` is empty elsewhere.
  Bytes distributed(const std::function<Bytes(int)>& message) const;
  /// On rank 0 what each rank has; elsewhere nothing.
  std::vector<Bytes> collected(const Bytes& own) const;
  /// What all ranks have, by rank; for little.
  std::vector<Bytes> gathered(const Bytes& own) const;

 private:
  void send(const Bytes& bytes, int to, int tag) const;
  Bytes received(int from, int tag) const;
  /// Runs `alone`, which may throw; returns if it succeeded on all ranks. Otherwise rank 0 throws, and the others
  /// return false.
  bool agreed(const std::function<void()>& alone) const;
  /// Runs what all ranks do together: where it fails, there is no way on.
  void together(const std::function<void()>& work) const;
  Share& share(int id);
  MumpsFactor& factor(int id);
  const model::Model& model() const { return of_root_ ? *of_root_ : *model_; }

  MPI_Comm comm_;
  int rank_ = 0, count_ = 1, on_this_machine_ = 1;
  std::string machine_;
  std::unique_ptr<model::Model> model_;  // of ranks other than 0; rank 0 passes its own
  std::filesystem::path directory_;      // of the results
  std::map<int, std::unique_ptr<Share>> shares_;
  std::map<int, std::unique_ptr<MumpsFactor>> factors_;
  std::unique_ptr<OwnFields> own_fields_;  // of all shares, made when they are first written
  const model::Model* of_root_ = nullptr;
};

}  // namespace scabo::mpi
