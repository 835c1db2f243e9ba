#include "settings.hpp"

namespace scabo::app {

std::vector<model::Override> parse_settings(const std::vector<std::string>& settings) {
  std::vector<model::Override> overrides;
  std::vector<Diagnostic> mistakes;
  std::string file;
  for (const std::string& setting : settings) {
    try {
      overrides.push_back(model::parse_override(setting));
    } catch (const InputError& error) {
      file = error.file();
      mistakes.insert(mistakes.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  if (!mistakes.empty()) throw InputError(file, mistakes);
  return overrides;
}

}  // namespace scabo::app
