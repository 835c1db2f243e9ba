// The laws of the pairs, from the contacts of the model. Strengths are per area; a pair's area is its tributary length
// (tributary_lengths.hpp) times the thickness, the same that pressures are taken over.
#pragma once

#include "scabo/system/contact_system.hpp"

namespace scabo::system {

/// Position of the pairs of a contact from its first (0) to its last (1), by length along them.
std::vector<double> positions_along(const mesh::Interface& interface);

contact::JointLaws contact_laws(const std::vector<ContactSystem::Pair>& pairs, const model::Model& model,
                                const mesh::Mesh& mesh);

}  // namespace scabo::system
