// VTK's XML files, for ParaView: .vtu (an unstructured grid with fields, appended raw binary data) and .pvd
// (the .vtu files of a run over time). docs/decisions/0002-vtu-writer.md says why VTK's own library does not
// write them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scabo/model/model.hpp"
#include "scabo/result/contact_lines.hpp"
#include "scabo/result/files.hpp"
#include "scabo/result/grid.hpp"

namespace scabo::result {

/// Stands near the beginning of every .vtu and .pvd of Scabo's, so that they are told from others.
inline constexpr std::string_view vtk_mark = "<!-- written by Scabo";

/// Content of a .vtu file, with the arrays that are wanted.
std::string vtu_content(const Grid& grid, const Fields& fields, const model::OutputFields& wanted = {});
std::string vtu_content(const ContactLines& lines);

/// A .pvd file, complete after every call.
class FieldCollection {
 public:
  explicit FieldCollection(const std::filesystem::path& path);
  /// `file` relative to the .pvd.
  void add(double time, std::string_view file);

 private:
  GrowingFile file_;
};

}  // namespace scabo::result
