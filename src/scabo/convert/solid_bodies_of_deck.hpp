// The bodies of a deck of solids, and the mesh file with the sets that the model names.
#pragma once

#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scabo/convert/deck_content.hpp"

namespace scabo::convert {

struct SolidDeckBody {
  std::string name, material;
  double young = 0.0, volume = 0.0;
  bool rigid = false;
  std::string preload;  ///< `, preload: {...}` of its line in the model
};

struct SolidDeckBodies {
  std::vector<SolidDeckBody> bodies;
  std::vector<int> of_cell, of_node;           ///< a node that several have: the one with the first of its cells
  std::map<int, std::vector<int>> further_of;  ///< by node: all others that have it
  std::set<std::pair<int, int>> joined;        ///< bodies that sides join, of different materials
  std::set<int> outer;                         ///< sides of the boundaries, 4 times the cell and the side
  std::string added_mesh;                      ///< of bodies that the deck has no elements of
};

/// The corners of a side, ascending.
std::array<int, 3> key_of_corners(const files::ImportedSolidCell& cell, int side);

/// Cells of one material that sides join, by the names of their sections. Such that meet at nodes only become remarks.
/// `material_of_cell`, `young`: as GivenMaterials.
SolidDeckBodies solid_bodies_of(const files::AbaqusDeck& deck, const DeckContent& content,
                                const std::vector<std::string>& material_of_cell, const std::vector<double>& young,
                                Remarks& remarks);

/// Sets of the mesh file by name: of nodes, and of sides as in SolidDeckBodies::outer.
struct SolidDeckSets {
  std::map<std::string, std::vector<int>> nodes, sides;
};
std::string solid_mesh_text(const files::AbaqusDeck& deck, const SolidDeckBodies& bodies, const SolidDeckSets& sets,
                            const std::string& deck_name);

}  // namespace scabo::convert
