// From a deck of solids to a model in space. Tetrahedra stay as they are, hexahedra and wedges are divided
// (files/split_solid.hpp). Bodies are the cells that sides join. Supports hold sets of nodes, forces act on nodes, and
// pressures, contacts and ties on surfaces, which the mesh file has by the names of the deck.
#pragma once

#include "scabo/convert/convert_abaqus.hpp"

namespace scabo::convert {

/// As convert_abaqus, of a deck with `solid`.
Conversion convert_solids(files::AbaqusDeck deck, const std::string& deck_name, const std::string& mesh_name,
                          bool rigid_contact);

}  // namespace scabo::convert
