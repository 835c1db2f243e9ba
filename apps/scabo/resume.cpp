// `scabo resume`: continues a run from its checkpoint.
#include <fmt/format.h>

#include "cluster.hpp"
#include "commands.hpp"
#include "scabo/base/impossible_path.hpp"
#include "scabo/input/settings.hpp"
#include "scabo/input/space/read_solid_model.hpp"
#include "scabo/model/wording.hpp"
#include "scabo/result/version.hpp"
#include "solids.hpp"
#include "startup.hpp"
#include "static_run.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& file, std::string message) {
  throw InputError(file, {{{}, std::move(message)}});
}

bool is_same(const std::string& path, const analysis::SourceFile& file) {
  std::error_code error;
  return fs::is_regular_file(path, error) && analysis::source_file(path).digest == file.digest;
}

/// Where the model file is: at its place of that time, or at the same place from the results directory.
std::string model_of(const ResumeOptions& options, const analysis::RunOrigin& origin) {
  const analysis::SourceFile& model = origin.files.at(0);
  const std::string as_before = (fs::path(origin.folder) / origin.model).string();
  std::vector<std::string> places = {as_before, (options.directory / origin.beside).lexically_normal().string()};
  if (!options.model.empty()) places = {options.model};
  std::error_code error;
  for (const std::string& place : places)
    if (is_same(place, model)) return place;
  for (const std::string& place : places) {
    if (fs::is_fifo(place, error))
      refuse(place, "is a pipe: say with --model where the text of the model is kept in a file");
    if (fs::exists(place, error))
      refuse(place, "has changed since the run began: restore it, or start anew with `scabo run`");
  }
  refuse(places.front(),
         "the model file of the run is no longer there: say where it is with --model, or start anew with `scabo run`");
}

/// `files`: those that the model names.
void check_files(const std::vector<std::string>& files, const std::string& model, const analysis::RunOrigin& origin) {
  bool same = files.size() + 1 == origin.files.size();
  for (std::size_t i = 0; same && i < files.size(); ++i)
    if (!is_same(files[i], origin.files[i + 1]))
      refuse(files[i], "has changed since the run began: restore it, or start anew with `scabo run`");
  if (!same) refuse(model, "names other files than when the run began: start anew with `scabo run`");
}

/// How many threads go on; tells what is resumed.
int begin(const ResumeOptions& options, const analysis::RunOrigin& origin, std::size_t finished) {
  ignore_broken_pipes();
  const int wanted = options.threads > 0 ? options.threads : origin.threads, threads = threads_that_fit(wanted);
  if (!options.quiet)
    print_to_stderr(finished > 0
                        ? fmt::format("Resuming after {}\n", model::counted(static_cast<long>(finished), "increment"))
                        : std::string("No increment was finished: the run starts from the beginning\n"));
  if (threads != origin.threads)
    print_warning(fmt::format("the run began with {} and continues with {}: the last digits of results may differ",
                              model::counted(origin.threads, "thread"), threads));
  return threads;
}

ExitStatus resume_in_space(const ResumeOptions& options, result::DirectoryLock lock, Events& events) {
  analysis::SolidCheckpoint begun = analysis::read_solid_checkpoint(options.directory, std::string(result::version()));
  const analysis::RunOrigin& origin = begun.origin;
  input::AnyModel read = input::read_any_model(model_of(options, origin), input::parse_settings(origin.settings));
  auto& model = std::get<model::SpaceModel>(read);
  check_files(model.files, model.file, origin);
  model.file = origin.model;  // results do not depend on the place from which the run is resumed
  const int threads = begin(options, origin, static_cast<std::size_t>(begun.results.finished));
  return resume_solids(model, std::move(begun), std::move(lock), options.directory, threads, options.quiet, events);
}

ExitStatus resume(const ResumeOptions& options, Cluster* cluster, Events& events) {
  events.stage("reading");
  const auto start = std::chrono::steady_clock::now();
  const std::string name = options.directory.string();
  std::error_code error;
  if (const std::string why = impossible_path(options.directory); !why.empty()) refuse(name, why);
  if (!fs::is_directory(options.directory, error))
    refuse(name, fs::exists(options.directory, error)
                     ? "is a file, not a directory: name the results directory of a run"
                     : "there is no such directory: name the results directory of a run");
  result::DirectoryLock lock(options.directory);
  const auto status = result::status_in(options.directory);
  if (!status) refuse(name, "holds no results of Scabo: name the results directory of a run");
  if (*status != "running" && *status != "interrupted" && *status != "failed")
    refuse(name, fmt::format("the run has ended with status `{}`: nothing is left to resume; `scabo run` starts anew",
                             *status));
  if (result::analysis_in(options.directory) == "space") return resume_in_space(options, std::move(lock), events);
  analysis::Checkpoint checkpoint = analysis::read_checkpoint(options.directory, std::string(result::version()));
  const analysis::RunOrigin& origin = checkpoint.origin;
  const std::string path = model_of(options, origin);
  model::Model model = input::read_model(path, input::parse_settings(origin.settings));
  check_files(model.files, model.file, origin);
  model.file = origin.model;  // results do not depend on the place from which the run is resumed
  const double reading = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  const int threads = begin(options, origin, checkpoint.from.increments.size());
  const Interrupt interrupt;
  result::ResultsDirectory directory(options.directory, std::move(lock), model, checkpoint.results);
  run::StaticRun run{model, &directory};
  run.begun = std::move(checkpoint);
  run.reading = reading;
  run.start = start;
  run.threads = threads;
  if (cluster) use(*cluster, path, run.begun.origin.settings, options.divide_from, run);
  return solve_and_report(std::move(run), interrupt, events, options.quiet);
}

}  // namespace

ExitStatus resume(const ResumeOptions& options, Cluster* cluster) {
  Events events(options.json_lines);
  return events.around("resume", [&] { return resume(options, cluster, events); });
}

std::string how_to_resume(const std::filesystem::path& directory) {
  return analysis::has_checkpoint(directory) ? fmt::format(": go on with `scabo resume {}`", directory.string()) : "";
}

}  // namespace scabo::app
