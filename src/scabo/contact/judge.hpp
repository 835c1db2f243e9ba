// The definition of "solved", in one place: Newton, sweeps, all other solvers, `scabo contact` and runs use it.
//
// A figure that depends on units is meaningless: W times 1e12 hides a wrong force behind a small motion. Motions are
// therefore converted to forces by one stiffness of the problem, and are compared with the forces that act in it:
//
//     k = 1 / mean W_ii                     force per length; 1 where W = 0
//     F = max(k |q|, |f|, applied forces)   largest entries; forces of the history where all of these are 0
//
// Three figures are computed for forces p and motions u = q + W p + G a.
//
//     natural map    | p - P_K(p - k (u + mu |u_t| n)) |_2 / max(k |q|_2, |f|_2, applied)
//                    the residual of FCLIB with W and q scaled so that the mean of W_ii is 1; P_K: nearest point of
//                    Coulomb's cone. For a pair with cohesion or tension, whose set of forces is not a cone:
//                    [p_n - max(p_n - k u_n, -tension), p_t - P_b(p_t - k u_t)], P_b the projection on the disc of
//                    radius b = cohesion + mu (p_n)+. Where mu differs by direction, mu |u_t| is mu_f u_t or -mu_b u_t,
//                    and P_K and P_b take the mu of the sign of what they project
//     certificate    every condition by itself (certificate.hpp); lengths against what p causes, F / k at most
//     rounding       eps max_i k sum_j |W_ij| |p_j| / F, the same of G'p: what double precision leaves uncertain of u
//
// A problem is solved if the natural map or the certificate AND the rounding figure are within the tolerance: where the
// sum W p loses more digits than the tolerance allows, u is not known, and a point may appear to satisfy every
// condition without doing so (one contact with p_n = 3.5e41, u_n = -1). No figure changes when W, q and all forces are
// written in other units; scaling by powers of two is exact.
#pragma once

#include <functional>
#include <string>

#include "scabo/contact/certificate.hpp"

namespace scabo::contact {

/// The figure that is compared with the tolerance. certificate: the worst figure of the certificate (increments of
/// elastic bodies). natural_map: the natural map (problems from other programs, whose W may be rank deficient) and the
/// balance of the rigid motions, which is not part of the natural map.
enum class Judge { certificate, natural_map };

struct Judgement {
  Certificate certificate;
  double natural_map_residual = 0.0;
  double rounding = 0.0;  ///< of W p and G'p, as above
  double figure = 0.0;    ///< the figure that is compared with the tolerance

  bool solved(double tolerance) const { return figure <= tolerance && rounding <= tolerance; }
};

/// Units of a problem: the scales of its forces and motions.
class Measure {
 public:
  /// `history`: forces of the previous increment, or empty; `applied`: largest applied force that is not part of the
  /// problem.
  explicit Measure(const Problem& problem, const Vector& history = Vector(), double applied = 0.0);
  /// The same for known 1 / mean W_ii.
  Measure(const Problem& problem, double stiffness, const Vector& history, double applied);

  double stiffness() const { return stiffness_; }  ///< k
  /// The scale of forces before any are known: the applied forces; else those that would cancel the motions q; else
  /// those of the history; 1 if there are none.
  double reference() const { return reference_; }
  /// Scales for a certificate of the forces p.
  Scales scales(const Vector& p) const;
  double natural_map(const Problem& problem, const Vector& p, const Vector& motion) const;
  /// Rounding error of W p and G'p, from sums of absolute values. If W is condensed, from its diagonal and the motions.
  double rounding(const Problem& problem, const Vector& p, const Vector& motion) const;
  /// Measure of the problem multiplied by k, with motions as forces.
  Measure of_forces() const;

 private:
  double stiffness_ = 1.0, at_work_ = 0.0, reference_ = 1.0, norm_ = 0.0;  // at_work_: F, 0 if there are no forces
};

/// For the motions u that the forces p and the rigid motions a cause.
Judgement judge(const Problem& problem, const Vector& p, const Vector& a, const Vector& motion, const Measure& measure,
                Judge by);

/// Whether forces, rigid motions and the motions u that they cause are a solution.
using IsSolution = std::function<bool(const Vector& p, const Vector& a, const Vector& motion)>;

/// The reason why the final forces of a solver are not a solution: its own `story`, the figure that was reached, and
/// the figure that rounding allows.
std::string reason_of(const Judgement& judgement, Judge by, double tolerance, const std::string& story);

/// 1 / mean W_ii, 1 where W = 0.
double stiffness_of(const Problem& problem);
/// q + W p + G a.
Vector motion_of(const Problem& problem, const Vector& p, const Vector& a);
/// Natural map of a problem without history and other applied forces.
double natural_map_residual(const Problem& problem, const Vector& p, const Vector& a);

}  // namespace scabo::contact
