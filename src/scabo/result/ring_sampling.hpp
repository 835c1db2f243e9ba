// Rings on which fields of a super-element are given, and what is needed to compute strains there.
//
// A ring is xi = const at the boundary nodes, with smaller distances between rings towards the boundary. Where two
// boundary elements meet, the mean of both is given, or two points if their materials differ. An unbounded body is
// shown up to `farthest` radii. Programs that draw interpolate linearly between points; where the points of a model are
// few, there are therefore more rings, and points between the nodes of coarse boundaries.
#pragma once

#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "scabo/element/cell_library.hpp"

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
    double weight = 1.0;  // of the elements that meet there; their sum is 1
    std::size_t element = 0;
    Eigen::Matrix<double, 3, Eigen::Dynamic> B1, B2;
  };
  /// A point of a ring between two nodes of an element.
  struct Between {
    std::vector<int> nodes;  // of the element
    Vector values;           // shape functions
  };
  std::vector<int> nodes;            ///< boundary node of every point: all in order, then those where materials meet
  std::vector<Between> between;      ///< the points that follow
  std::vector<std::size_t> sectors;  ///< a boundary element at every point, for its material
  std::vector<std::vector<int>> points;  ///< points of every element, in their order along it
  std::vector<int> centre;               ///< centre point of every element; one for each run of equal material
  std::vector<Sample> samples;
  std::vector<double> levels;  ///< xi of the rings, from the boundary (1) inwards; the centres come after them
  std::optional<CellMap> map;  ///< of a cell that occurs so often that the map saves time

  std::size_t size() const { return nodes.size() + between.size(); }  ///< points of a ring
  /// What `at_node(number)` is at the nodes, at a point.
  template <typename AtNode>
  Vec2 at(std::size_t point, const AtNode& at_node) const {
    if (point < nodes.size()) return at_node(nodes[point]);
    const Between& own = between[point - nodes.size()];
    Vec2 sum = Vec2::Zero();
    for (std::size_t i = 0; i < own.nodes.size(); ++i)
      sum += own.values[static_cast<Eigen::Index>(i)] * at_node(own.nodes[i]);
    return sum;
  }
};
/// `fine`: of a model with few points.
RingSampling ring_sampling(const element::Ring& ring, const element::Sectors& sectors, bool unbounded,
                           bool fine = false);

/// Samplings, each distinct one computed once: of a super-element that is a body, on many rings, and of a small one.
class SamplingLibrary {
 public:
  /// `fine`: of the bodies that are one super-element.
  explicit SamplingLibrary(bool fine) : fine_(fine) {}
  std::shared_ptr<const RingSampling> of_body(const element::SolvedSuperElement& super_element);
  /// `cells`: how many are equal to it. `fine`: see cell_levels.
  std::shared_ptr<const RingSampling> of_cell(const element::SolvedSuperElement& super_element, std::size_t cells,
                                              bool fine);

 private:
  bool fine_;
  std::unordered_map<const element::SolvedSuperElement*, std::shared_ptr<const RingSampling>> known_, known_cells_;
};

/// Rings on which a super-element is sampled: the outermost is about as wide as boundary nodes are apart, and those
/// further inside are wider by a constant factor. `fine`: twice as many, the outermost half as wide.
std::vector<double> ring_levels(const element::Ring& ring, bool fine = false);

/// The same for a cell of a mesh: one ring between sides and centre, as cells are small. `fine`: where it has many
/// nodes on its boundary, as the few large cells of a body have, and those around held side faces, more rings.
std::vector<double> cell_levels(const element::Ring& ring, bool fine);

/// Rings of an unbounded domain, outwards.
std::vector<double> outer_ring_levels();
constexpr double farthest = 6.0;

}  // namespace scabo::result
