// The file of a checkpoint in a results directory, of models in the plane and in space: replaced as a whole (written
// beside, synchronised with the disk, renamed), so that there is always a complete one.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "scabo/analysis/state/checkpoint.hpp"
#include "scabo/analysis/state/sealed_file.hpp"

namespace scabo::analysis {

inline constexpr const char* checkpoint_name = "checkpoint.state";
inline constexpr const char* checkpoint_mark = "scabo_checkpoint\n";

template <typename Io>
void exchange_origin(Io& io, RunOrigin& origin) {
  io.text("version", origin.version);
  io.text("origin/model", origin.model);
  io.text("origin/folder", origin.folder);
  io.text("origin/beside", origin.beside);
  exchange_texts(io, "origin/settings", origin.settings);
  exchange_integer(io, "origin/threads", origin.threads);
  origin.files.resize(exchange_count(io, "origin/files/count", origin.files.size()));
  for (std::size_t i = 0; i < origin.files.size(); ++i) {
    io.text(fmt::format("origin/files/path_{}", i), origin.files[i].path);
    io.text(fmt::format("origin/files/digest_{}", i), origin.files[i].digest);
  }
}

template <typename Io>
void exchange_results(Io& io, WrittenResults& results) {
  exchange_integer(io, "results/finished", results.finished);
  exchange_integer(io, "results/fields_written", results.fields_written);
  exchange_integer(io, "results/log_begun", results.log_begun);
  exchange_texts(io, "results/warnings", results.warnings);
  results.files.resize(exchange_count(io, "results/files/count", results.files.size()));
  for (std::size_t i = 0; i < results.files.size(); ++i) {
    WrittenResults::File& file = results.files[i];
    io.text(fmt::format("results/files/name_{}", i), file.name);
    double bytes = static_cast<double>(file.bytes);  // exact to 2^53
    exchange_scalars(io, fmt::format("results/files/bytes_{}", i), {&bytes});
    file.bytes = static_cast<long long>(bytes);
  }
}

/// Throws std::runtime_error with the reason `error` of the system.
[[noreturn]] void fail_to_keep(const std::filesystem::path& path, int error);
/// Makes the file that was written beside the one of the directory, when it is on the disk.
void put_in_place(const std::filesystem::path& written, const std::filesystem::path& file);

/// `exchange` writes the values. Throws std::runtime_error.
template <typename Exchange>
void write_checkpoint_file(const std::filesystem::path& directory, const Exchange& exchange) {
  const std::filesystem::path written = directory / (std::string(checkpoint_name) + ".new");
  Sealing io(checkpoint_mark);
  exchange(io);
  io.write(written);
  put_in_place(written, directory / checkpoint_name);
}

/// Throws InputError: there is no checkpoint, or another version of the program wrote it.
void check_checkpoint(const std::filesystem::path& directory, const std::string& version);
[[noreturn]] void refuse_damaged_checkpoint(const std::filesystem::path& directory);

/// `read` reads the values, and finishes. Throws InputError if there is no checkpoint, if it is damaged, or if another
/// version of the program wrote it.
template <typename Read>
void read_checkpoint_file(const std::filesystem::path& directory, const std::string& version, const Read& read) {
  check_checkpoint(directory, version);
  try {
    Unsealing io(directory / checkpoint_name, checkpoint_mark);
    read(io);
  } catch (const InputError&) {
    refuse_damaged_checkpoint(directory);
  } catch (const std::out_of_range&) {
    refuse_damaged_checkpoint(directory);
  } catch (const std::length_error&) {
    refuse_damaged_checkpoint(directory);
  }
}

}  // namespace scabo::analysis
