#include "scabo/convert/convert_abaqus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "scabo/convert/contact_softness.hpp"
#include "scabo/convert/convert_solids.hpp"
#include "scabo/convert/deck_adjust.hpp"
#include "scabo/convert/deck_bodies.hpp"
#include "scabo/convert/deck_content.hpp"
#include "scabo/convert/deck_elements.hpp"
#include "scabo/convert/deck_names.hpp"
#include "scabo/convert/piece_geometry.hpp"
#include "scabo/convert/write_mesh.hpp"
#include "scabo/convert/write_model.hpp"
#include "scabo/convert/write_steps.hpp"
#include "scabo/files/abaqus_lines.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::convert {

namespace {

using files::Facet;
using files::ImportedCell;
using files::ImportedMesh;
using files::upper;
using model::number_text;
using model::Plane;

/// How a node is held along x or y over the steps: its displacement, and when the support begins and ends.
struct HeldOver {
  Course course;
  int added = 0, removed = -1;
  friend bool operator==(const HeldOver&, const HeldOver&) = default;
};

class Converter {
 public:
  Converter(files::AbaqusDeck deck, const std::string& deck_name, const std::string& mesh_name)
      : deck_(std::move(deck)), deck_name_(deck_name), mesh_name_(mesh_name) {}

  Conversion convert(bool rigid_contact) {
    for (const std::string& remark : mesh_.remarks) mesh_remark(remark);
    content_ = read_content(deck_, rigid_contact, remarks_);
    adjust_nodes(deck_, content_, remarks_);
    parts_.plane = plane_of(deck_, remarks_).value_or(Plane::stress);
    for (const Vec2& x : mesh_.nodes) largest_radius_ = std::max(largest_radius_, std::abs(x.x()));
    GivenMaterials materials = materials_of(deck_, content_, parts_.plane, remarks_);
    parts_.materials = std::move(materials.lines);
    young_ = std::move(materials.young);
    bodies_ = bodies_of(deck_, content_, materials.of_cell, remarks_);
    give_thicknesses(content_, materials.thickness, parts_.plane, bodies_, remarks_);
    if (content_.steps.empty())
      remarks_.essential({deck_name_, 1}, "the deck has no *STEP, so that nothing is analysed; add one with *STATIC");
    collect_supports();
    collect_pressures();
    collect_surfaces();
    pieces_ = pieces_of(mesh_, bodies_, uses_of_, uses_);
    write_supports();
    write_forces();
    tell_inside();
    write_pressures();
    write_body_loads();
    write_contacts();
    parts_.steps = steps_text(content_.steps, driven_, parts_);
    parts_.title = content_.title;
    if (!content_.sections.empty()) parts_.thickness = content_.sections.front().thickness;
    result_.model = model_text(parts_, bodies_, remarks_, deck_name_, mesh_name_);
    result_.mesh = mesh_text(deck_, bodies_, pieces_, parts_.plane, deck_name_);
    result_.bodies = static_cast<int>(bodies_.bodies.size());
    result_.steps = static_cast<int>(content_.steps.size());
    result_.remarks = remarks_.take();
    return std::move(result_);
  }

 private:
  /// `file:line: text` of the reader of meshes.
  void mesh_remark(const std::string& remark) {
    const std::size_t end = remark.find(": "), colon = remark.rfind(':', end - 1);
    std::int64_t line = 0;
    const bool placed = end != std::string::npos && colon != std::string::npos &&
                        files::parse_number(std::string_view(remark).substr(colon + 1, end - colon - 1), line);
    const files::DeckPlace at =
        placed ? files::DeckPlace{remark.substr(0, colon), static_cast<int>(line)} : files::DeckPlace{deck_name_, 1};
    const std::string text = placed ? remark.substr(end + 2) : remark;
    remark.find("have no area") != std::string::npos ? remarks_.essential(at, text) : remarks_.note(at, text);
  }

  // ---- what acts on sides

  int use(const std::string& name, int rank) {
    uses_.push_back({name, rank});
    return static_cast<int>(uses_.size()) - 1;
  }
  void add_use(const Facet& side, int number) { uses_of_[key_of(side)].insert(number); }

  /// Number of the course that a node has in a direction; -1 without one.
  int course_of(int node, int component) const {
    const auto found = courses_of_.find({node, component});
    return found == courses_of_.end() ? -1 : found->second;
  }

  /// On the axis of revolution, where the radius stays 0 by itself.
  bool is_on_axis(int node) const {
    return parts_.plane == Plane::revolution &&
           std::abs(mesh_.nodes[static_cast<std::size_t>(node)].x()) <= 1e-9 * largest_radius_;
  }

