// What the converter promises, whatever the bytes: a model whose mesh can be read, remarks with places, or an
// InputError.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "scabo/base/error.hpp"
#include "scabo/convert/convert_abaqus.hpp"
#include "scabo/files/abaqus.hpp"
#include "scabo/files/solid_abaqus.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto require = [](bool holds) {
    if (!holds) __builtin_trap();
  };
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  scabo::convert::Conversion made;
  std::size_t cells = 0;
  try {
    const scabo::files::AbaqusDeck deck = scabo::files::is_solid_deck(text, "fuzz.inp")
                                              ? scabo::files::parse_solid_deck(text, "fuzz.inp")
                                              : scabo::files::parse_abaqus_deck(text, "fuzz.inp");
    cells = deck.mesh.cells.size();
    made = scabo::convert::convert_abaqus(deck, "fuzz.inp", "fuzz_mesh.inp");
  } catch (const scabo::InputError& error) {
    require(!error.diagnostics().empty() && !error.diagnostics().front().message.empty());
    return 0;
  }
  for (const scabo::convert::Remark& remark : made.remarks) require(!remark.text.empty() && remark.at.line > 0);
  require(made.bodies > 0 && !made.model.empty());
  if (!made.complete()) return 0;
  if (made.in_space) {
    require(scabo::files::parse_solid_abaqus(made.mesh, "fuzz_mesh.inp").cells.size() == cells);
    return 0;
  }
  const scabo::files::ImportedMesh mesh = scabo::files::parse_abaqus(made.mesh, "fuzz_mesh.inp");
  require(mesh.cells.size() == cells);
  return 0;
}
