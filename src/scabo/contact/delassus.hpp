// Delassus operator W: relative motion of the pairs per contact force, dN x dN (d components per pair, N pairs; length
// per force). There are three representations:
//
//     dense      the matrix itself: condensed elastic bodies, up to some thousand pairs
//     sparse     bodies that few pairs couple: stacks of blocks, collections of others
//     products   those of a structure (pair_operator.hpp): elastic bodies with more pairs; never formed unless dense()
//                is asked for
//
// The operator is kept as given: problems from other programs may be slightly unsymmetric. Copies are cheap because the
// content is shared and never changes; a factor is applied to products and entries (sparse matrices are copied).
#pragma once

#include <Eigen/SparseCore>
#include <memory>

#include "scabo/base/types.hpp"

namespace scabo::contact {

class PairOperator;  // pair_operator.hpp
class PairHolder;

class Delassus {
 public:
  Delassus() = default;    ///< for zero pairs
  Delassus(Matrix dense);  // implicit: a matrix is a Delassus operator
  explicit Delassus(Eigen::SparseMatrix<double> sparse);
  explicit Delassus(std::shared_ptr<const PairOperator> products);

  /// The same operator with a holder of its pairs. Motions that it gets and gives are those of W before any factor.
  Delassus with_holder(std::shared_ptr<const PairHolder> holder) const;
  const PairHolder* holder() const { return holder_.get(); }  ///< null: none
  /// The same operator of rigid bodies, W = Y'Y, with few rows of Y for each.
  Delassus with_bodies(Eigen::SparseMatrix<double> Y) const;
  const Eigen::SparseMatrix<double>* bodies() const;  ///< Y; null: not known

  Eigen::Index size() const;  ///< dN
  bool is_dense() const;
  bool is_sparse() const;

  Vector times(const Vector& p) const;  // dN
  Matrix times(const Matrix& p) const;  // dN x k
  /// result = W p, by the bodies of a sparse W where they are known; else it allocates no memory if W is dense or
  /// sparse and `result` has the right size.
  void apply(const Eigen::Ref<const Vector>& p, Vector& result) const;
  friend Vector operator*(const Delassus& W, const Vector& p) { return W.times(p); }
  /// d x dN: the diagonal block of pair i in columns d i .. d i + d - 1.
  Matrix diagonal_blocks(int d) const;
  Vector diagonal() const;

  /// Entries of W, computed at the first call and kept if they are not those of a dense W without factor; thread-safe.
  const Matrix& dense() const;
  /// Only when is_dense(): the entries of W are factor() times those of matrix(), which is never copied.
  const Matrix& matrix() const;
  double factor() const { return factor_; }
  /// Only when is_sparse().
  const Eigen::SparseMatrix<double>& sparse() const;

  /// factor W.
  Delassus scaled(double factor) const;

 private:
  struct Data;
  struct Formed;
  std::shared_ptr<const Data> data_;
  double factor_ = 1.0;                   // of data_
  std::shared_ptr<const Formed> formed_;  // entries and Y with the factor
  std::shared_ptr<const PairHolder> holder_;
};

}  // namespace scabo::contact
