// Runs without the interpreter lock, with a callback that can cancel them.
#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <docstrings.hpp>  // made by make_docstrings.py
#include <fstream>
#include <iterator>
#include <memory>
#include <thread>

#include "bindings.hpp"
#include "models.hpp"
#include "scabo/linalg/dense.hpp"
#include "scabo/result/history.hpp"
#include "scabo/result/modal_results.hpp"
#include "scabo/result/results_directory.hpp"
#include "scabo/result/solid/solid_outputs.hpp"
#include "scabo/result/solid/solid_results.hpp"
#include "scabo/result/summary.hpp"
#include "scabo/run/modal_run.hpp"
#include "scabo/run/sizes.hpp"
#include "scabo/run/solid_run.hpp"
#include "scabo/run/static_run.hpp"
#include "scabo/run/time_left.hpp"
#include "solved.hpp"
#include "until_ctrl_c.hpp"

namespace scabo::python {

namespace {

/// How far a run is, as its callback is told.
struct Progress {
  std::string stage;                     ///< what is being done, as 'factorisation' or 'step press, increment 2 of 10'
  int increment = 0;                     ///< number of finished increments
  std::optional<int> increments;         ///< number of increments of all steps; None if their size is automatic
  double fraction = 0.0;                 ///< part of the steps that is done, 0 to 1
  std::optional<int> newton_iterations;  ///< of the last finished increment; None before it
  std::optional<double> residual;        ///< of the last finished increment; None before it
  std::optional<int> iteration;          ///< of the contact solver in the increment at work; None between increments
  std::optional<double> iteration_residual;  ///< residual of that iteration
  std::optional<double>
      seconds_left;  ///< until the end, if the rest goes on as before; None before an increment is done
};

/// Passes progress to a Python callback, and looks for Ctrl-C. A callback that returns False or raises, and an
/// exception of a signal handler, stop the run. It ends at the next of these occasions: a stage or increment begins,
/// the contact solver iterates, an interruption point is passed. Finished increments are kept.
class Watch {
 public:
  explicit Watch(py::object callback) : callback_(std::move(callback)) { now_.stage = "mesh"; }

  const std::atomic<bool>& stopped() const { return stopped_; }
  /// With the interpreter lock.
  py::object error() const { return error_; }

  void begin(int increments) { now_.increments = increments; }
  void begin(const model::Model& model) {
    bool automatic = false;
    for (const model::Step& step : model.steps) automatic = automatic || !model::is_counted(step);
    if (!automatic) now_.increments = run::increments_of(model);
  }

  // Called by the run, without the lock.
  void stage(const std::string& name) {
    now_.stage = name;
    now_.iteration.reset();
    now_.iteration_residual.reset();
    look(true);
    if (stopped_) throw run::Stopped{};
  }
  /// The same of an analysis that can end with the increments that are finished.
  void stage_of_increments(const std::string& name) {
    try {
      stage(name);
    } catch (const run::Stopped&) {
      if (name == "mesh") throw;
      throw analysis::EndAtOnce{};
    }
  }
  void meshed() { time_left_.begin(); }
  void iteration(const contact::Iteration& iteration) {
    if (Clock::now() - told_ >= between_iterations) {
      now_.iteration = iteration.iteration;
      now_.iteration_residual = iteration.residual;
      now_.seconds_left = time_left_.seconds();
      look(true);
    }
    if (stopped_) throw analysis::EndAtOnce{};
  }
  void increment(const model::Model& model, const analysis::IncrementResult& result) {
    if (result.converged) done(run::part_done(model, result), result.newton_iterations, result.residual);
  }
  void increment(int of, const analysis::SolidIncrement& made) {
    if (made.status == contact::Status::solved)
      done((now_.increment + 1.0) / of, made.iterations, made.certificate.worst());
  }
  /// An increment is finished, and `fraction` of all.
  void done(double fraction, int iterations, double residual) {
    ++now_.increment;
    now_.fraction = fraction;
    now_.newton_iterations = iterations;
    now_.residual = residual;
    now_.iteration.reset();
    now_.iteration_residual.reset();
    time_left_.increment(now_.fraction, now_.increment == 1);
    now_.seconds_left = time_left_.seconds();
    look(true);  // what is finished is kept: the run looks at stopped() before the next one
  }

  /// At interruption points, on any thread: whether the run is to end. Only the thread of the run looks.
  bool work() {
    if (std::this_thread::get_id() == thread_) {
      const Clock::time_point now = Clock::now();
      if (now - looked_ >= between_looks) look(now - told_ >= between_work);
    }
    return stopped_;
  }

