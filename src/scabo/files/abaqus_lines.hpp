// The lines of an .inp file: comments are skipped, continued keyword lines are joined, included files are inserted.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "scabo/files/abaqus.hpp"
#include "scabo/files/mesh_builder.hpp"
#include "scabo/files/text_cursor.hpp"

namespace scabo::files {

std::string_view trimmed(std::string_view text);
std::string upper(std::string_view text);
/// `"Part-1-1".set` is `Part-1-1.set`: quotes only protect commas and blanks.
std::string without_quotes(std::string_view text);

/// `*NSET, NSET=Right, GENERATE`: name `NSET`, parameters NSET -> Right, GENERATE -> "".
struct AbaqusKeyword {
  std::string name;     ///< upper case, without blanks, as both programs read it
  std::string written;  ///< upper case, with its blanks and asterisk, for messages: `*NODE FILE`
  KeyParameters parameters;
  FilePlace at;

  bool has(const std::string& parameter) const { return parameters.count(parameter) > 0; }
  std::string value(const std::string& parameter) const;
};

/// A line as it stands in a file, without the blanks around it.
struct AbaqusLine {
  std::string_view text;
  FilePlace at;
};
using RecordedLines = std::shared_ptr<const std::vector<AbaqusLine>>;

class AbaqusLines {
 public:
  AbaqusLines(std::string_view text, const std::string& file, const ReadInclude& read_include, MeshBuilder& builder);

  /// Skips data lines up to the next keyword; false at the end of the file.
  bool next_keyword(AbaqusKeyword& keyword);

  /// The fields of the next data line; false at a keyword or at the end. A comma at the end adds no field.
  bool next_data(std::vector<std::string_view>& fields);

  /// Reads on in another file, whose name the keyword's INPUT gives, then here. *INCLUDE does so by itself, wherever it
  /// stands.
  void insert(const AbaqusKeyword& keyword);

  /// All lines up to the keyword of this name, which is read too. Nothing if it does not come.
  RecordedLines record_until(const std::string& name);
  /// Reads recorded lines, then on here.
  void insert(const RecordedLines& lines);

  /// Of the line read last.
  const FilePlace& at() const { return at_; }

 private:
  /// A text, or lines of it that were recorded.
  struct Open {
    TextCursor in;
    int file = 0;
    RecordedLines lines = nullptr;
    std::size_t next = 0;
  };
  bool next_of(Open& open);
  bool next_line();
  bool next_line_of_any_kind();
  AbaqusKeyword keyword_of_line();
  void open(Open source);

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
