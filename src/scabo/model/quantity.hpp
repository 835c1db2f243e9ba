// One number that an analysis computes, by the name under which users ask for its error bar or its history:
// `joint.normal_force`, `floor.reaction_y`, `tip.uy`, `plate.flaw.K_I`, `elastic_energy`; and what else has a history.
#pragma once

#include <string>

#include "scabo/base/error.hpp"
#include "scabo/base/types.hpp"

namespace scabo::model {

struct Quantity {
  enum class Kind {
    normal_force,      ///< of a contact: sum over its pairs, force
    tangential_force,  ///< likewise
    max_gap,           ///< of a contact, length
    reaction,          ///< of a support, force
    displacement,      ///< of a point, length
    stress_intensity,  ///< K_I or K_II of a crack, force / length^(3/2)
    elastic_energy,    ///< of all bodies, force times length
    // These have a history, but no error bar:
    contact_force,       ///< of a contact: resultant on B, force
    contact_moment,      ///< of a contact: of the forces on B about its `about`, force times length
    centre_of_pressure,  ///< of a contact, length
    max_pressure,        ///< of a contact, force / length^2
    external_energy,     ///< work of loads and reactions, force times length
    friction_energy,     ///< dissipated, force times length
    spring_force         ///< of springs on their body, force
  };
  Kind kind = Kind::elastic_energy;
  std::string name;        ///< as given by the user
  int index = -1;          ///< contact, support, spring or body; displacement: -1 for the body that contains the point
  int component = 0;       ///< 0: x or K_I, 1: y or K_II
  Vec2 at = Vec2::Zero();  ///< displacement: the point
  std::string crack;       ///< `flaw`; `flaw.start` or `flaw.end` if both ends are tips
  Source source;

  bool has_bar() const { return kind < Kind::contact_force; }
};

/// Meshes are refined until the error bar of the number is at most `relative` times the number.
struct QuantityTolerance {
  Quantity of;
  double relative = 0.0;  ///< > 0, < 1
  Source source;
};

}  // namespace scabo::model
