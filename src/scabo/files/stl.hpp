// Surfaces of triangles in STL files, as text and binary.
#pragma once

#include <string>

namespace scabo::files {

/// The volume that the triangles of a file enclose. Throws InputError if it cannot be read, or if they do not close a
/// solid: every side of a triangle belongs to exactly one other one, which runs along it the other way, and normals
/// point outwards.
double volume_of_stl(const std::string& path);
/// The same of the content of a file; `path`: in messages.
double volume_of_stl(const std::string& bytes, const std::string& path);

}  // namespace scabo::files
