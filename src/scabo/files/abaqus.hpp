// Input files of Abaqus and CalculiX (.inp): nodes, plane elements, sets, surfaces and sections.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

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

}  // namespace scabo::files
