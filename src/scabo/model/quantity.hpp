// One number that an analysis computes, by the name under which users ask for its error bar or its history:
// `joint.normal_force`, `floor.reaction_y`, `tip.uy`, `plate.flaw.K_I`, `elastic_energy`; and what else has a history:
// every figure of an increment that summary.json names.
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
    stress_intensity,  ///< K_I or K_II of a crack, force / length^(3/2); at a scaling centre on a corner without bar
    elastic_energy,    ///< of all bodies, force times length
    // These have a history, but no error bar:
    contact_force,       ///< of a contact: resultant on B, force
    contact_moment,      ///< of a contact: of the forces on B about its `about`, force times length
    centre_of_pressure,  ///< of a contact, length
    max_pressure,        ///< of a contact, force / length^2
    external_energy,     ///< work of loads and reactions, force times length
    friction_energy,     ///< dissipated, force times length
    energy_in_time,      ///< kinetic (component 0), damping (1), impact (2), projection (3), massless (4)
    velocity,            ///< of a point, relative to the ground, length / time
    stress,              ///< of a point: xx, yy, xy, zz, principal_1, 2, 3, von_mises (components 0 to 7)
    ground_velocity,     ///< of the ground, which was at rest before the first step in time, length / time
    spring_force,        ///< of springs on their body, force
    bar_tension,         ///< of a bar, force
    pairs_in_state,      ///< of a contact: how many of its pairs are open, stick or slip (component 0, 1, 2)
    broken_pairs,        ///< of a contact with cohesion: how many have lost it
    end_pair,            ///< of a contact: number of the first (component 0) or last (1) pair that is not open
    pore_force,          ///< of a contact with pressure in it, force
    total_normal_force,  ///< with the normal force, which is then the effective one, force
    support_moment,      ///< of a support that prescribes a rotation, force times length
    t_stress,            ///< of a crack: T (component 0), or T_left and T_right (1, 2) between two materials
    energy_release,      ///< of a crack: G or J (component 0, 1), force / length
    corner_stress        ///< of a corner: K_tt or K_rt (component 0, 1), force / length^(3/2)
  };
  Kind kind = Kind::elastic_energy;
  std::string name;   ///< as given by the user
  int index = -1;     ///< contact, support, spring, bar or body; displacement, velocity, stress: -1: with the point
  int component = 0;  ///< 0: x or K_I, 1: y or K_II; others as above
  Vec2 at = Vec2::Zero();  ///< displacement, velocity, stress: the point
  std::string crack;  ///< `flaw`; `flaw.start` or `flaw.end` if both ends are tips; the corner at the scaling centre
  Source source;

  bool has_bar() const { return kind < Kind::contact_force; }
  /// Whether it belongs to the tip of a crack or to a corner.
  bool is_of_tip() const { return kind == Kind::stress_intensity || kind >= Kind::t_stress; }
};

/// Meshes are refined until the error bar of the number is at most `relative` times the number.
struct QuantityTolerance {
  Quantity of;
  double relative = 0.0;  ///< > 0, < 1
  Source source;
};

}  // namespace scabo::model
