#include "scabo/run/solid_run.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "scabo/analysis/space/solid_restart.hpp"
#include "scabo/base/interruption.hpp"
#include "scabo/run/checkpoint_pace.hpp"
#include "scabo/run/failures.hpp"
#include "scabo/run/origin.hpp"
#include "scabo/system/pair_flexibility.hpp"

namespace scabo::run {

namespace {

/// Measured on one thread of a Xeon (benchmarks/README.md, "In space beside CalculiX"); the exponents are those of
/// sparse factors in space.
constexpr double unit_dofs = 95232.0, unit_bytes = 0.9e9, unit_seconds = 3.0;
constexpr double bytes_of_dof = 4000.0, seconds_of_dof = 1.6e-5;  // of elements and fields; of elements
constexpr double bytes_of_super_element = 1.5e5;                  // of each distinct one
constexpr double field_seconds = 3e-6;                            // for each degree of freedom and increment
constexpr double sweep_seconds = 3e-8;                            // for each degree of freedom and row of W
constexpr double row_seconds = 2e-8, solve_seconds = 1e-10;       // of an increment, for their square and their cube

/// Of a body with these rows of W: the block of its flexibility, of which a corner has the four nodes of a quadratic
/// face, and W twice.
double contact_bytes(double rows) {
  const double dofs = 4.0 * rows, parts = dofs > static_cast<double>(system::most_flexible_at_once) ? 4.0 / 9.0 : 1.0;
  return sizeof(double) * (parts * dofs * dofs + 2.0 * rows * rows);
}

double count_distinct(const element::SuperElements& solved) {
  std::set<std::shared_ptr<const element::SolidSuperElement>> cells(solved.begin(), solved.end());
  cells.erase(nullptr);
  return static_cast<double>(cells.size());
}

}  // namespace

Plan plan_of(const analysis::PosedSolids& posed) {
  Plan plan;
  plan.increments = static_cast<int>(posed.increments.size());
  std::vector<double> rows(posed.model.bodies.size(), 0.0);  // of W, on each body
  double all_rows = 0.0, factors = 0.0, fields = 0.0;        // rows; bytes
  const std::vector<int> counts = analysis::count_pairs(posed.model);
  for (std::size_t c = 0; c < counts.size(); ++c) {
    const analysis::SolidContact& contact = posed.model.contacts[c];
    const double pairs = counts[c];
    plan.sizes.contact_pairs += static_cast<int>(pairs);
    for (const int body : {contact.a.body, contact.b.body}) rows[static_cast<std::size_t>(body)] += 3.0 * pairs;
    all_rows += 3.0 * pairs;
  }
  for (const analysis::SolidHeldPoint& point : posed.model.held_points) {
    rows[static_cast<std::size_t>(point.body)] += 3.0;
    all_rows += 3.0;
  }
  plan.sizes.bodies = static_cast<int>(posed.model.bodies.size());
  for (std::size_t b = 0; b < rows.size(); ++b) {
    const mesh::SolidMesh& mesh = posed.model.bodies[b].mesh;
    const auto n = 3.0 * static_cast<double>(mesh.nodes.cols());
    plan.sizes.nodes += static_cast<int>(mesh.nodes.cols());
    const auto super = static_cast<int>(std::count_if(
        mesh.cells.begin(), mesh.cells.end(), [](const auto& cell) { return mesh::is_super_element(cell.size()); }));
    plan.sizes.super_elements += super;
    plan.sizes.finite_elements += static_cast<int>(mesh.cells.size()) - super;
    if (posed.model.bodies[b].rigid_at) continue;
    factors += bytes_of_super_element * count_distinct(posed.model.bodies[b].solved);
    factors += unit_bytes * std::pow(n / unit_dofs, 1.42);
    fields += bytes_of_dof * n;
    plan.cells += seconds_of_dof * n;
    plan.factorise += unit_seconds * std::pow(n / unit_dofs, 2.05);
    plan.condense += sweep_seconds * n * rows[b];
    plan.fields += plan.increments * field_seconds * n;
  }
  plan.sizes.dofs = 3 * plan.sizes.nodes;
  // The factors stay. Beside them there are elements and fields, or the block of one body at a time.
  const double most = rows.empty() ? 0.0 : *std::max_element(rows.begin(), rows.end());
  plan.bytes = CostConstants().base_bytes + factors + std::max(fields, contact_bytes(most));
  if (posed.model.has_stages()) plan.bytes += sizeof(double) * all_rows * all_rows;  // W of a stage beside the whole
  plan.contact = plan.increments * (row_seconds + solve_seconds * all_rows) * all_rows * all_rows;
  return plan;
}

namespace {

/// Writes checkpoints, also at an interruption.
class SolidCheckpoints {
 public:
  explicit SolidCheckpoints(const SolidRun& run)
      : run_(run), last_(run.begun), wanted_(run.posed.increments.size() > 1 && !run.begun.origin.model.empty()) {
    if (wanted_ && last_.results.finished == 0) write();
  }
  void add(const analysis::SolidState& state) {
    last_.state = state;
    is_newer_ = true;
    if (wanted_ && pace_.is_due()) write();
  }
  void finish() {
    if (wanted_ && is_newer_) write();
  }

