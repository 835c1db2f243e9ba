#include "read_mesh_fuzzer.hpp"
#include "scabo/files/abaqus.hpp"
#include "scabo/files/solid_abaqus.hpp"

namespace {

/// What the header of ImportedSolidMesh promises, or an InputError with a message.
void check_solid_reader(std::string_view text) {
  using namespace scabo::files;
  const auto require = [](bool holds) {
    if (!holds) __builtin_trap();
  };
  try {
    const ImportedSolidMesh mesh = parse_solid_abaqus(text, "fuzz");
    require(!mesh.cells.empty() && mesh.nodes.allFinite());
    for (const ImportedSolidCell& cell : mesh.cells) {
      require(cell.nodes.size() == 4 || cell.nodes.size() == 10);
      for (const int node : cell.nodes) require(node >= 0 && node < mesh.nodes.cols());
    }
    for (const NodeSet& set : mesh.node_sets)
      for (const int node : set.nodes) require(node >= 0 && node < mesh.nodes.cols());
    for (const CellSet& set : mesh.cell_sets)
      for (const int cell : set.cells) require(cell >= 0 && cell < static_cast<int>(mesh.cells.size()));
    for (const SolidSideSet& set : mesh.side_sets)
      for (const SolidSide& at : set.sides)
        require(at.cell >= 0 && at.cell < static_cast<int>(mesh.cells.size()) && at.side >= 0 && at.side < 4);
  } catch (const scabo::InputError& error) {
    require(!error.diagnostics().empty() && !error.diagnostics().front().message.empty());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  check_mesh_reader(data, size, [](std::string_view bytes, const std::string& file) {
    return scabo::files::parse_abaqus(bytes, file);
  });
  check_solid_reader(std::string_view(reinterpret_cast<const char*>(data), size));
  return 0;
}
