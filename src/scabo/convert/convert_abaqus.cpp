#include "scabo/convert/convert_abaqus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "scabo/convert/deck_bodies.hpp"
#include "scabo/convert/deck_content.hpp"
#include "scabo/convert/piece_geometry.hpp"
#include "scabo/convert/write_mesh.hpp"
#include "scabo/files/abaqus_lines.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::convert {

namespace {

using files::Facet;
using files::ImportedCell;
using files::ImportedMesh;
using files::upper;
using model::number_text;

/// A key or name as YAML takes it for text.
std::string word(const std::string& name) {
  static const std::set<std::string> reserved = {"TRUE", "FALSE", "NULL", "YES", "NO", "ON", "OFF", "Y", "N", "~"};
  return reserved.contains(upper(name)) ? '"' + name + '"' : name;
}

std::string quoted(const std::string& text) {
  std::string made = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') made += '\\';
    const bool plain = static_cast<unsigned char>(c) >= ' ' && static_cast<unsigned char>(c) < 127;
    made += plain ? std::string(1, c) : std::string("?");
  }
  return made + '"';
}

std::string point(const Vec2& x) { return fmt::format("[{}, {}]", number_text(x.x()), number_text(x.y())); }

/// What a load or a displacement that varies is in `steps`.
struct Driven {
  std::string name;
  Course factors;
};

class Converter {
 public:
  Converter(const files::AbaqusDeck& deck, const std::string& deck_name, const std::string& mesh_name)
      : deck_(deck), mesh_(deck.mesh), deck_name_(deck_name), mesh_name_(mesh_name) {}