  /// A radial displacement on the axis: none, or a mistake.
  void leave_out_on_axis(int node) {
    const Given& given = content_.displacements.at({node, 0});
    if (!is_zero(given.course))
      remarks_.essential(given.at, "a radial displacement on the axis opens a hole there; take it out");
  }

  void collect_supports() {
    for (const auto& [key, given] : content_.displacements) {
      const HeldOver held{given.course, given.added, given.removed};
      const auto known = std::find(courses_.begin(), courses_.end(), held);
      courses_of_[key] = static_cast<int>(known - courses_.begin());
      if (known == courses_.end()) courses_.push_back(held);
    }
    std::map<std::array<int, 2>, int> numbers;
    for (const auto& [key, side] : bodies_.boundary) {
      std::array<int, 2> courses{};
      for (const int k : {0, 1}) {
        const auto at = static_cast<std::size_t>(k);
        courses[at] = course_of(side.start, k);
        if (course_of(side.end, k) != courses[at] || (side.middle >= 0 && course_of(side.middle, k) != courses[at]))
          courses[at] = -1;
        if (k == 0 && is_on_axis(side.start) && is_on_axis(side.end)) courses[at] = -1;
        if (courses[at] < 0) continue;
        for (const int node : {side.start, side.end, side.middle})
          if (node >= 0) covered_.insert({node, k});
      }
      if (courses[0] < 0 && courses[1] < 0) continue;
      const auto [number, is_new] = numbers.try_emplace(courses, -1);
      if (is_new) {
        const int middle = side.middle >= 0 ? side.middle : side.start;
        const std::string& label = content_.displacements.at({middle, courses[0] >= 0 ? 0 : 1}).label;
        std::int64_t one = 0;
        number->second = use(files::parse_number(std::string_view(label), one) ? "held" : label, 2);
        support_uses_[number->second] = courses;
      }
      add_use(side, number->second);
    }
  }

  void collect_pressures() {
    std::map<std::pair<Course, int>, int> numbers;
    for (const auto& [key, given] : content_.pressures) {
      const auto side = bodies_.boundary.find(key);
      if (side == bodies_.boundary.end()) {
        remarks_.essential(given.at, "a pressure acts between two elements; only sides of the boundary are taken");
        continue;
      }
      const int body = bodies_.body_of_node[static_cast<std::size_t>(key.first)];
      const auto [number, is_new] = numbers.try_emplace({given.course, body}, -1);
      if (is_new) {
        std::int64_t element = 0;
        const bool named = !files::parse_number(std::string_view(given.label), element);
        number->second = use(named ? given.label : "loaded", 1);
        pressure_uses_[number->second] = &given;
      }
      add_use(side->second, number->second);
    }
  }

  /// Number of the use that is a surface; nothing if it is not there.
  std::optional<int> surface(const std::string& name, const files::DeckPlace& at) {
    const auto [known, is_new] = surfaces_.try_emplace(upper(name));
    if (!is_new) return known->second;
    const auto sides = sides_named(deck_, name);
    if (!sides || sides->empty()) {
      remarks_.essential(
          at, fmt::format("there is no surface '{}' with sides of plane elements; correct it", files::printable(name)));
      return std::nullopt;
    }
    known->second = use(name, 0);
    for (const Facet& side : *sides) {
      const auto found = bodies_.boundary.find(key_of(side));
      if (found == bodies_.boundary.end())
        remarks_.essential(
            at, fmt::format("surface '{}' has sides between two elements; only those of the boundary are taken",
                            files::printable(name)));
      else
        add_use(found->second, *known->second);
    }
    return known->second;
  }

  void collect_surfaces() {
    for (const DeckContact& contact : content_.contacts) {
      const auto slave = surface(contact.slave, contact.at), master = surface(contact.master, contact.at);
      contact_uses_.push_back(slave && master ? std::optional(std::array<int, 2>{*master, *slave}) : std::nullopt);
    }
  }

  std::string place(const DeckPiece& piece) const {
    return bodies_.bodies[static_cast<std::size_t>(piece.body)].name + "." + piece.name;
  }

