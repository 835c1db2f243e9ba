#include "scabo/convert/write_references.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "scabo/convert/deck_names.hpp"
#include "scabo/convert/rigid_plate.hpp"
#include "scabo/files/text_cursor.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::convert {

namespace {

using files::printable;
using model::number_text;
using Kind = DeckReference::Kind;
using On = DeckReference::On;

std::array<double, 3> array_of(const Eigen::Vector3d& x) { return {x.x(), x.y(), x.z()}; }

class ReferenceWriter {
 public:
  explicit ReferenceWriter(SolidModelWriter& to)
      : to_(to),
        mesh_(*to.deck.solid),
        node_(mesh_.nodes.cols() + 1),
        cell_(static_cast<long>(mesh_.cells.size()) + 1) {}

  void write() {
    for (const SolidDeckBody& body : to_.bodies.bodies) body_names_.take(body.name);
    for (const DeckReference& reference : to_.content.references) {
      if (reference.kind == Kind::bolt) bolt(reference);
      if (reference.kind == Kind::rigid) rigid(reference);
      if (reference.kind == Kind::distributing) distributing(reference);
    }
  }

 private:
  void essential(const DeckReference& reference, const std::string& text) { to_.remarks.essential(reference.at, text); }

  // ---- bolts

  /// A plane, and the body that it cuts; nothing, with a remark, where the surface is not all of its section.
  struct Cut {
    std::size_t body = 0;
    Eigen::Vector3d point = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::Zero();
  };
  std::optional<Cut> cut_of(const DeckReference& reference) {
    const auto facets = surface_named(to_.deck, reference.of);
    if (!facets || facets->empty()) {
      essential(reference, fmt::format("there is no surface '{}' with sides of solid elements for {}; give one",
                                       printable(reference.of), reference.written));
      return std::nullopt;
    }
    Cut cut;
    std::set<std::array<int, 3>> keys;
    double area = 0.0;
    cut.body = static_cast<std::size_t>(to_.body_of_side(facets->front().start));
    for (const files::Facet& facet : *facets) {
      const files::ImportedSolidCell& cell = mesh_.cells[static_cast<std::size_t>(facet.start / 4)];
      const Eigen::Matrix3d x = mesh_.nodes(Eigen::all, files::corners_of(cell, facet.start % 4));
      const Eigen::Vector3d of_side = 0.5 * (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0));
      cut.normal += of_side.dot(cut.normal) < 0.0 ? Eigen::Vector3d(-of_side) : of_side;
      cut.point += of_side.norm() * x.rowwise().mean();
      area += of_side.norm();
      keys.insert(key_of_corners(cell, facet.start % 4));
    }
    cut.point /= area;
    cut.normal.normalize();
    if (reference.normal && std::abs(reference.normal->dot(cut.normal)) < 1.0 - 1e-6)
      essential(reference,
                fmt::format("the normal of {} is not that of its surface, along which Scabo tightens a bolt; "
                            "leave it out",
                            reference.written));
    if (keys == cut_sides(cut)) return cut;
    essential(reference, fmt::format("surface '{}' of {} is not all of a plane section of body '{}', as the cut of a "
                                     "`preload` is; give all sides in one plane, or part the body and tie the parts",
                                     printable(reference.of), reference.written, to_.bodies.bodies[cut.body].name));
    return std::nullopt;
  }

