#include "scabo/model/image_shape.hpp"

#include <algorithm>

namespace scabo::model {

bool ImageShape::has_material(int column, int row) const {
  const auto width = static_cast<std::size_t>(image->width);
  const auto from_top = static_cast<std::size_t>(image->height - 1 - row);
  return materials.contains(image->labels[from_top * width + static_cast<std::size_t>(column)]);
}

PixelRectangle rectangle_of(const ImageShape& shape) {
  PixelRectangle found{shape.image->width, shape.image->height, 0, 0};
  for (int row = 0; row < shape.image->height; ++row)
    for (int column = 0; column < shape.image->width; ++column) {
      if (!shape.has_material(column, row)) continue;
      found.left = std::min(found.left, column);
      found.right = std::max(found.right, column + 1);
      found.bottom = std::min(found.bottom, row);
      found.top = row + 1;
    }
  return found.empty() ? PixelRectangle{} : found;
}

std::array<bool, 4> corners_with_material(const ImageShape& shape) {
  const PixelRectangle all = rectangle_of(shape);
  if (all.empty()) return {};
  return {shape.has_material(all.left, all.bottom), shape.has_material(all.right - 1, all.bottom),
          shape.has_material(all.right - 1, all.top - 1), shape.has_material(all.left, all.top - 1)};
}

bool is_unbroken(const ImageShape& shape, int side) {
  const PixelRectangle all = rectangle_of(shape);
  const bool along_x = side == 0 || side == 2;
  const int across = side == 0 ? all.bottom : side == 1 ? all.right - 1 : side == 2 ? all.top - 1 : all.left;
  for (int at = along_x ? all.left : all.bottom; at < (along_x ? all.right : all.top); ++at)
    if (!(along_x ? shape.has_material(at, across) : shape.has_material(across, at))) return false;
  return true;
}

}  // namespace scabo::model
