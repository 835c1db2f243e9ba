#include "scabo/convert/convert_solids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "scabo/convert/contact_softness.hpp"
#include "scabo/convert/deck_content.hpp"
#include "scabo/convert/deck_elements.hpp"
#include "scabo/convert/deck_names.hpp"
#include "scabo/convert/solid_adjust.hpp"
#include "scabo/convert/solid_bodies_of_deck.hpp"
#include "scabo/convert/solid_model_writer.hpp"
#include "scabo/convert/write_equations.hpp"
#include "scabo/convert/write_model.hpp"
#include "scabo/convert/write_references.hpp"
#include "scabo/convert/write_steps.hpp"
#include "scabo/convert/write_supports.hpp"
#include "scabo/files/text_cursor.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::convert {

namespace {

using model::number_text;

class SolidConverter {
 public:
  SolidConverter(files::AbaqusDeck deck, const std::string& deck_name, const std::string& mesh_name)
      : deck_name_(deck_name), mesh_name_(mesh_name) {
    to_.deck = std::move(deck);
  }

  Conversion convert(bool rigid_contact) {
    to_.content = read_content(to_.deck, rigid_contact, to_.remarks);
    to_.axes = transforms_of(to_.deck, to_.content.references, to_.remarks);
    tell_elements();
    GivenMaterials materials = materials_of(to_.deck, to_.content, model::Plane::strain, to_.remarks);
    to_.parts.materials = std::move(materials.lines);
    for (const DeckMaterial& material : to_.content.materials)
      if (material.orthotropic)
        to_.remarks.essential(material.at, fmt::format("material '{}' is orthotropic, which materials in space are not",
                                                       files::printable(material.name)));
    to_.bodies = solid_bodies_of(to_.deck, to_.content, materials.of_cell, materials.young, to_.remarks);
    if (to_.content.steps.empty())
      to_.remarks.essential({deck_name_, 1},
                            "the deck has no *STEP, so that nothing is analysed; add one with *STATIC");
    write_joints();
    write_equations(to_);
    write_references(to_);
    write_supports(to_);
    write_forces();
    write_pressures();
    write_body_loads();
    write_temperatures();
    write_contacts();
    to_.parts.steps = steps_text(to_.content.steps, to_.driven, to_.parts, true);
    to_.parts.title = to_.content.title;
    to_.result.model = text();
    to_.result.mesh = solid_mesh_text(to_.deck, to_.bodies, to_.sets, deck_name_);
    to_.result.bodies = static_cast<int>(to_.bodies.bodies.size());
    to_.result.steps = static_cast<int>(to_.content.steps.size());
    to_.result.in_space = true;
    to_.result.remarks = to_.remarks.take();
    return std::move(to_.result);
  }

 private:
  void tell_elements() {
    for (const std::string& remark : to_.deck.mesh.remarks) {
      const bool lost = remark.find("no solids") != std::string::npos;
      const files::DeckPlace at{deck_name_, 1};
      lost ? to_.remarks.essential(at, remark) : to_.remarks.note(at, remark);
    }
  }

  /// Bodies of different materials that sides of elements join.
  void write_joints() {
    for (const auto& [a, b] : to_.bodies.joined) {
      to_.remarks.note(
          to_.deck.elements.front().at,
          fmt::format("elements of two materials hang together: they become the bodies '{}' and '{}', with a "
                      "tie between them",
                      to_.name_of(a), to_.name_of(b)));
      to_.parts.ties += fmt::format("  {0}: {{between: [{1}.to_{2}, {2}.to_{1}]}}\n",
                                    yaml_word(to_.contact_names.take(to_.name_of(a) + "_" + to_.name_of(b))),
                                    to_.name_of(a), to_.name_of(b));
      ++to_.result.ties;
    }
  }

  // ---- loads

  std::size_t body_of(int node) const {
    return static_cast<std::size_t>(to_.bodies.of_node[static_cast<std::size_t>(node)]);
  }

  /// Nodal forces that are consistent with a hexahedron act as points on tetrahedra.
  void tell_forces_on_divided_elements() {
    const bool divided = std::any_of(to_.deck.elements.begin(), to_.deck.elements.end(), [](const auto& elements) {
      return elements.type.find("C3D4") != 0 && elements.type.find("C3D10") != 0;
    });
    if (divided && !to_.content.forces.empty())
      to_.remarks.note(
          to_.content.forces.begin()->second.at,
          "the forces act at the same nodes of elements that are divided, near which displacements differ; a "
          "*DLOAD on sides does not depend on the elements");
  }

