#include "scabo/input/settings.hpp"

namespace scabo::input {

std::vector<Override> parse_settings(const std::vector<std::string>& settings) {
  std::vector<Override> overrides;
  std::vector<Diagnostic> mistakes;
  std::string file;
  for (const std::string& setting : settings) {
    try {
      overrides.push_back(parse_override(setting));
    } catch (const InputError& error) {
      file = error.file();
      mistakes.insert(mistakes.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  if (!mistakes.empty()) throw InputError(file, mistakes);
  return overrides;
}

}  // namespace scabo::input
