#include "scabo/convert/solid_bodies_of_deck.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numeric>

#include "scabo/convert/deck_bodies.hpp"
#include "scabo/convert/deck_names.hpp"
#include "scabo/files/text_cursor.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::convert {

using files::ImportedSolidCell;
using files::ImportedSolidMesh;
using model::number_text;

std::array<int, 3> key_of_corners(const ImportedSolidCell& cell, int side) {
  const std::vector<int> corners = files::corners_of(cell, side);
  std::array<int, 3> key{corners[0], corners[1], corners[2]};
  std::sort(key.begin(), key.end());
  return key;
}

namespace {

/// Sides of cells by their corners; a side is 4 times the cell and its number.
using SidesAt = std::map<std::array<int, 3>, std::vector<int>>;

SidesAt sides_at(const ImportedSolidMesh& mesh) {
  SidesAt at;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (int side = 0; side < 4; ++side)
      at[key_of_corners(mesh.cells[c], side)].push_back(4 * static_cast<int>(c) + side);
  return at;
}

/// For each cell its body, numbered by the first cells.
std::vector<int> joined_cells(const SidesAt& at, const std::vector<std::string>& material_of_cell) {
  std::vector<int> parent(material_of_cell.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int c) {
    while (parent[static_cast<std::size_t>(c)] != c) c = parent[static_cast<std::size_t>(c)];
    return c;
  };
  const auto material = [&](int side) { return material_of_cell[static_cast<std::size_t>(side / 4)]; };
  for (const auto& [corners, sides] : at)
    for (std::size_t k = 1; k < sides.size(); ++k) {
      if (material(sides[0]) != material(sides[k])) continue;
      const int one = root(sides[0] / 4), other = root(sides[k] / 4);
      parent[static_cast<std::size_t>(std::max(one, other))] = std::min(one, other);
    }
  std::map<int, int> numbers;
  std::vector<int> bodies;
  for (int c = 0; c < static_cast<int>(parent.size()); ++c)
    bodies.push_back(numbers.try_emplace(root(c), static_cast<int>(numbers.size())).first->second);
  return bodies;
}

using Joints = std::set<std::pair<int, int>>;

/// Whether joints lead from one body to another.
bool lead(const Joints& joints, int from, int to) {
  std::set<int> reached{from};
  for (std::size_t before = 0; before < reached.size();) {
    before = reached.size();
    for (const auto& [a, b] : joints)
      if (reached.contains(a) || reached.contains(b)) reached.insert({a, b});
  }
  return reached.contains(to);
}

/// The outer sides, and the joints of bodies of different materials: those at each node.
std::map<int, Joints> find_boundaries(const ImportedSolidMesh& mesh, const SidesAt& at, SolidDeckBodies& made) {
  std::map<int, Joints> at_node;
  for (const auto& [corners, sides] : at) {
    if (sides.size() == 1) made.outer.insert(sides[0]);
    for (std::size_t k = 1; k < sides.size(); ++k) {
      const std::pair<int, int> joint = std::minmax(made.of_cell[static_cast<std::size_t>(sides[0] / 4)],
                                                    made.of_cell[static_cast<std::size_t>(sides[k] / 4)]);
      if (joint.first == joint.second) continue;
      made.joined.insert(joint);
      for (const int node : files::nodes_of_side(mesh.cells[static_cast<std::size_t>(sides[0] / 4)], sides[0] % 4))
        at_node[node].insert(joint);
    }
  }
  return at_node;
}

double volume_of(const ImportedSolidMesh& mesh, const ImportedSolidCell& cell) {
  const auto at = [&](std::size_t i) -> Eigen::Vector3d { return mesh.nodes.col(cell.nodes[i]); };
  return (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) / 6.0;
}

}  // namespace

