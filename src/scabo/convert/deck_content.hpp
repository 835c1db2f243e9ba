// What a deck of Abaqus or CalculiX says besides its mesh, in the terms of Scabo: materials, what happens to nodes and
// sides over the steps, contacts. All that has no such terms becomes a remark.
//
// Values over the steps follow the rules of the two programs: in a step a load goes linearly from where it is to its
// new value, or follows its *AMPLITUDE; without a new value it stays; OP=NEW takes it back to 0. Within one step,
// forces and pressures on the same node or side add up.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scabo/convert/deck_course.hpp"
#include "scabo/convert/deck_references.hpp"
#include "scabo/convert/remark.hpp"
#include "scabo/files/abaqus.hpp"

namespace scabo::convert {

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
  bool turned = false;  ///< within an instance that is turned
};

struct DeckInteraction {
  std::string name;
  double friction = 0.0;
  bool tied = false;
  std::optional<double> stiffness, stick_stiffness;  ///< pressure per overlap, shear stress per slip; none: rigid
  files::DeckPlace at_stiffness, at_stick_stiffness;
  bool linear = false;       ///< the pressure is the stiffness times the overlap
  bool exponential = false;  ///< pressure before the surfaces touch; its place is that of the stiffness
  bool rigid = false;        ///< by the wish of the user, whatever stiffness and law the deck gives
};

struct DeckContact {
  std::string slave, master, interaction;
  bool tie = false;
  files::DeckPlace at;
  std::optional<double> adjust_within;          ///< of a contact: nodes with at most this gap are moved onto the master
  std::optional<std::set<int>> adjusted_nodes;  ///< of a contact: or these, whatever their gap
  bool adjusts = true;                          ///< of a tie: nodes within the tolerance are moved onto the master
  std::optional<double> tolerance;              ///< of a tie
  std::optional<double> clearance;              ///< of a contact: its gap, whatever that of the mesh; negative: overlap
};

struct DeckStep {
  std::string name;
  double first = 1.0, period = 1.0, smallest = 0.0, largest = 0.0;  ///< of *STATIC; 0: not given
  bool equal = false;                                               ///< DIRECT
  bool at_once = false;  ///< AMPLITUDE=STEP: loads jump at its begin, so that one increment is the whole step
  std::map<std::string, double> friction;  ///< coefficients that change, by the interaction in upper case
  files::DeckPlace at;
};

/// Acceleration, force per volume, or rotation about the axis of revolution, whose `x` is the square of the angular
/// velocity, in the elements of a set.
struct DeckBodyLoad {
  enum class Kind { gravity, body_force, rotation };
  std::string set;
  Kind kind = Kind::gravity;
  Given x, y, z;  ///< z: of solids
};

struct DeckContent {
  std::string title;
  std::vector<DeckMaterial> materials;
  std::vector<DeckSection> sections;
  std::map<std::string, double> orientations;  ///< name in upper case: angle of axis 1 from x, degrees
  std::map<std::string, DeckInteraction> interactions;
  std::vector<DeckContact> contacts;
  std::vector<DeckStep> steps;
  std::map<std::pair<int, int>, Given> displacements;  ///< node of the mesh and 0, 1 or 2, for x, y or z
  std::map<std::pair<int, int>, Given> forces;
  std::map<std::pair<int, int>, Given> pressures;  ///< side of the mesh, by key_of
  std::vector<DeckBodyLoad> body_loads;
  std::map<int, Given> temperatures;  ///< of solids, by node: changes from the initial ones
  std::vector<DeckReference> references;
};

/// `rigid_contact`: all interactions are DeckInteraction::rigid.
DeckContent read_content(const files::AbaqusDeck& deck, bool rigid_contact, Remarks& remarks);

/// As the key of DeckContent::pressures.
inline std::pair<int, int> key_of(const files::Facet& side) { return std::minmax(side.start, side.end); }

}  // namespace scabo::convert
