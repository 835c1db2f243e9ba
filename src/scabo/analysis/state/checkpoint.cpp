#include "scabo/analysis/state/checkpoint.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "scabo/analysis/state/checkpoint_file.hpp"
#include "scabo/analysis/state/fields.hpp"
#include "scabo/analysis/state/increment_record.hpp"

namespace scabo::analysis {

namespace {

namespace fs = std::filesystem;

constexpr const char* records_name = "checkpoint.increments";
constexpr std::string_view records_mark = "scabo checkpoint\n";

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string content((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file.is_open() || file.bad()) throw InputError(path, {{{}, "cannot be read"}});
  return content;
}

template <typename Io>
void exchange_state(Io& io, RunState& run) {
  exchange_integer(io, "state/step", run.step);
  exchange_integer(io, "state/increment", run.progress.increment);
  exchange_scalars(io, "state/progress", {&run.progress.reached, &run.progress.size, &run.progress.limit});
  for (const Field& field : fields_of_state()) {
    std::vector<double> numbers = field.get(run.state);
    io.numbers(std::string("state/") + field.name, numbers);
    if constexpr (Io::reads) field.set(run.state, numbers);
  }
}

template <typename Io>
void exchange_warnings(Io& io, std::vector<Warning>& warnings) {
  std::vector<int> kinds;
  std::vector<std::string> subjects, texts;
  for (const Warning& warning : warnings) {
    kinds.push_back(static_cast<int>(warning.kind));
    subjects.push_back(warning.subject);
    texts.push_back(warning.text);
  }
  io.integers("warnings/kinds", kinds);
  exchange_texts(io, "warnings/subjects", subjects);
  exchange_texts(io, "warnings/texts", texts);
  if constexpr (Io::reads) {
    warnings.clear();
    for (std::size_t i = 0; i < kinds.size(); ++i)
      warnings.push_back({static_cast<WarningKind>(kinds[i]), subjects.at(i), texts.at(i)});
  }
}

/// All but the increments, of which `count` are in the other file.
template <typename Io>
void exchange_checkpoint(Io& io, Checkpoint& of, int& count) {
  exchange_origin(io, of.origin);
  exchange_results(io, of.results);
  Timing& t = of.from.timing;
  exchange_scalars(io, "timing",
                   {&t.read, &t.mesh, &t.super_elements, &t.assemble, &t.factorise, &t.condense, &t.newton, &t.recover,
                    &t.write, &t.total});
  exchange_integer(io, "increments/count", count);
  double bytes = static_cast<double>(of.increments_bytes);
  exchange_scalars(io, "increments/bytes", {&bytes});
  of.increments_bytes = static_cast<long long>(bytes);
  if (count == 0) return;
  exchange_state(io, of.from.at);
  exchange_warnings(io, of.from.warnings);
}

/// Puts `bytes` at `position`, the end of the part of the file that counts.
void append_records(const fs::path& path, long long position, std::string_view bytes) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) fail_to_keep(path, errno);
  int error = 0;
  while (!bytes.empty() && error == 0) {
    const ssize_t written = ::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(position));
    if (written < 0) {
      if (errno != EINTR) error = errno;
      continue;
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
    position += written;
  }
  if (error == 0 && ::fdatasync(descriptor) != 0 && errno != EINVAL) error = errno;
  ::close(descriptor);
  if (error != 0) fail_to_keep(path, error);
}

/// Length and digest of a record stand before it.
constexpr std::size_t of_head = 2 * sizeof(std::uint64_t);
std::string with_head(const std::string& record) {
  const std::uint64_t head[] = {record.size(), digest(record)};
  return std::string(reinterpret_cast<const char*>(head), of_head) + record;
}

/// Throws std::out_of_range for anything else than `count` records.
std::vector<IncrementResult> read_records(std::string_view content, int count) {
  if (!content.starts_with(records_mark)) throw std::out_of_range("no records");
  content.remove_prefix(records_mark.size());
  std::vector<IncrementResult> increments;
  for (int i = 0; i < count; ++i) {
    std::uint64_t head[2];
    if (content.size() < of_head) throw std::out_of_range("a record is missing");
    std::copy_n(content.data(), of_head, reinterpret_cast<char*>(head));
    content.remove_prefix(of_head);
    if (content.size() < head[0]) throw std::out_of_range("a record is cut off");
    const std::string_view record = content.substr(0, head[0]);
    if (digest(record) != head[1]) throw std::out_of_range("a record has changed");
    increments.push_back(increment_of(record));
    content.remove_prefix(head[0]);
  }
  return increments;
}

}  // namespace

SourceFile source_of(const std::string& path, std::string_view content) { return {path, hexadecimal(digest(content))}; }

SourceFile source_file(const std::string& path) { return source_of(path, content_of(path)); }

Checkpoint read_checkpoint(const fs::path& directory, const std::string& version) {
  Checkpoint checkpoint;
  read_checkpoint_file(directory, version, [&](Unsealing& io) {
    int count = 0;
    exchange_checkpoint(io, checkpoint, count);
    io.finish();
    if (count == 0) return;
    const std::string records = content_of((directory / records_name).string());
    if (checkpoint.increments_bytes > static_cast<long long>(records.size()))
      throw std::out_of_range("records are missing");
    checkpoint.from.increments =
        read_records(std::string_view(records).substr(0, static_cast<std::size_t>(checkpoint.increments_bytes)), count);
  });
  return checkpoint;
}

void remove_checkpoint(const fs::path& directory) noexcept {
  std::error_code ignored;
  const std::string name = checkpoint_name;
  for (const std::string& of : {name, name + ".new", std::string(records_name)}) fs::remove(directory / of, ignored);
}

CheckpointWriter::CheckpointWriter(fs::path directory, Checkpoint begun)
    : directory_(std::move(directory)), checkpoint_(std::move(begun)) {
  recorded_ = checkpoint_.from.increments.size();
  if (recorded_ > 0) return;  // the files are there
  append_records(directory_ / records_name, 0, records_mark);
  checkpoint_.increments_bytes = static_cast<long long>(records_mark.size());
  replace();
}

void CheckpointWriter::write(const RunState& run, const StaticSolution& solution, WrittenResults results,
                             const Timing& timing) {
  std::string records;
  for (; recorded_ < solution.increments.size(); ++recorded_)
    records += with_head(record_of(solution.increments[recorded_]));
  append_records(directory_ / records_name, checkpoint_.increments_bytes, records);
  checkpoint_.increments_bytes += static_cast<long long>(records.size());
  checkpoint_.results = std::move(results);
  checkpoint_.from.timing = timing;
  checkpoint_.from.warnings = solution.warnings;
  RunState& at = checkpoint_.from.at;
  at.step = run.step;
  at.progress = run.progress;
  at.state = run.state;  // without what follows from it (complete())
  const bool in_time = !at.state.velocity.empty();
  at.state.forces.clear(), at.state.prescribed.clear();
  if (!in_time) at.state.u.clear(), at.state.reactions.clear();
  replace();
}

void CheckpointWriter::replace() {
  int count = static_cast<int>(recorded_);
  write_checkpoint_file(directory_, [&](Sealing& io) { exchange_checkpoint(io, checkpoint_, count); });
}

}  // namespace scabo::analysis
