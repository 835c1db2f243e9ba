// Sizes of cells as a value, which refinement changes from mesh to mesh: what Division is to one super-element.
//
// Each sample asks for cells of a size s_i at a point x_i. Away from it sizes may grow by `growth` of the distance:
//
//     s(x) = min over i of (s_i + growth |x - x_i|)                                                          (1)
//
// so that the field is as smooth as meshers need it, and small samples are noticed by large cells around them. Squares
// of a quadtree are halved without their neighbours: with s_i = h / 2 at the middle of a square of side h and a growth
// of 1, eq. (1) gives 1.2 h at its corners, which its neighbours share, and 0.86 H or less at a corner or the middle of
// every larger square, of side H, that holds it.
#pragma once

#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::mesh {

class SizeField {
 public:
  struct Sample {
    Vec2 at = Vec2::Zero();
    double size = 0.0;  ///< length, > 0
  };

  /// Asks for nothing: infinite everywhere.
  SizeField() = default;
  /// `growth`: > 0. Samples that others make needless are left out.
  SizeField(const std::vector<Sample>& samples, double growth);

  /// s(x) of eq. (1), in about the logarithm of the number of samples.
  double at(const Vec2& x) const;

  /// Samples that count, in an order of their own.
  const std::vector<Sample>& samples() const { return samples_; }
  bool empty() const { return samples_.empty(); }
  double growth() const { return growth_; }

 private:
  void build(std::size_t from, std::size_t to);
  void search(std::size_t from, std::size_t to, const Vec2& x, double& least) const;

  /// A tree: of a range of samples the middle one is its root, and the halves beside it are its subtrees. lower_ and
  /// upper_ bound the points of the range of which the sample is the root, and smallest_ their sizes.
  std::vector<Sample> samples_;
  std::vector<Vec2> lower_, upper_;
  std::vector<double> smallest_;
  double growth_ = 1.0;
};

}  // namespace scabo::mesh
