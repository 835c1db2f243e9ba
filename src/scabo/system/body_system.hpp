// One body with its supports and springs: its displacement under nodal forces, prescribed displacements and rigid
// motions.
//
// Displacement vectors have two components per node, in space three; those of a rigid body, which is plane, have three,
// [u_x, u_y, L rotation] about its centroid, with L half its size so that all three are lengths. For both,
//
//     u = u_p(f, d) + A C'p + Nn a
//
// u_p: displacement under applied forces f and prescribed displacements d. A: flexibility, which is zero on the
// supports and, if supports leave rigid motions Nn free, on as many further degrees of freedom. a: amplitudes of those
// motions, which follow from their equilibrium Nn'(f + C'p) = 0. No springs are added but those of the model, S: u_p
// and A are those of K + S, and Nn has only motions under which no spring changes its length.
//
// In slender bodies K u is a small difference of large numbers: for a cantilever of length L and depth h they are
// (L/h)^3 times the load, and rounding u alone causes a relative error of 4e-9 at 100:1. In such bodies displacement,
// flexibility, reactions, imbalance and energy are computed with twice the working precision (linalg/twofold.hpp): u is
// refined to its last digit, and reactions and imbalance are those of the displacement of which u is the rounded value.
// In large bodies, whose displacement is large beside its differences over an element, so are they wherever u as it is
// leaves more than `Balanced` allows.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scabo/mesh/mesh.hpp"
#include "scabo/system/positions.hpp"
#include "scabo/system/stiffness.hpp"

namespace scabo::system {

/// The displacement of a point along a direction, which a support holds at a prescribed value.
struct Constraint {
  /// Elastic body: place of component 0 of the node + that of this constraint there; along x 0, y 1, z 2.
  int dof = -1;
  Vec2 point = Vec2::Zero();  ///< rigid body: the point (absolute)
  int component = 0;          ///< 0: along x, 1: along y, 2: along z, -1: along `inclined`
  bool rotation = false;      ///< rigid body: its rotation, held by a support on the whole body
  int support = -1;           ///< index into Model::supports
  double value = 0.0;         ///< length, at factor 1
  Eigen::Vector3d inclined = Eigen::Vector3d::Zero();  ///< unit vector, of component -1; in the plane without z

  Vec2 direction() const {
    return component < 0 ? Vec2(inclined.head<2>())
                         : Vec2(Vec2::Unit(dof >= 0 ? plane_components.component_of(dof) : component));
  }
  Eigen::Vector3d direction_in_space() const {
    return component < 0 ? inclined : Eigen::Vector3d(Eigen::Vector3d::Unit(component));
  }
};

/// Stiffness of a body along its free motions v, supports apart: u = map v where supports stay.
struct FreeStiffness {
  linalg::SparseMatrix K;    ///< k x k, with springs
  linalg::SparseMatrix map;  ///< size of u x k
  std::vector<int> dofs;     ///< k, of an elastic body: the degree of freedom that v is, or belongs to
  std::vector<int> further;  ///< m, among v: those on which A is zero although they are free
  Matrix motions;            ///< m x m: of `further`, per unit rigid motion
};

/// A displacement under given forces, and (K + S) u less these forces if that is known, of the displacement that u is
/// the rounded value of: else empty.
struct Displaced {
  Vector u, unbalanced;
};

/// Forces that a displacement may leave unbalanced at a node: `part` of the largest that acts on the body, or of
/// `at_least` if that is more. Where rounding does not allow that, as little as it allows.
struct Balanced {
  double part = 1e-11;
  double at_least = 0.0;  ///< force
};

/// A solve that displacement_at() has begun, for displaced() under forces that differ at few degrees of freedom.
struct BegunSolve {
  Vector f;      ///< its forces
  Vector begun;  ///< SymmetricPositiveSolver::begin(); empty: none
};

class BodySystem {
 public:
  virtual ~BodySystem() = default;
  virtual Eigen::Index size() const = 0;                          ///< of u
  const Matrix& rigid_motions() const { return rigid_motions_; }  ///< Nn, size x m
  const Vec2& reference() const { return reference_; }            ///< centre of rotation of a plane body
  double lever() const { return lever_; }                         ///< L
  /// Columns of Nn as [u_x, u_y, L rotation] at the reference point, 3 x m; in space 6 x m (rigid_motions.hpp).
  const Matrix& rigid_coordinates() const { return rigid_coordinates_; }