  /// Sides between the elements above the plane and those below it.
  std::set<std::array<int, 3>> cut_sides(const Cut& cut) const {
    std::map<std::array<int, 3>, std::array<int, 2>> sides;  // how many cells below and above
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      if (to_.bodies.of_cell[c] != static_cast<int>(cut.body)) continue;
      Eigen::Vector3d centre = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < 4; ++i) centre += 0.25 * mesh_.nodes.col(mesh_.cells[c].nodes[i]);
      const bool above = (centre - cut.point).dot(cut.normal) > 0.0;
      for (int side = 0; side < 4; ++side) ++sides[key_of_corners(mesh_.cells[c], side)][above ? 1 : 0];
    }
    std::set<std::array<int, 3>> keys;
    for (const auto& [key, counts] : sides)
      if (counts[0] == 1 && counts[1] == 1) keys.insert(key);
    return keys;
  }

  /// The step in which a value goes from 0 to another one, where it stays; nothing, if it has another course.
  std::optional<std::size_t> step_of(const Course& course) const {
    std::size_t step = 0;
    while (step < course.size() && course[step].end == 0.0) ++step;
    for (std::size_t s = 0; s < course.size(); ++s)
      if (!course[s].table.empty() || (s > step && course[s].end != course[step].end)) return std::nullopt;
    return step < course.size() ? std::optional(step) : std::nullopt;
  }

  void bolt(const DeckReference& reference) {
    const auto force = reference.forces.find(0), shortening = reference.displacements.find(0);
    const bool by_force = force != reference.forces.end() && !is_zero(force->second.course);
    const auto cut = cut_of(reference);
    if (!cut) return;
    if (!by_force && (shortening == reference.displacements.end() || is_zero(shortening->second.course)))
      return essential(reference, fmt::format("no *CLOAD and no *BOUNDARY tightens the bolt of {}; give node {} one",
                                              reference.written, reference.node));
    const Given& given = by_force ? force->second : shortening->second;
    const auto step = step_of(given.course);
    if (!step)
      return to_.remarks.essential(
          given.at,
          "a bolt is tightened once, over one step and without an *AMPLITUDE, and then keeps "
          "its length; give the force in one step, and hold the node by *BOUNDARY, FIXED in the next");
    const bool locked =
        shortening != reference.displacements.end() && shortening->second.added == static_cast<int>(*step) + 1;
    if (by_force && *step + 1 < given.course.size() && !locked)
      return to_.remarks.essential(
          given.at,
          "after its step the bolt keeps its force here, and its length in Scabo; hold the node by "
          "*BOUNDARY, FIXED in the next step");
    SolidDeckBody& body = to_.bodies.bodies[cut->body];
    if (!body.preload.empty())
      return essential(
          reference,
          fmt::format(
              "body '{}' has two sections that are tightened, and one of Scabo has one; part it, and tie the parts",
              body.name));
    const double value = scale_of(given.course);
    body.preload =
        fmt::format(", preload: {{cut: {{point: {}, normal: {}}}, {}: {}, tightened: {}}}",
                    yaml_vector(array_of(cut->point)), yaml_vector(array_of(cut->normal)),
                    by_force ? "force" : "shortening", number_text(value), names_of_steps(to_.content.steps)[*step]);
  }

  // ---- faces and bodies that move as one piece

  Course course_of(const std::map<int, Given>& of, int component) const {
    const auto found = of.find(component);
    return found == of.end() ? Course(to_.content.steps.size()) : found->second.course;
  }

  void write_forces(const DeckReference& reference, const std::string& on, const std::string& label) {
    std::array<Course, 3> forces, moments;
    for (int k = 0; k < 3; ++k) {
      forces[static_cast<std::size_t>(k)] = course_of(reference.forces, k);
      moments[static_cast<std::size_t>(k)] = course_of(reference.forces, k + 3);
    }
    to_.add_vector_load(label + "_force", fmt::format("on: {}, at: {}", on, yaml_vector(array_of(reference.place))),
                        "force", forces);
    to_.add_vector_load(label + "_moment", "on: " + on, "moment", moments);
  }

  /// `displacement: [null, 0, null], rotation: [0, null, null]` of these components.
  static std::string motion_text(const std::map<int, double>& values) {
    std::array<std::string, 6> words;
    words.fill("null");
    for (const auto& [component, value] : values) words[static_cast<std::size_t>(component)] = number_text(value);
    return fmt::format("displacement: [{}, {}, {}], rotation: [{}, {}, {}]", words[0], words[1], words[2], words[3],
                       words[4], words[5]);
  }

  void write_motions(const DeckReference& reference, const std::string& body) {
    std::map<int, double> held;
    const auto add = [&](const std::map<int, double>& values) {
      const std::string name = to_.names.take(body);
      to_.parts.supports += fmt::format("  - {{on: {}, {}, at: {}, name: {}}}\n", yaml_word(body), motion_text(values),
                                        yaml_vector(array_of(reference.place)), yaml_word(name));
      ++to_.result.supports;
      return name;
    };
    for (const auto& [component, given] : reference.displacements) {
      to_.tell_stages(given);
      if (is_zero(given.course)) {
        held[component] = 0.0;
        continue;
      }
      const double scale = scale_of(given.course);
      to_.driven.push_back({add({{component, scale}}), scaled(given.course, 1.0 / scale)});
    }
    if (!held.empty()) add(held);
  }

  /// The one body whose elements, or nodes, these are; nothing, if there is none.
  std::optional<std::size_t> whole_body(const DeckReference& reference) const {
    const bool by_nodes = reference.on == On::nodes;
    const auto members = by_nodes ? nodes_named(to_.deck, reference.of) : cells_named(to_.deck, reference.of);
    if (reference.of.empty() || !members || members->empty()) return std::nullopt;
    const std::vector<int>& body_of = by_nodes ? to_.bodies.of_node : to_.bodies.of_cell;
    const int body = body_of[static_cast<std::size_t>(members->front())];
    const std::set<int> different(members->begin(), members->end());
    const bool same = std::all_of(different.begin(), different.end(),
                                  [&](int member) { return body_of[static_cast<std::size_t>(member)] == body; });
    const auto count = static_cast<std::size_t>(std::count(body_of.begin(), body_of.end(), body));
    return same && different.size() == count ? std::optional(static_cast<std::size_t>(body)) : std::nullopt;
  }

  void rigid(const DeckReference& reference) {
    if (reference.on != On::surface) {
      if (const auto whole = whole_body(reference)) {
        SolidDeckBody& body = to_.bodies.bodies[*whole];
        body.rigid = true;
        write_motions(reference, body.name);
        return write_forces(reference, yaml_word(body.name), body.name);
      }
      if (reference.on == On::elements)
        return essential(
            reference,
            fmt::format("the elements '{}' of {} are not all of one body; give those of a whole one, or couple "
                        "a face by *COUPLING",
                        printable(reference.of), reference.written));
    }
    const auto sides = sides_of(reference);
    if (!sides) return;
    const std::string plate = body_names_.take(reference.of + "_plate"), face = to_.set_names.take(plate + "_face");
    to_.bodies.added_mesh += plate_text(mesh_, sides->second, plate, face, node_, cell_);
    SolidDeckBody body;
    body.name = plate;
    body.rigid = true;
    to_.bodies.bodies.push_back(body);
    to_.parts.ties +=
        fmt::format("  {}: {{between: [{}.{}, {}.{}]}}\n", yaml_word(to_.contact_names.take(plate)),
                    to_.name_of(sides->first), to_.set_of(to_.sets.sides, sides->second, reference.of), plate, face);
    ++to_.result.ties;
    to_.remarks.note(
        reference.at,
        fmt::format("{}: the face moves as one piece by a tie to a rigid plate, whose nodes follow it in the mean "
                    "and not each by itself",
                    reference.written));
    write_motions(reference, plate);
    write_forces(reference, yaml_word(plate), plate);
  }

  /// The sides of one body on which a reference acts; nothing, with a remark, if there is no such face.
  std::optional<std::pair<int, std::vector<int>>> sides_of(const DeckReference& reference) {
    const auto by_body = to_.surface(reference.of, reference.at);
    if (by_body.empty()) return std::nullopt;
    const auto& [body, sides] = *by_body.begin();
    std::set<int> of_nodes;
    if (reference.on == On::nodes) {
      const auto nodes = nodes_named(to_.deck, reference.of).value_or(std::vector<int>{});
      of_nodes.insert(nodes.begin(), nodes.end());
      for (const int side : sides)
        for (const int node : files::nodes_of_side(mesh_.cells[static_cast<std::size_t>(side / 4)], side % 4))
          of_nodes.erase(node);
    }
    const bool in_pieces = reference.kind == Kind::rigid && !hang_together(mesh_, sides);
    if (by_body.size() == 1 && of_nodes.empty() && !in_pieces) return *by_body.begin();
    essential(reference, fmt::format("'{}' of {} is not one face of one body; give such a face",
                                     printable(reference.of), reference.written));
    return std::nullopt;
  }

  void distributing(const DeckReference& reference) {
    for (const auto& [component, given] : reference.displacements)
      return to_.remarks.essential(
          given.at, fmt::format("the mean motion of a face is prescribed at node {} by *DISTRIBUTING, which Scabo's "
                                "supports do not; hold the face, or give *KINEMATIC",
                                reference.node));
    const auto sides = sides_of(reference);
    if (!sides) return;
    const std::string set = to_.set_of(to_.sets.sides, sides->second, reference.of);
    write_forces(reference, to_.name_of(sides->first) + "." + set, set);
  }

  SolidModelWriter& to_;
  const files::ImportedSolidMesh& mesh_;
  std::int64_t node_, cell_;  // the first numbers that are free in the mesh file
  UniqueNames body_names_;
};

}  // namespace

void write_references(SolidModelWriter& writer) { ReferenceWriter(writer).write(); }

}  // namespace scabo::convert
