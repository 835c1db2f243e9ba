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
//                    radius b = cohesion + mu (p_n)+
//     certificate    every condition by itself (certificate.hpp); lengths against what p causes, F / k at most
//     rounding       eps max_i k sum_j |W_ij| |p_j| / F, the same of G'p: what double precision leaves uncertain of u
//
// A problem is solved if the natural map or the certificate AND the rounding figure are within the tolerance: where the
// sum W p loses more digits than the tolerance allows, u is not known, and a point may appear to satisfy every
// condition without doing so (one contact with p_n = 3.5e41, u_n = -1). No figure changes when W, q and all forces are
// written in other units; scaling by powers of two is exact.
#pragma once

#include <string>

#include "scabo/contact/certificate.hpp"

namespace scabo::contact {

/// Which figure is compared with the tolerance. certificate: the worst of the certificate (increments of elastic
/// bodies). natural_map: the natural map (problems of others, whose W may be rank deficient) and the balance of rigid
/// motions, which the natural map does not know.
enum class Judge { certificate, natural_map };

struct Judgement {
  Certificate certificate;
  double natural_map_residual = 0.0;
  double rounding = 0.0;  ///< of W p and G'p, as above
  double figure = 0.0;    ///< what is compared with the tolerance

  bool solved(double tolerance) const { return figure <= tolerance && rounding <= tolerance; }
};

/// The units of a problem: what its forces and motions are measured by.
class Measure {
 public:
  /// `history`: forces of the increment before, or empty; `applied`: largest applied force that is not in the problem.
  explicit Measure(const Problem& problem, const Vector& history = Vector(), double applied = 0.0);
  /// The same where 1 / mean W_ii is known.
  Measure(const Problem& problem, double stiffness, const Vector& history, double applied);

  double stiffness() const { return stiffness_; }  ///< k
  double at_work() const { return at_work_; }      ///< F; 0 where nothing is at work
  /// By which forces are judged before any are known: those applied; else those that would undo the motions q; else
  /// those of the history; 1 where there is nothing.
  double reference() const { return reference_; }
  /// Of a certificate of forces p.
  Scales scales(const Vector& p) const;
  double natural_map(const Problem& problem, const Vector& p, const Vector& motion) const;
  /// Of W p and G'p, from the sums of absolute values. Of a W that is not formed from its diagonal and the motions.
  double rounding(const Problem& problem, const Vector& p, const Vector& motion) const;
  /// Of the problem times k, motions as forces.
  Measure of_forces() const;

 private:
  double stiffness_ = 1.0, at_work_ = 0.0, reference_ = 1.0, norm_ = 0.0;
};

Judgement judge(const Problem& problem, const Vector& p, const Vector& motion, const Measure& measure, Judge by);

/// Why forces are not a solution although a solver ended with them: its own `story`, what was reached, what rounding
/// allows.
std::string reason_of(const Judgement& judgement, Judge by, double tolerance, const std::string& story);

/// 1 / mean W_ii, 1 where W = 0.
double stiffness_of(const Problem& problem);
/// q + W p + G a.
Vector motion_of(const Problem& problem, const Vector& p, const Vector& a);
/// The natural map of a problem with nothing else at work.
double natural_map_residual(const Problem& problem, const Vector& p, const Vector& a);

}  // namespace scabo::contact
