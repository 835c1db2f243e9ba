// Bodies in space condensed to the pairs of their contacts, and what acts on them in an increment.
#pragma once

#include <vector>

#include "scabo/analysis/space/solid_analysis.hpp"
#include "scabo/system/structure.hpp"

namespace scabo::analysis {

inline constexpr Components in_space{3};

/// The pairs of all contacts, in their order.
struct PairedFaces {
  std::vector<system::PairPoints> points;
  std::vector<SolidPair> pairs;  // at rest
  std::vector<char> turned;      // whether the pairs are corners of side a
  contact::JointLaws laws;
};

PairedFaces paired_faces(const SolidModel& model);

/// The slip along the axes of a pair with these tangents, of which those of friction axes are not of length 1.
inline Eigen::Vector3d slip_of_pair(const Eigen::Matrix3d& directions, const Eigen::Vector2d& along) {
  return directions.col(1) * along[0] + directions.col(2) * (along[1] / directions.col(2).squaredNorm());
}

element::Mat6 elasticity_of(const SolidBody& body);

/// What stays over all increments. Pairs of bars come after those of all contacts.
struct PreparedSolids {
  const SolidModel& model;
  PairedFaces paired;
  system::Structure structure;
  system::ContactSystem contact;
  std::vector<model::Contact> given;  // laws of the contacts of the model
};

PreparedSolids prepared_solids(const SolidModel& model, int threads);

/// Laws of the pairs that move.
contact::JointLaws laws_of_solids(const PreparedSolids& prepared, const SolidFactors& factors);

/// Loads and prescribed displacements of all bodies, and of each the sum of the sizes of all its loads.
struct AppliedToSolids {
  std::vector<Vector> forces, prescribed, heated;
  std::vector<double> sums;
  Vector shortening;  // of preloads
};

AppliedToSolids applied_to_solids(const PreparedSolids& prepared, const SolidFactors& factors, Vector shortening);

/// The gap of pair i of the model; of an interference, the part that is there.
double gap_of_solids(const PreparedSolids& prepared, const SolidFactors& factors, std::size_t i);

/// The contact problem of the pairs that move, its laws not yet included; `slip`: (d - 1) numbers of each so far;
/// `gap`: of bars the elongation at which they were tightened;
/// `tightened`: preloads whose shortenings are unknowns too.
contact::Problem problem_of_solids(const PreparedSolids& prepared, const AppliedToSolids& applied,
                                   const SolidFactors& factors, const Vector& slip, const Vector& gap,
                                   const std::vector<std::size_t>& tightened);

/// What the parts do under loads, contact forces and rigid motions.
struct MovedSolids {
  AppliedToSolids applied;
  std::vector<Vector> u, forces, unbalanced, reactions;
};

MovedSolids moved_solids(const PreparedSolids& prepared, AppliedToSolids applied, const Vector& p, const Vector& a);

/// Before the first increment.
MovedSolids solids_at_rest(const PreparedSolids& prepared);

}  // namespace scabo::analysis
