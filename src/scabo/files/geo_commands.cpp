#include "scabo/files/geo_commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <string_view>

#include "scabo/base/error.hpp"
#include "scabo/files/bytes_of_file.hpp"
#include "scabo/files/cad.hpp"
#include "scabo/files/text_cursor.hpp"

namespace scabo::files {

namespace {

namespace fs = std::filesystem;

/// A word, a string between quotes or another character of a .geo file.
struct GeoToken {
  enum class Kind { word, text, character, end } kind = Kind::end;
  std::string_view text;
  int line = 1;
};

class GeoTokens {
 public:
  explicit GeoTokens(std::string_view text) : rest_(text) {}

  GeoToken next() {
    while (!rest_.empty()) {
      if (rest_.starts_with("//")) {
        skip(std::min(rest_.find('\n'), rest_.size()));
      } else if (rest_.starts_with("/*")) {
        const std::size_t end = rest_.find("*/", 2);
        skip(end == std::string_view::npos ? rest_.size() : end + 2);
      } else if (static_cast<unsigned char>(rest_.front()) <= ' ') {
        skip(1);
      } else {
        return token();
      }
    }
    return {GeoToken::Kind::end, {}, line_};
  }

 private:
  GeoToken token() {
    const int line = line_;
    const char first = rest_.front();
    if (first == '"' || first == '\'') {
      const std::size_t end = rest_.find(first, 1);
      const std::string_view text = rest_.substr(1, end == std::string_view::npos ? end : end - 1);
      skip(end == std::string_view::npos ? rest_.size() : end + 1);
      return {GeoToken::Kind::text, text, line};
    }
    const auto in_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    std::size_t length = 0;
    while (length < rest_.size() && in_word(rest_[length])) ++length;
    const std::string_view text = rest_.substr(0, std::max<std::size_t>(length, 1));
    skip(text.size());
    return {length > 0 ? GeoToken::Kind::word : GeoToken::Kind::character, text, line};
  }

  void skip(std::size_t count) {
    line_ += static_cast<int>(std::count(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(count), '\n'));
    rest_.remove_prefix(count);
  }

  std::string_view rest_;
  int line_ = 1;
};

[[noreturn]] void refuse_command(const std::string& file, int line, std::string_view command, const char* what) {
  fail_in_file(
      file, line, 1,
      fmt::format("the command {} {}: remove it, or mesh the file with gmsh -2 and use the .msh", command, what));
}

/// `outer`: the files around it.
void refuse_commands_of(const fs::path& path, std::set<fs::path> outer) {
  if (!outer.insert(path.lexically_normal()).second)
    fail_in_file(path.string(), 0, 0, "the file includes itself, without end: remove the command");
  const std::string text = bytes_of_file(path).value_or("");
  constexpr const char* runs = "runs other programs, which Scabo does not allow";
  constexpr const char* writes = "writes files, which Scabo does not allow";
  // Also in comments, whose end Gmsh may see elsewhere.
  for (const std::string_view word : {"SystemCall", "OnelabRun"})
    if (const std::size_t at = text.find(word); at != std::string::npos) {
      const auto end = text.begin() + static_cast<std::ptrdiff_t>(at);
      refuse_command(path.string(), static_cast<int>(std::count(text.begin(), end, '\n')) + 1, word, runs);
    }

  GeoTokens tokens(text);
  for (GeoToken token = tokens.next(); token.kind != GeoToken::Kind::end;) {
    const GeoToken at = token;
    token = tokens.next();
    if (at.kind != GeoToken::Kind::word) continue;
    const auto is = [&at](std::string_view word) { return at.text == word; };
    if (is("System")) refuse_command(path.string(), at.line, at.text, runs);
    if (is("Save") || is("Print") || is("CreateDir") || is("Plugin"))
      refuse_command(path.string(), at.line, at.text, writes);
    if (is("Exit") || is("AbortOnError")) refuse_command(path.string(), at.line, at.text, "ends the program");
    if (is("Open")) refuse_command(path.string(), at.line, at.text, "opens another model");
    if (is("Printf") && token.text == "(") {
      int depth = 0;
      do {
        depth += token.text == "(" ? 1 : token.text == ")" ? -1 : 0;
        token = tokens.next();
      } while (depth > 0 && token.kind != GeoToken::Kind::end);
      if (token.text == ">") refuse_command(path.string(), at.line, "Printf(...) >", writes);
    }
    if (is("Include") || is("Merge") || is("MergeWithBoundingBox")) {
      if (token.kind != GeoToken::Kind::text)
        refuse_command(path.string(), at.line, at.text, "has a name that is computed, which Scabo cannot check");
      const fs::path other = path.parent_path() / std::string(token.text);
      std::error_code error;
      if (!has_own_sizes(other.string()) && is_cad_file(other.string())) continue;
      if (fs::is_regular_file(other, error)) refuse_commands_of(other, outer);
    }
  }
}

}  // namespace

void refuse_commands(const std::string& path) { refuse_commands_of(path, {}); }

}  // namespace scabo::files
