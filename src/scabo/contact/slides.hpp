// Rigid motions that change no gap and that little friction resists: a roller on a cylinder, mu = 1e-6.
//
// Moved by s along such a slide v, the body feels
//
//     F(s) = v'f + sum over the pairs of v_t p_t,     p_t = -mu p_n sign(u_t + v_t s)
//
// a function of N steps, each as narrow as mu p_n is beside r u_t: flat nearly everywhere. Newton's method sees the
// slope 0, and its matrix is singular; the balance of v, at most mu times the loads, is nothing beside its other
// equations; and the rays n + mu t and n - mu t of a pair are parallel but for mu, so that the question whether
// friction holds the body at all is one of rounding.
//
// Such motions therefore become motions of their own: the basis of the rigid motions is changed so that each is one
// column of G, zero in all normals, and multiplied by 1 / sqrt(mu), so that its balance and its amount are of like
// size. Directions of Newton's method then solve F(s) = 0 at once, pair by pair (sliding_bodies.hpp). The solution is
// that of the problem, whose certificate is the only one that counts.
#pragma once

#include <optional>

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

/// The largest coefficient that counts as little. Of more, steps of F(s) overlap, and pairs that stick hold the body.
/// Rollers and pins with less took Newton's method thousands of iterations, or it ended as not converged; with 0.3, 3.
constexpr double little_friction = 0.1;

/// a = basis b: the slides first. q, W and forces are those of the problem.
struct SlidesApart {
  Problem problem;
  Matrix basis;  // m x m
};

/// Nothing where no motion is such a slide. Plane problems with dense W, few bodies and Coulomb's law alone.
std::optional<SlidesApart> slides_apart(const Problem& problem);

/// Whether a column of G is such a slide, as those of slides_apart() are.
bool has_slides(const Problem& problem);

}  // namespace scabo::contact