  /// u_p for the applied forces f and the prescribed values of all constraints.
  virtual Displaced displaced(const Vector& f, const Vector& prescribed, const Balanced& wanted,
                              const BegunSolve* begun = nullptr) const = 0;
  Vector displacement(const Vector& f, const Vector& prescribed) const { return displaced(f, prescribed, {}).u; }
  /// The same on the given degrees of freedom, and anything on others: in much less time, where the body is large and
  /// they are few, but without the refinement that equilibrium at every node needs.
  virtual Vector displacement_at(const Vector& f, const Vector& prescribed, const std::vector<int>& dofs,
                                 BegunSolve* begun = nullptr) const = 0;
  /// Whether forces may move a degree of freedom; where not, its row of A is 0.
  virtual bool moves(int) const { return true; }
  /// A on the given degrees of freedom.
  virtual Matrix flexibility(const std::vector<int>& dofs) const = 0;
  /// The same from the factor alone, without the refinement that slender bodies get: for estimates.
  virtual Matrix flexibility_by_factor(const std::vector<int>& dofs) const = 0;
  /// A times forces on the given degrees of freedom, on the same ones, by the factor.
  virtual Vector flexed(const std::vector<int>& dofs, const Vector& forces) const = 0;
  /// Whether its stiffness resists rigid motions, so that its forces need not be in balance: an unbounded body, and any
  /// body in time (inertia.hpp).
  virtual bool resists_rigid_motions() const { return false; }
  /// Whether it is a body of revolution, of whose motions only that along the axis is free.
  virtual bool is_revolved() const = 0;
  /// Whether several processes have its stiffness.
  virtual bool is_divided() const { return false; }
  /// Not of a divided one.
  virtual FreeStiffness free_stiffness() const = 0;
  /// Floating point operations of the factorisation, roughly.
  virtual double operations() const = 0;
  /// (K + S) u - f for displacements u under the forces f (contact forces included): the forces of the constraints, and
  /// what is not balanced elsewhere.
  virtual Vector unbalanced(const Vector& u, const Vector& f) const = 0;
  /// Of these: the forces exerted by the constraints, one for each.
  virtual Vector reactions_of(const Vector& unbalanced) const = 0;
  Vector reactions(const Vector& u, const Vector& f) const { return reactions_of(unbalanced(u, f)); }
  /// Of these: the largest on a degree of freedom without constraint.
  virtual double imbalance_of(const Vector& unbalanced) const = 0;
  double imbalance(const Vector& u, const Vector& f) const { return imbalance_of(unbalanced(u, f)); }
  /// 1/2 u'(K + S) u.
  virtual double elastic_energy(const Vector& u) const = 0;
  /// The same of the displacement under the forces f, from one that is nearly that and leaves `unbalanced` of them:
  /// u'f - 1/2 u'(K + S) u with what supports add to f, in which errors of u count squared only.
  virtual double elastic_energy(const Vector& u, const Vector& f, const Vector& unbalanced) const = 0;
  /// Estimated error of elastic_energy(u) by the rounding of the entries of K. Its ratio to the energy is the relative
  /// error of the displacement under the load.
  virtual double energy_lost(const Vector& u) const = 0;
  /// Force by which K would resist one component of u alone: max_i K_ii max_i |u_i|; 0 of a rigid body.
  virtual double stiff_force(const Vector& u) const = 0;

