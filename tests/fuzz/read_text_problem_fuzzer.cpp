// Whatever the bytes, the reader of contact problems as text returns a problem whose sizes fit, or throws
// InputError.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "scabo/contact/files/text_problem.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const scabo::contact::Problem problem = scabo::contact::parse_text_problem(text, "fuzz.dat").problem;
    const auto rows = problem.dimension * problem.mu.size();
    if (problem.W.size() != rows || problem.q.size() != rows || !problem.q.allFinite()) __builtin_trap();
    if (problem.mu.size() > 0 && problem.mu.minCoeff() < 0.0) __builtin_trap();  // no contacts is a problem too
    // What was read can be written and read again.
    const auto again = scabo::contact::parse_text_problem(scabo::contact::text_of(problem), "again.dat").problem;
    if (again.q != problem.q || again.mu != problem.mu) __builtin_trap();
  } catch (const scabo::InputError& error) {
    if (error.diagnostics().empty()) __builtin_trap();
  }
  return 0;
}
