// What is read of STEP files, whatever the bytes: faces whose vertices are numbers. What is not understood is passed over.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "scabo/files/step_names.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const auto& solid : scabo::files::step_solids(text))
    for (const scabo::files::StepFace& face : solid)
      for (const Eigen::Vector3d& vertex : face.vertices)
        if (!vertex.allFinite()) __builtin_trap();
  return 0;
}
