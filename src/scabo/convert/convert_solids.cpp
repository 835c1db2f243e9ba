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
#include "scabo/convert/solid_bodies_of_deck.hpp"
#include "scabo/convert/write_model.hpp"
#include "scabo/convert/write_steps.hpp"
#include "scabo/files/abaqus_lines.hpp"
#include "scabo/files/text_cursor.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::convert {

namespace {

using files::upper;
using model::number_text;

std::string yaml_vector(const std::array<double, 3>& x) {
  return fmt::format("[{}, {}, {}]", number_text(x[0]), number_text(x[1]), number_text(x[2]));
}

class SolidConverter {
 public:
  SolidConverter(files::AbaqusDeck deck, const std::string& deck_name, const std::string& mesh_name)
      : deck_(std::move(deck)), deck_name_(deck_name), mesh_name_(mesh_name) {}

  Conversion convert() {
    content_ = read_content(deck_, remarks_);
    tell_elements();
    GivenMaterials materials = materials_of(deck_, content_, model::Plane::strain, remarks_);
    parts_.materials = std::move(materials.lines);
    for (const DeckMaterial& material : content_.materials)
      if (material.orthotropic)
        remarks_.essential(material.at, fmt::format("material '{}' is orthotropic, which materials in space are not",
                                                    files::printable(material.name)));
    bodies_ = solid_bodies_of(deck_, content_, materials.of_cell, materials.young, remarks_);
    if (content_.steps.empty())
      remarks_.essential({deck_name_, 1}, "the deck has no *STEP, so that nothing is analysed; add one with *STATIC");
    write_supports();
    write_forces();
    write_pressures();
    write_body_loads();
    write_contacts();
    parts_.steps = steps_text(content_.steps, driven_, parts_.curves, true);
    parts_.title = content_.title;
    result_.model = text();
    result_.mesh = solid_mesh_text(deck_, bodies_, sets_, deck_name_);
    result_.bodies = static_cast<int>(bodies_.bodies.size());
    result_.steps = static_cast<int>(content_.steps.size());
    result_.in_space = true;
    result_.remarks = remarks_.take();
    return std::move(result_);
  }

 private:
  const std::string& name_of(int body) const { return bodies_.bodies[static_cast<std::size_t>(body)].name; }

  void tell_elements() {
    for (const std::string& remark : deck_.mesh.remarks) {
      const bool lost = remark.find("no solids") != std::string::npos;
      const files::DeckPlace at{deck_name_, 1};
      lost ? remarks_.essential(at, remark) : remarks_.note(at, remark);
    }
  }

  /// A set of the mesh file with these members, called after a label of the deck; the same one for the same members.
  std::string set_of(std::map<std::string, std::vector<int>>& sets, const std::vector<int>& members,
                     const std::string& label) {
    for (const auto& [name, known] : sets)
      if (known == members) return name;
    std::int64_t number = 0;
    const bool named = !files::parse_number(std::string_view(label), number) && !label.empty();
    const std::string name = set_names_.take(named ? label : "set");
    sets[name] = members;
    return name;
  }

  // ---- supports and loads

  void write_supports() {
    using Key = std::tuple<int, int, Course>;  // body, component, course
    std::map<Key, std::pair<std::vector<int>, std::string>> held;
    std::set<std::string> told;  // labels
    for (const auto& [at, given] : content_.displacements) {
      if ((given.added > 0 || given.removed >= 0) && told.insert(given.label).second)
        remarks_.essential(given.at,
                           fmt::format("the support of '{}' begins or ends in step {}, which supports in space do not; "
                                       "give it in every step",
                                       files::printable(given.label), std::max(given.added, given.removed) + 1));
      auto& [nodes, label] = held[{bodies_.of_node[static_cast<std::size_t>(at.first)], at.second, given.course}];
      nodes.push_back(at.first);
      if (label.empty()) label = given.label;
    }
    std::map<std::pair<int, std::string>, std::string> fixed;  // body and set: the axes along which it is held
    for (const auto& [key, of] : held) {
      const auto& [body, component, course] = key;
      const std::string set = set_of(sets_.nodes, of.first, of.second);
      if (is_zero(course)) {
        std::string& axes = fixed[{body, set}];
        axes += (axes.empty() ? "" : ", ") + std::string(1, "xyz"[component]);
        continue;
      }
      const double scale = scale_of(course);
      const std::string name = names_.take(set);
      std::array<std::string, 3> values{"null", "null", "null"};
      values[static_cast<std::size_t>(component)] = number_text(scale);
      parts_.supports += fmt::format("  - {{on: {}.{}, displacement: [{}], name: {}}}\n", name_of(body), set,
                                     fmt::join(values, ", "), yaml_word(name));
      driven_.push_back({name, scaled(course, 1.0 / scale)});
      ++result_.supports;
    }
    for (const auto& [at, axes] : fixed) {
      parts_.supports += fmt::format("  - {{on: {}.{}, fix: [{}], name: {}}}\n", name_of(at.first), at.second, axes,
                                     yaml_word(names_.take(at.second)));
      ++result_.supports;
    }
  }