  /// Which factorisation it uses: equal bodies share one. None of a rigid body.
  virtual const void* factor() const { return nullptr; }

  const std::vector<Constraint>& constraints() const { return constraints_; }
  /// Forces of the springs on the body, -S u.
  virtual Vector spring_forces(const Vector& u) const = 0;
  /// Whether forces move it: not a rigid body without springs.
  virtual bool is_flexible() const = 0;
  virtual bool has_springs() const = 0;

 protected:
  std::vector<Constraint> constraints_;
  Matrix rigid_motions_, rigid_coordinates_;
  Vec2 reference_ = Vec2::Zero();
  double lever_ = 1.0;
};

/// Adds the forces of constraints, one for each, to those on the nodes of an elastic body.
void add_reactions(const std::vector<Constraint>& constraints, const Vector& reactions, Vector& forces);

/// An elastic body, in the plane or in space. `nodes` give the rigid motions; constraints have distinct `dof`s, and two
/// at one node are not parallel, nor are three in one plane.
std::unique_ptr<BodySystem> elastic_body(Stiffness stiffness, const Positions& nodes,
                                         std::vector<Constraint> constraints);

/// An elastic body that is not factorised yet.
struct ElasticPart {
  Stiffness stiffness;
  Positions nodes;
  std::vector<Constraint> constraints;
  /// Of the nodes in contact pairs, ascending and distinct: those whose flexibility is asked for later.
  std::vector<int> contact_dofs = {};
  /// The body on an earlier mesh, by whose factor a large one is solved where most of its matrix is the same, and the
  /// nodes there; null: none.
  const BodySystem* like = nullptr;
  Positions nodes_of_like = {};
};
/// The same for many bodies, on up to `threads` threads. Bodies whose matrices are equal bit for bit, as those of equal
/// blocks with equal supports are wherever they stand, share stiffness and factor. `before`: bodies, of which those
/// that are made again at the same place give theirs; no digit depends on that, and null is none. NotPositiveDefinite
/// comes with the number of the body: see NotPositiveDefinitePart.
std::vector<std::unique_ptr<BodySystem>> elastic_bodies(
    std::vector<ElasticPart> parts, int threads, const linalg::SparseOptions& options = {},
    const std::vector<std::unique_ptr<BodySystem>>* before = nullptr);

/// Stiffness of this body is not positive definite to working precision.
struct NotPositiveDefinitePart : linalg::NotPositiveDefinite {
  explicit NotPositiveDefinitePart(std::size_t number) : part(number) {}
  std::size_t part;
};

/// A rigid body with reference point `reference` and extent `size`; the matrix of its springs is 3 x 3. `revolved`: it
/// moves along y only, the axis of revolution. If constraints
/// contradict each other, `contradiction` is set to a description of the first that does, which the caller must report;
/// otherwise it is empty.
std::unique_ptr<BodySystem> rigid_body(const Vec2& reference, double size, std::vector<Constraint> constraints,
                                       Springs springs, std::string& contradiction, bool revolved = false);

/// Rigid motions that constraints and springs leave free in an elastic body, as [u_x, u_y, L rotation], 3 x m; sets the
/// centre of rotation and L. `revolved`: of a body of revolution.
Matrix free_motions(const std::vector<Vec2>& nodes, const std::vector<Constraint>& constraints,
                    const std::vector<HeldDirection>& springs, Vec2& reference, double& lever, bool revolved = false);

/// Displacement of a point `x` of a rigid body per unit [u_x, u_y, L rotation], 2 x 3.
Eigen::Matrix<double, 2, 3> rigid_point(const Vec2& x, const Vec2& reference, double lever);

/// `translation along (1, 0)` or `rotation about (x, y)` for [u_x, u_y, L rotation].
std::string describe_motion(const Eigen::Vector3d& motion, const Vec2& reference, double lever);

}  // namespace scabo::system
