// *STEP and *STATIC of a deck.
#pragma once

#include "scabo/convert/deck_content.hpp"

namespace scabo::convert {

/// With a remark about the first step that asks for large displacements.
DeckStep begun_step(const files::DeckBlock& block, bool told_of_large_displacements, Remarks& remarks);
bool asks_for_large_displacements(const files::DeckBlock& step);

/// Increments of *STATIC.
void read_static(const files::DeckBlock& block, DeckStep& step, Remarks& remarks);

/// The part of the step that its first increment is, such that whole increments make up the step.
double first_part(const DeckStep& step);

/// Of every block whether it belongs to a step that is left out, with a remark: one that finds natural frequencies,
/// loads of buckling or what follows from them, about a state that static steps of the deck give. What such a step sets
/// goes on in later steps, so that one with conditions is left out only if no static step follows.
std::vector<bool> blocks_left_out(const files::AbaqusDeck& deck, Remarks& remarks);

}  // namespace scabo::convert
