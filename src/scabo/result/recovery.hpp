// Displacement and stress of every body, for output files and figures.
//
// A super-element is sampled on rings xi = const at the boundary nodes, with smaller distances towards the boundary.
// Displacement and stress follow from its semi-analytical solution u(xi) = xi^S u(1), strain = B1 u,xi + 1/xi B2 u.
// Where two boundary elements meet, the mean of both is given, or two points if their materials differ. At a scaling
// centre where strains are infinite (the tip of a crack), stress is not a number. An unbounded body is shown up to
// `farthest` radii. A body of many cells is given at its nodes, with the mean stress of the cells of one material that
// meet there, on one ring inside every super-element and at its centre. A
// rigid body is its displaced outline, without stress.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <unordered_map>
#include <variant>
#include <vector>

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/result/grid.hpp"

namespace scabo::result {

/// Values in a cell without loads inside, as a linear map of the displacements of its nodes: u_x, u_y and the stress
/// xx, yy, xy of every point inside, in their order, then the stress of the points on its sides.
struct CellMap {
  Matrix values;               ///< (5 points inside + 3 points on sides) x n
  std::vector<int> materials;  ///< of the points inside
};

/// Strain matrices of a super-element at the points of a ring. They are valid on every ring and for all bodies that
/// share the super-element.
struct RingSampling {
  struct Sample {
    int point = 0;        // point of the ring to which the strain belongs
    double weight = 1.0;  // 1 / number of boundary elements that meet there
    std::size_t element = 0;
    Eigen::Matrix<double, 3, Eigen::Dynamic> B1, B2;
  };
  std::vector<int> nodes;            ///< boundary node of every point: all in order, then those where materials meet
  std::vector<std::size_t> sectors;  ///< a boundary element at every point, for its material
  std::vector<std::vector<int>> points;  ///< points of every element, one for each of its nodes
  std::vector<int> centre;               ///< centre point of every element; one for each run of equal material
  std::vector<Sample> samples;
  std::vector<double> levels;  ///< xi of the rings, from the boundary (1) inwards; the centres come after them
  std::optional<CellMap> map;  ///< of a cell that occurs so often that the map saves time
};
RingSampling ring_sampling(const element::Ring& ring, const element::Sectors& sectors, bool unbounded);

struct SuperElementBody {
  std::shared_ptr<const RingSampling> sampling;
};
/// A body of many cells. Points are numbered within the body: first those on the sides, which cells of one material
/// share.
struct CellsBody {
  struct OfCell {
    std::shared_ptr<const RingSampling> sampling;  // null: a finite element
    std::vector<std::int32_t> outer;               // shared point of every point of the ring, or of every node
    std::int32_t inner = 0;                        // first point inside
  };
  std::vector<OfCell> cells;
  std::vector<int> nodes, materials;  // of every shared point
};
struct RigidBody {
  std::vector<Vec2> arms;  // outline relative to its centroid
};

/// Samplings, each distinct one computed once: of a super-element that is a body, on many rings, and of a small one.
class SamplingLibrary {
 public:
  std::shared_ptr<const RingSampling> of_body(const element::SolvedSuperElement& super_element);
  std::shared_ptr<const RingSampling> of_cell(const element::SolvedSuperElement& super_element,
                                              std::size_t cells);  ///< `cells`: how many are equal to it

 private:
  std::unordered_map<const element::SolvedSuperElement*, std::shared_ptr<const RingSampling>> known_, known_cells_;
};

/// Stress and temperature at points on the sides of cells, 4 x points.
using SharedValues = Eigen::Matrix<double, 4, Eigen::Dynamic>;

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
  explicit Recovery(const analysis::StaticSolution& solution, const std::vector<char>& divided = {});

  const Grid& grid() const { return grid_; }
  /// Fields of a state of the same analysis.
  Fields fields(const analysis::StaticSolution& solution, const analysis::FieldState& state,
                const CompleteSums& complete = {}) const;

 private:
  Grid grid_;
  std::vector<std::variant<SuperElementBody, CellsBody, RigidBody>> bodies_;
};

/// Rings on which a super-element is sampled: the outermost is about as wide as boundary nodes are apart, and those
/// further inside are wider by a constant factor.
std::vector<double> ring_levels(const element::Ring& ring);

/// Rings of an unbounded domain, outwards.
std::vector<double> outer_ring_levels();
constexpr double farthest = 6.0;

}  // namespace scabo::result