  Conversion convert() {
    for (const std::string& remark : mesh_.remarks) mesh_remark(remark);
    content_ = read_content(deck_, remarks_);
    check_elements();
    give_materials();
    bodies_ = bodies_of(deck_, content_, material_of_cell_, remarks_);
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
    write_steps();
    result_.model = model_text();
    result_.mesh = mesh_text(deck_, bodies_, pieces_, plane_strain_.value_or(false), deck_name_);
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

  void check_elements() {
    for (const auto& elements : deck_.elements) {
      const std::string& type = elements.type;
      const bool taken = type.size() >= 4 && (type.starts_with("CPS") || type.starts_with("CPE")) &&
                         std::string_view("3468").find(type[3]) != std::string_view::npos &&
                         type.find_first_not_of("RIHM", 4) == std::string::npos;
      if (!taken) {
        if (type.starts_with("T") || type.starts_with("B"))
          remarks_.note(elements.at, fmt::format("elements of type {} have no section and are left out",
                                                 files::printable(elements.type)));
        else if (std::any_of(deck_.type_of_cell.begin(), deck_.type_of_cell.end(), [&](const auto& cell) {
                   return &deck_.elements[static_cast<std::size_t>(cell.second)] == &elements;
                 }))
          remarks_.essential(
              elements.at,
              fmt::format("elements of type {} are not taken; use plane ones with 3, 4, 6 or 8 nodes (CPS, CPE)",
                          files::printable(elements.type)));
        continue;
      }
      const bool strain = type[2] == 'E';
      if (plane_strain_ && *plane_strain_ != strain)
        remarks_.essential(elements.at,
                           "plane stress (CPS) and plane strain (CPE) in one deck are not taken; use one of them");
      if (!plane_strain_) plane_strain_ = strain;
      if (type.find_first_of("RI", 4) != std::string::npos)
        remarks_.note(
            elements.at,
            fmt::format("elements of type {} become elements of the same nodes with full integration; results differ "
                        "by what the mesh does not resolve",
                        files::printable(type)));
      if (type.find_first_of("HM", 4) != std::string::npos)
        remarks_.note(
            elements.at,
            fmt::format("elements of type {} become elements for displacements alone; use them only where the "
                        "material can change its volume",
                        files::printable(type)));
    }
    for (const DeckSection& section : content_.sections)
      if (section.thickness != content_.sections.front().thickness)
        remarks_.essential(
            section.at,
            fmt::format("the thickness {:g} is not that of the first section, {:g}; a model has one thickness",
                        section.thickness, content_.sections.front().thickness));
  }

  const DeckMaterial* material_named(const std::string& name) const {
    for (const DeckMaterial& material : content_.materials)
      if (upper(material.name) == upper(name)) return &material;
    return nullptr;
  }

  void give_materials() {
    material_of_cell_.assign(mesh_.cells.size(), "");
    UniqueNames names;
    std::map<std::string, std::string> made;
    std::set<std::string> used;
    for (const DeckSection& section : content_.sections) {
      const DeckMaterial* material = material_named(section.material);
      const auto cells = cells_named(mesh_, section.set);
      if (!cells) continue;  // of elements that are left out
      if (material == nullptr) {
        if (!section.material.empty())
          remarks_.essential(section.at, fmt::format("there is no material '{}'; correct its name",
                                                     files::printable(section.material)));
        continue;
      }
      used.insert(upper(material->name));
      std::string key = upper(material->name);
      double angle = 0.0;
      if (!section.orientation.empty()) {
        const auto found = content_.orientations.find(section.orientation);
        if (found == content_.orientations.end() && material->orthotropic)
          remarks_.essential(section.at, fmt::format("there is no usable *ORIENTATION '{}'; correct it",
                                                     files::printable(section.orientation)));
        if (found != content_.orientations.end() && material->orthotropic) angle = found->second;
      }
      if (angle != 0.0) key += " " + number_text(angle);
      const auto [entry, is_new] = made.try_emplace(key);
      if (is_new) {
        entry->second = names.take(material->name);
        write_material(*material, angle, entry->second);
      }
      for (const int c : *cells) material_of_cell_[static_cast<std::size_t>(c)] = entry->second;
    }
    for (const DeckMaterial& material : content_.materials)
      if (!used.contains(upper(material.name)))
        remarks_.note(material.at, fmt::format("material '{}' is used by no section and is left out",
                                               files::printable(material.name)));
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      if (material_of_cell_[c].empty()) {
        remarks_.essential(
            deck_.elements[static_cast<std::size_t>(deck_.type_of_cell.at(mesh_.cells[c].number))].at,
            fmt::format("element {} and maybe others have no material; add a *SOLID SECTION", mesh_.cells[c].number));
        break;
      }
  }

  void write_material(const DeckMaterial& material, double angle, const std::string& name) {
    std::string text;
    if (material.isotropic)
      text = fmt::format("young: {}, poisson: {}", number_text(material.isotropic->first),
                         number_text(material.isotropic->second));
    else if (material.orthotropic) {
      const std::vector<double>& n = *material.orthotropic;
      text = fmt::format("orthotropic: {{E1: {}, E2: {}, nu12: {}, G12: {}", number_text(n[0]), number_text(n[1]),
                         number_text(n[3]), number_text(n[6]));
      if (plane_strain_.value_or(false))
        text += fmt::format(", E3: {}, nu13: {}, nu23: {}", number_text(n[2]), number_text(n[4]), number_text(n[5]));
      if (angle != 0.0) text += fmt::format(", angle: {}", number_text(angle));
      text += "}";
    } else {
      remarks_.essential(material.at, fmt::format("material '{}' has no *ELASTIC that is taken; add one",
                                                  files::printable(material.name)));
      return;
    }
    if (material.density) text += fmt::format(", density: {}", number_text(*material.density));
    if (material.expansion) text += fmt::format(", expansion: {}", number_text(*material.expansion));
    materials_ += fmt::format("  {}: {{{}}}\n", word(name), text);
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

  void collect_supports() {
    for (const auto& [key, given] : content_.displacements) {
      const auto known = std::find(courses_.begin(), courses_.end(), given.course);
      courses_of_[key] = static_cast<int>(known - courses_.begin());
      if (known == courses_.end()) courses_.push_back(given.course);
    }
    std::map<std::array<int, 2>, int> numbers;
    for (const auto& [key, side] : bodies_.boundary) {
      std::array<int, 2> courses{};
      for (const int k : {0, 1}) {
        const auto at = static_cast<std::size_t>(k);
        courses[at] = course_of(side.start, k);
        if (course_of(side.end, k) != courses[at] || (side.middle >= 0 && course_of(side.middle, k) != courses[at]))
          courses[at] = -1;
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
    const auto sides = sides_named(mesh_, name);
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
    const std::int64_t number = deck_.node_numbers[static_cast<std::size_t>(node)];
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
    return fmt::format("{{body: {}, near: {}}}", word(bodies_.bodies[static_cast<std::size_t>(body)].name), point(x));
  }

  /// One sentence for each line of the deck, whose set may have thousands of such nodes.
  void tell_inside() {
    for (const auto& [at, inside] : inside_)
      remarks_.essential({at.first, at.second},
                         fmt::format("{}{} acts inside of a body; Scabo takes it at the boundary only", inside.text,
                                     inside.count > 1 ? fmt::format(" (and {} more)", inside.count - 1) : ""));
  }

  // ---- sections of the model

  /// Of a place with courses of displacement in x and y, -1 where it is free.
  void write_support(const std::string& on, const std::array<int, 2>& courses, const std::string& label) {
    std::vector<std::string> fixed;
    for (const int k : {0, 1}) {
      const int number = courses[static_cast<std::size_t>(k)];
      if (number < 0) continue;
      const Course& course = courses_[static_cast<std::size_t>(number)];
      if (is_zero(course)) {
        fixed.push_back(k == 0 ? "x" : "y");
        continue;
      }
      const double scale = scale_of(course);
      const std::string name = names_.take(label), value = number_text(scale);
      supports_ +=
          fmt::format("  - {{on: {}, displacement: {}, name: {}}}\n", on,
                      k == 0 ? fmt::format("[{}, null]", value) : fmt::format("[null, {}]", value), word(name));
      driven_.push_back({name, scaled(course, 1.0 / scale)});
      ++result_.supports;
    }
    if (fixed.empty()) return;
    supports_ +=
        fmt::format("  - {{on: {}, fix: [{}], name: {}}}\n", on, fmt::join(fixed, ", "), word(names_.take(label)));
    ++result_.supports;
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
        courses[static_cast<std::size_t>(k)] = course_of(node, k);
        given = &content_.displacements.at({node, k});
      }
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
    loads_ += fmt::format("  {}: {{{}{}{}}}\n", word(name), on, on.empty() ? "" : ", ", kind);
    driven_.push_back({name, factors});
    ++result_.loads;
  }

  /// A load along x and y: one if both have the same factors, else two.
  void add_vector_load(const std::string& label, const std::string& on, const char* kind, const Course& x,
                       const Course& y) {
    const double sx = is_zero(x) ? 0.0 : scale_of(x), sy = is_zero(y) ? 0.0 : scale_of(y);
    const Course fx = scaled(x, sx != 0.0 ? 1.0 / sx : 1.0), fy = scaled(y, sy != 0.0 ? 1.0 / sy : 1.0);
    const auto write = [&](double a, double b, const Course& factors) {
      add_load(names_.take(label), on, fmt::format("{}: {}", kind, point({a, b})), factors);
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
      const auto cells = cells_named(mesh_, load.set);
      if (!cells) {
        remarks_.essential(load.x.at,
                           fmt::format("there is no element set '{}'; correct its name", files::printable(load.set)));
        continue;
      }
      std::vector<std::size_t> in_body(bodies_.bodies.size()), of_body(bodies_.bodies.size());
      for (const int body : bodies_.body_of_cell) ++of_body[static_cast<std::size_t>(body)];
      for (const int c : *cells) ++in_body[static_cast<std::size_t>(bodies_.body_of_cell[static_cast<std::size_t>(c)])];
      const char* kind = load.gravity ? "gravity" : "body_force";
      const char* label = load.gravity ? "gravity" : "body_force";
      if (load.gravity && in_body == of_body) {
        add_vector_load(label, "", kind, load.x.course, load.y.course);
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
        add_vector_load(label, "on: " + word(name), kind, load.x.course, load.y.course);
      }
    }
  }

  // ---- contacts

  void write_contacts() {
    UniqueNames names;
    for (std::size_t k = 0; k < content_.contacts.size(); ++k) {
      const DeckContact& contact = content_.contacts[k];
      const auto interaction = content_.interactions.find(contact.interaction);
      if (!contact.tie && !contact.interaction.empty() && interaction == content_.interactions.end())
        remarks_.essential(contact.at, fmt::format("there is no *SURFACE INTERACTION '{}'; correct its name",
                                                   files::printable(contact.interaction)));
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
        const std::string between = fmt::format("between: [{}, {}]", place(*a), place(*b));
        const bool bonded = contact.tie || (interaction != content_.interactions.end() && interaction->second.tied);
        const std::string wanted = interaction != content_.interactions.end() && content_.contacts.size() == 1
                                       ? interaction->second.name
                                       : contact.slave + "_" + contact.master;
        if (bonded && least_distance(mesh_, *b, *a) <= 1e-6 * length_of(mesh_, *b)) {
          ties_ += fmt::format("  {}: {{{}}}\n", word(names.take(wanted)), between);
          ++result_.ties;
          continue;
        }
        const double mu = interaction == content_.interactions.end() ? 0.0 : interaction->second.friction;
        contacts_ += fmt::format("  {}: {{{}, {}}}\n", word(names.take(wanted)), between,
                                 bonded ? std::string("bond: true") : "friction: " + number_text(mu));
        ++result_.contacts;
      }
    }
  }

  // ---- steps

  std::string curve_for(const std::vector<std::pair<double, double>>& table) {
    for (const auto& [name, known] : curves_)
      if (known == table) return name;
    curves_.emplace_back(fmt::format("curve_{}", curves_.size() + 1), table);
    return curves_.back().first;
  }

  void write_steps() {
    UniqueNames names;
    for (std::size_t s = 0; s < content_.steps.size(); ++s) {
      const DeckStep& step = content_.steps[s];
      std::vector<std::string> factors;
      bool plain = content_.steps.size() == 1;  // everything goes to 1, which needs no word
      for (const Driven& driven : driven_) {
        const Leg& leg = driven.factors[s];
        const double before = s > 0 ? driven.factors[s - 1].end : 0.0;
        plain = plain && leg.table.empty() && leg.end == 1.0;
        if (leg.table.empty() && leg.end == before) continue;
        factors.push_back(
            fmt::format("{}: {}", word(driven.name), leg.table.empty() ? number_text(leg.end) : curve_for(leg.table)));
      }
      if (factors.empty() && !plain && !driven_.empty())
        factors.push_back(
            fmt::format("{}: {}", word(driven_.front().name), number_text(driven_.front().factors[s].end)));
      const double first = step.first / step.period,
                   largest = std::min(1.0, step.largest > 0.0 ? step.largest / step.period : 1.0);
      std::string increments = "1";
      if (step.equal) {
        const double count = std::round(step.period / step.first);
        increments = fmt::format("{}", static_cast<int>(std::clamp(count, 1.0, 100000.0)));
      } else if (first < 1.0) {
        const double most = std::max(largest, 1e-6), least = std::clamp(step.smallest / step.period, 1e-6, most);
        increments = fmt::format("{{first: {}, smallest: {}, largest: {}}}",
                                 number_text(std::clamp(first, least, most)), number_text(least), number_text(most));
      }
      steps_ += fmt::format("  - {{name: {}, increments: {}{}}}\n",
                            word(names.take(step.name.empty() ? fmt::format("step_{}", s + 1) : step.name)), increments,
                            plain || factors.empty() ? "" : fmt::format(", loads: {{{}}}", fmt::join(factors, ", ")));
    }
  }

  // ---- text

  std::string model_text() {
    std::string text = fmt::format("# Made by `scabo convert` from {}\n", files::printable(deck_name_));
    for (const Remark& remark : remarks_.all())
      if (remark.essential) text += fmt::format("# Missing ({}): {}\n", remark.at.line, remark.text);
    text += "scabo: 1\n";
    if (!content_.title.empty()) text += fmt::format("title: {}\n", quoted(content_.title));
    const double thickness = content_.sections.empty() ? 1.0 : content_.sections.front().thickness;
    text += fmt::format("analysis: {{plane: {}, thickness: {}}}\n", plane_strain_.value_or(false) ? "strain" : "stress",
                        number_text(thickness));
    text += "materials:\n" + materials_ + "bodies:\n";
    for (const DeckBody& body : bodies_.bodies) {
      text += fmt::format("  {}:\n", word(body.name));
      if (body.regions.size() == 1) {
        text += fmt::format("    material: {}\n", word(body.regions[0].material));
      } else {
        std::vector<std::string> materials;
        for (const DeckRegion& region : body.regions)
          materials.push_back(fmt::format("{}: {}", word(region.name), word(region.material)));
        text += fmt::format("    materials: {{{}}}\n", fmt::join(materials, ", "));
      }
      text += fmt::format("    mesh: {{file: {}, region: {}, elements: fem}}\n", quoted(mesh_name_), word(body.name));
    }
    const auto section = [&](const char* name, const std::string& content) {
      if (!content.empty()) text += fmt::format("{}:\n{}", name, content);
    };
    section("supports", supports_);
    section("loads", loads_);
    section("contacts", contacts_);
    section("ties", ties_);
    std::string curves;
    for (const auto& [name, table] : curves_) {
      std::vector<std::string> points;
      for (const auto& [part, value] : table) points.push_back(point({part, value}));
      curves += fmt::format("  {}: {{table: [{}]}}\n", name, fmt::join(points, ", "));
    }
    section("curves", curves);
    section("steps", steps_);
    return text;
  }

  const files::AbaqusDeck& deck_;
  const ImportedMesh& mesh_;
  std::string deck_name_, mesh_name_;
  Remarks remarks_;
  DeckContent content_;
  DeckBodies bodies_;
  std::vector<std::string> material_of_cell_;
  std::optional<bool> plane_strain_;
  std::vector<SideUse> uses_;
  std::map<std::pair<int, int>, std::set<int>> uses_of_;
  std::vector<Course> courses_;                     // of displacements
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
  std::vector<std::pair<std::string, std::vector<std::pair<double, double>>>> curves_;
  std::string materials_, supports_, loads_, contacts_, ties_, steps_;
  Conversion result_;
};

}  // namespace

bool Conversion::complete() const {
  return std::none_of(remarks.begin(), remarks.end(), [](const Remark& remark) { return remark.essential; });
}

Conversion convert_abaqus(const files::AbaqusDeck& deck, const std::string& deck_name, const std::string& mesh_name) {
  return Converter(deck, deck_name, mesh_name).convert();
}

}  // namespace scabo::convert
