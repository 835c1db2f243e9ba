#include "scabo/analysis/state/checkpoint_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace scabo::analysis {

namespace {

namespace fs = std::filesystem;

/// Waits until the file is on the disk.
void synchronise(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail_to_keep(path, errno);
  const int error = ::fsync(descriptor) != 0 && errno != EINVAL ? errno : 0;  // some file systems cannot
  ::close(descriptor);
  if (error != 0) fail_to_keep(path, error);
}

[[noreturn]] void refuse_checkpoint(const fs::path& path, std::string message) {
  throw InputError(path.string(), {{{}, std::move(message)}});
}

}  // namespace

void fail_to_keep(const fs::path& path, int error) {
  throw std::runtime_error(fmt::format("cannot write {}: {}", path.string(), std::system_category().message(error)));
}

void put_in_place(const fs::path& written, const fs::path& file) {
  synchronise(written);
  std::error_code error;
  fs::rename(written, file, error);
  if (error) fail_to_keep(file, error.value());
  synchronise(file.parent_path());
}

bool has_checkpoint(const fs::path& directory) {
  std::error_code error;
  return fs::exists(directory / checkpoint_name, error);
}

void refuse_damaged_checkpoint(const fs::path& directory) {
  refuse_checkpoint(directory / checkpoint_name, "the checkpoint is damaged: run the model again with `scabo run`");
}

void check_checkpoint(const fs::path& directory, const std::string& version) {
  if (!has_checkpoint(directory))
    refuse_checkpoint(directory,
                      "there is no checkpoint to resume from: analyses of one increment and modal analyses write none; "
                      "run the model again with `scabo run`");
  std::string written_by;
  try {
    written_by = Unsealing(directory / checkpoint_name, checkpoint_mark).first_text();
  } catch (const InputError&) {
    refuse_damaged_checkpoint(directory);
  } catch (const std::out_of_range&) {
    refuse_damaged_checkpoint(directory);
  }
  if (!written_by.empty() && written_by != version)
    refuse_checkpoint(directory / checkpoint_name,
                      fmt::format("the checkpoint was written by Scabo {}, and this is {}: resume with that version, "
                                  "or run the model again with `scabo run`",
                                  written_by, version));
}

}  // namespace scabo::analysis
