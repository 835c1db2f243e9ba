// What joins bodies: contacts and ties.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scabo/model/place.hpp"

namespace scabo::model {

/// Coefficient of friction at a position from 0 to 1 along a contact.
struct FrictionPoint {
  double position = 0.0, friction = 0.0;
};

/// Unilateral contact between two edges, or the two faces of a crack, A (named first) and B. Either friction, cohesion
/// and tension, or `bond`, or a shear strength.
struct Contact {
  std::string name;
  Place a, b;
  double friction = 0.0;  ///< coefficient, >= 0; the static one if a dynamic one is given
  /// Coefficient against backward slip (slip < 0), where it differs; `friction` is then that against forward slip.
  std::optional<double> backward_friction;
  std::optional<double> dynamic_friction;  ///< coefficient, <= friction
  /// The same against backward slip, <= backward_friction; given if both a dynamic and a backward one are.
  std::optional<double> backward_dynamic_friction;
  double slip_distance = 0.0;                 ///< slip over which friction falls to the dynamic value; 0: at once
  std::vector<FrictionPoint> friction_along;  ///< instead of one coefficient; in ascending order of position
  double cohesion = 0.0;                      ///< force / length^2, until first failure
  double lasting_cohesion = 0.0;              ///< force / length^2, of pairs while they are closed
  double tension = 0.0;                       ///< tensile strength, force / length^2, until first failure
  bool bond = false;                          ///< neither opens nor slips
  std::optional<double> shear_strength;       ///< prescribed friction bound (Tresca), force / length^2
  /// Modulus of a bed of springs between the sides, which only presses, force / length^3; empty: none.
  std::optional<double> modulus;
  double gap = 0.0;  ///< length, added to the geometric gap; negative: an interference fit
  /// Index into Model::steps of the step over which interferences, negative gaps, grow from 0 to their values; -1: they
  /// are there from the start.
  int fit_in = -1;
  bool large_slip = false;    ///< its pairs are found anew as its sides pass each other
  Vec2 about = Vec2::Zero();  ///< point to which the moment of the contact forces refers
  Source source;
};

/// Two edges of different bodies that do not separate.
struct Tie {
  std::string name;
  Place a, b;
  Source source;
};

/// Whether the contact has one coefficient of friction, or one for each direction of slip, which a step may change.
bool has_one_coefficient(const Contact& contact);
/// Whether pairs of any of them are found anew.
bool has_large_slip(const std::vector<Contact>& contacts);

}  // namespace scabo::model
