// `scabo convert`: from a deck of Abaqus or CalculiX to a model file and a mesh file.
#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "commands.hpp"
#include "scabo/analysis/space/posed_solids.hpp"
#include "scabo/analysis/static_analysis.hpp"
#include "scabo/convert/convert_abaqus.hpp"
#include "scabo/files/read_deck_file.hpp"
#include "scabo/input/read_model.hpp"
#include "scabo/input/space/read_solid_model.hpp"
#include "scabo/model/wording.hpp"
#include "scabo/result/files.hpp"
#include "scabo/run/sizes.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

namespace fs = std::filesystem;

/// `2 bodies, 1 support`, of what there is.
std::string counts_of(const convert::Conversion& made) {
  std::string text = made.bodies == 1 ? "1 body" : fmt::format("{} bodies", made.bodies);
  for (const auto& [count, noun] :
       {std::pair(made.supports, "support"), std::pair(made.loads, "load"), std::pair(made.contacts, "contact"),
        std::pair(made.ties, "tie"), std::pair(made.steps, "step")})
    if (count > 0) text += ", " + model::counted(count, noun);
  return text;
}

}  // namespace

ExitStatus convert_deck(const ConvertOptions& options) {
  const fs::path file = options.output.empty() ? fs::path(options.deck).replace_extension("yaml") : options.output;
  const fs::path mesh_file = file.parent_path() / (file.stem().string() + "_mesh.inp");
  for (const fs::path& path : {file, mesh_file}) {
    std::error_code error;
    if (fs::equivalent(path, options.deck, error))
      throw InputError(path.string(), {{{}, "is the deck itself: name another file with -o"}});
    if (!options.force && fs::exists(fs::symlink_status(path, error)))
      throw InputError(path.string(),
                       {{{}, "exists: remove it, replace it with --force, or name another file with -o"}});
  }
  const convert::Conversion made = convert::convert_abaqus(files::read_deck_file(options.deck), options.deck,
                                                           mesh_file.filename().string(), options.rigid_contact);
  int lost = 0;
  for (const bool essential : {true, false})
    for (const convert::Remark& remark : made.remarks) {
      if (remark.essential != essential) continue;
      lost += essential;
      print_to_stderr(
          fmt::format("{}:{}: {}{}\n", remark.at.file, remark.at.line, essential ? "" : "warning: ", remark.text));
    }
  if (lost > 0 && !options.incomplete) {
    print_error(
        fmt::format("no model is written, because it would not be that of the deck: correct the {} above, or take what "
                    "there is with "
                    "--incomplete",
                    lost == 1 ? "line" : fmt::format("{} lines", lost)));
    return ExitStatus::wrong_input;
  }
  result::replace_file(file, made.model);
  result::replace_file(mesh_file, made.mesh);
  std::string sizes;
  try {
    if (made.in_space) {
      const auto model = std::get<model::SpaceModel>(input::read_any_model(file.string()));
      Eigen::Index nodes = 0;
      for (const auto& body : analysis::pose_solids(model).model.bodies) nodes += body.mesh.nodes.cols();
      sizes = model::counted(nodes, "node");
      for (const Warning& warning : model.warnings) print_warning(warning.text);
    } else {
      const model::Model model = input::read_model(file.string(), {});
      sizes = run::describe_sizes(run::sizes_of(model, analysis::check(model)));
      for (const Warning& warning : model.warnings) print_warning(warning.text);
    }
  } catch (const InputError& error) {
    print_mistakes(error);
    print_error("the deck is converted, but Scabo cannot analyse the model: correct it, or the deck");
    return ExitStatus::wrong_input;
  }
  print_output(fmt::format("{}: {} ({}). Mesh: {}. Solve it with `scabo run {}`\n", file.string(), counts_of(made),
                           sizes, mesh_file.string(), file.string()));
  return lost > 0 ? ExitStatus::wrong_input : ExitStatus::solved;
}

}  // namespace scabo::app
