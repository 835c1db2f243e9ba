// The stiffness that a deck gives to contact and to sticking: an aid of its solver, or a part of the model.
#pragma once

#include <optional>
#include <vector>

#include "scabo/convert/deck_bodies.hpp"

namespace scabo::convert {

/// Scabo's contact does not give way. A joint of stiffness k (N/m3) beside a body of the size L and Young's modulus E
/// adds the share E / (k L) to its displacements; up to 1 % of it is left out with a remark. A softer one whose
/// pressure is k times the overlap is a bed of springs, and k its modulus, which is returned; any other is an essential
/// remark. `young`: per cell. `a`, `b`: the two bodies.
std::optional<double> modulus_of(const files::ImportedMesh& mesh, const DeckBodies& bodies,
                                 const std::vector<double>& young, int a, int b, const DeckInteraction& interaction,
                                 Remarks& remarks);
/// `body`: E / L of the softer one; infinite without a material.
std::optional<double> modulus_of(double body, const DeckInteraction& interaction, Remarks& remarks);

}  // namespace scabo::convert
