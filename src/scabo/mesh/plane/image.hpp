// Meshes of images: a quadtree whose cells are uniform blocks of pixels.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "scabo/files/image.hpp"
#include "scabo/mesh/plane/domain.hpp"

namespace scabo::mesh {

struct ImageOptions {
  double pixel = 1.0;          ///< length of the side of a pixel, > 0
  double size = 0.0;           ///< length: no cell is larger, but none is smaller than a pixel; 0: no limit
  std::map<int, int> regions;  ///< region, from 0, of each label; pixels of other labels are void. Empty: the labels
                               ///< are the regions, and negative labels are void
};

/// The cells of an image. Its `left` has one line for every unbroken chain of sides along the smallest rectangle around
/// all cells: an empty pixel on it parts two chains. Borders between regions, and around empty pixels elsewhere, are no
/// lines.
struct ImageMesh : PolygonMesh {
  /// Of the bottom, right, top and left side of that rectangle: its lines, counter-clockwise; one or more.
  std::array<std::vector<std::size_t>, 4> lines_of_side;
  /// Node at its bottom left, bottom right, top right and top left corner; -1 where the pixel is empty.
  std::array<int, 4> corners{-1, -1, -1, -1};
};

/// The image with its lower left corner at the origin, x to the right and y upwards. Cells are the largest squares of
/// 2^k by 2^k pixels of one region, at positions that are multiples of their size, that differ by one halving at most
/// from those with which they share a side or a corner. Borders of the image that are not multiples of a large power of
/// two pixels long therefore have small cells at the top and on the right.
///
/// Throws InputError if no pixel belongs to a region, or if two parts that share no side of a pixel share a corner: a
/// hinge that the material does not have.
ImageMesh image_mesh(const files::Image& image, const ImageOptions& options);

}  // namespace scabo::mesh
