#include "scabo/contact/files/saved_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "scabo/base/impossible_path.hpp"
#include "scabo/contact/files/fclib.hpp"
#include "scabo/contact/files/hdf5_file.hpp"
#include "scabo/contact/files/text_problem.hpp"
#include "scabo/contact/judge.hpp"
#include "scabo/linalg/dense.hpp"

namespace scabo::contact {

namespace {

/// Residuals contain squares of motions and of the forces q / W, which must not overflow.
void check_magnitudes(const std::string& file, const Problem& problem) {
  constexpr double most = 1e150;
  const double motion = linalg::largest_of(problem.q), stiffness = stiffness_of(problem);
  const double force = std::max(stiffness * motion, linalg::largest_of(problem.f));
  if (motion <= most && force <= most) return;
  throw InputError(file, {{{},
                           fmt::format("has motions q up to {:.1g} and a mean stiffness 1 / W_ii of {:.1g}: motions "
                                       "and the forces that follow may be at most {:.0e}; use other units",
                                       motion, stiffness, most)}});
}

}  // namespace

SavedProblem read_problem_file(const std::string& file) {
  namespace fs = std::filesystem;
  const auto refuse = [&](const std::string& why) { throw InputError(file, {{{}, why}}); };
  if (const std::string why = impossible_path(file); !why.empty()) refuse(why);
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) refuse("no such file");
  if (fs::is_directory(status)) refuse("is a directory: name a problem file");
  if (!fs::is_regular_file(status)) refuse("is not a regular file");
  if (fs::file_size(file, error) == 0) refuse("is empty");
  const bool hdf5 = is_hdf5(file);
  // The name is that of an HDF5 file but the content is not. Reading it as text would fail at the first byte with a
  // misleading message.
  const std::string ending = fs::path(file).extension().string();
  if (!hdf5 && (ending == ".hdf5" || ending == ".h5" || ending == ".hdf"))
    refuse("is not an HDF5 file: the signature with which one begins is missing");
  SavedProblem saved = hdf5 ? read_fclib(file) : read_text_problem(file);
  check_magnitudes(file, saved.problem);
  return saved;
}

}  // namespace scabo::contact
