// What a deck of Abaqus or CalculiX says besides its mesh, in the terms of Scabo: materials, what happens to nodes and
// sides over the steps, contacts. All that has no such terms becomes a remark.
//
// Values over the steps follow the rules of the two programs: in a step a load goes linearly from where it is to its
// new value, or follows its *AMPLITUDE; without a new value it stays; OP=NEW takes it back to 0. Within one step,
// forces and pressures on the same node or side add up.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scabo/convert/deck_course.hpp"
#include "scabo/convert/remark.hpp"
#include "scabo/files/abaqus.hpp"

namespace scabo::convert {

struct Given {
  Course course;
  std::string label;  ///< the set or number of the deck
  files::DeckPlace at;
};

struct DeckMaterial {
  std::string name;
  files::DeckPlace at;
  std::optional<std::pair<double, double>> isotropic;  ///< Young's modulus, Poisson's ratio
  std::optional<std::vector<double>> orthotropic;      ///< E1, E2, E3, nu12, nu13, nu23, G12
  std::optional<double> density, expansion;
};

struct DeckSection {
  std::string set, material, orientation;
  double thickness = 1.0;
  files::DeckPlace at;
};

struct DeckInteraction {
  std::string name;
  double friction = 0.0;
  bool tied = false;
};

struct DeckContact {
  std::string slave, master, interaction;
  bool tie = false;
  files::DeckPlace at;
};

struct DeckStep {
  std::string name;
  double first = 1.0, period = 1.0, smallest = 0.0, largest = 0.0;  ///< of *STATIC; 0: not given
  bool equal = false;                                               ///< DIRECT
  files::DeckPlace at;
};

/// Acceleration or force per volume in the elements of a set.
struct DeckBodyLoad {
  std::string set;
  bool gravity = true;
  Given x, y;
};

struct DeckContent {
  std::string title;
  std::vector<DeckMaterial> materials;
  std::vector<DeckSection> sections;
  std::map<std::string, double> orientations;  ///< name in upper case: angle of axis 1 from x, degrees
  std::map<std::string, DeckInteraction> interactions;
  std::vector<DeckContact> contacts;
  std::vector<DeckStep> steps;
  std::map<std::pair<int, int>, Given> displacements;  ///< node of the mesh and 0 or 1, for x or y
  std::map<std::pair<int, int>, Given> forces;
  std::map<std::pair<int, int>, Given> pressures;  ///< side of the mesh by its corners, the smaller one first
  std::vector<DeckBodyLoad> body_loads;
};

DeckContent read_content(const files::AbaqusDeck& deck, Remarks& remarks);

/// Sides of the facet set, or between nodes of the node set, of this name in any case; nothing if there is neither.
std::optional<std::vector<files::Facet>> sides_named(const files::ImportedMesh& mesh, const std::string& name);
/// Cells of the cell set of this name; nothing if there is none. Every cell for one that is called as all elements are.
std::optional<std::vector<int>> cells_named(const files::ImportedMesh& mesh, const std::string& name);

/// As the key of DeckContent::pressures.
inline std::pair<int, int> key_of(const files::Facet& side) { return std::minmax(side.start, side.end); }

}  // namespace scabo::convert
