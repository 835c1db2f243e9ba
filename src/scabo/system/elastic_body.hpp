// An elastic body, by the factor of its stiffness (body_system.hpp).
#pragma once

#include <memory>
#include <vector>

#include "scabo/system/body_system.hpp"
#include "scabo/system/inclined_nodes.hpp"
#include "scabo/system/internal_forces.hpp"

namespace scabo::system {

/// What equal bodies share.
struct Factored {
  Stiffness stiffness;
  double largest_diagonal = 0.0;  ///< of the stiffness: asked for often, and as long as a product with it
  // Of the body that was factorised, which the order of elimination depends on:
  Positions nodes;
  std::vector<int> contact_dofs;
  linalg::SymmetricPositiveSolver solver;
};

class ElasticBody final : public BodySystem {
 public:
  ElasticBody(std::shared_ptr<Factored> factored, const Positions& nodes, std::vector<Constraint> constraints);

  const std::vector<int>& solved_dofs() const { return dofs_; }
  const InclinedNodes& inclined() const { return inclined_; }
  const std::shared_ptr<Factored>& factored() const { return factored_; }
  /// Whether the matrices of both are the same to the last bit.
  bool equals(const ElasticBody& other) const;
  void share(std::shared_ptr<Factored> other) { factored_ = std::move(other); }
  const void* factor() const override { return factored_.get(); }
  void factorise(linalg::SparseOptions options);
  /// By the factor of this body on an earlier mesh; false where that would not pay.
  bool factorise_by(const ElasticBody& like, const Positions& nodes_of_like);

  Vector spring_forces(const Vector& u) const override { return -stiffness().springs.times(u); }
  bool is_flexible() const override { return true; }
  bool has_springs() const override { return !stiffness().springs.none(); }
  bool resists_rigid_motions() const override { return stiffness().resists_rigid_motions; }
  bool is_revolved() const override { return stiffness().revolved; }
  bool is_divided() const override { return stiffness().divided != nullptr; }
  Eigen::Index size() const override { return stiffness().size(); }
  double operations() const override;

  Displaced displaced(const Vector& f, const Vector& prescribed, const Balanced& wanted,
                      const BegunSolve* begun) const override;
  Vector displacement_at(const Vector& f, const Vector& prescribed, const std::vector<int>& dofs,
                         BegunSolve* begun) const override;
  bool moves(int dof) const override;
  Matrix flexibility(const std::vector<int>& dofs) const override { return flexibility(dofs, true); }
  Matrix flexibility_by_factor(const std::vector<int>& dofs) const override { return flexibility(dofs, false); }
  Vector flexed(const std::vector<int>& dofs, const Vector& forces) const override;
  FreeStiffness free_stiffness() const override;
  /// Where rounding u matters, of the displacement that u is the rounded value of, if it is one: u must not differ from
  /// it in more than its last digits.
  Vector unbalanced(const Vector& u, const Vector& f) const override;
  Vector reactions_of(const Vector& unbalanced) const override;
  double imbalance_of(const Vector& unbalanced) const override;
  double elastic_energy(const Vector& u) const override;
  double elastic_energy(const Vector& u, const Vector& f, const Vector& unbalanced) const override;
  double energy_lost(const Vector& u) const override;
  double stiff_force(const Vector& u) const override;

 private:
  void find_rigid_motions(const Positions& nodes);
  void find_rigid_motions_in_space(const Matrix& nodes);
  /// As many degrees of freedom as there are rigid motions, chosen so that holding them stops every motion.
  std::vector<int> further_dofs() const;
  /// Of Goal::held: B' x = z for forces x on these degrees of freedom along which the motions are B, and resultants z.
  void find_forces_on_further();

