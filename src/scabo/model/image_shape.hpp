// A body that an image shows: which of its pixels have a material, and the rectangle around them.
#pragma once

#include <array>
#include <map>
#include <memory>

#include "scabo/base/types.hpp"
#include "scabo/files/image.hpp"

namespace scabo::model {

struct ImageShape {
  std::shared_ptr<const files::Image> image;
  double pixel = 0.0;            ///< length of the side of a pixel, > 0
  std::map<int, int> materials;  ///< index into Model::materials of each level; pixels of other levels are empty
  Vec2 corner = Vec2::Zero();    ///< bottom left corner of the image

  bool has_material(int column, int row) const;  ///< of the pixel at this place from the bottom left, from 0
};

/// Columns and rows from the bottom left, the last ones not included.
struct PixelRectangle {
  int left = 0, bottom = 0, right = 0, top = 0;
  bool empty() const { return right <= left; }
  bool operator==(const PixelRectangle&) const = default;
};

/// The smallest rectangle around all pixels with a material: its sides are the edges of the body. Empty if there are
/// none.
PixelRectangle rectangle_of(const ImageShape& shape);

/// Whether the pixel at each corner of the rectangle has a material: bottom left, bottom right, top right, top left.
/// The body has no node at the others.
std::array<bool, 4> corners_with_material(const ImageShape& shape);

/// Whether all pixels along a side of the rectangle have a material: 0 bottom, 1 right, 2 top, 3 left, as the edges of
/// the body.
bool is_unbroken(const ImageShape& shape, int side);

}  // namespace scabo::model
