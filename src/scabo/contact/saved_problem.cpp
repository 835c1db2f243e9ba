#include "scabo/contact/saved_problem.hpp"

#include <filesystem>

#include "scabo/contact/fclib.hpp"
#include "scabo/contact/hdf5_file.hpp"
#include "scabo/contact/text_problem.hpp"

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
  // By its name an HDF5 file, by its content not: read as text it would fail at its first byte for a reason
  // that helps nobody.
  const std::string ending = fs::path(file).extension().string();
  if (ending == ".hdf5" || ending == ".h5" || ending == ".hdf")
    refuse("is not an HDF5 file: it is empty, damaged or of another format; use a complete copy");
  if (fs::file_size(file, error) == 0) refuse("is empty");
  return read_text_problem(file);
}

}  // namespace scabo::contact
