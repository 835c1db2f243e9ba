// Condensation of a structure to its contact pairs: relative motion = q + W p + G a (contact/problem.hpp).
//
// Either side of a pair is a point that moves as the weighted mean of some nodes of its part, so that it may lie
// anywhere on a facet. With the directions D of the pair ([n, t], in space [n, t1, t2]) its rows of B are D' sum_i w_i
// u_i, positive for side B and negative for side A, and W = B K^-1 B'.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "scabo/contact/laws/evolution.hpp"
#include "scabo/system/structure.hpp"

namespace scabo::system {

/// W is sparse if bodies fill at most this part of it.
inline constexpr double most_filled = 0.2;
/// A dense W of more rows (1.2 GB) is not formed: for 10,001 pairs of two bodies it would take 3.2 GB, several times.
inline constexpr Eigen::Index most_formed = 12000;

/// A contact pair, apart from its law.
struct PairPoints {
  /// d x d, orthonormal columns: the normal, out of A towards B, and the tangents.
  using Directions = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;
  PairSide a, b;
  Directions directions;
  double gap = 0.0;
  double softness = 0.0;  ///< length / force, of a spring between the sides along the normal
};

/// The part of the contact problem that does not change from increment to increment.
struct ContactSystem {
  /// A pair that can move: contact, index into the interface's pairs, number shown to users (from 1 in each contact).
  /// Bars and held points (Structure::bars) come after all contacts: they have no contact, and the index is that of
  /// the bar.
  struct Pair {
    int contact = -1, index = -1, number = 0;
    bool is_bar() const { return contact < 0; }
  };
  Components components;                                 // of a pair: d
  std::vector<Pair> pairs;                               // N
  std::vector<Eigen::SparseMatrix<double>> motion;       // per part, dN x size of u: B side positive, A side negative
  std::vector<Pair> held;                                // pairs whose gap is fixed by supports, which are left out
  std::vector<Eigen::SparseMatrix<double>> held_motion;  // per part, rows as above
  Vector gap;                                            // N, initial; 0 if the pair is bonded in its initial position
  Vector softness;          // N, length / force: of springs between the sides, which W includes; 0: none
  contact::JointLaws laws;  // law of every pair
  contact::Delassus W;  // dN x dN, a sum over parts: sparse if there are many, by products beyond 6,000 pairs; those
                        // and large dense ones have a holder (joined_bodies.hpp), and need the structure
  contact::RigidMap G;  // dN x m
  std::vector<int> first_rigid;  // per part: its first column in G; an absent one has none

  int rigid_motions() const { return static_cast<int>(G.cols()); }
};

/// The parts on up to `threads` threads.
ContactSystem condense(const Structure& structure, const model::Model& model, const mesh::Mesh& mesh, int threads = 1);

/// The same for given parts and pairs, without a model: `laws` has one for each pair, and pair i of the result is
/// {0, i, number}. `structure` needs its parts alone.
ContactSystem condense(const Structure& structure, const std::vector<PairPoints>& pairs, const contact::JointLaws& laws,
                       int threads = 1);

/// Rows and columns of a matrix of pairs; row_place and column_place: the new number of each, -1: left out. Without
/// `column_place` all columns.
Eigen::SparseMatrix<double> block_of(const Eigen::SparseMatrix<double>& matrix, const std::vector<int>& row_place,
                                     const std::vector<int>& column_place, Eigen::Index rows, Eigen::Index columns);
/// The same rows and columns of W, without its holder.
contact::Delassus block_of(const contact::Delassus& W, const std::vector<int>& place);

/// What is left of a system where some parts are absent: the pairs between parts that are there, in their order and
/// with their numbers, and the rigid motions of these parts; `absent`: one for each part; `waiting`: one for each
/// bar, whose stiffness does not act yet, or empty. W is a sum over parts, and a part contributes only to its own
/// pairs, so that a block of W is exact.
ContactSystem without_parts(const ContactSystem& whole, const Structure& structure, const model::Model& model,
                            const std::vector<char>& absent, const std::vector<char>& waiting = {});

}  // namespace scabo::system
