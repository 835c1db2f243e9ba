// Rank 0's side: what the program asks of all ranks (system/ranks.hpp), and the loop of the others.
#pragma once

#include <cluster.hpp>
#include <mutex>

#include "process.hpp"
#include "scabo/result/results_directory.hpp"
#include "scabo/system/ranks.hpp"

namespace scabo::mpi {

/// What all are to do next.
enum class Command : int {
  end,
  read_model,
  divide,
  multiply,
  multiply_squares,
  multiply_twofold,
  factorise,
  solve,
  inverse_block,
  release_share,
  release_factor,
  write_fields,
};
struct Announcement {
  Command command = Command::end;
  int id = 0, other = 0;
};

class PetscRanks final : public system::Ranks, public result::FieldParts, public app::Cluster {
 public:
  explicit PetscRanks(Process& process) : process_(process) {}

  int count() const override { return process_.count(); }
  double divide_from() const override { return divide_from_; }
  std::shared_ptr<const system::DividedStiffness> stiffness(const model::Model& model, const mesh::Mesh& mesh,
                                                            const system::Dofs& dofs, std::size_t part,
                                                            int threads) override;

  bool any() const override;
  std::vector<std::string> write(const analysis::Discretisation& discretisation,
                                 const analysis::IncrementResult& increment, const std::filesystem::path& directory,
                                 const std::string& stem) override;

  system::Ranks& ranks() override { return *this; }
  result::FieldParts& fields() override { return *this; }
  void begin(const std::string& file, const std::vector<std::string>& settings, const std::filesystem::path& directory,
             double divide_from) override;
  int threads_of_a_rank() const override;
  double part_on_this_machine() const override;
  void end();

 private:
  friend class DividedPart;
  friend class DividedFactor;

  /// Tells all ranks what follows, which `work` then does on this one. One at a time.
  template <typename Work>
  auto all(const Announcement& what, const Work& work) {
    const std::lock_guard lock(one_at_a_time_);
    announce(what);
    return work();
  }
  void announce(const Announcement& what);

  Process& process_;
  std::mutex one_at_a_time_;
  int next_id_ = 0;
  double divide_from_ = 0.0;
};

/// The loop of a rank other than 0, until rank 0 ends.
void serve(Process& process);

}  // namespace scabo::mpi