 private:
  void write() {
    pace_.write([&] {
      last_.results = run_.results.written();
      analysis::write_solid_checkpoint(run_.directory, last_);
    });
    is_newer_ = false;
  }

  const SolidRun& run_;
  analysis::SolidCheckpoint last_;
  bool wanted_, is_newer_ = false;
  CheckpointPace pace_;
};

/// Those that are left, each told to `add`. Whether it was interrupted; an interruption point follows every increment
/// but the last.
bool solve_increments(const analysis::PosedSolids& posed, analysis::SolidOptions options,
                      const std::function<void(const analysis::SolidIncrement&, const analysis::SolidState&)>& add) {
  std::size_t left = posed.increments.size() - options.first;
  options.on_increment = [&](const analysis::SolidIncrement& increment, const analysis::SolidState& state) {
    add(increment, state);
    if (--left > 0) interruption_point();
  };
  try {
    analysis::solve_solids(posed.model, posed.increments, options);
  } catch (const Stopped&) {
    return true;
  }
  return false;
}

analysis::SolidOptions options_of(const model::SpaceModel& model, const analysis::PosedSolids& posed, int threads) {
  analysis::SolidOptions options;
  options.tolerance = model.tolerance;
  options.uniqueness = model.uniqueness;
  options.threads = threads;
  if (model.restart)
    options.start = [&](const analysis::PreparedSolids& prepared) {
      return analysis::state_of_restart(prepared, model, posed);
    };
  return options;
}

result::SolidEnd solve_and_write(const SolidRun& run) {
  SolidCheckpoints checkpoints(run);
  analysis::SolidOptions options = options_of(run.model, run.posed, run.threads);
  options.first = static_cast<std::size_t>(run.begun.results.finished);
  if (options.first > 0) options.from = &run.begun.state;
  options.on_end = [&](const analysis::PreparedSolids& prepared, const analysis::SolidState& state) {
    analysis::write_end_state(run.directory, analysis::end_state_of_solids(prepared, run.model, state));
  };
  const bool interrupted = solve_increments(
      run.posed, std::move(options), [&](const analysis::SolidIncrement& increment, const analysis::SolidState& state) {
        run.results.add(increment);
        if (increment.status == contact::Status::solved) checkpoints.add(state);
        if (run.on_increment) run.on_increment(increment);
      });
  const Interruptible nobody(nullptr);
  if (interrupted) checkpoints.finish();
  result::SolidEnd end = run.results.finish(interrupted);
  if (!interrupted) analysis::remove_checkpoint(run.directory);
  return end;
}

}  // namespace

analysis::RunOrigin origin_of(const model::SpaceModel& model, const std::vector<std::string>& settings,
                              const std::filesystem::path& output, int threads) {
  return origin_of(model.file, model.files, settings, output, threads, model.text.get());
}

result::SolidEnd solve(const SolidRun& run) {
  return marking_failures(run.directory, [&] { return solve_and_write(run); });
}

bool solve_in_memory(const model::SpaceModel& model, const analysis::PosedSolids& posed, int threads,
                     const std::function<void(const analysis::SolidIncrement&)>& on_increment) {
  return solve_increments(posed, options_of(model, posed, threads),
                          [&](const analysis::SolidIncrement& increment, const analysis::SolidState&) {
                            if (on_increment) on_increment(increment);
                          });
}

}  // namespace scabo::run
