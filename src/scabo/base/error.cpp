#include "scabo/base/error.hpp"

#include <fmt/format.h>

namespace scabo {

namespace {

std::string join(const std::string& file, const std::vector<Diagnostic>& diagnostics) {
  std::string all;
  for (const Diagnostic& diagnostic : diagnostics) {
    if (!all.empty()) all += '\n';
    all += format_diagnostic(file, diagnostic);
  }
  return all;
}

}  // namespace

InputError::InputError(std::string file, std::vector<Diagnostic> diagnostics)
    : std::runtime_error(join(file, diagnostics)), file_(std::move(file)), diagnostics_(std::move(diagnostics)) {}

std::string format_diagnostic(std::string_view file, const Diagnostic& diagnostic) {
  std::string text(file);
  if (diagnostic.at.line > 0) text += fmt::format(":{}:{}", diagnostic.at.line, diagnostic.at.column);
  text += ": ";
  if (!diagnostic.at.path.empty()) text += diagnostic.at.path + ": ";
  return text + diagnostic.message;
}

}  // namespace scabo
