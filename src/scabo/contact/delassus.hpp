// Delassus operator W: relative motion of the pairs per contact force, dN x dN (d components per pair, N pairs; length
// per force). Three kinds behind one value:
//
//     dense      the matrix itself: condensed elastic bodies, up to about a thousand pairs
//     sparse     bodies that few pairs couple: stacks of blocks, collections of others
//     condensed  W = B' K^-1 B: factorised stiffness K (n x n) and pair matrix B (n x dN, displacements per unit of
//                pair motion); never formed unless dense() is asked for
//
// Kept as given: data of others may be slightly unsymmetric. Cheap to copy: what is inside is shared and never changes.
#pragma once

#include <Eigen/SparseCore>
#include <memory>

#include "scabo/base/types.hpp"

namespace scabo::linalg {
class SymmetricPositiveSolver;
}

namespace scabo::contact {

class Delassus {
 public:
  Delassus() = default;    ///< of no pairs
  Delassus(Matrix dense);  // implicit: a matrix is a Delassus operator
  explicit Delassus(Eigen::SparseMatrix<double> sparse);
  Delassus(std::shared_ptr<const linalg::SymmetricPositiveSolver> K, Eigen::SparseMatrix<double> B);

  Eigen::Index size() const;  ///< dN
  bool is_dense() const;
  bool is_sparse() const;

  Vector times(const Vector& p) const;  // dN
  Matrix times(const Matrix& p) const;  // dN x k
  /// result = W p; without memory of its own where W is dense or sparse and `result` has its size.
  void apply(const Eigen::Ref<const Vector>& p, Vector& result) const;
  friend Vector operator*(const Delassus& W, const Vector& p) { return W.times(p); }
  /// d x dN: the block of pair i on itself in columns d i .. d i + d - 1. Of a condensed operator they cost dN solves
  /// and are kept; above 4000 rows they are estimated by probing with 64 d vectors of random signs, good to a few
  /// percent: they only scale equations and precondition.
  Matrix diagonal_blocks(int d) const;
  Vector diagonal() const;

  /// Formed at the first call and kept; safe from several threads.
  const Matrix& dense() const;
  /// Only when is_sparse().
  const Eigen::SparseMatrix<double>& sparse() const;

  /// factor W.
  Delassus scaled(double factor) const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace scabo::contact
