#include "settings.hpp"

namespace scabo::app {

std::vector<input::Override> parse_settings(const std::vector<std::string>& settings) {
  std::vector<input::Override> overrides;
  std::vector<Diagnostic> mistakes;
  std::string file;
  for (const std::string& setting : settings) {
    try {
      overrides.push_back(input::parse_override(setting));
    } catch (const InputError& error) {
      file = error.file();
      mistakes.insert(mistakes.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  if (!mistakes.empty()) throw InputError(file, mistakes);
  return overrides;
}

}  // namespace scabo::app