  void add_load(const std::string& label, const std::string& text, const Course& factors) {
    const std::string name = names_.take(label);
    parts_.loads += fmt::format("  {}: {{{}}}\n", yaml_word(name), text);
    driven_.push_back({name, factors});
    ++result_.loads;
  }

  /// One load of all components whose courses are the same but for their size.
  void add_vector_load(const std::string& label, const std::string& on, const char* kind,
                       const std::array<Course, 3>& courses) {
    std::vector<std::pair<Course, std::array<double, 3>>> loads;
    for (std::size_t k = 0; k < 3; ++k) {
      if (is_zero(courses[k])) continue;
      const double scale = scale_of(courses[k]);
      const Course factors = scaled(courses[k], 1.0 / scale);
      auto same = std::find_if(loads.begin(), loads.end(), [&](const auto& load) { return load.first == factors; });
      if (same == loads.end()) same = loads.insert(same, {factors, {0.0, 0.0, 0.0}});
      same->second[k] = scale;
    }
    for (const auto& [factors, vector] : loads)
      add_load(label, fmt::format("{}{}{}: {}", on, on.empty() ? "" : ", ", kind, yaml_vector(vector)), factors);
  }

  /// Nodal forces that are consistent with a hexahedron act as points on tetrahedra.
  void tell_forces_on_divided_elements() {
    const bool divided = std::any_of(deck_.elements.begin(), deck_.elements.end(), [](const auto& elements) {
      return elements.type.find("C3D4") != 0 && elements.type.find("C3D10") != 0;
    });
    if (divided && !content_.forces.empty())
      remarks_.note(content_.forces.begin()->second.at,
                    "the forces act at the same nodes of elements that are divided, near which displacements differ; a "
                    "*DLOAD on sides does not depend on the elements");
  }

  void write_forces() {
    tell_forces_on_divided_elements();
    const Course none(content_.steps.size());
    std::map<int, std::array<Course, 3>> at_node;
    std::map<int, std::string> labels;
    for (const auto& [at, given] : content_.forces) {
      at_node.try_emplace(at.first, std::array<Course, 3>{none, none, none})
          .first->second[static_cast<std::size_t>(at.second)] = given.course;
      labels[at.first] = given.label;
    }
    std::map<std::pair<int, std::array<Course, 3>>, std::vector<int>> groups;
    for (const auto& [node, courses] : at_node)
      groups[{bodies_.of_node[static_cast<std::size_t>(node)], courses}].push_back(node);
    for (const auto& [key, nodes] : groups) {
      const std::string set = set_of(sets_.nodes, nodes, labels.at(nodes.front()));
      add_vector_load(set + "_force", fmt::format("on: {}.{}", name_of(key.first), set), "nodal_force", key.second);
    }
  }

  int body_of_side(int side) const { return bodies_.of_cell[static_cast<std::size_t>(side / 4)]; }

  void write_pressures() {
    std::map<std::pair<int, Course>, std::pair<std::vector<int>, std::string>> groups;
    for (const auto& [key, given] : content_.pressures) {
      if (!bodies_.outer.contains(key.first)) {
        remarks_.essential(given.at, "a pressure acts between two elements; only sides of the boundary are taken");
        continue;
      }
      auto& [sides, label] = groups[{body_of_side(key.first), given.course}];
      sides.push_back(key.first);
      if (label.empty()) label = given.label;
    }
    for (const auto& [key, of] : groups) {
      const std::string set = set_of(sets_.sides, of.first, of.second);
      const double scale = scale_of(key.second);
      add_load(set + "_pressure", fmt::format("on: {}.{}, pressure: {}", name_of(key.first), set, number_text(scale)),
               scaled(key.second, 1.0 / scale));
    }
  }

  void write_body_loads() {
    for (const DeckBodyLoad& load : content_.body_loads) {
      if (load.kind != DeckBodyLoad::Kind::gravity) {
        remarks_.essential(load.x.at,
                           "forces per volume (BX, BY, BZ) and rotation (CENTRIF) are not taken in space; "
                           "there is GRAV");
        continue;
      }
      const auto cells = cells_named(deck_, load.set);
      if (!cells) {
        remarks_.essential(load.x.at,
                           fmt::format("there is no element set '{}'; correct its name", files::printable(load.set)));
        continue;
      }
      std::vector<std::size_t> in_body(bodies_.bodies.size()), of_body(bodies_.bodies.size());
      for (const int body : bodies_.of_cell) ++of_body[static_cast<std::size_t>(body)];
      for (const int c : *cells) ++in_body[static_cast<std::size_t>(bodies_.of_cell[static_cast<std::size_t>(c)])];
      const std::array<Course, 3> courses{load.x.course, load.y.course, load.z.course};
      if (in_body == of_body) {
        add_vector_load("gravity", "", "gravity", courses);
        continue;
      }
      for (std::size_t b = 0; b < in_body.size(); ++b) {
        if (in_body[b] == 0) continue;
        if (in_body[b] < of_body[b])
          remarks_.essential(load.x.at,
                             fmt::format("the load acts on a part of body '{}' only, which Scabo's do not; give "
                                         "it to all of its elements",
                                         bodies_.bodies[b].name));
        add_vector_load("gravity", "on: " + bodies_.bodies[b].name, "gravity", courses);
      }
    }
  }

