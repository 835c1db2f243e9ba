// Meshes of images: a quadtree whose cells are uniform blocks of pixels.
#pragma once

#include <map>
#include <vector>

#include "scabo/files/image.hpp"
#include "scabo/mesh/domain.hpp"

namespace scabo::mesh {

struct ImageOptions {
  double pixel = 1.0;          ///< length of the side of a pixel, > 0
  double size = 0.0;           ///< length: no cell is larger, but none is smaller than a pixel; 0: no limit
  std::map<int, int> regions;  ///< region, from 0, of each label; pixels of other labels are void. Empty: the labels
                               ///< are the regions, and negative labels are void
};

/// The image with its lower left corner at the origin, x to the right and y upwards. Cells are the largest squares of
/// 2^k by 2^k pixels of one region, at positions that are multiples of their size, that differ by one halving at most
/// from those with which they share a side or a corner. Borders of the image that are not multiples of a large power of
/// two pixels long therefore have small cells at the top and on the right.
///
/// `left` and `right` have four lines, the bottom, right, top and left border of the image, counter-clockwise: all
/// nodes on it. Where pixels at the border are void, successive nodes need not be joined by a side. Borders between
/// regions and around voids inside are no lines.
///
/// Throws InputError if no pixel belongs to a region, or if two parts that share no side of a pixel share a corner: a
/// hinge that the material does not have.
PolygonMesh image_mesh(const files::Image& image, const ImageOptions& options);

}  // namespace scabo::mesh