SolidDeckBodies solid_bodies_of(const files::AbaqusDeck& deck, const DeckContent& content,
                                const std::vector<std::string>& material_of_cell, const std::vector<double>& young,
                                Remarks& remarks) {
  const ImportedSolidMesh& mesh = *deck.solid;
  SolidDeckBodies made;
  const SidesAt at_corners = sides_at(mesh);
  made.of_cell = joined_cells(at_corners, material_of_cell);
  const std::map<int, Joints> joints = find_boundaries(mesh, at_corners, made);
  made.of_node.assign(static_cast<std::size_t>(mesh.nodes.cols()), -1);
  made.bodies.resize(static_cast<std::size_t>(1 + *std::max_element(made.of_cell.begin(), made.of_cell.end())));
  const files::DeckPlace at = deck.elements.front().at;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    SolidDeckBody& body = made.bodies[static_cast<std::size_t>(made.of_cell[c])];
    if (body.material.empty()) body.material = material_of_cell[c], body.young = young[c];
    body.volume += volume_of(mesh, mesh.cells[c]);
    for (const int node : mesh.cells[c].nodes) {
      int& of = made.of_node[static_cast<std::size_t>(node)];
      if (of < 0) of = made.of_cell[c];
      if (of == made.of_cell[c]) continue;
      const auto joint = joints.find(node);
      std::vector<int>& further = made.further_of[node];
      if (joint == joints.end() || !lead(joint->second, of, made.of_cell[c]))
        remarks.essential(at,
                          fmt::format("element {} and others meet at node {} only, which joins bodies in the deck and "
                                      "not at all in the model; join them by a side, or part them",
                                      mesh.cells[c].number, deck.node_numbers[static_cast<std::size_t>(node)]));
      else if (std::find(further.begin(), further.end(), made.of_cell[c]) == further.end())
        further.push_back(made.of_cell[c]);
    }
  }
  UniqueNames names;
  for (const DeckSection& section : content.sections)
    for (const int c : cells_named(deck, section.set).value_or(std::vector<int>{}))
      if (std::string& name = made.bodies[static_cast<std::size_t>(made.of_cell[static_cast<std::size_t>(c)])].name;
          name.empty())
        name = names.take(section.set.empty() ? "body" : section.set);
  for (SolidDeckBody& body : made.bodies)
    if (body.name.empty()) body.name = names.take("body");
  return made;
}

std::string solid_mesh_text(const files::AbaqusDeck& deck, const SolidDeckBodies& bodies, const SolidDeckSets& sets,
                            const std::string& deck_name) {
  const ImportedSolidMesh& mesh = *deck.solid;
  std::string text =
      fmt::format("** Made by `scabo convert` from {}: bodies are element sets\n*NODE\n", files::printable(deck_name));
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i)
    text += fmt::format("{}, {}, {}, {}\n", i + 1, number_text(mesh.nodes(0, i)), number_text(mesh.nodes(1, i)),
                        number_text(mesh.nodes(2, i)));
  for (std::size_t b = 0; b < bodies.bodies.size(); ++b)
    for (const std::size_t count : {4u, 10u}) {
      std::string lines;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        if (bodies.of_cell[c] != static_cast<int>(b) || mesh.cells[c].nodes.size() != count) continue;
        lines += fmt::format("{}", c + 1);
        for (const int node : mesh.cells[c].nodes) lines += fmt::format(", {}", node + 1);
        lines += '\n';
      }
      if (!lines.empty())
        text += fmt::format("*ELEMENT, TYPE=C3D{}, ELSET={}\n{}", count, bodies.bodies[b].name, lines);
    }
  text += bodies.added_mesh;
  for (const auto& [name, nodes] : sets.nodes) {
    text += fmt::format("*NSET, NSET={}\n", name);
    for (const int node : nodes) text += fmt::format("{}\n", node + 1);
  }
  for (const auto& [name, sides] : sets.sides) {
    text += fmt::format("*SURFACE, NAME={}, TYPE=ELEMENT\n", name);
    for (const int side : sides) text += fmt::format("{}, S{}\n", side / 4 + 1, side % 4 + 1);
  }
  return text;
}

}  // namespace scabo::convert
