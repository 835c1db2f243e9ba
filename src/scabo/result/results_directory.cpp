#include "scabo/result/results_directory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <system_error>

#include "scabo/base/interruption.hpp"
#include "scabo/base/stopwatch.hpp"
#include "scabo/result/contact_table.hpp"
#include "scabo/result/convergence.hpp"
#include "scabo/result/crack_table.hpp"
#include "scabo/result/old_results.hpp"
#include "scabo/result/report.hpp"
#include "scabo/result/summary.hpp"

namespace scabo::result {

namespace {

namespace fs = std::filesystem;

/// A model without contact has none.
bool has_iterations(const analysis::StaticSolution& solution) {
  for (const analysis::IncrementResult& increment : solution.increments)
    for (const analysis::AttemptResult& attempt : increment.attempts)
      if (!attempt.iterations.empty()) return true;
  return false;
}

}  // namespace

void mark_failed(const fs::path& directory, const std::string& reason) noexcept try {
  const fs::path file = directory / "summary.json";
  std::ifstream stream(file, std::ios::binary);
  const std::string before((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  try {
    replace_file(file, failed_summary(before, reason));
  } catch (const WriteError&) {
    constexpr std::string_view running = R"("status": "running")", failed = R"("status": "failed" )";
    static_assert(running.size() == failed.size());
    if (const auto at = before.find(running); at != std::string::npos) overwrite(file, failed, at);
  }
} catch (...) {  // the caller reports why the run ended
}

namespace {

std::string summary_in(const fs::path& directory) {
  std::ifstream stream(directory / "summary.json", std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace

std::optional<std::string> status_in(const fs::path& directory) { return status_of_summary(summary_in(directory)); }

std::optional<std::string> analysis_in(const fs::path& directory) { return analysis_of_summary(summary_in(directory)); }

namespace {

/// Of a run that continues.
void mark_running(const fs::path& directory) {
  const fs::path file = directory / "summary.json";
  std::ifstream stream(file, std::ios::binary);
  const std::string before((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (status_of_summary(before)) replace_file(file, running_summary(before));
}

}  // namespace

ResultsDirectory::ResultsDirectory(fs::path path, const model::Model& model, mesh::Mesh mesh)
    : path_(std::move(path)),
      steps_(static_cast<int>(model.steps.size())),
      in_time_(model::is_dynamic(model)),
      history_(model),
      output_(model.output) {
  const Stopwatch writing(write_seconds_);
  std::error_code error;
  if (model.restart && fs::equivalent(model.restart->directory, path_, error))
    throw InputError(
        model.file,
        {{model.restart->source, fmt::format("{} is also the directory that this run writes to: choose another one by "
                                             "-o",
                                             path_.string())}});
  analysis::StaticSolution start;
  start.model = model;
  start.mesh = std::move(mesh);
  lock_.emplace(prepare_directory(path_, summary_content(start, {}, true, history_.extremes())));
  write_running_summary(start);
  open_files(model, nullptr);
}

ResultsDirectory::ResultsDirectory(fs::path path, DirectoryLock lock, const model::Model& model,
                                   const analysis::WrittenResults& written)
    : path_(std::move(path)),
      steps_(static_cast<int>(model.steps.size())),
      in_time_(model::is_dynamic(model)),
      lock_(std::move(lock)),
      written_before_(written.finished),
      finished_(written.finished),
      fields_written_(written.fields_written),
      log_begun_(written.log_begun),
      history_(model),
      warnings_(written.warnings),
      output_(model.output) {
  const Stopwatch writing(write_seconds_);
  open_files(model, &written);
  remove_later_fields(path_, fields_written_);
  mark_running(path_);
}

void ResultsDirectory::open_files(const model::Model& model, const analysis::WrittenResults* written) {
  const auto open = [&](const std::string& name, std::optional<GrowingFile>& file, std::string_view header) {
    if (written) {
      file.emplace(path_ / name, size_in(*written, name));
      return;
    }
    file.emplace(path_ / name);
    file->append(header);
  };
  const auto open_collection = [&](const std::string& name, std::optional<FieldCollection>& collection) {
    if (written)
      collection.emplace(path_ / name, size_in(*written, name));
    else
      collection.emplace(path_ / name);
  };
  open("contact.csv", contact_table_, contact_table_header_of(model.analysis));
  open("convergence.csv", convergence_table_, convergence_table_header);
  if (model::has_growth(model)) open("cracks.csv", crack_table_, crack_table_header);
  if (history_.wanted()) open("history.csv", history_table_, history_.header());
  if (history_table_ && written) {  // its last row is that of the checkpoint
    std::ifstream stream(history_table_->path(), std::ios::binary);
    history_.restore(std::string((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>()));
  }
  for (const PointTable table : point_tables) {
    if (!wanted(model.output, table)) continue;
    point_files_.emplace_back();
    point_files_.back().table = table;
    open(std::string(file_of(table)), point_files_.back().file, header_of(table));
  }
  if (output_.fields.any_of_bodies()) open_collection("fields.pvd", fields_collection_);
  if (output_.fields.contact && !model.contacts.empty()) open_collection("contact.pvd", contact_collection_);
  open("log.txt", log_, "");
}

std::vector<GrowingFile*> ResultsDirectory::growing_files() {
  std::vector<GrowingFile*> files;
  for (auto* file : {&contact_table_, &convergence_table_, &crack_table_, &history_table_, &log_})
    if (*file) files.push_back(&**file);
  for (PointFile& of : point_files_) files.push_back(&*of.file);
  for (auto* collection : {&fields_collection_, &contact_collection_})
    if (*collection) files.push_back(&(*collection)->file());
  return files;
}

analysis::WrittenResults ResultsDirectory::written() {
  const Stopwatch writing(write_seconds_);
  analysis::WrittenResults written{finished_, fields_written_, log_begun_, {}, warnings_};
  for (const fs::path& file : not_synchronised_) synchronise_file(file);
  not_synchronised_.clear();
  for (GrowingFile* file : growing_files()) {
    file->synchronise();
    written.files.push_back({file->path().filename().string(), file->size()});
  }
  return written;
}

void ResultsDirectory::add(const analysis::StaticSolution& solution, const analysis::IncrementResult& increment) {
  Reached before = reached();
  try {
    add_files(solution, increment);
  } catch (const WriteError&) {
    take_back(std::move(before));
    try {  // there is room for what was removed
      const auto of = std::find_if(solution.increments.begin(), solution.increments.end(),
                                   [&](const analysis::IncrementResult& one) { return &one == &increment; });
      replace_file(path_ / "summary.json",
                   summary_content(solution, complete(solution.timing), true, history_.extremes(),
                                   static_cast<std::size_t>(of - solution.increments.begin())));
    } catch (const WriteError&) {
    }
    throw;
  }
  const Stopwatch writing(write_seconds_);
  if (Clock::now() >= next_summary_) write_running_summary(solution);
}

ResultsDirectory::Reached ResultsDirectory::reached() {
  Reached reached;
  for (const GrowingFile* file : growing_files()) reached.sizes.push_back(file->size());
  reached.finished = finished_;
  reached.fields_written = fields_written_;
  reached.log_begun = log_begun_;
  reached.not_synchronised = not_synchronised_.size();
  reached.extremes = history_.extremes();
  return reached;
}

void ResultsDirectory::take_back(Reached before) {
  const std::vector<GrowingFile*> files = growing_files();
  for (std::size_t i = 0; i < files.size(); ++i) files[i]->cut_back(before.sizes[i]);
  finished_ = before.finished;
  fields_written_ = before.fields_written;
  log_begun_ = before.log_begun;
  not_synchronised_.resize(before.not_synchronised);
  history_.take_back(std::move(before.extremes));
  remove_later_fields(path_, fields_written_);
}

/// What was prepared for another mesh is prepared again.
void ResultsDirectory::follow_mesh(const analysis::StaticSolution& solution) {
  if (solution.pairings == pairings_) return;
  pairings_ = solution.pairings;
  recovery_.reset();
  packed_grid_ = {};
  for (PointFile& of : point_files_) of.evaluation.reset();
}

void ResultsDirectory::add_files(const analysis::StaticSolution& solution, const analysis::IncrementResult& increment) {
  follow_mesh(solution);
  // What takes long comes first and may be interrupted; from the first file on, all files of an increment are written.
  std::vector<std::string> points;
  std::optional<std::string> fields;
  if (increment.converged) {
    const int number = finished_ + 1;
    points = point_rows(solution, increment);
    const bool with_fields = number % output_.every == 0 || may_be_last(solution.model, increment);
    if (with_fields && fields_collection_ && !in_parts()) fields = fields_of_bodies(solution, increment);
    const Interruptible nobody(nullptr);
    finished_ = number;
    if (with_fields) write_fields(solution, increment, fields);
    const Stopwatch writing(write_seconds_);
    contact_table_->append(contact_table_rows(increment, solution.model.analysis));
    if (crack_table_) crack_table_->append(crack_table_rows(increment));
    if (history_table_) history_table_->append(history_.row(solution, increment));
    for (std::size_t i = 0; i < points.size(); ++i) point_files_[i].file->append(points[i]);
  }
  const Interruptible nobody(nullptr);
  const Stopwatch writing(write_seconds_);
  convergence_table_->append(convergence_table_rows(increment));
  begin_log(solution);
  log_->append(report_increment(solution.model, increment));
}

/// The content of the file.
std::string ResultsDirectory::fields_of_bodies(const analysis::StaticSolution& solution,
                                               const analysis::IncrementResult& increment) {
  std::optional<Fields> fields;
  {
    const Stopwatch recovering(recover_seconds_);
    if (!recovery_) recovery_.emplace(solution);
    fields = recovery_->fields(solution, increment.fields);
    if (output_.fields.displacement && model::is_dynamic(solution.model))
      fields->velocity = recovery_->fields(solution, analysis::with_velocities(increment).fields).displacement;
  }
  const Stopwatch writing(write_seconds_);
  if (increment.absent.empty())
    return vtu_content(recovery_->grid(), *fields, output_.fields, solution.threads, {}, &packed_grid_);
  const GridFields there = without_bodies(recovery_->grid(), *fields, increment.absent);
  return vtu_content(there.grid, there.fields, output_.fields, solution.threads);
}

/// Collections are written last, because they may name only complete files.
void ResultsDirectory::write_fields(const analysis::StaticSolution& solution,
                                    const analysis::IncrementResult& increment,
                                    const std::optional<std::string>& of_bodies) {
  if (in_parts()) {
    const Stopwatch writing(write_seconds_);
    const std::string stem = fmt::format("fields_{:04d}", finished_);
    const std::vector<std::string> parts = parts_->write(solution, increment, path_, stem);
    replace_file(path_ / (stem + ".pvtu"), pvtu_content(output_.fields, parts));
    for (const std::string& part : parts) not_synchronised_.push_back(path_ / part);
    not_synchronised_.push_back(path_ / (stem + ".pvtu"));
    fields_collection_->add(pseudo_time(increment), stem + ".pvtu");
  } else if (of_bodies) {
    const Stopwatch writing(write_seconds_);
    const std::string file = fmt::format("fields_{:04d}.vtu", finished_);
    replace_file(path_ / file, *of_bodies);
    not_synchronised_.push_back(path_ / file);
    fields_collection_->add(pseudo_time(increment), file);
  }
  if (contact_collection_) {
    const Stopwatch writing(write_seconds_);
    const std::string file = fmt::format("contact_{:04d}.vtu", finished_);
    replace_file(path_ / file, vtu_content(contact_lines(increment, solution.model.analysis)));
    not_synchronised_.push_back(path_ / file);
    contact_collection_->add(pseudo_time(increment), file);
  }
  fields_written_ = finished_;
}

std::filesystem::path ResultsDirectory::problem_file(const analysis::IncrementResult& increment,
                                                     std::size_t attempt) const {
  const fs::path folder = path_ / problems_name;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw WriteError("cannot create the directory", folder, error.message());
  std::string name = fmt::format("{}_{}", increment.step_name, increment.increment);
  if (attempt + 1 < increment.attempts.size()) name += fmt::format(".attempt_{}", attempt + 1);
  return folder / (name + ".hdf5");
}

/// Rows of the tables of points, one text for each file.
std::vector<std::string> ResultsDirectory::point_rows(const analysis::StaticSolution& solution,
                                                      const analysis::IncrementResult& increment) {
  std::vector<std::string> rows;
  if (point_files_.empty()) return rows;
  const Stopwatch writing(write_seconds_);
  mesh::OutputPoints points;
  int increments = 0;
  if (!point_files_.front().evaluation) {
    points = mesh::output_points(solution.model);
    for (const model::Step& step : solution.model.steps) increments += model::expected_increments(step);
  }
  for (PointFile& of : point_files_) {
    if (!of.evaluation) {
      auto& list = of.table == PointTable::points  ? points.points
                   : of.table == PointTable::lines ? points.lines
                                                   : points.grid;
      of.evaluation.emplace(solution, std::move(list), increments);
      if (written_before_ == 0 && pairings_ == 0)
        warnings_.insert(warnings_.end(), of.evaluation->warnings().begin(), of.evaluation->warnings().end());
    }
    rows.push_back(point_table_rows(of.table, *of.evaluation, solution, increment));
  }
  return rows;
}

namespace {

bool has_many_cells(const mesh::Mesh& mesh) {
  return std::any_of(mesh.bodies.begin(), mesh.bodies.end(),
                     [](const mesh::BodyMesh& body) { return body.cells.size() > 1; });
}

}  // namespace

void ResultsDirectory::finish(const analysis::StaticSolution& solution) {
  // If the run ended early, the last converged increment was not known to be the last. If it ended after pairs had been
  // found anew, the mesh of that increment is no longer there.
  const auto last = std::find_if(solution.increments.rbegin(), solution.increments.rend(), [](const auto& increment) {
    return increment.converged && !increment.fields.displacements.empty();
  });
  if (fields_written_ < finished_ && last != solution.increments.rend())
    write_fields(solution, *last,
                 fields_collection_ && !in_parts() ? std::optional(fields_of_bodies(solution, *last)) : std::nullopt);
  if (fields_collection_ && last != solution.increments.rend() && has_many_cells(solution.mesh)) {
    const Stopwatch writing(write_seconds_);
    replace_file(path_ / cells_name, vtu_content(cell_polygons(solution, last->fields), solution.threads));
  }
  {
    const Stopwatch writing(write_seconds_);
    if (has_iterations(solution)) replace_file(path_ / "convergence.svg", convergence_plot(solution));
    if (solution.mechanism)
      replace_file(path_ / mechanism_name,
                   vtu_content(mechanism_cells(solution, *solution.mechanism), solution.threads));
    begin_log(solution);
    for (const std::string& warning : warnings_) log_->append("warning: " + warning + "\n");
    log_->append(report_end(solution, complete(solution.timing)));
  }
  // Not counted in `write`, because a file cannot contain the time of its own writing.
  replace_file(path_ / "summary.json",
               summary_content(solution, complete(solution.timing), false, history_.extremes()));
}

analysis::Timing ResultsDirectory::complete(analysis::Timing timing) const {
  timing.recover += recover_seconds_;
  timing.write += write_seconds_;
  return timing;
}

double ResultsDirectory::pseudo_time(const analysis::IncrementResult& increment) const {
  return time_of(increment, in_time_);
}

/// Any increment of a step that looks for a limit may be its last equilibrium.
bool ResultsDirectory::may_be_last(const model::Model& model, const analysis::IncrementResult& increment) const {
  return increment.step == steps_ && (increment.reached == 1.0 || model.steps.back().limit);
}

void ResultsDirectory::begin_log(const analysis::StaticSolution& solution) {
  if (log_begun_) return;
  log_->append(report_header(solution.model, sizes_of(solution)) + report_passes(solution));
  log_begun_ = true;
}

/// For long runs the file is long: writing it may take a twentieth of the time.
void ResultsDirectory::write_running_summary(const analysis::StaticSolution& solution) {
  const Clock::time_point start = Clock::now();
  replace_file(path_ / "summary.json", summary_content(solution, complete(solution.timing), true, history_.extremes()));
  const Clock::time_point end = Clock::now();
  next_summary_ = end + 20 * (end - start);
}

}  // namespace scabo::result
