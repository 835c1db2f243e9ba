// `scabo contact`: solution of a saved discrete problem.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "commands.hpp"
#include "compare/solvers.hpp"
#include "contact_report.hpp"
#include "scabo/contact/files/fclib.hpp"
#include "scabo/contact/files/text_problem.hpp"
#include "scabo/contact/unit_motions.hpp"
#include "scabo/input/suggestions.hpp"
#include "scabo/result/convergence.hpp"
#include "scabo/result/files.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

using Clock = std::chrono::steady_clock;

compare::Method method_of(const std::string& name) {
  if (const auto method = compare::method_named(name)) return *method;
  const std::vector<std::string> names = compare::method_names();
  std::string all;
  for (const std::string& known : names) all += (all.empty() ? "" : ", ") + known;
  const std::string nearest = input::nearest_name(name, names);
  throw InputError("--solver",
                   {{{},
                     fmt::format("there is no solver called {}{}; available are {}", input::quoted_name(name),
                                 nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest), all)}});
}

/// The rigid motions of problems saved by a run have suitable units; those of other programs may have any.
contact::UnitMotions problem_to_solve(const contact::SavedProblem& saved) {
  if (saved.force_scale > 0.0) return {saved.problem, saved.start, Vector::Ones(saved.problem.G.cols())};
  return contact::in_unit_motions(saved.problem, saved.start);
}

Judged judge(const contact::SavedProblem& saved, const ContactOptions& options) {
  Judged judged;
  judged.solver = options.solver;
  judged.tolerance = options.tolerance;
  contact::SolverOptions solver;
  solver.tolerance = options.tolerance;
  solver.force_scale = saved.force_scale;
  // Problems saved by Scabo are judged as in their run, those of other programs by the natural map.
  const bool by_certificate = saved.force_scale > 0.0 || saved.problem.G.cols() > 0;
  solver.judge = by_certificate ? contact::Judge::certificate : contact::Judge::natural_map;
  judged.by_certificate = by_certificate;
  if (options.iterations > 0) solver.iterations = options.iterations;
  if (options.time_limit > 0.0) solver.deadline = contact::Deadline::in(options.time_limit);

  const Clock::time_point start = Clock::now();
  const contact::UnitMotions problem = problem_to_solve(saved);
  judged.solution =
      problem.given(compare::solve_with(method_of(options.solver), problem.problem, problem.start, solver));
  judged.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return judged;
}

/// For a solution that was judged solved.
contact::UniquenessReport uniqueness_of(const contact::SavedProblem& saved, const Judged& judged) {
  contact::SolverOptions solver;
  solver.tolerance = judged.tolerance;
  solver.force_scale = saved.force_scale;
  const contact::UnitMotions problem = problem_to_solve(saved);
  contact::Solution solution = judged.solution;
  solution.a = solution.a.cwiseQuotient(problem.unit);
  return contact::examine_uniqueness(problem.problem, problem.start, solution, solver);
}

/// Throws InputError if `file` exists and does not begin with `mark`: it was not written by Scabo and must not be
/// replaced.
void refuse_files_of_others(const std::filesystem::path& file, std::string_view mark) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return;  // a new one, or a device
  std::string beginning(512, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  if (stream.gcount() > 0 && beginning.find(mark) == std::string::npos)
    throw InputError(file.string(),
                     {{{}, "exists and is not a trace written by Scabo: name another file, as in --trace=FILE.csv"}});
}

/// Files for the iterations and their plot, which is empty beside a device, as for --trace=/dev/stdout.
struct TraceFiles {
  std::filesystem::path table, picture;
};

TraceFiles trace_files(const ContactOptions& options) {
  TraceFiles files;
  files.table = files.picture = options.trace.empty() ? options.file + ".trace.csv" : options.trace;
  files.picture.replace_extension("svg");
  if (files.picture == files.table)
    throw InputError(options.trace,
                     {{{}, "is the name of the plot: give the name of the table, as in --trace=FILE.csv"}});
  refuse_files_of_others(files.table, trace_header);
  std::error_code ignored;
  const auto there = std::filesystem::symlink_status(files.table, ignored);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there))
    files.picture.clear();
  else
    refuse_files_of_others(files.picture, result::convergence_plot_mark);
  return files;
}

void write_trace(const TraceFiles& files, const contact::SavedProblem& saved, const ContactOptions& options,
                 const Judged& judged) {
  result::write_file(files.table, report_trace(judged.solution));
  if (files.picture.empty()) return;
  const std::string title = saved.title.empty() ? options.file : saved.title;
  const result::ConvergenceCurve curve{judged.solver, judged.solution.trace, is_solved(judged)};
  result::write_file(files.picture, result::convergence_plot({curve}, title, options.tolerance));
}

void refuse_to_overwrite(const std::string& file) {
  std::error_code ignored;
  if (!file.empty() && std::filesystem::exists(file, ignored))
    throw InputError(file, {{{}, "exists: remove it, or name another file after --save"}});
}

/// Writes the local form, also for a problem that was read in the global form; as text if the name of the file says so.
void save(const std::string& file, contact::SavedProblem saved, const Judged& judged) {
  if (std::filesystem::path(file).extension() == ".dat") {
    try {
      result::write_file(file, contact::text_of(saved.problem));
    } catch (const std::invalid_argument& error) {
      throw InputError(file, {{{}, error.what()}});
    }
    return;
  }
  saved.r = is_solved(judged) ? judged.solution.p : Vector();
  saved.a = is_solved(judged) ? judged.solution.a : Vector();
  // If the problem was not solved, the best iterate is saved as a start for a later solve.
  if (judged.solution.status == contact::Status::not_converged) saved.start = {judged.solution.p, judged.solution.a};
  contact::write_fclib(file, saved);
}

}  // namespace

ExitStatus solve_contact(const ContactOptions& options) {
  method_of(options.solver);  // before a large file is read
  refuse_to_overwrite(options.save);
  const contact::SavedProblem saved = contact::read_problem_file(options.file);
  const TraceFiles trace = options.write_trace ? trace_files(options) : TraceFiles();
  Judged judged = judge(saved, options);
  if (options.uniqueness && is_solved(judged)) judged.uniqueness = uniqueness_of(saved, judged);
  if (options.write_trace) write_trace(trace, saved, options, judged);
  if (!options.save.empty()) save(options.save, saved, judged);
  print_output(options.json ? report_json(options.file, saved, judged) : report_table(options.file, saved, judged));
  if (is_solved(judged)) return ExitStatus::solved;
  print_error(fmt::format("{}: {}: {}", options.file, spoken_name_of(judged.solution.status), judged.solution.reason));
  return ExitStatus::not_converged;
}

}  // namespace scabo::app
