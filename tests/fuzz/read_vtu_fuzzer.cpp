#include "read_mesh_fuzzer.hpp"
#include "scabo/files/solid_vtu.hpp"
#include "scabo/files/vtu.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  check_mesh_reader(
      data, size, [](std::string_view bytes, const std::string& file) { return scabo::files::parse_vtu(bytes, file); });
  check_solid_reader(data, size, [](std::string_view bytes, const std::string& file) {
    return scabo::files::parse_solid_vtu(bytes, file);
  });
  const auto kept = [](std::string_view bytes, const std::string& file) {
    return scabo::files::parse_solid_vtu(bytes, file, scabo::files::Bricks::kept);
  };
  check_solid_reader(data, size, kept, false);
  return 0;
}
