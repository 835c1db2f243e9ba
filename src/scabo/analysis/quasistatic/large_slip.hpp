// Contacts with large slip (`slip: large`): their pairs are found anew as their sides pass each other.
//
// Strains and rotations stay small. Each side of such a contact is moved along the contact, by the mean displacement of
// its points in the pairs, weighted by their normal forces:
//
//     placement of side s = t sum_i p_n,i (u_s,i . t) / sum_i p_n,i
//
// t: along the straight edge of the contact. Both sides are divided again as they face each other there
// (mesh/plane/match), which gives new nodes, super-elements and pairs; divisions always begin with those that the model
// asks for. Stiffness, loads and supports are those of the bodies where they are at the start. The displacements of a
// part are then counted from its translation c (Replacing::moved), without which rounding of K u would exceed the
// forces.
//
// What is carried over, by arc length on either side and as the mean of both: tractions of the pairs, the direction of
// their slip, and slip so far. Contact is then solved again under the same loads, and the totals of its forces change
// by the jump that the results report:
//  - pairs that slipped keep their direction and the force of the cone there;
//  - pairs that stuck have no slip from the displacements under the tractions that are carried over, so that these
//    remain in equilibrium as far as the new pairs can represent them.
//
// Sides that slide off each other face each other over less and less. Their pairs are found anew at the end of every
// increment, so that its results are those of the overlap there. The forces fall with it, and the work since the pairs
// were found is that of the mean of the forces before and after.
#pragma once

#include <string>
#include <vector>

#include "scabo/analysis/quasistatic/attempt.hpp"

namespace scabo::analysis {

class LargeSlip {
 public:
  /// Of a valid model with such contacts. Divides its bodies.
  explicit LargeSlip(const model::Model& model);

  /// Whether the sides have passed each other by half an element since their pairs were found.
  bool is_due(const Prepared& prepared, const State& state) const;
  /// By how much the sides pass each other from one state to another of the same pairs, relative to half an element.
  double passed(const Prepared& prepared, const State& from, const State& to) const;
  /// Whether the length over which the sides of a contact face each other has changed since their pairs were found.
  bool overlap_changed(const Prepared& prepared, const State& state) const;
  /// Motion of side B along that of A, as a vector, of every contact with large slip from one state to another of the
  /// same pairs; zero of other contacts.
  std::vector<Vec2> motions(const Prepared& prepared, const State& from, const State& to) const;

  /// Where the sides are.
  mesh::Placement placement_of(const Prepared& prepared, const State& state) const;
  std::variant<mesh::Mesh, std::vector<Diagnostic>> mesh_in(const model::Model& model, mesh::Placement placement) const;

  /// A sentence for each contact whose sides face each other over less than at the start; its index before it.
  std::vector<std::pair<std::size_t, std::string>> slid_off(const model::Model& model,
                                                            const mesh::Placement& placement) const;

 private:
  struct Of {
    std::size_t contact = 0;
    Vec2 along = Vec2::Zero();  ///< t, unit
    double element = 0.0;       ///< length of the shortest element of both sides, as the model asks for
    double facing = 0.0;        ///< length over which the sides face each other at the start
  };
  double lag(const Prepared& prepared, const State& state, const Of& of) const;

  std::vector<Of> contacts_;
  std::vector<mesh::BodyMesh> bodies_;  // not matched
};

/// Pairs found anew in a state.
struct FoundAnew {
  std::string reason;             ///< why they were not; empty if they were
  Discretisation discretisation;  ///< with them
  double jump = 0.0;              ///< largest change of the force of a contact, relative to it
  int iterations = 0;             ///< of the contact solver
  contact::Certificate certificate;
  double residual = 0.0;
};

/// Replaces the state by that on new pairs; `since`: the state in which the present pairs began to slide off each
/// other. Nothing changes if it fails.
FoundAnew find_pairs_anew(const LargeSlip& large, const Prepared& at, const State& since, State& state, Timing& timing);

}  // namespace scabo::analysis
