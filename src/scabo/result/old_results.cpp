#include "scabo/result/old_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <system_error>
#include <vector>

#include "scabo/model/restart_files.hpp"
#include "scabo/result/contact_table.hpp"
#include "scabo/result/convergence.hpp"
#include "scabo/result/crack_table.hpp"
#include "scabo/result/history.hpp"
#include "scabo/result/point_tables.hpp"
#include "scabo/result/vtu.hpp"

namespace scabo::result {

namespace fs = std::filesystem;

constexpr std::string_view unfinished = ".part";  // as in replace_file

bool is_vtu_name(const std::string& name, std::string_view begin) {
  if (!name.starts_with(begin)) return false;
  std::string_view rest = std::string_view(name).substr(begin.size());
  if (rest.ends_with(unfinished)) rest.remove_suffix(unfinished.size());
  const auto digits = [&] {
    const std::size_t count = std::min(rest.find_first_not_of("0123456789"), rest.size());
    rest.remove_prefix(count);
    return count;
  };
  if (digits() < 4) return false;
  if (rest.starts_with('_')) {
    rest.remove_prefix(1);
    return digits() > 0 && rest == ".vtu";
  }
  return rest == ".vtu" || rest == ".pvtu";
}

namespace {

/// Text at the beginning of a result file; nothing for names that are not results.
std::optional<std::string_view> mark_of(const std::string& name) {
  if (is_vtu_name(name, "fields_") || is_vtu_name(name, "contact_")) return vtk_mark;
  if (name == "fields.pvd" || name == "contact.pvd") return vtk_mark;
  if (name == cells_name || name == std::string(cells_name) + ".part") return vtk_mark;
  if (name == mechanism_name || name == std::string(mechanism_name) + ".part") return vtk_mark;
  if (name == "summary.json" || name == "summary.json.part") return "{\n  \"scabo\":";
  if (name == "contact.csv") return "step,increment,contact,pair,x,y,";  // in the plane and in space
  if (name == "cracks.csv") return crack_table_header;
  if (name == "history.csv") return history_mark;
  if (name == "convergence.csv") return convergence_table_header;
  if (name == "convergence.svg" || name == "convergence.svg.part") return convergence_plot_mark;
  if (name == "log.txt") return "Scabo ";
  if (name == "checkpoint.state" || name == "checkpoint.state.new") return "scabo_checkpoint";
  if (name == model::state_at_end_file) return "scabo_end";
  if (name == model::factors_at_end_file) return "# Scabo: factors";
  if (name == std::string(model::state_at_end_file) + ".part") return "scabo_end";
  if (name == "checkpoint.increments") return "scabo checkpoint";
  for (const PointTable table : point_tables)
    if (name == file_of(table)) return "step,increment,name,body,x,y,";  // in the plane and in space
  return std::nullopt;
}

/// Also true for a file that a full disk or a kill left empty: nothing is lost by removing it.
bool written_by_scabo(const fs::path& file, std::string_view mark) {
  std::array<char, 4096> beginning{};  // an HDF5 file has the names of its groups there
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return false;  // opening a pipe would wait for its other end
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return false;
  stream.read(beginning.data(), beginning.size());
  const std::string_view read(beginning.data(), static_cast<std::size_t>(stream.gcount()));
  return read.empty() || read.find(mark) != std::string_view::npos;
}

/// The message of the system, with a remedy if it lacks one.
std::string reason_of(const std::error_code& error) {
  if (error == std::errc::too_many_symbolic_link_levels)
    return "the symbolic links in its path form a loop: remove them, or choose another directory";
  if (error == std::errc::filename_too_long) return "the name is too long: choose a shorter one";
  if (error == std::errc::permission_denied || error == std::errc::read_only_file_system)
    return error.message() + ": choose a directory that you may write to";
  if (error == std::errc::not_a_directory) return "a part of the path is a file, not a directory";
  return error.message();
}

void create(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found && fs::is_symlink(fs::symlink_status(path, error)))
    throw WriteError("cannot write results to", path,
                     "it is a symbolic link to a directory that does not exist: make that, or choose another one");
  if (fs::exists(status) && !fs::is_directory(status))
    throw WriteError("cannot write results to", path, "it is a file, not a directory: choose another name");
  fs::create_directories(path, error);
  if (error) throw WriteError("cannot create the directory", path, reason_of(error));
}

/// The discrete problems of an earlier run: HDF5 files with the group `scabo`, whose name occurs near the beginning.
void add_old_problems(const fs::path& path, std::vector<fs::path>& old) {
  std::error_code error;
  const auto refuse = [&](const std::string& name) {
    throw WriteError(
        "cannot write results to", path.parent_path(),
        fmt::format("Scabo did not write the problems/{} there: move it, or choose another directory", name));
  };
  if (!fs::exists(path, error)) return;
  if (!fs::is_directory(path, error)) refuse("");
  for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() != ".hdf5") continue;
    if (!entry->is_regular_file(error)) refuse(entry->path().filename().string());
    std::string beginning(4096, '\0');
    std::ifstream(entry->path(), std::ios::binary)
        .read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
    if (!beginning.starts_with("\x89HDF") || beginning.find("scabo") == std::string::npos)
      refuse(entry->path().filename().string());
    old.push_back(entry->path());
  }
  if (error) throw WriteError("cannot read the directory", path, error.message());
}

/// Whether the file was there and is now this one. Not on a full disk: what is removed then makes room for it.
bool replaced(const fs::path& file, std::string_view content) try {
  std::error_code error;
  if (content.empty() || !fs::exists(file, error)) return false;
  replace_file(file, content);
  return true;
} catch (const WriteError&) {
  return false;
}

/// Removes the results of an earlier run. All files are checked first, so that an error leaves the directory unchanged.
void remove_old_results(const fs::path& path, std::string_view summary) {
  std::error_code error;
  std::vector<fs::path> old;
  for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
    const auto mark = mark_of(entry->path().filename().string());
    if (!mark) continue;
    if (!written_by_scabo(entry->path(), *mark))
      throw WriteError("cannot write results to", path,
                       fmt::format("Scabo did not write the {} there: move it, or choose another directory",
                                   entry->path().filename().string()));
    old.push_back(entry->path());
  }
  if (error) throw WriteError("cannot read the directory", path, error.message());
  add_old_problems(path / problems_name, old);
  if (replaced(path / "summary.json", summary)) std::erase(old, path / "summary.json");
  for (const fs::path& file : old) {
    fs::remove(file, error);
    if (error) throw WriteError("cannot remove", file, error.message());
  }
  fs::remove(path / problems_name, error);  // only if it is empty
}

}  // namespace

long long size_in(const analysis::WrittenResults& written, const std::string& name) {
  for (const analysis::WrittenResults::File& file : written.files)
    if (file.name == name) return file.bytes;
  return 0;
}

void remove_later_fields(const fs::path& path, int last) {
  std::error_code error;
  std::vector<fs::path> later;
  for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    for (const std::string_view begin : {"fields_", "contact_"})
      if (is_vtu_name(name, begin) && std::atoi(name.c_str() + begin.size()) > last) later.push_back(entry->path());
  }
  for (const fs::path& file : later) fs::remove(file, error);
}

DirectoryLock prepare_directory(const fs::path& path, std::string_view summary) {
  create(path);
  DirectoryLock lock(path);
  remove_old_results(path, summary);
  return lock;
}

}  // namespace scabo::result
