// ADJUST of contacts between solids: nodes of the slave are moved onto a plane master before the analysis.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "scabo/convert/deck_content.hpp"

namespace scabo::convert {

/// Moves nodes of the slave's sides (4 times the cell and the side) that lie opposite the master and whose gap is small
/// enough, or which are in the set. A remark, and no motion, if the master is not plane.
void adjust_solids(files::AbaqusDeck& deck, const DeckContact& contact, const std::vector<int>& master,
                   const std::vector<int>& slave, Remarks& remarks);

/// The least and the largest gap between nodes of the slave and the sides of the master that they face; negative:
/// overlap. Nothing if they face none.
std::optional<std::pair<double, double>> gaps_of_mesh(const files::ImportedSolidMesh& mesh,
                                                      const std::vector<int>& master, const std::vector<int>& slave);

/// Whether the middle of a side of either surface lies opposite a side of the other one, their normals being opposite
/// up to 60 degrees, and not deeper below it than its size.
bool face_each_other(const files::ImportedSolidMesh& mesh, const std::vector<int>& a, const std::vector<int>& b);

}  // namespace scabo::convert
