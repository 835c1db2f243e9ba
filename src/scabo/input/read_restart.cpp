// `restart`: a directory with the results of another run. Its file of factors tells where the loads of the first step
// start; its state is read by the analysis (analysis/state/restart.hpp).
#include <fmt/format.h>

#include <filesystem>

#include "scabo/files/bytes_of_file.hpp"
#include "scabo/input/reading.hpp"
#include "scabo/input/suggestions.hpp"
#include "scabo/input/yaml_document.hpp"
#include "scabo/model/restart_files.hpp"

namespace scabo::input {

namespace {

namespace fs = std::filesystem;

/// Factors by the names in `section` of the file; `index_of`: the place of a name, -1 if this model has none.
template <typename IndexOf>
void take_factors(const Node& root, const char* section, const IndexOf& index_of, std::vector<double>& factors) {
  const MapEntry* entry = root.find(section);
  if (entry == nullptr || entry->value->kind != Node::Kind::map) return;
  for (const MapEntry& factor : entry->value->entries) {
    const int i = index_of(factor.key);
    if (i >= 0) factors[static_cast<std::size_t>(i)] = std::strtod(factor.value->text.c_str(), nullptr);
  }
}

/// The place of a name in an index; -1 if it is not there.
auto in(const Index& index) {
  return [&index](const std::string& key) {
    const auto found = index.find(key);
    return found == index.end() ? -1 : found->second;
  };
}

/// Bars that the other run, in the directory `name`, has tightened.
void take_tightened(Reading& reading, const Node& root, const std::string& name) {
  Index bars;
  for (std::size_t i = 0; i < reading.model.bars.size(); ++i)
    bars.emplace(reading.model.bars[i].name, static_cast<int>(i));
  std::vector<double> tightened(bars.size(), 0.0);
  take_factors(root, "bars", in(bars), tightened);
  for (std::size_t i = 0; i < tightened.size(); ++i)
    if (tightened[i] < 0.0) reading.model.bars[i].tightened = static_cast<int>(tightened[i]);
  for (const auto& [bar, step] : reading.steps_of_bars)
    if (tightened[bar] < 0.0)
      reading.report.error(step, fmt::format("bar '{}' has been tightened in {} already: leave 'tightened' out",
                                             reading.model.bars[bar].name, quoted_name(name)));
}

/// Supports that have begun in the other run: they hold their places where those were then.
void take_placed(Reading& reading, const Node& root, const Index& supports) {
  std::vector<double> placed(reading.model.supports.size(), 0.0);
  take_factors(root, "placed", in(supports), placed);
  for (std::size_t i = 0; i < placed.size(); ++i) reading.model.supports[i].placed = placed[i] != 0.0;
}

}  // namespace

void read_restart(Reading& reading, const Value& value) {
  const auto name = read_text(reading.report, value);
  if (!name) return;
  const fs::path directory = fs::path(reading.model.file).parent_path() / *name, file = directory / factors_at_end_file;
  std::error_code error;
  if (!fs::is_directory(directory, error)) {
    reading.report.error(
        value,
        fmt::format(
            "there is no directory {} in the folder of the model: name the results of a run that was solved, as in "
            "restart: first.results",
            quoted_name(*name)));
    return;
  }
  const std::optional<std::string> text = files::bytes_of_file(file);
  std::vector<Diagnostic> mistakes;
  const NodePtr root =
      text && fs::exists(directory / state_at_end_file, error) ? parse_yaml(*text, mistakes) : NodePtr();
  if (!root || root->kind != Node::Kind::map || !mistakes.empty()) {
    reading.report.error(
        value, fmt::format("{} has no state at its end to start from: only a run that was solved, without error bars, "
                           "tolerances and cracks that grow, leaves one; run it again",
                           quoted_name(*name)));
    return;
  }
  Restart restart;
  restart.directory = directory.string();
  restart.source = value.source();
  restart.load_factors.assign(reading.model.loads.size(), 0.0);
  restart.support_factors.assign(reading.model.supports.size(), 0.0);
  Index supports;
  for (std::size_t i = 0; i < reading.model.supports.size(); ++i)
    supports.emplace(reading.model.supports[i].name, static_cast<int>(i));
  take_factors(*root, "loads", in(reading.index_of_load), restart.load_factors);
  take_factors(*root, "supports", in(supports), restart.support_factors);
  take_placed(reading, *root, supports);
  take_tightened(reading, *root, *name);
  if (root->find("motion") != nullptr) {
    const Index names{{"time", 0}, {"ground_x", 1}, {"ground_y", 2}};
    std::vector<double> motion(names.size(), 0.0);
    take_factors(*root, "motion", in(names), motion);
    restart.motion = {motion[0], {motion[1], motion[2]}};
  }
  reading.model.files.push_back(file.string());
  reading.model.files.push_back((directory / state_at_end_file).string());
  reading.model.restart = std::move(restart);
}

}  // namespace scabo::input