  // ---- contacts

  /// The outer sides of a surface by body; a remark, and nothing, without any.
  std::map<int, std::vector<int>> surface(const std::string& name, const files::DeckPlace& at) {
    std::map<int, std::vector<int>> sides;
    for (const files::Facet& facet : sides_named(deck_, name).value_or(std::vector<files::Facet>{}))
      if (bodies_.outer.contains(facet.start)) sides[body_of_side(facet.start)].push_back(facet.start);
    if (sides.empty())
      remarks_.essential(at, fmt::format("there is no surface '{}' with outer sides of solid elements; correct it",
                                         files::printable(name)));
    return sides;
  }

  void tell_adjustment(const DeckContact& contact) {
    if (contact.adjust_within.value_or(0.0) > 0.0 || contact.adjusted_nodes)
      remarks_.essential(contact.at,
                         "ADJUST moves nodes, which is not done in space; move them in the deck, or give the "
                         "contact of the model a 'gap'");
  }

  void write_contacts() {
    UniqueNames names;
    for (const DeckContact& contact : content_.contacts) {
      const auto interaction = content_.interactions.find(contact.interaction);
      const bool known = interaction != content_.interactions.end();
      if (!contact.tie && !contact.interaction.empty() && !known)
        remarks_.essential(contact.at, fmt::format("there is no *SURFACE INTERACTION '{}'; correct its name",
                                                   files::printable(contact.interaction)));
      tell_adjustment(contact);
      const auto master = surface(contact.master, contact.at), slave = surface(contact.slave, contact.at);
      if (master.empty() || slave.empty()) continue;
      if (master.size() > 1 || slave.size() > 1 || master.begin()->first == slave.begin()->first) {
        remarks_.essential(contact.at,
                           "each of both surfaces must be of one body, and not of the same; part them, a "
                           "surface for each body");
        continue;
      }
      const auto& [a, a_sides] = *master.begin();
      const auto& [b, b_sides] = *slave.begin();
      if (known && !contact.tie) {
        const auto stiffness = [](const SolidDeckBody& body) { return body.young / std::cbrt(body.volume); };
        tell_softness(std::min(stiffness(bodies_.bodies[static_cast<std::size_t>(a)]),
                               stiffness(bodies_.bodies[static_cast<std::size_t>(b)])),
                      interaction->second, remarks_);
      }
      const std::string between =
          fmt::format("between: [{}.{}, {}.{}]", name_of(a), set_of(sets_.sides, a_sides, contact.master), name_of(b),
                      set_of(sets_.sides, b_sides, contact.slave));
      const std::string name = yaml_word(names.take(
          known && content_.contacts.size() == 1 ? interaction->second.name : contact.slave + "_" + contact.master));
      if (contact.tie || (known && interaction->second.tied)) {
        parts_.ties += fmt::format("  {}: {{{}}}\n", name, between);
        ++result_.ties;
      } else {
        parts_.contacts += fmt::format("  {}: {{{}, friction: {}}}\n", name, between,
                                       number_text(known ? interaction->second.friction : 0.0));
        ++result_.contacts;
      }
    }
  }

  std::string text() const {
    std::string text = head_text(parts_, remarks_, deck_name_) + "analysis: {space: true}\nmaterials:\n" +
                       parts_.materials + "bodies:\n";
    for (const SolidDeckBody& body : bodies_.bodies)
      text += fmt::format("  {}: {{material: {}, mesh: {{file: {}, region: {}}}}}\n", yaml_word(body.name),
                          yaml_word(body.material), yaml_quoted(mesh_name_), yaml_word(body.name));
    return text + sections_text(parts_);
  }

  files::AbaqusDeck deck_;
  std::string deck_name_, mesh_name_;
  Remarks remarks_;
  DeckContent content_;
  SolidDeckBodies bodies_;
  SolidDeckSets sets_;
  UniqueNames names_, set_names_;
  std::vector<Driven> driven_;
  ModelParts parts_;
  Conversion result_;
};

}  // namespace

Conversion convert_solids(files::AbaqusDeck deck, const std::string& deck_name, const std::string& mesh_name) {
  return SolidConverter(std::move(deck), deck_name, mesh_name).convert();
}

}  // namespace scabo::convert
