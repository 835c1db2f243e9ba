// The mesh file of a converted deck: bodies are element sets, pieces of their boundaries are surfaces. Numbers of nodes
// and elements are those of the deck.
#pragma once

#include <string>
#include <vector>

#include "scabo/convert/deck_bodies.hpp"
#include "scabo/files/abaqus.hpp"
#include "scabo/model/material.hpp"

namespace scabo::convert {

/// First letters of the types of plane stress, plane strain and bodies of revolution: CPS, CPE, CAX.
const char* element_family(model::Plane plane);

std::string mesh_text(const files::AbaqusDeck& deck, const DeckBodies& bodies, const std::vector<DeckPiece>& pieces,
                      model::Plane plane, const std::string& deck_name);

}  // namespace scabo::convert
