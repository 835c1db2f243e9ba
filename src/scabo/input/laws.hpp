// Laws of contacts and what steps change of them, in the plane and in space.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scabo/input/reader.hpp"
#include "scabo/model/contact.hpp"
#include "scabo/model/step.hpp"

namespace scabo::input {

/// Contact law: `friction`, `cohesion`, `tension`, `bond`, `shear_strength`.
void read_law(Report& report, const MapReader& map, model::Contact& contact);
/// `0.3` or `{forward: 0.3, backward: 0.6}`: coefficients of friction against forward and backward slip; nothing if
/// broken.
std::optional<std::pair<double, double>> read_coefficients(Report& report, const Value& value);

/// Laws that several contacts share, by name; nothing for one that is broken.
struct ContactProperty {
  std::optional<model::Contact> law;
  bool used = false;
  Source source;
};
using ContactProperties = std::map<std::string, ContactProperty>;

ContactProperties read_properties(Report& report, const std::optional<Value>& given);
/// The law of a contact: its own keys, or those of a property. False: the property is broken, which has been reported.
bool read_law_or_property(Report& report, const MapReader& map, ContactProperties& properties, model::Contact& contact);
void tell_of_unused(const ContactProperties& properties, std::vector<Warning>& warnings);

/// `friction` of a step, `{joint: 0.3}`: coefficients at its end. `all_known`: `contacts` has all of the model.
void read_friction_of_step(Report& report, const Value& value, const std::vector<model::Contact>& contacts,
                           bool all_known, model::Step& step);
/// The coefficients of the contacts themselves become those of a step.
void add_coefficients(const std::vector<model::Contact>& contacts, model::Step& step);

}  // namespace scabo::input
