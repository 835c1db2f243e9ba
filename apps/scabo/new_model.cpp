// `scabo new`: a model to begin with.
#include "new_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "commands.hpp"
#include "scabo/base/error.hpp"
#include "scabo/input/read_model.hpp"
#include "scabo/result/files.hpp"
#include "terminal.hpp"

namespace scabo::app {

ExitStatus write_new_model(const NewOptions& options) {
  const auto& models = starter_models();
  const auto model = std::find_if(models.begin(), models.end(), [&](const auto& m) { return m.name == options.kind; });
  ensure(model != models.end(), "the command line accepts only the kinds there are");
  const std::filesystem::path file = options.output.empty() ? options.kind + ".yaml" : options.output.string();
  std::error_code ignored;
  if (std::filesystem::exists(std::filesystem::symlink_status(file, ignored)))
    throw InputError(file.string(), {{{}, "exists: remove it, or name another file with -o"}});
  result::write_file(file, model->text);
  print_output(fmt::format("{}: {}. Solve it with `scabo run {}`\n", file.string(), model->subject, file.string()));
  const std::filesystem::path schema = file.parent_path() / "model.schema.json";
  if (std::filesystem::exists(std::filesystem::symlink_status(schema, ignored))) return ExitStatus::solved;
  result::write_file(schema, fmt::format("{}\n", input::model_schema()));
  print_output(fmt::format("{}: editors complete and check the model by it\n", schema.string()));
  return ExitStatus::solved;
}

}  // namespace scabo::app
