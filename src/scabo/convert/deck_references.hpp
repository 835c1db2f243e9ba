// Nodes of a deck of solids that stand for more than themselves: of *PRE-TENSION SECTION, *COUPLING, *RIGID BODY
// and *EQUATION.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scabo/convert/deck_course.hpp"
#include "scabo/convert/remark.hpp"
#include "scabo/files/abaqus.hpp"

namespace scabo::convert {

struct DeckReference {
  enum class Kind {
    bolt,          ///< the force or the shortening of a section
    rigid,         ///< a face or a body that moves as one piece
    distributing,  ///< a force and a moment that are spread over a face
    of_equations   ///< its displacements stand in equations
  };
  enum class On { surface, nodes, elements };
  Kind kind = Kind::rigid;
  On on = On::surface;
  std::string of;                         ///< name of the surface or set
  std::int64_t node = 0;                  ///< a node of no element
  std::optional<std::int64_t> turning;    ///< of *RIGID BODY: the node whose displacements are the rotations
  Eigen::Vector3d place;                  ///< of the node
  std::optional<Eigen::Vector3d> normal;  ///< of a bolt
  files::DeckPlace at;
  std::string written;                         ///< `*COUPLING`
  std::map<int, Given> displacements, forces;  ///< by component: 0 to 2 along the axes, 3 to 5 about them; of a bolt 0
};

/// Whether `references_of` reads this keyword.
bool is_of_reference(const std::string& keyword);
std::vector<DeckReference> references_of(const files::AbaqusDeck& deck, Remarks& remarks);

/// Which of the references a node number is, and 3 if its displacements are rotations, else 0.
std::optional<std::pair<std::size_t, int>> reference_at(const std::vector<DeckReference>& references,
                                                        std::int64_t number);

/// Components of a reference that a word such as ENCASTRE holds.
std::optional<std::vector<int>> components_of_reference(const std::string& word);

}  // namespace scabo::convert
