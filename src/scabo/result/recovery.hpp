// Displacement and stress of every body, for output files and pictures.
//
// A super-element is sampled on rings xi = const, at the boundary nodes of every ring, closer towards the
// boundary. Both displacement and stress come from its semi-analytical solution u(xi) = xi^S u(1), strain =
// B1 u,xi + 1/xi B2 u; where two boundary elements meet, the mean of both. A FE body is given at its nodes,
// stress as the mean over the elements of a node. A rigid body is its outline, moved, without stress.
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/result/grid.hpp"

namespace scabo::result {

/// Strain matrices of a super-element at the nodes of its boundary elements. They hold on every ring, and for
/// all bodies that share the super-element.
struct RingSampling {
  struct Sample {
    int node = 0;         // to which the strain belongs
    double weight = 1.0;  // 1 / number of boundary elements that meet there
    std::vector<int> nodes;
    Eigen::Matrix<double, 3, Eigen::Dynamic> B1, B2;
  };
  std::vector<Sample> samples;
  std::vector<double>
      levels;                ///< xi of the rings, from the boundary (1) inwards; the centre comes after them
  Vector body_load_weights;  // element::body_load_weights, int N |J| deta
};
RingSampling ring_sampling(const element::Ring& ring);

struct SuperElementBody {
  std::shared_ptr<const RingSampling> sampling;
};
struct FiniteElementBody {};
struct RigidBody {
  std::vector<Vec2> arms;  // outline relative to its centroid
};

/// Made once for a mesh; then gives the fields of any increment.
class Recovery {
 public:
  explicit Recovery(const analysis::StaticSolution& solution);

  const Grid& grid() const { return grid_; }
  /// Fields of a converged increment of the same analysis.
  Fields fields(const analysis::StaticSolution& solution, const analysis::IncrementResult& increment) const;

 private:
  Grid grid_;
  std::vector<std::variant<SuperElementBody, FiniteElementBody, RigidBody>> bodies_;
};

/// Rings on which a super-element with `nodes` boundary nodes is sampled: the outermost about as wide as
/// boundary nodes are apart, those further inside wider by a constant factor.
std::vector<double> ring_levels(const element::Ring& ring);

}  // namespace scabo::result
