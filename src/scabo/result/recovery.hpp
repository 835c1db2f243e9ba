// Displacement and stress of every body, for output files and figures.
//
// Displacement and stress of a super-element, on the rings where it is sampled (ring_sampling.hpp), follow from its
// semi-analytical solution u(xi) = xi^S u(1), strain = B1 u,xi + 1/xi B2 u. At a scaling centre where strains are
// infinite (the tip of a crack), stress is not a number. A body of many cells is given at its nodes, with the mean
// stress of the cells of one material that meet there, on one ring inside every super-element and at its centre. A
// rigid body is its displaced outline, without stress.
#pragma once

#include <functional>
#include <variant>
#include <vector>

#include "scabo/analysis/state/discretisation.hpp"
#include "scabo/analysis/state/results.hpp"
#include "scabo/result/body_grid.hpp"

namespace scabo::result {

/// Stress, temperature and strain zz at points on the sides of cells, 5 x points.
using SharedValues = Eigen::Matrix<double, 5, Eigen::Dynamic>;

/// Values at the points that the cells of a body share are sums over these cells, divided by their number. Where other
/// processes have cells of the body, it adds what they have: `nodes` and `materials` of every point, the sums and the
/// numbers of cells.
using CompleteSums =
    std::function<void(std::size_t body, const std::vector<int>& nodes, const std::vector<int>& materials,
                       SharedValues& sums, std::vector<int>& cells)>;

/// Created once for a mesh; gives the fields of any state.
class Recovery {
 public:
  /// `divided`: one for each body, or empty: it has cells here and in other processes.
  explicit Recovery(const analysis::Discretisation& discretisation, const std::vector<char>& divided = {});

  const Grid& grid() const { return grid_; }
  /// Fields of a state of the same analysis.
  Fields fields(const analysis::Discretisation& discretisation, const analysis::FieldState& state,
                const CompleteSums& complete = {}) const;

 private:
  Grid grid_;
  std::vector<std::variant<SuperElementBody, CellsBody, RigidBody>> bodies_;
};

}  // namespace scabo::result
