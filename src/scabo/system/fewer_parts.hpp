// What is left of a contact system where some parts are absent, and some pairs wait: staged construction.
#pragma once

#include <functional>

#include "scabo/system/contact_system.hpp"

namespace scabo::system {

/// The pairs that are there, in their order and with their numbers, and the rigid motions of the parts that are not
/// `absent` (one for each part). A pair that is there has both parts. W is a sum over parts, and a part contributes
/// only to its own pairs, so that a block of W is exact.
ContactSystem with_pairs(const ContactSystem& whole, const Structure& structure, const std::vector<char>& absent,
                         const std::function<bool(const ContactSystem::Pair&)>& is_there);

/// Of each pair its place among those of another stage; -1 if it is new.
std::vector<Eigen::Index> places_in(const std::vector<ContactSystem::Pair>& before,
                                    const std::vector<ContactSystem::Pair>& pairs);

}  // namespace scabo::system
