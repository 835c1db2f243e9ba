// `scabo sweep`: the same model with varied values, several runs at a time, and one table of their results.
//
// Every point is a run of this program in a process and directory of its own (point_001, ...), so that a point that
// fails, or is killed for its memory, loses no other. sweep.json says what the directory holds; a second call of the
// same sweep resumes points that were interrupted and runs those that are missing or failed.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "child_process.hpp"
#include "commands.hpp"
#include "interrupt.hpp"
#include "scabo/analysis/state/checkpoint.hpp"
#include "scabo/input/settings.hpp"
#include "scabo/input/space/read_solid_model.hpp"
#include "scabo/model/wording.hpp"
#include "scabo/result/files.hpp"
#include "scabo/result/results_directory.hpp"
#include "scabo/result/version.hpp"
#include "startup.hpp"
#include "sweep_axes.hpp"
#include "sweep_table.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

[[noreturn]] void refuse_sweep(const std::string& directory, std::string message) {
  throw InputError(directory, {{{}, std::move(message)}});
}

std::vector<std::string> settings_at(const std::vector<SweepAxis>& axes, std::size_t point) {
  const std::vector<std::string> values = values_at(axes, point);
  std::vector<std::string> settings;
  for (std::size_t a = 0; a < axes.size(); ++a) settings.push_back(axes[a].path + "=" + values[a]);
  return settings;
}

std::string name_of_point(std::size_t point, std::size_t points) {
  return fmt::format("point_{:0{}d}", point + 1, std::max<std::size_t>(3, std::to_string(points).size()));
}

/// The model of the first point. Throws InputError, with the mistakes of a varied value named by its --vary.
input::AnyModel first_model(const SweepOptions& options, const std::vector<SweepAxis>& axes) {
  std::vector<std::string> settings = options.settings;
  for (std::string& setting : settings_at(axes, 0)) settings.push_back(std::move(setting));
  try {
    return input::read_any_model(options.model, input::parse_settings(settings));
  } catch (const InputError& error) {
    std::vector<Diagnostic> mistakes = error.diagnostics();
    for (Diagnostic& mistake : mistakes)
      for (const SweepAxis& axis : axes)
        if (const std::string path = "--set " + axis.path; mistake.at.path.starts_with(path))
          mistake.at.path.replace(0, 5, "--vary");
    throw InputError(error.file(), mistakes);
  }
}

/// Every point is a run that reads the model file again.
void refuse_pipe(const std::string& model) {
  std::error_code error;
  const fs::file_status status = fs::status(model, error);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status))
    throw InputError(
        model, {{{}, "is a pipe or a device, but every run of a sweep reads the model again: save it as a file"}});
}

/// What decides the results of a sweep.
Json manifest_of(const SweepOptions& options, const std::vector<SweepAxis>& axes, const input::AnyModel& read) {
  Json manifest = {{"scabo", result::version()}, {"kind", "sweep"}, {"settings", options.settings}};
  std::visit(
      [&](const auto& model) {
        manifest["files"] = {analysis::source_of(options.model, *model.text).digest};
        for (const std::string& file : model.files) manifest["files"].push_back(analysis::source_file(file).digest);
      },
      read);
  manifest["vary"] = Json::array();
  for (const SweepAxis& axis : axes) manifest["vary"].push_back({{"path", axis.path}, {"values", axis.values}});
  return manifest;
}

