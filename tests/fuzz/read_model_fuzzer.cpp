// Whatever the bytes, the reader of model files returns a model or throws InputError: no crash, hang or leak.
//
// Comment lines of this form at the start are overrides as well:
//     # --set supports.0.fix=x
//     scabo: 1 ...
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "scabo/input/read_model.hpp"

namespace {

constexpr std::string_view override_mark = "# --set ";

/// Takes the leading `# --set path=value` lines as overrides.
std::vector<scabo::input::Override> overrides_in(std::string_view text) {
  std::vector<scabo::input::Override> overrides;
  while (text.substr(0, override_mark.size()) == override_mark && overrides.size() < 10) {
    const auto end = text.find('\n');
    if (end == std::string_view::npos) break;
    overrides.push_back(scabo::input::parse_override(text.substr(override_mark.size(), end - override_mark.size())));
    text.remove_prefix(end + 1);
  }
  return overrides;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const scabo::model::Model model = scabo::input::parse_model(text, "fuzz.yaml", overrides_in(text));
    // What the parts that follow rely on.
    for (const scabo::model::Body& body : model.bodies) {
      // A circle is one edge.
      if (body.outline.edges.empty() || !((body.outside ? -1.0 : 1.0) * body.outline.area() > 0.0)) __builtin_trap();
    }
    for (const scabo::model::Step& step : model.steps) {
      if (step.load_factors.size() != model.loads.size()) __builtin_trap();
      if (step.support_factors.size() != model.supports.size()) __builtin_trap();
    }
  } catch (const scabo::InputError& error) {
    if (error.diagnostics().empty()) __builtin_trap();
  }
  return 0;
}
