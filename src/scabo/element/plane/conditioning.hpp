// What makes a stiffness matrix lose its digits, measured: a message names a cause only where its figure is that large.
#pragma once

#include <string>
#include <vector>

#include "scabo/base/types.hpp"
#include "scabo/element/plane/elasticity.hpp"
#include "scabo/mesh/mesh.hpp"

namespace scabo::element {

/// Each 1 or more; the larger, the more digits are lost.
struct Conditioning {
  double slenderness = 1.0;  ///< length over depth of the rectangle with the same area and perimeter
  double moduli = 1.0;       ///< between materials: the largest modulus over that of the softest one
  /// Within one material: its largest over its smallest modulus, which near Poisson's ratio 1/2 is 1 / (1 - 2 nu).
  double compression = 1.0;
  double sizes = 1.0;     ///< the longest side over the shortest one
  double nearness = 1.0;  ///< size over the distance of the scaling centre from the nearest side
  double springs = 1.0;   ///< stiffness of the springs over that of the body, or its inverse
};

/// Length over depth of a region.
double slenderness_of(double area, double perimeter);

/// Sets `moduli` and `compression`.
void measure(const std::vector<Mat3>& D, Conditioning& found);
/// Sets `slenderness` and `sizes`, and `nearness` of a single super-element. `sides`: around the body, seen from
/// `centre`.
void measure(const std::vector<mesh::LineElement>& sides, const std::vector<Vec2>& nodes, const Vec2* centre,
             Conditioning& found);

/// `slenderness` and `sizes` of a body, over all of its cells.
Conditioning measured(const mesh::BodyMesh& mesh);

/// `it is 4e+03 times as long as deep, and its moduli differ by a factor of 1e+13`: what costs that many digits; where
/// nothing does, all that was measured, and that it does not explain the loss.
std::string causes_in_words(const Conditioning& found);

}  // namespace scabo::element
