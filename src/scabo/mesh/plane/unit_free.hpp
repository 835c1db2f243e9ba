// A body in coordinates of its own, so that its mesh depends neither on the unit of length nor on where the body lies.
//
// With the low corner o and the longer side L of the box around the outline,
//
//     x' = (x - o) / L, rounded to multiples of epsilon                                                      (1)
//
// with epsilon of rounding_of_points, and lengths l' = l / L rounded to 40 binary digits. The same body in metres and
// in millimetres differs in last digits of x only, which eq. (1) removes: a mesher sees the same numbers, and makes the
// same cells. Nodes on the outline are put on the outline as given afterwards, at the same fractions of its edges, and
// those on borders of regions likewise; crack tips are where they were given, and all other points at o + L x'.
#pragma once

#include "scabo/mesh/mesh.hpp"
#include "scabo/mesh/plane/size_field.hpp"

namespace scabo::mesh {

/// Multiples of it are the coordinates of the points that describe a body. A body a thousand of its sizes away from the
/// origin has an error of 1e-13 there. With 2^-40, one coordinate in ten is then rounded to another multiple than near
/// the origin, and one mesh of polygons in six is another one (60 plates tried); with 2^-34 one coordinate in a
/// thousand is. A quadtree was the same in all 60, and has rows of nodes on one line, which 2^-34 would move by more
/// than the rounding that results allow for.
constexpr double rounding_of_points(model::MeshKind kind) {
  return kind == model::MeshKind::quadtree ? 0x1p-40 : 0x1p-34;
}

/// Nodes along a part of an edge of a region.
struct BorderNodes {
  int region = 0, edge = 0;  ///< counted from 0
  std::vector<int> nodes;
};

class UnitFree {
 public:
  /// It holds on to `body`, which has an outline with an extent.
  UnitFree(const model::Body& body, const SizeField& sizes);

  const model::Body& body() const { return made_; }
  const SizeField& sizes() const { return sizes_; }

  Vec2 real(const Vec2& x) const { return origin_ + stretch_.cwiseProduct(x); }
  double scale() const { return scale_; }  ///< L, > 0
  /// The mesh of body() as one of the body itself. `borders`: ends of sides on borders of regions.
  BodyMesh real(BodyMesh mesh, const std::vector<BorderNodes>& borders) const;

 private:
  const model::Body& given_;
  Vec2 origin_ = Vec2::Zero();
  double scale_ = 1.0;
  Vec2 stretch_ = Vec2::Ones();  ///< L, but for rounding
  model::Body made_;
  SizeField sizes_;
};

}  // namespace scabo::mesh
