// Laws of the contact pairs, from the contacts of the model. Strengths are per area; the area of a pair is its
// tributary length (tributary_lengths.hpp) times the thickness, as for pressures.
#pragma once

#include "scabo/system/contact_system.hpp"

namespace scabo::system {

/// Position of every pair of a contact along its length, from 0 at the first pair to 1 at the last.
std::vector<double> positions_along(const mesh::Interface& interface);

using LawPointer = std::shared_ptr<const contact::Law>;
/// Of a pair at a position from 0 to 1 along its contact, on which only coefficients that vary along it depend.
LawPointer law_of(const model::Contact& contact, double s = 0.0);

/// Coefficients of all contacts as they are given, in the order of model::coefficients_of.
std::vector<double> coefficients_of(const std::vector<model::Contact>& contacts);

contact::JointLaws contact_laws(const std::vector<ContactSystem::Pair>& pairs, const model::Model& model,
                                const mesh::Mesh& mesh);

/// The same laws with other coefficients of friction and lasting cohesions (model::coefficients_of) for each of the
/// contacts `all` that has one coefficient, or one for each direction; empty: as they are.
contact::JointLaws with_coefficients(const contact::JointLaws& laws, const std::vector<ContactSystem::Pair>& pairs,
                                     const std::vector<model::Contact>& all, const std::vector<double>& coefficients);

}  // namespace scabo::system