 private:
  using Clock = std::chrono::steady_clock;

  void look(bool tell) {
    {
      const py::gil_scoped_acquire acquire;
      if (!stopped_) {
        error_ = raised_by_signals();
        stopped_ = !error_.is_none();
      }
      if (tell && !callback_.is_none() && !stopped_) call();
    }
    looked_ = Clock::now();
    if (tell) told_ = looked_;
  }

  void call() {
    try {
      stopped_ = callback_(py::cast(now_)).is(py::bool_(false));
    } catch (py::error_already_set& raised) {
      error_ = raised.value();
      if (raised.trace()) error_.attr("__traceback__") = raised.trace();
      stopped_ = true;
    }
  }

  // A display shows a few a second, and each needs the interpreter lock. Within a stage nothing new is told, but the
  // callback may want the end.
  static constexpr std::chrono::milliseconds between_iterations{50}, between_work{250};

  py::object callback_;
  py::object error_ = py::none();
  Progress now_;
  std::atomic<bool> stopped_{false};
  run::TimeLeft time_left_;
  const std::thread::id thread_ = std::this_thread::get_id();
  Clock::time_point told_ = Clock::now(), looked_ = told_;
};

std::string text_of_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

analysis::StaticSolution run_in_directory(run::StaticRun& run, const CheckedModel& checked, const std::string& output,
                                          mesh::Mesh mesh, RunRecord& record) {
  result::ResultsDirectory directory(output, checked.model, std::move(mesh));
  run.directory = &directory;
  if (checked.is_of_file && run::keeps_checkpoints(checked.model)) {
    run.begun.origin = run::origin_of(checked.model, checked.settings, output, run.threads);
    run.begun.results = directory.written();
  }
  analysis::StaticSolution solution = run::solve(run);
  record.directory = output;
  record.summary = text_of_file(directory.path() / "summary.json");
  record.warnings = texts_of(solution.warnings);
  record.warnings.insert(record.warnings.end(), directory.warnings().begin(), directory.warnings().end());
  return solution;
}

/// Runs a static analysis. `output`: directory of its files, or None. `threads`: upper limit. `keep_fields`: of all
/// increments, not of the last one alone. `ignore_memory`: starts even if the estimated memory is not available.
/// `progress`: None, or a function that is called with a Progress; False or an exception of it ends the run, whose
/// result then contains the finished increments. Raises ModelError, WriteError and MemoryError.
std::shared_ptr<StaticResult> solve_static(const CheckedModel& checked, const std::optional<std::string>& output,
                                           int threads, bool keep_fields, bool ignore_memory,
                                           const py::object& progress) {
  auto solved = std::make_shared<StaticResult>();
  Watch watch(progress);
  watch.begin(checked.model);
  {
    const py::gil_scoped_release release;
    const linalg::KeptBlasThreads kept;
    run::StaticRun run{checked.model};
    run.reading = checked.reading;
    run.threads = threads;
    run.stop = &watch.stopped();
    run.keep_fields = keep_fields;
    if (!ignore_memory) run.anyway = "start it with ignore_memory=True";
    run.observer.on_stage = [&](const std::string& stage) { watch.stage_of_increments(stage); };
    run.observer.on_mesh = [&](const auto&) { watch.meshed(); };
    run.observer.on_iteration = [&](const contact::Iteration& iteration) { watch.iteration(iteration); };
    run.observer.on_increment = [&](const auto&, const auto& increment) { watch.increment(checked.model, increment); };
    const Interruptible::Ask ask = [&] {
      if (watch.work()) throw analysis::EndAtOnce{};
    };
    mesh::Mesh mesh = analysis::check(checked.model);
    if (checked.model.analysis.type == model::AnalysisType::static_) result::check_sections(checked.model, mesh);
    run.plan = run::plan_of(checked.model, mesh);
    const Interruptible here(&ask);
    if (output) {
      solved->solution = run_in_directory(run, checked, *output, std::move(mesh), solved->record);
    } else {
      solved->solution = run::solve(run);
      solved->record.summary = result::summary_content(solved->solution, solved->solution.timing, false);
      solved->record.warnings = texts_of(solved->solution.warnings);
    }
    const bool interrupted = solved->solution.outcome == analysis::Outcome::interrupted;
    solved->record.why_not_solved = run::why_not_solved(solved->solution, interrupted);
  }
  solved->record.error = watch.error();
  return solved;
}

/// Runs a modal analysis; arguments as of `solve_static`. Raises Interrupted if `progress` returns False.
std::shared_ptr<ModalRunResult> solve_modal(const CheckedModel& checked, const std::optional<std::string>& output,
                                            int threads, const py::object& progress) {
  auto solved = std::make_shared<ModalRunResult>();
  Watch watch(progress);
  try {
    const py::gil_scoped_release release;
    const linalg::KeptBlasThreads kept;
    run::ModalRun run{checked.model};
    run.reading = checked.reading;
    run.threads = threads;
    if (output) run.output = *output;
    run.on_stage = [&](const std::string& stage) { watch.stage(stage); };
    const Interruptible::Ask ask = [&] {
      if (watch.work()) throw run::Stopped{};
    };
    const Interruptible here(&ask);
    solved->result = run::solve(run);
    solved->record.directory = output;
    solved->record.warnings = texts_of(solved->result.warnings);
    solved->record.summary = output ? text_of_file(std::filesystem::path(*output) / "summary.json")
                                    : result::modal_summary_content(solved->result);
  } catch (const run::Stopped&) {
    if (watch.error().is_none()) throw;
    solved->record.error = watch.error();
  }
  return solved;
}

/// `step press, increment 2 of 10`
std::string stage_of(const model::SpaceModel& model, const analysis::PosedSolids& posed, std::size_t number) {
  const auto& [step, of_step] = posed.step_and_number[number];
  return "step " + model.steps[step].name + ", increment " + std::to_string(of_step) + " of " +
         std::to_string(model.steps[step].increments);
}

result::SolidEnd run_in_directory(const run::SolidRun& run, const CheckedModel& checked, RunRecord& record) {
  run::SolidRun with_origin = run;
  if (checked.is_of_file)
    with_origin.begun.origin = run::origin_of(run.model, checked.settings, run.directory, run.threads);
  const result::SolidEnd end = run::solve(with_origin);
  record.directory = run.directory.string();
  record.summary = text_of_file(run.directory / "summary.json");
  return end;
}

result::SolidEnd solve_space_without_lock(const CheckedModel& checked, const std::optional<std::string>& output,
                                          int threads, bool keep_fields, bool ignore_memory, Watch& watch,
                                          SpaceResult& solved) {
  const model::SpaceModel& model = *checked.space;
  watch.stage("mesh");
  solved.posed = std::make_shared<const analysis::PosedSolids>(analysis::pose_solids(model));
  const analysis::PosedSolids& posed = *solved.posed;
  const result::SolidOutputs outputs(model, posed);  // checks them
  if (!ignore_memory)
    if (const std::string why =
            run::why_it_does_not_fit(run::plan_of(posed), run::available_memory(), "start it with ignore_memory=True");
        !why.empty())
      throw run::NotEnoughMemory(why);
  const auto count = static_cast<int>(posed.increments.size());
  watch.begin(count);
  watch.stage(stage_of(model, posed, 0));
  watch.meshed();
  const auto add = [&](const analysis::SolidIncrement& increment) {
    if (!keep_fields && increment.status == contact::Status::solved && !solved.increments.empty())
      solved.increments.back().u.clear();
    solved.increments.push_back(increment);
    watch.increment(count, increment);
    if (const std::size_t next = solved.increments.size(); next < posed.increments.size())
      watch.stage(stage_of(model, posed, next));
  };
  if (output) {
    result::SolidResults results(*output, model, posed);
    run::SolidRun run{model, posed, results, *output, threads};
    run.on_increment = add;
    return run_in_directory(run, checked, solved.record);
  }
  const bool interrupted = run::solve_in_memory(model, posed, threads, add);
  auto [summary, end] = result::summary_of(model, posed, solved.increments, interrupted);
  solved.record.summary = std::move(summary);
  return end;
}

/// Runs a static analysis in space, with the arguments and exceptions of solve_static.
std::shared_ptr<SpaceResult> solve_space(const CheckedModel& checked, const std::optional<std::string>& output,
                                         int threads, bool keep_fields, bool ignore_memory,
                                         const py::object& progress) {
  auto solved = std::make_shared<SpaceResult>();
  solved->model = checked.space;
  solved->posed = std::make_shared<const analysis::PosedSolids>();
  solved->record.warnings = texts_of(checked.space->warnings);
  Watch watch(progress);
  result::SolidEnd end;
  try {
    const py::gil_scoped_release release;
    const linalg::KeptBlasThreads kept;
    const Interruptible::Ask ask = [&] {
      if (watch.work()) throw run::Stopped{};
    };
    const Interruptible here(&ask);
    end = solve_space_without_lock(checked, output, threads, keep_fields, ignore_memory, watch, *solved);
  } catch (const run::Stopped&) {  // before the first increment
    if (watch.error().is_none()) throw;
    std::tie(solved->record.summary, end) = result::summary_of(*solved->model, *solved->posed, {}, true);
  }
  solved->status = end.status;
  if (end.status != "solved")
    solved->record.why_not_solved = (end.status == "interrupted" || end.at.empty() ? "" : end.at + ": ") + end.reason;
  for (const std::string& warning : texts_of(end.warnings)) solved->record.warnings.push_back(warning);
  solved->record.error = watch.error();
  return solved;
}

/// Writes results that are in memory, with the fields of all increments, to a directory, as a run does. Raises
/// WriteError.
void write_results(const StaticResult& solved, const std::string& output) {
  until_ctrl_c([&] {
    const analysis::StaticSolution& solution = solved.solution;
    result::ResultsDirectory directory(output, solution.model, solution.mesh);
    run::marking_failures(directory.path(), [&] {
      for (const analysis::IncrementResult& increment : solution.increments) directory.add(solution, increment);
      directory.finish(solution);
    });
  });
}

/// The same of results in space.
void write_space_results(const SpaceResult& solved, const std::string& output) {
  until_ctrl_c([&] {
    result::SolidResults results(output, *solved.model, *solved.posed);
    run::marking_failures(output, [&] {
      for (const analysis::SolidIncrement& increment : solved.increments) results.add(increment);
      results.finish(solved.status == "interrupted");
    });
  });
}

}  // namespace

void bind_runs(py::module_& module) {
  py::class_<Progress>(module, "Progress", doc::runs::Progress)
      .def_readonly("stage", &Progress::stage, doc::runs::Progress_stage)
      .def_readonly("increment", &Progress::increment, doc::runs::Progress_increment)
      .def_readonly("increments", &Progress::increments, doc::runs::Progress_increments)
      .def_readonly("fraction", &Progress::fraction, doc::runs::Progress_fraction)
      .def_readonly("newton_iterations", &Progress::newton_iterations, doc::runs::Progress_newton_iterations)
      .def_readonly("residual", &Progress::residual, doc::runs::Progress_residual)
      .def_readonly("iteration", &Progress::iteration, doc::runs::Progress_iteration)
      .def_readonly("iteration_residual", &Progress::iteration_residual, doc::runs::Progress_iteration_residual)
      .def_readonly("seconds_left", &Progress::seconds_left, doc::runs::Progress_seconds_left)
      .def("__repr__", [](const Progress& progress) {
        return py::str("Progress(stage={!r}, increment={}, increments={}, fraction={})")
            .format(progress.stage, progress.increment, progress.increments, progress.fraction);
      });
  py::class_<RunRecord>(module, "RunRecord", doc::solved::RunRecord)
      .def_readonly("summary", &RunRecord::summary, doc::solved::RunRecord_summary)
      .def_readonly("directory", &RunRecord::directory, doc::solved::RunRecord_directory)
      .def_readonly("warnings", &RunRecord::warnings, doc::solved::RunRecord_warnings)
      .def_readonly("error", &RunRecord::error, doc::solved::RunRecord_error)
      .def_readonly("why_not_solved", &RunRecord::why_not_solved, doc::solved::RunRecord_why_not_solved);
  module.def("solve_static", &solve_static, py::arg("model"), py::arg("output"), py::arg("threads"),
             py::arg("keep_fields"), py::arg("ignore_memory"), py::arg("progress"), doc::runs::solve_static);
  module.def("solve_space", &solve_space, py::arg("model"), py::arg("output"), py::arg("threads"),
             py::arg("keep_fields"), py::arg("ignore_memory"), py::arg("progress"), doc::runs::solve_space);
  module.def("solve_modal", &solve_modal, py::arg("model"), py::arg("output"), py::arg("threads"), py::arg("progress"),
             doc::runs::solve_modal);
  module.def("write_results", &write_results, py::arg("result"), py::arg("output"), doc::runs::write_results);
  module.def("write_space_results", &write_space_results, py::arg("result"), py::arg("output"),
             doc::runs::write_space_results);
}

}  // namespace scabo::python
