// *EQUATION of a deck of solids: sum of a_i u_i = 0 of displacements of nodes along the axes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scabo/convert/remark.hpp"
#include "scabo/files/abaqus.hpp"

namespace scabo::convert {

struct DeckTerm {
  std::int64_t number = 0;  ///< of the node
  int component = 0;        ///< 0 to 2
  double factor = 0.0;
};

struct DeckEquation {
  std::vector<DeckTerm> terms;  ///< the first one is that of the dependent displacement
  files::DeckPlace at;
};

/// Of one block, with remarks about what is not taken; nothing if there are such.
std::optional<std::vector<DeckEquation>> equations_of(const files::DeckBlock& block, Remarks& remarks);

}  // namespace scabo::convert
