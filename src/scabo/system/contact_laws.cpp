#include "scabo/system/contact_laws.hpp"

#include "scabo/contact/laws/bonded.hpp"
#include "scabo/contact/laws/cohesive.hpp"
#include "scabo/contact/laws/coulomb.hpp"
#include "scabo/contact/laws/frictionless.hpp"
#include "scabo/contact/laws/lasting.hpp"
#include "scabo/contact/laws/slip_weakening.hpp"
#include "scabo/contact/laws/tresca.hpp"
#include "scabo/contact/laws/two_sided.hpp"
#include "scabo/system/tributary_lengths.hpp"

namespace scabo::system {

namespace {

/// Linear between the given points, constant beyond them.
double coefficient_at(const std::vector<model::FrictionPoint>& along, double s) {
  std::size_t next = 0;
  while (next < along.size() && along[next].position < s) ++next;
  if (next == 0) return along.front().friction;
  if (next == along.size()) return along.back().friction;
  const model::FrictionPoint &from = along[next - 1], &to = along[next];
  const double part = (s - from.position) / (to.position - from.position);
  return from.friction + part * (to.friction - from.friction);
}

LawPointer friction_law(const model::Contact& contact, double s) {
  if (contact.dynamic_friction) {
    contact::SlipWeakening::Fall forward{contact.friction, *contact.dynamic_friction}, backward = forward;
    if (contact.backward_friction) backward = {*contact.backward_friction, *contact.backward_dynamic_friction};
    return std::make_shared<contact::SlipWeakening>(forward, backward, contact.slip_distance);
  }
  const double mu = contact.friction_along.empty() ? contact.friction : coefficient_at(contact.friction_along, s);
  const double backward = contact.backward_friction.value_or(mu);
  if (mu == 0.0 && backward == 0.0) return std::make_shared<contact::Frictionless>();
  return std::make_shared<contact::Coulomb>(mu, backward);
}

}  // namespace

LawPointer law_of(const model::Contact& contact, double s) {
  if (contact.bond) return std::make_shared<contact::Bonded>();
  if (contact.shear_strength) return std::make_shared<contact::Tresca>(*contact.shear_strength);
  LawPointer friction = friction_law(contact, s);
  if (contact.lasting_cohesion > 0.0)
    return std::make_shared<contact::LastingCohesion>(std::move(friction), contact.lasting_cohesion);
  if (contact.cohesion == 0.0 && contact.tension == 0.0) return friction;
  return std::make_shared<contact::Cohesive>(std::move(friction), contact.cohesion, contact.tension);
}

std::vector<double> positions_along(const mesh::Interface& interface) {
  std::vector<double> positions;
  double length = 0.0;
  for (std::size_t i = 0; i < interface.pairs.size(); ++i) {
    if (i > 0) length += (interface.pairs[i].point_a - interface.pairs[i - 1].point_a).norm();
    positions.push_back(length);
  }
  for (double& position : positions)
    if (length > 0.0) position /= length;
  return positions;
}

contact::JointLaws contact_laws(const std::vector<ContactSystem::Pair>& pairs, const model::Model& model,
                                const mesh::Mesh& mesh) {
  contact::JointLaws laws;
  laws.area = Vector::Ones(static_cast<Eigen::Index>(pairs.size()));
  int contact_before = -1;
  std::vector<double> positions;
  std::vector<double> areas;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const ContactSystem::Pair& at = pairs[k];
    if (at.is_bar()) {
      laws.of_pair.push_back(std::make_shared<contact::TwoSided>());
      continue;
    }
    const model::Contact& contact = model.contacts[static_cast<std::size_t>(at.contact)];
    const mesh::Interface& interface = mesh.interfaces[static_cast<std::size_t>(at.contact)];
    if (at.contact != contact_before) {
      contact_before = at.contact;
      positions = positions_along(interface);
      areas = tributary_areas(at.contact, model, mesh);
    }
    const auto index = static_cast<std::size_t>(at.index);
    laws.of_pair.push_back(law_of(contact, positions[index]));
    laws.area[static_cast<Eigen::Index>(k)] = areas[index];
  }
  return laws;
}

std::vector<double> coefficients_of(const std::vector<model::Contact>& contacts) {
  std::vector<double> coefficients;
  for (const model::Contact& contact : contacts) coefficients.push_back(contact.friction);
  for (const model::Contact& contact : contacts)
    coefficients.push_back(contact.backward_friction.value_or(contact.friction));
  for (const model::Contact& contact : contacts) coefficients.push_back(contact.lasting_cohesion);
  return coefficients;
}

contact::JointLaws with_coefficients(const contact::JointLaws& laws, const std::vector<ContactSystem::Pair>& pairs,
                                     const std::vector<model::Contact>& all, const std::vector<double>& coefficients) {
  contact::JointLaws changed = laws;
  const std::size_t contacts = all.size();
  std::vector<LawPointer> of_contact(contacts);  // one for all pairs
  for (std::size_t k = 0; k < pairs.size() && !coefficients.empty(); ++k) {
    if (pairs[k].is_bar()) continue;
    const auto c = static_cast<std::size_t>(pairs[k].contact);
    const model::Contact& given = all[c];
    const double forward = coefficients[c], backward = coefficients[contacts + c];
    const double cohesion = coefficients[2 * contacts + c];
    if (!model::has_one_coefficient(given) ||
        (forward == given.friction && backward == given.backward_friction.value_or(given.friction) &&
         cohesion == given.lasting_cohesion))
      continue;
    if (!of_contact[c]) {
      model::Contact contact = given;
      contact.friction = forward;
      contact.backward_friction = backward;
      contact.lasting_cohesion = cohesion;
      of_contact[c] = law_of(contact, 0.0);
    }
    changed.of_pair[k] = of_contact[c];
  }
  return changed;
}

}  // namespace scabo::system
