// Nodes of a contact or tie that a deck moves before the analysis (ADJUST): onto the other side, without strain.
//
// A slave node belongs to the master where its perpendicular meets one of the master's sides and both sides face each
// other. gap = (x - foot) . n, n out of the master: open > 0. *CONTACT PAIR, ADJUST=a moves nodes with gap <= a, also
// those that overlap; ADJUST=set the nodes of the set. *TIE moves nodes within its POSITION TOLERANCE, unless
// ADJUST=NO.
#pragma once

#include "scabo/convert/deck_content.hpp"

namespace scabo::convert {

/// Moves the nodes in the mesh of the deck. What a deck leaves open becomes an essential remark.
void adjust_nodes(files::AbaqusDeck& deck, const DeckContent& content, Remarks& remarks);

}  // namespace scabo::convert