  Matrix flexibility(const std::vector<int>& dofs, bool refines) const;
  /// A along the directions of the constraints, on degrees of freedom of v.
  Matrix flexibility_along(const std::vector<int>& dofs, bool refines) const;
  /// K + S along the directions of the constraints.
  Matrix whole_dense() const;
  linalg::SparseMatrix whole_sparse() const;
  bool is_whole_alone() const { return inclined_.none() && !has_springs(); }  // K itself
  /// The degree of freedom, or all of its node, if that is inclined.
  std::vector<int> all_if_inclined(int dof) const;
  /// Displacements of the constraints; 0 of everything else.
  Vector held_displacement(const Vector& prescribed) const;
  /// The displacement under f, by the factor alone.
  Vector solved(const Vector& f) const;
  Vector solved_from(const BegunSolve& begun, const Vector& f) const;

  Vector internal_forces(const Vector& u) const { return system::internal_forces(stiffness(), motions_, u); }
  Vector forces_left(const linalg::TwofoldVector& u, const Vector& f, Product product = Product::twofold,
                     double* rounding = nullptr) const {
    return system::forces_left(stiffness(), motions_, u, f, product, rounding);
  }
  bool is_large() const { return system::is_large(stiffness()); }
  bool by_differences() const { return system::by_differences(stiffness(), motions_); }
  /// 1/2 u'(K + S) u in twice the working precision.
  double exact_energy(const Vector& u) const;

  // Refinement in twice the working precision (elastic_body_refinement.cpp)

  /// Whether rounding u can leave forces that are not small beside those that act: in slender bodies K u is a small
  /// difference of large numbers.
  bool rounding_matters(const Vector& u, double acting, const Balanced& wanted = {}) const;
  /// Differences of energies between meshes are 1e-13 of them: here rounding counts sooner.
  bool energy_needs_digits(const Vector& u, const Vector& resisting) const;
  /// Largest force that acts on the body: of f, and of the constraints where that saves large bodies, which supports
  /// move, the refinement in twice the working precision.
  double largest_acting(const Vector& unbalanced, const Vector& f) const;

  /// What of the forces that are left another solve can make smaller.
  struct Goal {
    Vector held;          // m: on the degrees of freedom that hold the body in u_p, against the resultants of f
    double spread = 1.0;  // all forces over the largest: resultants may be larger than forces by this factor
  };
  Goal goal(const Vector& f, double largest_force) const;
  /// Largest of the forces on degrees of freedom that are solved for, of what these add up to on those that hold the
  /// body, and of their resultants over `spread`: each is small, but there are many, and rounding of equal elements is
  /// equal.
  double largest_left(const Vector& unbalanced, const Goal& of) const;

  /// The displacement under f in twice the working precision, refined from u, and the forces that are left with it.
  struct Refined {
    linalg::TwofoldVector u;
    Vector left;
  };
  /// K u - f of a given u, and how much rounding can have changed it (0 where it is not known).
  struct Left {
    Vector forces;
    double rounding = 0.0;
  };
  Left left_by(const Vector& u, const Vector& f) const;
  Refined refined(const Vector& u, const Vector& f, const Balanced& wanted) const;
  /// By conjugate gradients, whose preconditioner is the factor of K + S: exact but for few directions, the bending of
  /// a slender body or its motion on soft springs, in which rounding of the factor counts. Plain refinement is their
  /// first step. Until at most `allowed` (a force) is left at a node, or rounding allows no less; and in a large body
  /// until u hardly changes: in bending, few forces change it much. `first` is left_by(u, f), where the caller has it.
  Refined refined(const Vector& u, const Vector& f, double allowed, const Goal& of, const Left* first = nullptr) const;

  const Stiffness& stiffness() const { return factored_->stiffness; }
  const linalg::SymmetricPositiveSolver& solver() const { return factored_->solver; }

  std::shared_ptr<Factored> factored_;
  InclinedNodes inclined_;
  NodalRigidMotions motions_;
  std::vector<bool> free_;    // by supports
  std::vector<bool> solved_;  // free, and not among the further dofs
  std::vector<int> dofs_, place_;
  std::vector<int> further_;  // hold the body in u_p along its rigid motions
  Matrix on_further_;         // m x m
};

}  // namespace scabo::system
