#include "scabo/analysis/state/quantities.hpp"

namespace scabo::analysis {

std::optional<double> value_in(const ContactResult& contact, const model::Quantity& quantity) {
  using Kind = model::Quantity::Kind;
  switch (quantity.kind) {
    case Kind::normal_force:
      return contact.normal_force;
    case Kind::tangential_force:
      return contact.tangential_force;
    case Kind::max_gap:
      return contact.max_gap;
    case Kind::contact_force:
      return contact.force[quantity.component];
    case Kind::contact_moment:
      return contact.moment;
    case Kind::centre_of_pressure:
      return contact.centre_of_pressure ? std::optional((*contact.centre_of_pressure)[quantity.component])
                                        : std::nullopt;
    case Kind::max_pressure:
      return contact.max_pressure;
    case Kind::pairs_in_state:
      return quantity.component == 0 ? contact.open : quantity.component == 1 ? contact.stick : contact.slip;
    case Kind::broken_pairs:
      return contact.broken;
    case Kind::end_pair:
      return quantity.component == 0 ? contact.first_in_contact : contact.last_in_contact;
    case Kind::pore_force:
      return contact.pore_force;
    case Kind::total_normal_force:
      return contact.pore_force ? std::optional(contact.normal_force + *contact.pore_force) : std::nullopt;
    default:
      throw BrokenInvariant("a number that is none of a contact");
  }
}

}  // namespace scabo::analysis
