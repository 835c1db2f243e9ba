// Stiffness of an elastic body and of the springs that hold it.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "scabo/linalg/symmetric_positive_solver.hpp"
#include "scabo/linalg/twofold.hpp"

namespace scabo::system {

/// A point of a body that springs hold along a direction.
struct HeldDirection {
  Vec2 point, direction;  ///< the squares of the directions of one spring add up to 1 along it, however soft it is
};

/// Springs between a body and the ground (springs.hpp). Their forces on the body are -S u.
struct Springs {
  linalg::SparseMatrix matrix;            ///< S, as large as u, positive semidefinite; 0 x 0 without springs
  std::vector<HeldDirection> directions;  ///< motions that leave all of them at rest are free: S is zero along them

  bool none() const { return matrix.size() == 0; }
  Vector times(const Vector& u) const { return none() ? Vector(Vector::Zero(u.size())) : Vector(matrix * u); }
};

class DividedStiffness;  // ranks.hpp

/// Stiffness of an elastic body: dense for one super-element, sparse for finite elements, or divided among several
/// processes. Springs are kept apart from it: it resists no rigid motion, they do.
struct Stiffness {
  std::shared_ptr<const Matrix> dense;
  linalg::SparseMatrix sparse;
  std::shared_ptr<const DividedStiffness> divided = {};
  double rounding = std::numeric_limits<double>::epsilon();  ///< relative error of its entries
  bool resists_rigid_motions =
      false;  ///< no rigid motion is free: it reaches to infinity, or has inertia (inertia.hpp)
  Springs springs = {};
  bool revolved = false;          ///< body of revolution: of the rigid motions it resists all but that along its axis
  std::vector<int> on_axis = {};  ///< then: radial degrees of freedom on the axis, which are 0

  Eigen::Index size() const;
  Vector times(const Vector& u) const;
  linalg::TwofoldVector times(const linalg::TwofoldVector& u) const;  ///< in twice the working precision
  double largest_diagonal() const;
  Vector times_squares(const Vector& u) const;  ///< product of the matrix of the squared entries
  double entries() const;
};

/// K + S, of a sparse K.
linalg::SparseMatrix with_springs(const Stiffness& stiffness);

/// Rows and columns `dofs` (ascending) of K; place[i]: position of i in `dofs`, or -1.
linalg::SparseMatrix principal_part(const linalg::SparseMatrix& K, const std::vector<int>& dofs,
                                    const std::vector<int>& place);

/// Whether two are equal bit for bit.
bool equal(const Stiffness& a, const Stiffness& b);
/// The same number for equal ones.
std::size_t hash_of(const Stiffness& stiffness);

}  // namespace scabo::system
