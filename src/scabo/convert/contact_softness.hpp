// The stiffness that a deck gives to contact and to sticking: an aid of its solver, or a part of the model.
#pragma once

#include <vector>

#include "scabo/convert/deck_bodies.hpp"

namespace scabo::convert {

/// Scabo's contact does not give way. A joint of stiffness k (N/m3) beside a body of the size L and Young's modulus E
/// adds the share E / (k L) to its displacements; up to 1 % of it is noted, more is an essential remark. `young`: per
/// cell. `a`, `b`: the two bodies.
void tell_softness(const files::ImportedMesh& mesh, const DeckBodies& bodies, const std::vector<double>& young, int a,
                   int b, const DeckInteraction& interaction, Remarks& remarks);
/// `body`: E / L of the softer one; infinite without a material.
void tell_softness(double body, const DeckInteraction& interaction, Remarks& remarks);

}  // namespace scabo::convert
