// Element types of input files for Abaqus and CalculiX.
#pragma once

#include <optional>
#include <string>

#include "scabo/files/imported_mesh.hpp"

namespace scabo::files {

enum class ElementFamily { cell, shell, line };  // a shell or membrane has two faces, sides count after them

struct AbaqusElement {
  ElementFamily family = ElementFamily::cell;
  int nodes = 0;
};

/// Nothing for a type that is not read. `type` in upper case, here and below.
std::optional<AbaqusElement> abaqus_element(const std::string& type);

/// The cell of an element with 3, 4, 6, 8 or 9 nodes; the last without its centre node.
CellKind abaqus_cell_kind(int nodes);

/// Springs, dashpots, gaps, masses: they join nodes or load them.
bool is_discrete_abaqus_element(const std::string& type);

/// Why a type is not read, and what to do: the rest of a sentence that begins with the type.
std::string abaqus_refusal(const std::string& type);

}  // namespace scabo::files