  void write_forces() {
    tell_forces_on_divided_elements();
    const Course none(to_.content.steps.size());
    std::map<int, std::array<Course, 3>> at_node;
    std::map<int, std::string> labels;
    for (const auto& [at, given] : to_.content.forces) {
      if (to_.axes.contains(at.first)) {
        to_.remarks.essential(given.at,
                              "the force acts along axes of the node by *TRANSFORM, which is not taken; write "
                              "it along x, y and z at a node without them");
        continue;
      }
      at_node.try_emplace(at.first, std::array<Course, 3>{none, none, none})
          .first->second[static_cast<std::size_t>(at.second)] = given.course;
      labels[at.first] = given.label;
    }
    std::map<std::pair<int, std::array<Course, 3>>, std::vector<int>> groups;
    for (const auto& [node, courses] : at_node)
      groups[{to_.bodies.of_node[static_cast<std::size_t>(node)], courses}].push_back(node);
    for (const auto& [key, nodes] : groups) {
      const std::string set = to_.set_of(to_.sets.nodes, nodes, labels.at(nodes.front()));
      to_.add_vector_load(set + "_force", fmt::format("on: {}.{}", to_.name_of(key.first), set), "nodal_force",
                          key.second);
    }
  }

  void write_pressures() {
    std::map<std::pair<int, Course>, std::pair<std::vector<int>, std::string>> groups;
    for (const auto& [key, given] : to_.content.pressures) {
      if (!to_.bodies.outer.contains(key.first)) {
        to_.remarks.essential(given.at, "a pressure acts between two elements; only sides of the boundary are taken");
        continue;
      }
      auto& [sides, label] = groups[{to_.body_of_side(key.first), given.course}];
      sides.push_back(key.first);
      if (label.empty()) label = given.label;
    }
    for (const auto& [key, of] : groups) {
      const std::string set = to_.set_of(to_.sets.sides, of.first, of.second);
      const double scale = scale_of(key.second);
      to_.add_load(set + "_pressure",
                   fmt::format("on: {}.{}, pressure: {}", to_.name_of(key.first), set, number_text(scale)),
                   scaled(key.second, 1.0 / scale));
    }
  }

  void write_body_loads() {
    for (const DeckBodyLoad& load : to_.content.body_loads) {
      if (load.kind != DeckBodyLoad::Kind::gravity) {
        to_.remarks.essential(load.x.at,
                              "forces per volume (BX, BY, BZ) and rotation (CENTRIF) are not taken in space; "
                              "there is GRAV");
        continue;
      }
      const auto cells = cells_named(to_.deck, load.set);
      if (!cells) {
        to_.remarks.essential(
            load.x.at, fmt::format("there is no element set '{}'; correct its name", files::printable(load.set)));
        continue;
      }
      std::vector<std::size_t> in_body(to_.bodies.bodies.size()), of_body(to_.bodies.bodies.size());
      for (const int body : to_.bodies.of_cell) ++of_body[static_cast<std::size_t>(body)];
      for (const int c : *cells) ++in_body[static_cast<std::size_t>(to_.bodies.of_cell[static_cast<std::size_t>(c)])];
      const std::array<Course, 3> courses{load.x.course, load.y.course, load.z.course};
      if (in_body == of_body) {
        to_.add_vector_load("gravity", "", "gravity", courses);
        continue;
      }
      for (std::size_t b = 0; b < in_body.size(); ++b) {
        if (in_body[b] == 0) continue;
        if (in_body[b] < of_body[b])
          to_.remarks.essential(load.x.at,
                                fmt::format("the load acts on a part of body '{}' only, which Scabo's do not; give "
                                            "it to all of its elements",
                                            to_.bodies.bodies[b].name));
        to_.add_vector_load("gravity", "on: " + to_.bodies.bodies[b].name, "gravity", courses);
      }
    }
  }

  /// Each of a whole body, since one of Scabo's is a formula of the coordinates.
  void write_temperatures() {
    std::map<int, std::size_t> nodes;  // of the deck, by body
    for (std::size_t i = 0; i < to_.deck.node_numbers.size(); ++i)
      nodes[to_.bodies.of_node[i]] += to_.deck.node_numbers[i] > 0;
    std::map<std::pair<int, Course>, std::pair<std::size_t, const Given*>> groups;
    for (const auto& [node, given] : to_.content.temperatures) {
      if (node < 0) continue;
      auto& [count, first] = groups[{static_cast<int>(body_of(node)), given.course}];
      ++count;
      first = &given;
    }
    for (const auto& [key, group] : groups) {
      const auto& [body, course] = key;
      if (is_zero(course)) continue;
      if (group.first < nodes.at(body)) {
        to_.remarks.essential(group.second->at,
                              fmt::format("the change of temperature is not the same at all nodes of body '{}', and is "
                                          "not taken; give the body one, or a `temperature` load of the model",
                                          to_.name_of(body)));
        continue;
      }
      const double scale = scale_of(course);
      to_.add_load("temperature", fmt::format("on: {}, temperature: {}", to_.name_of(body), number_text(scale)),
                   scaled(course, 1.0 / scale));
    }
  }

  // ---- contacts

