// The lines of an .inp file: comments are skipped, continued keyword lines are joined, included files are inserted.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scabo/files/abaqus.hpp"
#include "scabo/files/mesh_builder.hpp"
#include "scabo/files/text_cursor.hpp"

namespace scabo::files {

std::string_view trimmed(std::string_view text);
std::string upper(std::string_view text);

/// `*NSET, NSET=Right, GENERATE`: name `NSET`, parameters NSET -> Right, GENERATE -> "".
struct AbaqusKeyword {
  std::string name;                               ///< upper case, without spaces, as CalculiX reads it
  std::map<std::string, std::string> parameters;  ///< names in upper case, values as written
  FilePlace at;

  bool has(const std::string& parameter) const { return parameters.count(parameter) > 0; }
  std::string value(const std::string& parameter) const;
};

class AbaqusLines {
 public:
  AbaqusLines(std::string_view text, const std::string& file, const ReadInclude& read_include, MeshBuilder& builder);

  /// Skips data lines up to the next keyword; false at the end of the file.
  bool next_keyword(AbaqusKeyword& keyword);

  /// The fields of the next data line; false at a keyword or at the end. A comma at the end adds no field.
  bool next_data(std::vector<std::string_view>& fields);

  /// Reads on in another file, whose name the keyword's INPUT gives, then here.
  void insert(const AbaqusKeyword& keyword);

  /// Of the line read last.
  const FilePlace& at() const { return at_; }

 private:
  struct Open {
    TextCursor in;
    int file;
  };
  bool next_line();

  const ReadInclude& read_include_;
  MeshBuilder& builder_;
  std::deque<std::string> texts_;  // of included files
  std::deque<std::string> names_;  // of all files
  std::vector<Open> open_;
  std::string_view line_;
  bool kept_ = false;  // line_ was read but not used
  FilePlace at_;
};

}  // namespace scabo::files
