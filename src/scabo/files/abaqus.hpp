// Input files of Abaqus and CalculiX (.inp): nodes, plane elements, sets, surfaces and sections.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scabo/files/imported_solid_mesh.hpp"

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
/// facet sets. Trusses and beams without a section (as Gmsh writes curves) become facet sets. Each instance of a part
/// has nodes and elements of its own; its sets are `Set`, or `Instance.Set` where another set is called so. Throws
/// InputError.
ImportedMesh parse_abaqus(std::string_view text, const std::string& file, const ReadInclude& read_include = {},
                          std::vector<std::string>* types = nullptr);

inline Facet facet_of_solid(const SolidSide& side) {
  Facet facet;
  facet.start = facet.end = 4 * side.cell + side.side;
  return facet;
}
inline SolidSide solid_side_of(const Facet& facet) { return {facet.start / 4, facet.start % 4}; }

struct DeckPlace {
  std::string file;
  int line = 0;  ///< from 1
};

/// Names of parameters are the same with and without blanks: `NO SEPARATION`, `NOSEPARATION`.
struct LessWithoutBlanks {
  bool operator()(const std::string& a, const std::string& b) const;
};
/// Parameters of a keyword: names in upper case, values as written but without quotes.
using KeyParameters = std::map<std::string, std::string, LessWithoutBlanks>;

struct DeckLine {
  std::vector<std::string> fields;
  DeckPlace at;
  /// Of a pressure on sides of elements (*DLOAD with P1 to P4): the facet set of the mesh that these sides are, whose
  /// name begins with `*`.
  std::string sides;
};

/// A keyword with its data lines; those of the mesh itself (*NODE, *ELEMENT, *NSET, *ELSET, *SURFACE) are left out.
struct DeckBlock {
  std::string name;     ///< upper case, without blanks: `CONTACTPAIR`
  std::string written;  ///< as messages show it: `*CONTACT PAIR`
  KeyParameters parameters;
  DeckPlace at;
  std::vector<DeckLine> lines;
  bool has_data = false;  ///< data lines that are not empty, those of the mesh too
  int instance = -1;      ///< index into AbaqusDeck::instances: that it stands in, with its part
};

/// A part where it is in the assembly. Its sets are called `Instance.Set` in the mesh of the deck, and its elements are
/// the cell set `Instance`.
struct DeckInstance {
  /// The number k of the part, up to `largest`, is k + offset in the mesh.
  struct Numbers {
    std::int64_t offset = 0, largest = 0;
  };
  std::string name;
  Eigen::Matrix3d turn;  ///< from the axes of the part to those of the assembly
  Numbers nodes, elements;
};

/// A whole deck: its mesh, and all that the mesh does not hold, in the order of the file.
struct AbaqusDeck {
  /// Of a deck of solids. `mesh` then has its sets and the numbers of its cells alone; both ends of its facets are 4
  /// times the cell and the side (facet_of_solid).
  std::optional<ImportedSolidMesh> solid;
  struct Elements {
    std::string type;  ///< upper case
    DeckPlace at;      ///< of their *ELEMENT line
  };
  ImportedMesh mesh;
  std::vector<DeckInstance> instances;
  std::vector<std::int64_t> node_numbers;    ///< per node of the mesh: as in the file, of an instance with its offset
  std::vector<Elements> elements;            ///< of all *ELEMENT lines with cells
  std::map<std::int64_t, int> type_of_cell;  ///< number of a cell in the file: index into `elements`
  std::vector<DeckBlock> blocks;
  /// Of a deck of solids: nodes of no element, and the node sets with such nodes by their names in upper case.
  std::map<std::int64_t, Eigen::Vector3d> loose_nodes;
  std::map<std::string, std::vector<std::int64_t>> loose_sets;
};

/// As parse_abaqus, with everything else. Sets keep the full names that the deck may use. Throws InputError for what no
/// mesh can be read from.
AbaqusDeck parse_abaqus_deck(std::string_view text, const std::string& file, const ReadInclude& read_include = {});

}  // namespace scabo::files