/// Prepares the directory: false if it holds a part of this sweep already.
bool begin_directory(const SweepOptions& options, const fs::path& directory, const Json& manifest) {
  const fs::path file = directory / "sweep.json";
  std::error_code error;
  if (!options.anew && fs::exists(file, error)) {
    std::ifstream stream(file, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    const Json before = Json::parse(text, nullptr, false);
    if (before == manifest) return false;
    const bool same_files = before.is_object() && before.value("vary", Json()) == manifest["vary"] &&
                            before.value("settings", Json()) == manifest["settings"];
    refuse_sweep(directory.string(),
                 fmt::format("holds the results of {}: name another directory with -o, or replace them with --anew",
                             same_files ? "this sweep of another model file, or by another version of the program"
                                        : "another sweep"));
  }
  result::replace_file(file, manifest.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  return true;
}

SweepRow ended_as(const char* status) {
  SweepRow row;
  row.status = status;
  return row;
}

struct RunningPoint {
  std::size_t point = 0;
  ChildProcess process;
  Clock::time_point start;
  bool resumes = false;
};

/// The first error in the output of a run, for the screen.
std::string first_error(const fs::path& output) {
  std::ifstream stream(output);
  for (std::string line; std::getline(stream, line);)
    if (!line.empty() && line.find("warning:") == std::string::npos) return line.substr(0, 300);
  return {};
}

class Sweep {
 public:
  Sweep(const SweepOptions& options, std::vector<SweepAxis> axes, fs::path directory)
      : options_(options), axes_(std::move(axes)), directory_(std::move(directory)), rows_(count_points(axes_)) {}

  /// Points that are there already.
  void read_rows() {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      rows_[i] = row_of(folder(i));
      kept_ += is_finished(rows_[i]);
    }
  }

  void run(const Interrupt& interrupt) {
    if (kept_ > 0 && !options_.quiet)
      print_to_stderr(fmt::format("{} of {} points are there already\n", kept_, rows_.size()));
    std::size_t next = 0;
    bool told = false;
    write_table();
    while (true) {
      if (interrupt.requested() && !told) {
        for (const RunningPoint& of : running_) of.process.stop(interrupt.signal());
        told = true;
      }
      while (!interrupt.requested() && running_.size() < static_cast<std::size_t>(options_.jobs) &&
             next < rows_.size()) {
        if (!is_finished(rows_[next])) start(next, true);
        ++next;
      }
      if (running_.empty()) break;
      if (!collect()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    write_table();
  }

  ExitStatus status(int signal) const {
    if (signal != 0) return static_cast<ExitStatus>(ExitStatus::signalled + signal);
    const auto any = [&](std::initializer_list<const char*> names) {
      return std::any_of(rows_.begin(), rows_.end(), [&](const SweepRow& row) {
        return std::any_of(names.begin(), names.end(), [&](const char* name) { return row.status == name; });
      });
    };
    if (any({"failed", "killed", "interrupted"})) return ExitStatus::failure;
    if (any({"wrong_input"})) return ExitStatus::wrong_input;
    return any({"not_converged", "mechanism", "collapse"}) ? ExitStatus::not_converged : ExitStatus::solved;
  }

  std::string totals() const {
    std::map<std::string, long> counts;
    for (const SweepRow& row : rows_) ++counts[row.status];
    std::string text;
    for (const auto& [name, number] : counts) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", number, name);
    return fmt::format("{}: {}\nTable: {}\n", model::counted(static_cast<long>(rows_.size()), "point"), text,
                       (directory_ / "sweep.csv").string());
  }

 private:
  fs::path folder(std::size_t point) const { return directory_ / name_of_point(point, rows_.size()); }
  fs::path output(std::size_t point) const { return directory_ / (name_of_point(point, rows_.size()) + ".txt"); }

  void start(std::size_t point, bool may_resume) {
    const fs::path results = folder(point);
    const bool resumes = may_resume && (rows_[point].status == "interrupted" || rows_[point].status == "failed") &&
                         analysis::has_checkpoint(results);
    std::vector<std::string> arguments;
    if (resumes) {
      arguments = {"resume", results.string(), "--model", options_.model, "--quiet"};
    } else {
      // A run that ends before it writes must not leave the summary of an earlier one.
      std::error_code error;
      if (result::status_in(results)) fs::remove(results / "summary.json", error);
      arguments = {
          "run", options_.model, "--quiet", "-o", results.string(), "--threads", std::to_string(options_.threads)};
      for (const std::string& setting : options_.settings) arguments.insert(arguments.end(), {"--set", setting});
      for (const std::string& setting : settings_at(axes_, point))
        arguments.insert(arguments.end(), {"--set", setting});
    }
    running_.push_back({point, ChildProcess(arguments, output(point)), Clock::now(), resumes});
  }

  /// Takes the results of runs that have ended. False if there are none.
  bool collect() {
    bool any = false;
    for (std::size_t i = 0; i < running_.size();) {
      const auto status = running_[i].process.ended();
      if (!status) {
        ++i;
        continue;
      }
      const RunningPoint ended = running_[i];
      running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
      if (ended.resumes && *status == ExitStatus::wrong_input) {  // its checkpoint does not fit: from the beginning
        start(ended.point, false);
        continue;
      }
      finish(ended, *status);
      any = true;
    }
    return any;
  }

  void finish(const RunningPoint& ended, int status) {
    SweepRow& row = rows_[ended.point];
    row = row_of(folder(ended.point));
    if (status == ExitStatus::wrong_input) row = ended_as("wrong_input");
    if (status == ExitStatus::failure || status == 127 || (status == ExitStatus::solved && row.status != "solved"))
      row = ended_as("failed");
    if (status > ExitStatus::signalled && row.status != "interrupted") row = ended_as("killed");
    const double seconds = std::chrono::duration<double>(Clock::now() - ended.start).count();
    std::string at;
    for (const std::string& setting : settings_at(axes_, ended.point)) at += " " + setting;
    ++done_;
    if (!options_.quiet)
      print_to_stderr(fmt::format("{}/{} {}:{}: {} ({:.2g} s)\n", kept_ + done_, rows_.size(),
                                  name_of_point(ended.point, rows_.size()), at, row.status, seconds));
    const std::string why = first_error(output(ended.point));
    if (!why.empty() && row.status != "solved" && row.status != "interrupted") print_to_stderr("  " + why + "\n");
    std::error_code error;
    if (fs::file_size(output(ended.point), error) == 0 && !error) fs::remove(output(ended.point), error);
    if (Clock::now() >= next_table_) write_table();
  }

  /// After every point, unless that would take more than a twentieth of the time.
  void write_table() {
    const Clock::time_point start = Clock::now();
    result::replace_file(directory_ / "sweep.csv", sweep_table(axes_, rows_));
    next_table_ = Clock::now() + 20 * (Clock::now() - start);
  }

  const SweepOptions& options_;
  std::vector<SweepAxis> axes_;
  fs::path directory_;
  std::vector<SweepRow> rows_;
  std::vector<RunningPoint> running_;
  std::size_t kept_ = 0, done_ = 0;
  Clock::time_point next_table_;
};

}  // namespace

ExitStatus sweep(SweepOptions options) {
  std::vector<SweepAxis> axes;
  for (const std::string& text : options.vary) axes.push_back(parse_axis(text));
  count_points(axes);
  refuse_pipe(options.model);
  const input::AnyModel model = first_model(options, axes);
  if (const auto* plane = std::get_if<model::Model>(&model);
      plane != nullptr && plane->analysis.type == model::AnalysisType::modal)
    refuse_sweep(options.model, "a sweep runs static analyses: leave out type: modal");
  if (options.output.empty()) options.output = fs::path(options.model).replace_extension("sweep");
  const int processors = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  if (options.jobs <= 0) options.jobs = processors;
  if (options.threads <= 0) options.threads = std::max(1, processors / options.jobs);

  ignore_broken_pipes();
  std::error_code error;
  fs::create_directories(options.output, error);
  if (error || !fs::is_directory(options.output))
    throw result::WriteError("cannot create the directory", options.output, error ? error.message() : "it is a file");
  const result::DirectoryLock lock(options.output);
  const bool is_new = begin_directory(options, options.output, manifest_of(options, axes, model));
  const Interrupt interrupt;
  Sweep runs(options, std::move(axes), options.output);
  if (!is_new) runs.read_rows();
  runs.run(interrupt);
  if (!options.quiet) print_summary(runs.totals());
  if (interrupt.requested()) print_error("interrupted; the same command goes on with the points that are missing");
  return runs.status(interrupt.signal());
}

}  // namespace scabo::app
