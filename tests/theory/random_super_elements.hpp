// Random super-elements for tests, from good ones to what no mesh generator should make.
#pragma once

#include <algorithm>
#include <cmath>

#include "theory/rings.hpp"

namespace scabo::test {

using element::Mat3;
using element::Ring;

struct Sample {
  Ring ring;
  std::vector<Mat3> D;  // one, or one for each element
  double thickness = 1.0;
  bool uniform_material() const { return D.size() == 1; }
};

/// Where an edge of a polygon is divided, ascending in (0, 1): evenly, at random, or towards one end down to 1e-4.
std::vector<double> marks(std::mt19937& random, int parts);

/// A ring of straight elements of one order through `vertices`; open: its first vertex is a doubled node.
Ring ring_through(const std::vector<Vec2>& vertices, int order, bool open);

Mat3 random_isotropic(std::mt19937& random);

/// 3 to 40 edges, orders 1 to 8, aspect to 1:100, edges 1 to 1e-4 of the size, nu to 0.49999, E ratio between sectors
/// to 1e6; a third with a crack, a half of several materials. At most `most` degrees of freedom.
Sample random_sample(std::mt19937& random, int most);

}  // namespace scabo::test
