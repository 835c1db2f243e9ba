// The mesh file of a converted deck: bodies are element sets, pieces of their boundaries are surfaces. Numbers of nodes
// and elements are those of the deck.
#pragma once

#include <string>
#include <vector>

#include "scabo/convert/deck_bodies.hpp"
#include "scabo/files/abaqus.hpp"

namespace scabo::convert {

std::string mesh_text(const files::AbaqusDeck& deck, const DeckBodies& bodies, const std::vector<DeckPiece>& pieces,
                      bool plane_strain, const std::string& deck_name);

}  // namespace scabo::convert
