#include "scabo/contact/files/saved_problem.hpp"

#include <filesystem>

#include "scabo/contact/files/fclib.hpp"
#include "scabo/contact/files/hdf5_file.hpp"
#include "scabo/contact/files/text_problem.hpp"

namespace scabo::contact {

SavedProblem read_problem_file(const std::string& file) {
  namespace fs = std::filesystem;
  const auto refuse = [&](const char* why) { throw InputError(file, {{{}, why}}); };
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) refuse("no such file");
  if (fs::is_directory(status)) refuse("is a directory: name a problem file");
  if (!fs::is_regular_file(status)) refuse("is not a regular file");
  if (is_hdf5(file)) return read_fclib(file);
  // The name is that of an HDF5 file but the content is not. Reading it as text would fail at the first byte with a
  // misleading message.
  const std::string ending = fs::path(file).extension().string();
  if (ending == ".hdf5" || ending == ".h5" || ending == ".hdf")
    refuse("is not an HDF5 file: it is empty, damaged or of another format; use a complete copy");
  if (fs::file_size(file, error) == 0) refuse("is empty");
  return read_text_problem(file);
}

}  // namespace scabo::contact
