// Commands that a .geo file, which is a program of Gmsh, may not have.
#pragma once

#include <string>

namespace scabo::files {

/// Throws InputError if the file, or one that it includes, has a command that runs a program, writes a file or ends
/// this program, or includes itself.
void refuse_commands(const std::string& path);

}  // namespace scabo::files