  /// A point of the boundary; nothing inside of a body, or where another node has the same place.
  std::optional<std::string> place_of_node(int node, const Given& given, const char* what) {
    const std::string number =
        shown_number(deck_, deck_.node_numbers[static_cast<std::size_t>(node)], DeckNumbers::nodes);
    const int body = bodies_.body_of_node[static_cast<std::size_t>(node)];
    const Vec2& x = mesh_.nodes[static_cast<std::size_t>(node)];
    if (!bodies_.boundary_nodes.contains(node)) {
      auto& inside = inside_[{given.at.file, given.at.line}];
      if (inside.count++ == 0) inside.text = fmt::format("{} at node {}", what, number);
      return std::nullopt;
    }
    if (places_.empty())
      for (const int other : bodies_.boundary_nodes) {
        const Vec2& at = mesh_.nodes[static_cast<std::size_t>(other)];
        ++places_[{bodies_.body_of_node[static_cast<std::size_t>(other)], at.x(), at.y()}];
      }
    if (places_.at({body, x.x(), x.y()}) > 1) {
      remarks_.essential(
          given.at,
          fmt::format("{} at node {} cannot be told from that at another node of the same place; give it on a side",
                      what, number));
      return std::nullopt;
    }
    return fmt::format("{{body: {}, near: {}}}", yaml_word(bodies_.bodies[static_cast<std::size_t>(body)].name),
                       yaml_point(x));
  }

  /// One sentence for each line of the deck, whose set may have thousands of such nodes.
  void tell_inside() {
    for (const auto& [at, inside] : inside_)
      remarks_.essential({at.first, at.second},
                         fmt::format("{}{} acts inside of a body; Scabo takes it at the boundary only", inside.text,
                                     inside.count > 1 ? fmt::format(" (and {} more)", inside.count - 1) : ""));
  }

  // ---- sections of the model

  /// `, added: step_2` of a support that begins or ends.
  std::string stages_of(const HeldOver& held) const {
    const std::vector<std::string> names = names_of_steps(content_.steps);
    std::string text;
    for (const auto& [key, step] : {std::pair("added", held.added), std::pair("removed", held.removed)})
      if (step > 0) text += fmt::format(", {}: {}", key, names[static_cast<std::size_t>(step)]);
    return text;
  }

  /// Of a place with courses of displacement in x and y, -1 where it is free.
  void write_support(const std::string& on, const std::array<int, 2>& courses, const std::string& label) {
    std::map<std::string, std::vector<std::string>> fixed;  // by their stages
    for (const int k : {0, 1}) {
      const int number = courses[static_cast<std::size_t>(k)];
      if (number < 0) continue;
      const HeldOver& held = courses_[static_cast<std::size_t>(number)];
      const Course& course = held.course;
      if (is_zero(course)) {
        fixed[stages_of(held)].push_back(k == 0 ? "x" : "y");
        continue;
      }
      const double scale = scale_of(course);
      const std::string name = names_.take(label), value = number_text(scale);
      parts_.supports += fmt::format("  - {{on: {}, displacement: {}, name: {}{}}}\n", on,
                                     k == 0 ? fmt::format("[{}, null]", value) : fmt::format("[null, {}]", value),
                                     yaml_word(name), stages_of(held));
      driven_.push_back({name, scaled(course, 1.0 / scale)});
      ++result_.supports;
    }
    for (const auto& [stages, components] : fixed) {
      parts_.supports += fmt::format("  - {{on: {}, fix: [{}], name: {}{}}}\n", on, fmt::join(components, ", "),
                                     yaml_word(names_.take(label)), stages);
      ++result_.supports;
    }
  }

  void write_supports() {
    for (const DeckPiece& piece : pieces_)
      for (const int number : piece.uses)
        if (const auto found = support_uses_.find(number); found != support_uses_.end())
          write_support(place(piece), found->second, uses_[static_cast<std::size_t>(number)].name);
    std::set<int> nodes;
    for (const auto& [key, given] : content_.displacements)
      if (!covered_.contains(key)) nodes.insert(key.first);
    for (const int node : nodes) {
      std::array<int, 2> courses{-1, -1};
      const Given* given = nullptr;
      for (const int k : {0, 1}) {
        if (covered_.contains({node, k}) || course_of(node, k) < 0) continue;
        if (k == 0 && is_on_axis(node)) {
          leave_out_on_axis(node);
          continue;
        }
        courses[static_cast<std::size_t>(k)] = course_of(node, k);
        given = &content_.displacements.at({node, k});
      }
      if (given == nullptr) continue;
      if (const auto on = place_of_node(node, *given, "a support"))
        write_support(*on, courses, named(given->label, "support", node));
    }
  }

  /// A label of the deck, or a word and the number where that is a number.
  std::string named(const std::string& label, const char* what, int node) const {
    std::int64_t number = 0;
    return files::parse_number(std::string_view(label), number)
               ? fmt::format("{}_{}", what, deck_.node_numbers[static_cast<std::size_t>(node)])
               : label;
  }

