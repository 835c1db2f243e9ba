// XML files of VTK for ParaView: .vtu (an unstructured grid with fields, appended binary data, compressed if there is
// much of it) and .pvd (the .vtu files of a run over time). docs/decisions/0002-vtu-writer.md explains why they are not
// written by the VTK library.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scabo/model/model.hpp"
#include "scabo/result/cell_polygons.hpp"
#include "scabo/result/contact_lines.hpp"
#include "scabo/result/files.hpp"
#include "scabo/result/grid.hpp"
#include "scabo/result/mechanism_cells.hpp"

namespace scabo::result {

/// Text near the beginning of every .vtu and .pvd file of Scabo, by which it is recognised.
inline constexpr std::string_view vtk_mark = "<!-- written by Scabo";

/// Arrays of a grid, compressed, in the order in which files have them: the files of all increments repeat them.
struct PackedGrid {
  std::vector<std::string> arrays;
};

/// Content of a .vtu file with the requested arrays, on up to `threads` threads; the content does not depend on them.
/// `nodes`: of a part of the fields, the node of the body at every point, from 0, or -1; else empty. `packed`, if
/// given: filled, or used, where a file of this grid (with or without nodes) filled it.
std::string vtu_content(const Grid& grid, const Fields& fields, const model::OutputFields& wanted = {}, int threads = 1,
                        const std::vector<std::int32_t>& nodes = {}, PackedGrid* packed = nullptr);
std::string vtu_content(const ContactLines& lines);
std::string vtu_content(const CellPolygons& polygons, int threads = 1);
std::string vtu_content(const MechanismCells& cells, int threads = 1);

/// Content of a .pvtu file: the arrays of parts of the fields, and the files that hold a part each, relative to it.
std::string pvtu_content(const model::OutputFields& wanted, const std::vector<std::string>& parts);

/// A .pvd file, which is complete after every call.
class FieldCollection {
 public:
  explicit FieldCollection(const std::filesystem::path& path);
  /// Continues one with the files in its first `size` bytes.
  FieldCollection(const std::filesystem::path& path, long long size);
  /// `file` is relative to the .pvd file.
  void add(double time, std::string_view file);
  GrowingFile& file() { return file_; }

 private:
  GrowingFile file_;
};

}  // namespace scabo::result
