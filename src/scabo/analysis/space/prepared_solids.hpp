// Bodies in space condensed to the pairs of their contacts, and what acts on them in an increment.
#pragma once

#include <optional>
#include <vector>

#include "scabo/analysis/space/solid_analysis.hpp"
#include "scabo/system/structure.hpp"

namespace scabo::analysis {

inline constexpr Components in_space{3};

/// The pairs of all contacts, in their order.
struct PairedFaces {
  std::vector<system::PairPoints> points;  // of the contacts, then of the held points, then of the bars
  std::vector<SolidPair> pairs;            // at rest
  std::vector<char> turned;                // whether the pairs are corners of side a
  contact::JointLaws laws;
};

PairedFaces paired_faces(const SolidModel& model);

/// Those of one contact; turned: the corners are on its side a, and directions point away from its side b.
struct PairsOfFaces {
  std::vector<mesh::FacetPair> pairs;
  bool turned;
};
PairsOfFaces pairs_of(const SolidModel& model, const SolidContact& contact);

/// A point that moves with a rigid body: of all means of its nodes that lie there the one with the least squares of
/// weights.
system::PairSide side_at(const SolidModel& model, int body, const Eigen::Vector3d& at);

/// The slip along the axes of a pair with these tangents, of which those of friction axes are not of length 1.
inline Eigen::Vector3d slip_of_pair(const Eigen::Matrix3d& directions, const Eigen::Vector2d& along) {
  return directions.col(1) * along[0] + directions.col(2) * (along[1] / directions.col(2).squaredNorm());
}

element::Mat6 elasticity_of(const SolidBody& body);

/// What stays over all increments.
struct PreparedSolids {
  const SolidModel& model;
  PairedFaces paired;
  system::Structure structure;
  system::ContactSystem whole;        // of all bodies
  std::vector<model::Contact> given;  // laws of the contacts of the model
  // Of the present stage:
  std::vector<char> absent = {};  // per body; empty: all are there
  std::optional<system::ContactSystem> fewer = {};

  /// Of the bodies that are there.
  const system::ContactSystem& contact() const { return fewer ? *fewer : whole; }
  bool is_absent(std::size_t body) const { return !absent.empty() && absent[body] != 0; }
  // Pairs without a contact:
  bool is_bar(const system::ContactSystem::Pair& pair) const {
    return static_cast<std::size_t>(pair.index) >= paired.pairs.size() + model.held_points.size();
  }
  bool is_held_point(const system::ContactSystem::Pair& pair) const { return pair.is_bar() && !is_bar(pair); }
  /// Which of the held points or bars of the model a pair is.
  std::size_t held_point(const system::ContactSystem::Pair& pair) const {
    return static_cast<std::size_t>(pair.index) - paired.pairs.size();
  }
  std::size_t bar(const system::ContactSystem::Pair& pair) const { return held_point(pair) - model.held_points.size(); }
};

PreparedSolids prepared_solids(const SolidModel& model, int threads);

/// Laws of the pairs that move.
contact::JointLaws laws_of_solids(const PreparedSolids& prepared, const SolidFactors& factors);

/// Per body: not there during a step; empty: all are there.
std::vector<char> absent_in(const SolidModel& model, int step);
/// Goes to the stage of a step. No factor of a body changes.
void set_stage(PreparedSolids& prepared, int step);

/// Loads and prescribed displacements of all bodies, and of each the sum of the sizes of all its loads.
struct AppliedToSolids {
  std::vector<Vector> forces, prescribed, heated;
  std::vector<double> sums;
  Vector shortening;  // of preloads
};

/// `released`: what removed bodies exerted (SolidState::released).
AppliedToSolids applied_to_solids(const PreparedSolids& prepared, const SolidFactors& factors, Vector shortening,
                                  const std::vector<Vector>& released);

/// The gap of pair i of the model; of an interference, the part that is there.
double gap_of_solids(const PreparedSolids& prepared, const SolidFactors& factors, std::size_t i);

/// Half the size of a rigid body whose rotation is held, by which that is a length; else 1.
double lever_of(const SolidModel& model, const SolidHeldPoint& point);
/// What a held point prescribes, a length.
double displacement_of_held_point(const PreparedSolids& prepared, const SolidFactors& factors, std::size_t point);
/// What each held point exerts, as reactions of constraints; of one that has ended the part that is not yet released.
Vector reactions_of_held_points(const PreparedSolids& prepared, const Vector& p, double release,
                                const Vector& released);

/// The contact problem of the pairs that move, its laws not yet included, from the slip and the offsets of `from`;
/// `tightened`: preloads whose shortenings are unknowns too.
contact::Problem problem_of_solids(const PreparedSolids& prepared, const AppliedToSolids& applied,
                                   const SolidFactors& factors, const SolidState& from,
                                   const std::vector<std::size_t>& tightened);

/// What the parts do under loads, contact forces and rigid motions; nothing, if they are absent.
struct MovedSolids {
  AppliedToSolids applied;
  std::vector<Vector> u, forces, unbalanced, reactions;
};

MovedSolids moved_solids(const PreparedSolids& prepared, AppliedToSolids applied, const Vector& p, const Vector& a);

/// Before the first increment.
MovedSolids solids_at_rest(const PreparedSolids& prepared);
SolidState solid_state_at_rest(const PreparedSolids& prepared);

}  // namespace scabo::analysis