  void add_load(const std::string& name, const std::string& on, const std::string& kind, const Course& factors) {
    parts_.loads += fmt::format("  {}: {{{}{}{}}}\n", yaml_word(name), on, on.empty() ? "" : ", ", kind);
    driven_.push_back({name, factors});
    ++result_.loads;
  }

  /// A load along x and y: one if both have the same factors, else two.
  void add_vector_load(const std::string& label, const std::string& on, const char* kind, const Course& x,
                       const Course& y) {
    const double sx = is_zero(x) ? 0.0 : scale_of(x), sy = is_zero(y) ? 0.0 : scale_of(y);
    const Course fx = scaled(x, sx != 0.0 ? 1.0 / sx : 1.0), fy = scaled(y, sy != 0.0 ? 1.0 / sy : 1.0);
    const auto write = [&](double a, double b, const Course& factors) {
      add_load(names_.take(label), on, fmt::format("{}: {}", kind, yaml_point({a, b})), factors);
    };
    if (sx != 0.0 && sy != 0.0 && fx == fy) return write(sx, sy, fx);
    if (sx != 0.0) write(sx, 0.0, fx);
    if (sy != 0.0) write(0.0, sy, fy);
  }

  void write_forces() {
    std::set<int> nodes;
    for (const auto& [key, given] : content_.forces) nodes.insert(key.first);
    const Course none(content_.steps.size());
    for (const int node : nodes) {
      const auto x = content_.forces.find({node, 0}), y = content_.forces.find({node, 1});
      const Given& given = x != content_.forces.end() ? x->second : y->second;
      const auto on = place_of_node(node, given, "a force");
      if (!on) continue;
      add_vector_load(named(given.label, "force", node), "on: " + *on, "force",
                      x != content_.forces.end() ? x->second.course : none,
                      y != content_.forces.end() ? y->second.course : none);
    }
  }

  void write_pressures() {
    for (const DeckPiece& piece : pieces_)
      for (const int number : piece.uses)
        if (const auto found = pressure_uses_.find(number); found != pressure_uses_.end()) {
          const double scale = scale_of(found->second->course);
          add_load(names_.take(uses_[static_cast<std::size_t>(number)].name + "_pressure"), "on: " + place(piece),
                   "pressure: " + number_text(scale), scaled(found->second->course, 1.0 / scale));
        }
  }

  void write_body_loads() {
    for (const DeckBodyLoad& load : content_.body_loads) {
      const auto cells = cells_named(deck_, load.set);
      if (!cells) {
        const auto meaning = meaning_of(deck_, load.set, DeckNumbers::elements);
        const std::string name = files::printable(load.set);
        remarks_.essential(load.x.at, meaning && !meaning->number
                                          ? fmt::format("there is no element set '{}'; correct its name", name)
                                          : fmt::format("element {} is not in the file", name));
        continue;
      }
      std::vector<std::size_t> in_body(bodies_.bodies.size()), of_body(bodies_.bodies.size());
      for (const int body : bodies_.body_of_cell) ++of_body[static_cast<std::size_t>(body)];
      for (const int c : *cells) ++in_body[static_cast<std::size_t>(bodies_.body_of_cell[static_cast<std::size_t>(c)])];
      if (load.kind == DeckBodyLoad::Kind::rotation && parts_.plane != Plane::revolution) {
        remarks_.essential(load.x.at, "a rotation (CENTRIF) is one of bodies of revolution (CAX) only");
        continue;
      }
      if (load.kind != DeckBodyLoad::Kind::body_force && in_body == of_body) {
        write_body_load(load, "");
        continue;
      }
      for (std::size_t b = 0; b < in_body.size(); ++b) {
        if (in_body[b] == 0) continue;
        const std::string& name = bodies_.bodies[b].name;
        if (in_body[b] < of_body[b])
          remarks_.essential(
              load.x.at,
              fmt::format("the load acts on a part of body '{}' only, which Scabo's do not; give it to all of its "
                          "elements",
                          name));
        write_body_load(load, "on: " + yaml_word(name));
      }
    }
  }

  void write_body_load(const DeckBodyLoad& load, const std::string& on) {
    if (load.kind != DeckBodyLoad::Kind::rotation) {
      const char* kind = load.kind == DeckBodyLoad::Kind::gravity ? "gravity" : "body_force";
      return add_vector_load(kind, on, kind, load.x.course, load.y.course);
    }
    const double square = scale_of(load.x.course);  // factors multiply the force
    add_load(names_.take("spin"), on, "spin: " + number_text(std::sqrt(square)), scaled(load.x.course, 1.0 / square));
  }

