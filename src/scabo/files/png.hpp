// Images in PNG files.
#pragma once

#include <string>

#include "scabo/files/image.hpp"

namespace scabo::files {

struct PngImage : Image {
  int largest_label = 255;  ///< that a pixel of the file can have: 65535 if it has 16 bits per sample
  long transparent = 0;     ///< how many pixels are so, in part or whole
};

/// Reads an image. Labels are levels of grey as stored: 0 to 255, or 0 to 65535 if the file has 16 bits per sample.
/// Images of 1, 2 or 4 bits are spread to 0 to 255. Colours, also those of a palette, become their grey,
/// 0.299 red + 0.587 green + 0.114 blue, rounded, of transparent pixels too.
///
/// Throws InputError with the name of the file and the reason if it cannot be read, is not a PNG file, is broken, or
/// has more than 2^28 pixels.
PngImage read_png(const std::string& file);

}  // namespace scabo::files
