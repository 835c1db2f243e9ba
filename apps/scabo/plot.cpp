// `scabo plot`: pictures of results, and of models that are not solved, by the Python program beside this one
// (python/scabo/plot).
#include "plot.hpp"

#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "commands.hpp"
#include "python_program.hpp"
#include "scabo/analysis/static_analysis.hpp"
#include "scabo/base/error.hpp"
#include "scabo/input/space/read_solid_model.hpp"
#include "scabo/result/files.hpp"
#include "scabo/result/model_drawing.hpp"

namespace scabo::app {

namespace {

namespace fs = std::filesystem;

/// A file that is gone when this is.
class TemporaryFile {
 public:
  TemporaryFile() {
    std::string name = (fs::temp_directory_path() / "scabo_drawing_XXXXXX").string();
    const int file = mkstemp(name.data());
    if (file < 0) throw std::system_error(errno, std::generic_category(), "cannot make a file in " + name);
    close(file);
    path_ = name;
  }
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

ExitStatus draw_model(const model::Model& model, const mesh::Mesh& mesh, std::vector<std::string> arguments) {
  const std::vector<std::string> command = command_of(pictures());
  const TemporaryFile drawing;
  result::write_file(drawing.path(), result::model_drawing(model, mesh));
  arguments.insert(arguments.end(), {"--drawing", drawing.path().string()});
  return static_cast<ExitStatus>(run_and_wait(command, arguments));
}

ExitStatus plot(const std::string& directory, const std::vector<std::string>& arguments) {
  std::error_code ignored;
  if (!fs::is_regular_file(directory, ignored)) return become(command_of(pictures()), arguments);
  const input::AnyModel read = input::read_any_model(directory, {});
  if (std::holds_alternative<model::SpaceModel>(read))
    throw InputError(directory, {{{},
                                  "is of bodies in space, of which there are pictures of results alone: "
                                  "solve it with `scabo run`"}});
  const auto& model = std::get<model::Model>(read);
  return draw_model(model, analysis::check(model), arguments);
}

}  // namespace scabo::app
