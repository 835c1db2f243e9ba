// Materials, orientations and sections of a deck.
#pragma once

#include "scabo/convert/deck_content.hpp"

namespace scabo::convert {

/// Takes a block if it is about materials, orientations or sections; false if it is not.
bool read_material_block(const files::AbaqusDeck& deck, const files::DeckBlock& block, DeckContent& content,
                         Remarks& remarks);

}  // namespace scabo::convert
