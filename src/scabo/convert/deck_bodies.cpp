#include "scabo/convert/deck_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/base/disjoint_sets.hpp"
#include "scabo/convert/deck_names.hpp"
#include "scabo/files/abaqus_lines.hpp"
#include "scabo/model/imported_body.hpp"

namespace scabo::convert {

namespace {

using files::Facet;
using files::ImportedCell;
using files::ImportedMesh;

/// Number of the body of each cell, in the order of their first cells.
std::vector<int> joined_by_sides(const ImportedMesh& mesh, int& count) {
  std::map<std::pair<int, int>, int> first;
  DisjointSets sets(mesh.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (int i = 0; i < mesh.cells[c].corners(); ++i) {
      const auto [found, is_new] = first.emplace(key_of(files::side_of(mesh.cells[c], i)), static_cast<int>(c));
      if (!is_new) sets.join(static_cast<std::size_t>(found->second), c);
    }
  std::map<std::size_t, int> number;
  std::vector<int> bodies;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    bodies.push_back(number.emplace(sets.root(c), static_cast<int>(number.size())).first->second);
  count = static_cast<int>(number.size());
  return bodies;
}

}  // namespace

std::string UniqueNames::take(const std::string& wanted) {
  const std::string name = model::name_from(wanted);
  std::string made = name;
  for (int k = 2; !taken_.insert(files::upper(made)).second; ++k) made = fmt::format("{}_{}", name, k);
  return made;
}

DeckBodies bodies_of(const files::AbaqusDeck& deck, const DeckContent& content,
                     const std::vector<std::string>& material_of_cell, Remarks& remarks) {
  const ImportedMesh& mesh = deck.mesh;
  DeckBodies made;
  int count = 0;
  made.body_of_cell = joined_by_sides(mesh, count);
  made.body_of_node.assign(mesh.nodes.size(), -1);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (const int node : mesh.cells[c].nodes) {
      int& body = made.body_of_node[static_cast<std::size_t>(node)];
      if (body >= 0 && body != made.body_of_cell[c])
        remarks.essential(
            deck.elements.at(static_cast<std::size_t>(deck.type_of_cell.at(mesh.cells[c].number))).at,
            fmt::format(
                "elements {} and others meet at node {} only, which joins bodies by a hinge in the deck and not "
                "at all in the model; join them by a side, or part them",
                shown_number(deck, mesh.cells[c].number, DeckNumbers::elements),
                shown_number(deck, deck.node_numbers[static_cast<std::size_t>(node)], DeckNumbers::nodes)));
      body = made.body_of_cell[c];
    }

  std::vector<std::vector<int>> cells(static_cast<std::size_t>(count));
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    cells[static_cast<std::size_t>(made.body_of_cell[c])].push_back(static_cast<int>(c));
  UniqueNames names;
  for (const std::vector<int>& of_body : cells) {
    DeckBody body;
    // An instance names the body best, then sections, then sets that are exactly its cells, then sections of several
    // bodies.
    std::string shared;
    for (const files::DeckInstance& instance : deck.instances)
      if (cells_named(deck, instance.name) == of_body) body.name = instance.name;
    for (const bool exactly : {true, false}) {
      for (const DeckSection& section : content.sections) {
        const auto in_section = cells_named(deck, section.set);
        if (!in_section) continue;
        if (exactly && *in_section == of_body && body.name.empty()) body.name = section.set;
        if (!exactly && shared.empty() && std::binary_search(in_section->begin(), in_section->end(), of_body.front()))
          shared = section.set;
      }
      for (const files::CellSet& set : mesh.cell_sets)
        if (exactly && body.name.empty() && set.cells == of_body) body.name = set.name;
    }
    std::map<std::string, std::vector<int>> by_material;
    for (const int c : of_body) by_material[material_of_cell[static_cast<std::size_t>(c)]].push_back(c);
    if (body.name.empty()) body.name = shared.empty() || by_material.size() > 1 ? "body" : shared;
    body.name = names.take(body.name);
    for (auto& [material, of_material] : by_material)
      body.regions.push_back({by_material.size() > 1 ? names.take(body.name + "_" + material) : body.name, material,
                              std::move(of_material)});
    made.bodies.push_back(std::move(body));
  }
  for (const files::BoundaryLoop& loop : files::boundary_facets(mesh))
    for (const Facet& side : loop.facets) {
      made.boundary.emplace(key_of(side), side);
      for (const int node : {side.start, side.end, side.middle})
        if (node >= 0) made.boundary_nodes.insert(node);
    }
  return made;
}

void give_thicknesses(const DeckContent& content, const std::vector<double>& thickness_of_cell, model::Plane plane,
                      DeckBodies& bodies, Remarks& remarks) {
  if (plane == model::Plane::revolution || content.sections.empty()) return;
  const auto place_of = [&](double thickness) {
    const auto section = std::find_if(content.sections.begin(), content.sections.end(),
                                      [&](const DeckSection& of) { return of.thickness == thickness; });
    return section == content.sections.end() ? content.sections.front().at : section->at;
  };
  std::vector<bool> told(bodies.bodies.size(), false);
  for (std::size_t c = 0; c < thickness_of_cell.size(); ++c) {
    const double thickness = thickness_of_cell[c];
    const auto b = static_cast<std::size_t>(bodies.body_of_cell[c]);
    DeckBody& body = bodies.bodies[b];
    if (thickness == 0.0 || told[b]) continue;
    if (body.thickness == 0.0) body.thickness = thickness;
    const double first = content.sections.front().thickness;
    if (thickness != body.thickness) {
      remarks.essential(place_of(thickness),
                        fmt::format("body '{}' has elements of the thickness {:g} and of {:g}; a body has one, part it",
                                    body.name, body.thickness, thickness));
      told[b] = true;
    } else if (plane == model::Plane::strain && thickness != first) {
      remarks.essential(place_of(thickness),
                        fmt::format("the thickness {:g} is not that of the first section, {:g}; in plane strain a "
                                    "model has one thickness",
                                    thickness, first));
      told[b] = true;
    }
  }
}

std::vector<DeckPiece> pieces_of(const ImportedMesh& mesh, const DeckBodies& bodies,
                                 const std::map<std::pair<int, int>, std::set<int>>& uses_of,
                                 const std::vector<SideUse>& uses) {
  static const std::set<int> none;
  const auto of = [&](const Facet& side) -> const std::set<int>& {
    const auto found = uses_of.find(key_of(side));
    return found == uses_of.end() ? none : found->second;
  };
  std::vector<DeckPiece> pieces;
  for (const files::BoundaryLoop& loop : files::boundary_facets(mesh)) {
    const std::size_t count = loop.facets.size();
    std::size_t first = 0;  // a side before which the uses change, if there is one
    for (std::size_t i = 0; i < count; ++i)
      if (of(loop.facets[i]) != of(loop.facets[(i + count - 1) % count])) {
        first = i;
        break;
      }
    const std::set<int>* before = &none;
    for (std::size_t k = 0; k < count; ++k) {
      const Facet& side = loop.facets[(first + k) % count];
      const std::set<int>& now = of(side);
      if (!now.empty()) {
        if (k == 0 || now != *before)
          pieces.push_back({bodies.body_of_node[static_cast<std::size_t>(side.start)], "", {}, now});
        pieces.back().sides.push_back(side);
      }
      before = &now;
    }
  }
  std::map<int, UniqueNames> names;
  std::map<std::string, std::string> spelling;  // names in a deck are the same in upper and lower case
  for (DeckPiece& piece : pieces) {
    const int best = *std::min_element(piece.uses.begin(), piece.uses.end(), [&](int x, int y) {
      return uses[static_cast<std::size_t>(x)].rank < uses[static_cast<std::size_t>(y)].rank;
    });
    const std::string name = names[piece.body].take(uses[static_cast<std::size_t>(best)].name);
    piece.name = spelling.try_emplace(files::upper(name), name).first->second;
  }
  return pieces;
}

}  // namespace scabo::convert
