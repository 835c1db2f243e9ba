// G: relative motion of the pairs per unit rigid motion of the bodies that only contact holds, dN x m (d components per
// pair, N pairs, m rigid motions). Every pair touches two bodies, so that G is sparse: at most six entries per row in
// the plane.
//
// Copies are cheap because the content is shared and never changes.
#pragma once

#include <Eigen/SparseCore>
#include <memory>

#include "scabo/base/types.hpp"

namespace scabo::contact {

class RigidMap {
 public:
  using Sparse = Eigen::SparseMatrix<double>;

  RigidMap();                     ///< 0 x 0
  RigidMap(const Matrix& dense);  // implicit: a matrix is such a map
  template <typename Derived>
  RigidMap(const Eigen::MatrixBase<Derived>& dense) : RigidMap(Matrix(dense)) {}
  explicit RigidMap(Sparse sparse);

  Eigen::Index rows() const { return sparse().rows(); }
  Eigen::Index cols() const { return sparse().cols(); }
  /// Sets the map to zero, with the given size.
  void resize(Eigen::Index rows, Eigen::Index cols);

  const Sparse& sparse() const;
  /// Computed at the first call and kept; thread-safe.
  const Matrix& dense() const;

  auto transpose() const { return sparse().transpose(); }
  Vector operator*(const Vector& a) const { return sparse() * a; }
  /// motion += G a.
  void add_motion(const Eigen::Ref<const Vector>& a, Vector& motion) const { motion.noalias() += sparse() * a; }

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace scabo::contact
