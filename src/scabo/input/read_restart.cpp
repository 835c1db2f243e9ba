// `restart`: a directory with the results of another run. Its file of factors tells where the loads of the first step
// start; its state is read by the analysis (analysis/state/restart.hpp).
#include <fmt/format.h>

#include <filesystem>

#include "scabo/files/bytes_of_file.hpp"
#include "scabo/input/reading.hpp"
#include "scabo/input/restart.hpp"
#include "scabo/input/suggestions.hpp"
#include "scabo/input/yaml_document.hpp"
#include "scabo/model/restart_files.hpp"

namespace scabo::input {

namespace fs = std::filesystem;

std::vector<double> EndOfRun::numbers(const char* section, const std::vector<std::string>& names) const {
  std::vector<double> numbers(names.size(), 0.0);
  const MapEntry* entry = factors->find(section);
  if (entry == nullptr || entry->value->kind != Node::Kind::map) return numbers;
  Index index;
  for (std::size_t i = 0; i < names.size(); ++i) index.emplace(names[i], static_cast<int>(i));
  for (const MapEntry& factor : entry->value->entries)
    if (const auto found = index.find(factor.key); found != index.end())
      numbers[static_cast<std::size_t>(found->second)] = std::strtod(factor.value->text.c_str(), nullptr);
  return numbers;
}

std::optional<EndOfRun> read_end_of_run(Report& report, const Value& value, const std::string& model_file) {
  const auto name = read_text(report, value);
  if (!name) return {};
  const fs::path directory = fs::path(model_file).parent_path() / *name, file = directory / factors_at_end_file;
  std::error_code error;
  if (!fs::is_directory(directory, error)) {
    report.error(value,
                 fmt::format("there is no directory {} in the folder of the model: name the results of a run that was "
                             "solved, as in restart: first.results",
                             quoted_name(*name)));
    return {};
  }
  const std::optional<std::string> text = files::bytes_of_file(file);
  std::vector<Diagnostic> mistakes;
  const NodePtr root =
      text && fs::exists(directory / state_at_end_file, error) ? parse_yaml(*text, mistakes) : NodePtr();
  if (!root || root->kind != Node::Kind::map || !mistakes.empty()) {
    report.error(
        value, fmt::format("{} has no state at its end to start from: only a run that was solved, without error bars, "
                           "tolerances and cracks that grow, leaves one; run it again",
                           quoted_name(*name)));
    return {};
  }
  EndOfRun end{*name, {}, root, {file.string(), (directory / state_at_end_file).string()}};
  end.restart.directory = directory.string();
  end.restart.source = value.source();
  return end;
}

std::string tightened_already(const char* what, const std::string& name, const EndOfRun& end) {
  return fmt::format("{} '{}' has been tightened in {} already: leave 'tightened' out", what, name,
                     quoted_name(end.name));
}

namespace {

template <typename Named>
std::vector<std::string> names_of(const std::vector<Named>& list) {
  std::vector<std::string> names;
  for (const Named& of : list) names.push_back(of.name);
  return names;
}

/// Bars that the other run has tightened.
void take_tightened(Reading& reading, const EndOfRun& end) {
  const std::vector<double> tightened = end.numbers("bars", names_of(reading.model.bars));
  for (std::size_t i = 0; i < tightened.size(); ++i)
    if (tightened[i] < 0.0) reading.model.bars[i].tightened = static_cast<int>(tightened[i]);
  for (const auto& [bar, step] : reading.steps_of_bars)
    if (tightened[bar] < 0.0) reading.report.error(step, tightened_already("bar", reading.model.bars[bar].name, end));
}

}  // namespace

void read_restart(Reading& reading, const Value& value) {
  const auto end = read_end_of_run(reading.report, value, reading.model.file);
  if (!end) return;
  Model& model = reading.model;
  Restart restart = end->restart;
  const std::vector<std::string> supports = names_of(model.supports);
  restart.load_factors = end->numbers("loads", names_of(model.loads));
  restart.support_factors = end->numbers("supports", supports);
  // Supports that have begun in the other run: they hold their places where those were then.
  const std::vector<double> placed = end->numbers("placed", supports);
  for (std::size_t i = 0; i < placed.size(); ++i) model.supports[i].placed = placed[i] != 0.0;
  take_tightened(reading, *end);
  if (end->factors->find("motion") != nullptr) {
    const std::vector<double> motion = end->numbers("motion", {"time", "ground_x", "ground_y"});
    restart.motion = {motion[0], {motion[1], motion[2]}};
  }
  model.files.insert(model.files.end(), end->files.begin(), end->files.end());
  model.restart = std::move(restart);
}

}  // namespace scabo::input
