// Where pieces of boundaries lie to each other. Curved sides count as their chords.
#pragma once

#include "scabo/convert/deck_bodies.hpp"

namespace scabo::convert {

double length_of(const files::ImportedMesh& mesh, const DeckPiece& piece);

/// Smallest distance of the corners of one piece from the other.
double least_distance(const files::ImportedMesh& mesh, const DeckPiece& of, const DeckPiece& from);

/// Whether a side of `of` lies opposite to one of `to`: its middle projects onto it, and they face each other.
bool are_opposite(const files::ImportedMesh& mesh, const DeckPiece& of, const DeckPiece& to);

}  // namespace scabo::convert
