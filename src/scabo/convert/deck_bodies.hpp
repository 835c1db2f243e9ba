// The bodies of a deck: cells that are joined by sides, with the boundary cut into pieces on which the same things
// happen. Scabo's edges do not overlap, while sets and surfaces of a deck may.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scabo/convert/deck_content.hpp"
#include "scabo/model/material.hpp"

namespace scabo::convert {

struct DeckRegion {
  std::string name;      ///< in the mesh file
  std::string material;  ///< of the model
  std::vector<int> cells;
};

struct DeckBody {
  std::string name;
  std::vector<DeckRegion> regions;  ///< at least one
  double thickness = 0.0;           ///< 0: of bodies of revolution, or not known
};

struct DeckPiece {
  int body = 0;
  std::string name;  ///< in the mesh file; of its own within the body
  std::vector<files::Facet> sides;
  std::set<int> uses;
};

struct DeckBodies {
  std::vector<DeckBody> bodies;
  std::vector<int> body_of_node, body_of_cell;
  std::map<std::pair<int, int>, files::Facet> boundary;  ///< by key_of
  std::set<int> boundary_nodes;
};

/// `material_of_cell`: names of the model; sections name the bodies. Bodies that meet at a node only become a remark.
DeckBodies bodies_of(const files::AbaqusDeck& deck, const DeckContent& content,
                     const std::vector<std::string>& material_of_cell, Remarks& remarks);

/// Of the sections. Bodies whose elements have several thicknesses, and in plane strain bodies of different thickness,
/// become remarks.
void give_thicknesses(const DeckContent& content, const std::vector<double>& thickness_of_cell, model::Plane plane,
                      DeckBodies& bodies, Remarks& remarks);

/// What a use of sides is called, and which names are preferred: the lowest rank.
struct SideUse {
  std::string name;
  int rank = 0;
};

/// Cuts the boundary where the uses of sides change. `uses_of`: by key_of, indices into `uses`.
std::vector<DeckPiece> pieces_of(const files::ImportedMesh& mesh, const DeckBodies& bodies,
                                 const std::map<std::pair<int, int>, std::set<int>>& uses_of,
                                 const std::vector<SideUse>& uses);

/// Names of a model: letters, digits, _ and -, each one once, in upper and lower case.
class UniqueNames {
 public:
  std::string take(const std::string& wanted);

 private:
  std::set<std::string> taken_;
};

}  // namespace scabo::convert
