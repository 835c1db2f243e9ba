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

/// For each cell its body, numbered by the first cells; and the sides of one cell only.
std::vector<int> joined_cells(const ImportedSolidMesh& mesh, std::set<int>& outer) {
  std::map<std::array<int, 3>, std::vector<int>> at;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (int side = 0; side < 4; ++side)
      at[key_of_corners(mesh.cells[c], side)].push_back(4 * static_cast<int>(c) + side);
  std::vector<int> parent(mesh.cells.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int c) {
    while (parent[static_cast<std::size_t>(c)] != c) c = parent[static_cast<std::size_t>(c)];
    return c;
  };
  for (const auto& [corners, sides] : at) {
    if (sides.size() == 1) outer.insert(sides[0]);
    for (std::size_t k = 1; k < sides.size(); ++k) {
      const int one = root(sides[0] / 4), other = root(sides[k] / 4);
      parent[static_cast<std::size_t>(std::max(one, other))] = std::min(one, other);
    }
  }
  std::map<int, int> numbers;
  std::vector<int> bodies;
  for (int c = 0; c < static_cast<int>(parent.size()); ++c)
    bodies.push_back(numbers.try_emplace(root(c), static_cast<int>(numbers.size())).first->second);
  return bodies;
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
  made.of_cell = joined_cells(mesh, made.outer);
  made.of_node.assign(static_cast<std::size_t>(mesh.nodes.cols()), -1);
  made.bodies.resize(static_cast<std::size_t>(1 + *std::max_element(made.of_cell.begin(), made.of_cell.end())));
  const files::DeckPlace at = deck.elements.front().at;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    SolidDeckBody& body = made.bodies[static_cast<std::size_t>(made.of_cell[c])];
    if (body.material.empty()) body.material = material_of_cell[c], body.young = young[c];
    body.volume += volume_of(mesh, mesh.cells[c]);
    if (material_of_cell[c] != body.material)
      remarks.essential(
          at, fmt::format("element {} and others of the same body have the materials '{}' and '{}', and a body "
                          "in space has one; part it, and tie the parts",
                          mesh.cells[c].number, body.material, material_of_cell[c]));
    for (const int node : mesh.cells[c].nodes) {
      int& of = made.of_node[static_cast<std::size_t>(node)];
      if (of >= 0 && of != made.of_cell[c])
        remarks.essential(at,
                          fmt::format("element {} and others meet at node {} only, which joins bodies in the deck and "
                                      "not at all in the model; join them by a side, or part them",
                                      mesh.cells[c].number, deck.node_numbers[static_cast<std::size_t>(node)]));
      of = made.of_cell[c];
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
