// How bodies in space move without deformation: where an analysis ends as a mechanism or collapse, and where neither
// supports nor friction nor loads determine their place. As analysis/diagnostics in the plane.
//
//     u(x) = shift + rotation x (x - about),  `about` the centroid
//
// Integrals over a body of products of two such motions, v'M v, are sums over its nodes with the weights of
// system::volume_of, which integrate quadratic polynomials exactly in tetrahedra with straight edges.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scabo/analysis/space/solid_analysis.hpp"

namespace scabo::analysis {

/// Bodies that are condensed to their pairs. The motions of the contact problem are those of the parts, and after them
/// the shortenings of the preloads `tightened`.
struct MovingSolids {
  const SolidModel& model;
  const system::Structure& structure;
  const system::ContactSystem& contact;
  const std::vector<std::size_t>& tightened;
  // Of all pairs:
  const std::vector<SolidPair>& pairs;  // at rest
  const std::vector<system::PairPoints>& points;
  const std::vector<char>& turned;  // whether the pairs are corners of side a
  const std::vector<char>& absent;  // of all bodies; empty: all are there

  bool is_absent(std::size_t body) const { return !absent.empty() && absent[body] != 0; }
  /// Of a body that is there; none of another one.
  Matrix rigid_motions(std::size_t body) const {
    const Matrix& rigid = structure.parts[body]->rigid_motions();
    return is_absent(body) ? Matrix(rigid.rows(), 0) : rigid;
  }
};

/// The motion without deformation nearest to displacements of the nodes; `largest` is theirs.
SolidBodyMotion motion_of_nodes(const mesh::SolidMesh& mesh, const Vector& u);

/// Of a problem that ended as a mechanism or collapse: the motion by Coulomb's law (contact/questions/onset.hpp), or,
/// where that is not found, the one that proves the mechanism.
SolidMechanism solid_mechanism(const MovingSolids& solids, const contact::Problem& problem,
                               const contact::Solution& solution);

/// Why there is no solution, as a sentence; `mechanism`: the motion, if there is one.
std::string reason_of_solids(const SolidModel& model, const contact::Solution& solution,
                             const std::optional<SolidMechanism>& mechanism);

/// Warnings of a solution that were not `given`, to these too: motions that are not determined, other solutions,
/// pressures and motions that are not small.
void add_warnings(const MovingSolids& solids, const contact::Solution& solution, std::vector<Warning>& given,
                  SolidIncrement& to);

/// `translation along (1, 0, 0)`, `rotation about the axis through (0, 0, 1) along (0, 1, 0)`.
std::string describe_motion(const SolidBodyMotion& motion);

/// `2 of 3 bodies move, most of all 'block'`.
std::string describe(const SolidMechanism& mechanism, const SolidModel& model);

}  // namespace scabo::analysis
