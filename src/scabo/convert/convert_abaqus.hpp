// From a deck of Abaqus or CalculiX to a model of Scabo: the text of a model file and of the mesh file that it names.
//
// Every element becomes a finite element of the same nodes. Bodies are the cells that sides join; supports, pressures
// and contacts act on edges, which are sides of the mesh file; what acts on single nodes acts on points of the model. A
// name of the deck stays where Scabo's rules for names allow it.
//
// What is taken, and what not, is listed in docs/convert.md. Whatever is not becomes a remark with its place.
#pragma once

#include <string>
#include <vector>

#include "scabo/convert/remark.hpp"
#include "scabo/files/abaqus.hpp"

namespace scabo::convert {

struct Conversion {
  std::string model;  ///< YAML
  std::string mesh;   ///< .inp
  std::vector<Remark> remarks;
  bool in_space = false;
  int bodies = 0, supports = 0, loads = 0, contacts = 0, ties = 0, steps = 0;

  /// False if something essential was lost, so that the model is not that of the deck.
  bool complete() const;
};

/// Of plane elements, or of solids (convert_solids.hpp). `deck_name` for the head of both files; `mesh_name` as the
/// model names the mesh file, relative to its own folder. `rigid_contact`: the stiffness that the deck gives to contact
/// and sticking is left out, however small it is.
Conversion convert_abaqus(files::AbaqusDeck deck, const std::string& deck_name, const std::string& mesh_name,
                          bool rigid_contact = false);

}  // namespace scabo::convert
