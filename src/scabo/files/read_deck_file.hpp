// A whole deck of Abaqus or CalculiX from its file.
#pragma once

#include <string>

#include "scabo/files/abaqus.hpp"

namespace scabo::files {

/// *INCLUDE and INPUT= are read beside the file. Throws InputError with the file and the line.
AbaqusDeck read_deck_file(const std::string& path);

}  // namespace scabo::files
