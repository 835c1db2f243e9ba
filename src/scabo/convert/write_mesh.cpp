#include "scabo/convert/write_mesh.hpp"

#include <fmt/format.h>

#include <map>

#include "scabo/files/text_cursor.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::convert {

using files::Facet;
using files::ImportedCell;
using files::ImportedMesh;
using model::number_text;

const char* element_family(model::Plane plane) {
  return plane == model::Plane::stress ? "CPS" : plane == model::Plane::strain ? "CPE" : "CAX";
}

std::string mesh_text(const files::AbaqusDeck& deck, const DeckBodies& bodies, const std::vector<DeckPiece>& pieces,
                      model::Plane plane, const std::string& deck_name) {
  const ImportedMesh& mesh = deck.mesh;
  std::string text =
      fmt::format("** Made by `scabo convert` from {}: bodies are element sets, edges are surfaces\n*NODE\n",
                  files::printable(deck_name));
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    text += fmt::format("{}, {}, {}\n", deck.node_numbers[i], number_text(mesh.nodes[i].x()),
                        number_text(mesh.nodes[i].y()));
  for (const DeckBody& body : bodies.bodies)
    for (const DeckRegion& region : body.regions) {
      std::map<std::size_t, std::string> by_nodes;
      for (const int c : region.cells) {
        const ImportedCell& cell = mesh.cells[static_cast<std::size_t>(c)];
        std::string& lines = by_nodes[cell.nodes.size()];
        lines += fmt::format("{}", cell.number);
        for (const int node : cell.nodes)
          lines += fmt::format(", {}", deck.node_numbers[static_cast<std::size_t>(node)]);
        lines += '\n';
      }
      for (const auto& [count, lines] : by_nodes)
        text += fmt::format("*ELEMENT, TYPE={}{}, ELSET={}\n{}", element_family(plane), count, region.name, lines);
      if (body.regions.size() > 1) text += fmt::format("*ELSET, ELSET={}\n{}\n", body.name, region.name);
    }
  std::map<std::pair<int, int>, std::pair<long, int>> sides;  // element and number of the side
  for (const ImportedCell& cell : mesh.cells)
    for (int i = 0; i < cell.corners(); ++i) sides[key_of(files::side_of(cell, i))] = {cell.number, i + 1};
  std::map<std::string, std::string> surfaces;
  for (const DeckPiece& piece : pieces)
    for (const Facet& side : piece.sides) {
      const auto& [element, number] = sides.at(key_of(side));
      surfaces[piece.name] += fmt::format("{}, S{}\n", element, number);
    }
  for (const auto& [name, lines] : surfaces) text += fmt::format("*SURFACE, NAME={}, TYPE=ELEMENT\n{}", name, lines);
  return text;
}

}  // namespace scabo::convert
