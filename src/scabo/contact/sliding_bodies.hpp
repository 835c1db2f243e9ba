// Bodies of a plane problem that all their pairs let slide, for directions of Newton's method.
//
// A block that rests on others which stretch below it slips forward at one end of its joint and backward at the other;
// in between one pair sticks. Where Newton's method takes that pair for a slipping one, nothing holds the block: each
// pair gives its friction bound whatever the block does, the matrix is singular, and with a little on its diagonal the
// block flies off. (The top courses of walls under their own weight, mu = 0.3: five blocks of 264 stopped Newton's
// method, and interior points had to follow to 1e-8 of the largest force.)
//
// With all other motions as they are the block's own problem is solved at once. Moved by s it has the forces
//
//     F(s) = f + sum over its slipping pairs of G_t p_t(s),   p_t = -mu p_n sign(u_t + G_t s)
//
// and F falls by 2 |G_t| mu p_n, where mu differs by direction by |G_t| (mu_f + mu_b) p_n, wherever a pair's slip
// turns: the pair at which F changes its sign sticks, those passed before slip the other way. If that pair leads to a
// body that slides as well, both are one body, and another pair holds the two.
//
// Where F(0) = 0 already (a block in the line of symmetry of a wall, a course of which a whole number of equal pairs
// slips backward) any s is a solution, and the motion stays as it is. On the way there F is only small: a pair made to
// stick for it would move the body by all of its slip, a million times what the other equations lack. A group of bodies
// that has stayed therefore stays until F is most of what is left, and so does one whose next pair would turn by a
// hundredth of its friction bound.
//
// The same holds of one roller with little friction (slides.hpp).
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "scabo/contact/b_differentiable.hpp"

namespace scabo::contact {

/// What the two rows of a pair ask for.
struct PairState {
  bool presses = false, sticks = false;
  double slope = 0.0;  ///< e mu: dp_t over dp_n where it slips
  bool operator==(const PairState& other) const {
    return presses == other.presses && sticks == other.sticks && slope == other.slope;
  }
};

class SlidingBodies {
 public:
  /// Keeps a reference. G is sparse.
  explicit SlidingBodies(const BDifferentiableEquations& equations);

  /// Changes the states of pairs so that each body is held that can be, and the rows of `H` with them (p: forces of the
  /// point `at`). Returns the motions that are to stay as they are, one of each group of bodies that slide together;
  /// `stayed`: those of the step before.
  std::vector<int> hold(const Vector& p, const Residual& at, std::vector<PairState>& states, Vector& H,
                        const std::vector<int>& stayed) const;

 private:
  struct Entry {
    Eigen::Index row = 0;
    double value = 0.0;
  };
  struct Slip {
    double at = 0.0;    ///< s at which it turns
    double fall = 0.0;  ///< of F
    std::size_t pair = 0;
  };
  struct Slide {
    double force = 0.0;       ///< F(0)
    std::vector<Slip> turns;  ///< those that F(0) leads to
    bool held = false;        ///< by a pair that is not slipping, or nothing slips
  };
  Slide slide_of(const std::vector<int>& motions, const Vector& p, const Residual& at,
                 const std::vector<PairState>& states) const;
  bool alike(Eigen::Index a, Eigen::Index b) const;
  std::vector<std::vector<int>> loose_groups(const std::vector<PairState>& states, std::vector<int>& group_of) const;
  std::vector<Entry> together(const std::vector<int>& motions) const;

  const BDifferentiableEquations& equations_;
  Eigen::SparseMatrix<double> G_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> by_rows_;
  Vector size_;                          ///< of the columns of G
  std::vector<std::vector<int>> alike_;  ///< motions of other bodies, of each motion; ascending
};

}  // namespace scabo::contact