  /// What a *CLEARANCE adds to the gap of the mesh.
  double gap_of(const DeckContact& contact, const std::vector<int>& master, const std::vector<int>& slave) {
    if (!contact.clearance) return 0.0;
    const auto gaps = gaps_of_mesh(*to_.deck.solid, master, slave);
    const double range = gaps ? gaps->second - gaps->first : 0.0, wanted = *contact.clearance;
    constexpr double most_uneven = 0.01;  // of the clearance
    if (gaps && range <= most_uneven * std::abs(wanted)) return wanted - 0.5 * (gaps->first + gaps->second);
    to_.remarks.essential(
        contact.at,
        gaps
            ? fmt::format("*CLEARANCE replaces the gaps of the mesh, which are from {:.3g} to {:.3g}, and the `gap` of "
                          "Scabo's contacts is added to them; move the nodes so that they are equal",
                          gaps->first, gaps->second)
            : std::string("the surfaces of a contact with *CLEARANCE do not face each other; correct them"));
    return 0.0;
  }

  using Sides = std::pair<const int, std::vector<int>>;  // of a body

  void write_contacts() {
    for (const DeckContact& contact : to_.content.contacts) {
      const auto master = to_.surface(contact.master, contact.at), slave = to_.surface(contact.slave, contact.at);
      const bool of_two = master.size() == 1 && slave.size() == 1 && master.begin()->first != slave.begin()->first;
      std::set<int> used;
      for (const Sides& a : master)
        for (const Sides& b : slave) {
          if (!of_two && !face_each_other(*to_.deck.solid, a.second, b.second)) continue;
          used.insert({a.first, b.first});
          if (a.first != b.first)
            write_contact(contact, a, b);
          else
            to_.remarks.essential(contact.at,
                                  fmt::format("sides of body '{}' face each other in both surfaces, and contact "
                                              "of a body with itself is not taken; part it, or the surfaces",
                                              to_.name_of(a.first)));
        }
      if (used.empty() && !master.empty() && !slave.empty())
        to_.remarks.essential(contact.at,
                              "the two surfaces do not face each other, and the contact is lost; correct them");
      for (const auto* surface : {&master, &slave})
        for (const Sides& of : *surface)
          if (!used.empty() && !used.contains(of.first))
            to_.remarks.note(contact.at,
                             fmt::format("the surface has sides of body '{}', which face none of the other one "
                                         "and are left out of the contact",
                                         to_.name_of(of.first)));
    }
  }

  void write_contact(const DeckContact& contact, const Sides& a, const Sides& b) {
    const auto interaction = to_.content.interactions.find(contact.interaction);
    const bool known = interaction != to_.content.interactions.end();
    adjust_solids(to_.deck, contact, a.second, b.second, to_.remarks);
    std::optional<double> modulus;
    if (known && !contact.tie) {
      const auto stiffness = [&](int of) {
        const SolidDeckBody& body = to_.bodies.bodies[static_cast<std::size_t>(of)];
        return body.rigid ? HUGE_VAL : body.young / std::cbrt(body.volume);
      };
      modulus = modulus_of(std::min(stiffness(a.first), stiffness(b.first)), interaction->second, to_.remarks);
    }
    const std::string between = fmt::format("between: [{}.{}, {}.{}]", to_.name_of(a.first),
                                            to_.set_of(to_.sets.sides, a.second, contact.master), to_.name_of(b.first),
                                            to_.set_of(to_.sets.sides, b.second, contact.slave));
    const std::string name = yaml_word(to_.contact_names.take(
        known && to_.content.contacts.size() == 1 ? interaction->second.name : contact.slave + "_" + contact.master));
    if (contact.tie || (known && interaction->second.tied)) {
      to_.parts.ties += fmt::format("  {}: {{{}}}\n", name, between);
      ++to_.result.ties;
    } else {
      add_contact(to_.parts, name, between, known ? interaction->second.friction : 0.0, modulus, contact.interaction,
                  gap_of(contact, a.second, b.second));
      ++to_.result.contacts;
    }
  }

  std::string text() const {
    std::string text = head_text(to_.parts, to_.remarks, deck_name_) + "analysis: {space: true}\nmaterials:\n" +
                       to_.parts.materials + "bodies:\n";
    for (const SolidDeckBody& body : to_.bodies.bodies)
      text += fmt::format("  {}: {{{}, mesh: {{file: {}, region: {}}}{}}}\n", yaml_word(body.name),
                          body.rigid ? "rigid: true" : "material: " + yaml_word(body.material), yaml_quoted(mesh_name_),
                          yaml_word(body.name), body.preload);
    return text + sections_text(to_.parts);
  }

  SolidModelWriter to_;
  std::string deck_name_, mesh_name_;
};

}  // namespace

Conversion convert_solids(files::AbaqusDeck deck, const std::string& deck_name, const std::string& mesh_name,
                          bool rigid_contact) {
  return SolidConverter(std::move(deck), deck_name, mesh_name).convert(rigid_contact);
}

}  // namespace scabo::convert
