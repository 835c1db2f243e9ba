// An image as labels of its pixels.
#pragma once

#include <vector>

namespace scabo::files {

/// A label for each pixel, row by row from the top, each row from the left, as in image files.
struct Image {
  int width = 0, height = 0;
  std::vector<int> labels;  // width * height
};

}  // namespace scabo::files
