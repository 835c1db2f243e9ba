// Input files of Abaqus and CalculiX (.inp): nodes, plane elements, sets, surfaces and sections.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scabo/files/imported_mesh.hpp"

namespace scabo::files {

/// Text of a file that is named in *INCLUDE or INPUT=, and the name under which messages mention it.
struct IncludedFile {
  std::string name;
  std::string text;
};
/// `name` as written in the file `from`; nothing if it cannot be read.
using ReadInclude = std::function<std::optional<IncludedFile>(const std::string& name, const std::string& from)>;

/// The mesh in the text of a file of that name. The region of an element is the element set of its last section, which
/// gives the material as well; without a section the set of its *ELEMENT line, then the first *ELSET with it, then
/// `elements`. Element sets become cell sets, node sets and surfaces of TYPE=NODE node sets, surfaces of TYPE=ELEMENT
/// facet sets. Trusses and beams without a section (as Gmsh writes curves) become facet sets. Throws InputError.
ImportedMesh parse_abaqus(std::string_view text, const std::string& file, const ReadInclude& read_include = {});

struct DeckPlace {
  std::string file;
  int line = 0;  ///< from 1
};

struct DeckLine {
  std::vector<std::string> fields;
  DeckPlace at;
  /// Of a pressure on sides of elements (*DLOAD with P1 to P4): the facet set of the mesh that these sides are, whose name
  /// begins with `*`.
  std::string sides;
};

/// A keyword that is not part of the mesh, or a section, with its data lines.
struct DeckBlock {
  std::string name;                               ///< upper case, without spaces: `CONTACTPAIR`
  std::map<std::string, std::string> parameters;  ///< names in upper case, values as written
  DeckPlace at;
  std::vector<DeckLine> lines;
};

/// A whole deck: its mesh, and all that the mesh does not hold, in the order of the file.
struct AbaqusDeck {
  struct Elements {
    std::string type;  ///< upper case
    DeckPlace at;      ///< of their *ELEMENT line
  };
  ImportedMesh mesh;
  std::vector<std::int64_t> node_numbers;     ///< per node of the mesh: as in the file
  std::vector<Elements> elements;             ///< of all *ELEMENT lines with cells
  std::map<std::int64_t, int> type_of_cell;   ///< number of a cell in the file: index into `elements`
  std::vector<DeckBlock> blocks;
};

/// As parse_abaqus, with everything else. Throws InputError for what no mesh can be read from.
AbaqusDeck parse_abaqus_deck(std::string_view text, const std::string& file, const ReadInclude& read_include = {});

}  // namespace scabo::files
