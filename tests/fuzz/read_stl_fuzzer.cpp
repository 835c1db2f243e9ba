// What the reader of STL files promises, whatever the bytes: a volume, or an InputError with a message.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "scabo/base/error.hpp"
#include "scabo/files/stl.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto require = [](bool holds) {
    if (!holds) __builtin_trap();
  };
  try {
    const double volume =
        scabo::files::volume_of_stl(std::string(reinterpret_cast<const char*>(data), size), "fuzz.stl");
    require(volume > 0.0 && std::isfinite(volume));
  } catch (const scabo::InputError& error) {
    require(!error.diagnostics().empty() && !error.diagnostics().front().message.empty());
  }
  return 0;
}