  // ---- contacts

  void write_contacts() {
    UniqueNames names;
    for (std::size_t k = 0; k < content_.contacts.size(); ++k) {
      const DeckContact& contact = content_.contacts[k];
      const auto interaction = content_.interactions.find(contact.interaction);
      const bool known = interaction != content_.interactions.end();
      if (!contact_uses_[k]) continue;
      const auto [master, slave] = *contact_uses_[k];
      std::vector<std::pair<const DeckPiece*, const DeckPiece*>> pairs;
      bool same_body = false;
      for (const DeckPiece& a : pieces_)
        for (const DeckPiece& b : pieces_) {
          if (!a.uses.contains(master) || !b.uses.contains(slave)) continue;
          same_body = same_body || a.body == b.body;
          if (a.body != b.body) pairs.emplace_back(&a, &b);
        }
      if (pairs.size() > 1)
        std::erase_if(pairs, [&](const auto& pair) {
          return !are_opposite(mesh_, *pair.first, *pair.second) && !are_opposite(mesh_, *pair.second, *pair.first);
        });
      if (pairs.empty())
        remarks_.essential(
            contact.at,
            same_body
                ? "both surfaces are of one body, and Scabo's contacts join two bodies; leave it out, or part the body"
                : "the two surfaces do not lie opposite to each other, and the contact is lost; correct them");
      for (const auto& [a, b] : pairs) {
        std::optional<double> modulus;
        if (!contact.tie && known)
          modulus = modulus_of(mesh_, bodies_, young_, a->body, b->body, interaction->second, remarks_);
        const std::string between = fmt::format("between: [{}, {}]", place(*a), place(*b));
        const bool bonded = contact.tie || (known && interaction->second.tied);
        const std::string wanted =
            known && content_.contacts.size() == 1 ? interaction->second.name : contact.slave + "_" + contact.master;
        if (bonded && least_distance(mesh_, *b, *a) <= 1e-6 * length_of(mesh_, *b)) {
          parts_.ties += fmt::format("  {}: {{{}}}\n", yaml_word(names.take(wanted)), between);
          ++result_.ties;
          continue;
        }
        const std::string name = yaml_word(names.take(wanted));
        if (bonded)
          parts_.contacts += fmt::format("  {}: {{{}, bond: true}}\n", name, between);
        else
          add_contact(parts_, name, between, known ? interaction->second.friction : 0.0, modulus, contact.interaction);
        ++result_.contacts;
      }
    }
  }

  files::AbaqusDeck deck_;
  const ImportedMesh& mesh_ = deck_.mesh;
  std::string deck_name_, mesh_name_;
  Remarks remarks_;
  DeckContent content_;
  DeckBodies bodies_;
  std::vector<double> young_;  // per cell
  double largest_radius_ = 0.0;
  std::vector<SideUse> uses_;
  std::map<std::pair<int, int>, std::set<int>> uses_of_;
  std::vector<HeldOver> courses_;                   // of displacements
  std::map<std::pair<int, int>, int> courses_of_;   // node and component: index into courses_
  std::set<std::pair<int, int>> covered_;           // those that supports on sides hold
  std::map<int, std::array<int, 2>> support_uses_;  // use: courses along x and y
  std::map<int, const Given*> pressure_uses_;
  std::map<std::string, std::optional<int>> surfaces_;           // by name in upper case: its use
  std::vector<std::optional<std::array<int, 2>>> contact_uses_;  // master and slave
  std::map<std::tuple<int, double, double>, int> places_;        // how many boundary nodes of a body are there
  struct Inside {
    std::string text;  // about the first
    int count = 0;
  };
  std::map<std::pair<std::string, int>, Inside> inside_;  // by file and line: what acts inside of bodies
  std::vector<DeckPiece> pieces_;
  UniqueNames names_;  // of loads and supports
  std::vector<Driven> driven_;
  ModelParts parts_;
  Conversion result_;
};

}  // namespace

bool Conversion::complete() const {
  return std::none_of(remarks.begin(), remarks.end(), [](const Remark& remark) { return remark.essential; });
}

Conversion convert_abaqus(files::AbaqusDeck deck, const std::string& deck_name, const std::string& mesh_name,
                          bool rigid_contact) {
  if (deck.solid) return convert_solids(std::move(deck), deck_name, mesh_name, rigid_contact);
  return Converter(std::move(deck), deck_name, mesh_name).convert(rigid_contact);
}

}  // namespace scabo::convert
