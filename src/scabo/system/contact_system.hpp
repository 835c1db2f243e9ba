// Condensation of a structure to its contact pairs: relative motion = q + W p + G a (contact/problem.hpp).
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "scabo/contact/laws/evolution.hpp"
#include "scabo/system/structure.hpp"

namespace scabo::system {

/// What stays the same over all increments.
struct ContactSystem {
  /// A pair that can move: contact, index into the interface's pairs, number shown to users (from 1 in each contact).
  struct Pair {
    int contact = -1, index = -1, number = 0;
  };
  std::vector<Pair> pairs;                               // N
  std::vector<Eigen::SparseMatrix<double>> motion;       // per body, 2N x size of u: B side positive, A side negative
  std::vector<Pair> held;                                // pairs whose supports fix the gap: they take no part
  std::vector<Eigen::SparseMatrix<double>> held_motion;  // per body, rows [n, t] as above
  Vector gap;                                            // N, initial; 0 where the pair is bonded as it is
  contact::JointLaws laws;                               // what each pair carries
  contact::Delassus W;                                   // 2N x 2N, a sum over bodies: sparse where they are many
  contact::RigidMap G;                                   // 2N x m
  std::vector<int> first_rigid;                          // per body: its first column in G

  int rigid_motions() const { return static_cast<int>(G.cols()); }
};

ContactSystem condense(const Structure& structure, const model::Model& model, const mesh::Mesh& mesh);

}  // namespace scabo::system
