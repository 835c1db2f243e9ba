#include "scabo/files/abaqus_lines.hpp"

#include <fmt/format.h>

namespace scabo::files {

namespace {

constexpr std::size_t most_nested_includes = 20;
constexpr std::size_t most_includes = 1000;

bool is_keyword(std::string_view line) { return !line.empty() && line.front() == '*'; }

/// Splits at commas; quotes protect them.
std::vector<std::string_view> split_fields(std::string_view line) {
  std::vector<std::string_view> fields;
  std::size_t first = 0;
  bool quoted = false;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i < line.size() && (line[i] != ',' || quoted)) continue;
    fields.push_back(trimmed(line.substr(first, i - first)));
    first = i + 1;
  }
  if (fields.back().empty()) fields.pop_back();
  return fields;
}

std::string_view without_quotes(std::string_view text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') return text.substr(1, text.size() - 2);
  return text;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && static_cast<unsigned char>(text.front()) <= ' ') text.remove_prefix(1);
  while (!text.empty() && static_cast<unsigned char>(text.back()) <= ' ') text.remove_suffix(1);
  return text;
}

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return result;
}

std::string AbaqusKeyword::value(const std::string& parameter) const {
  const auto found = parameters.find(parameter);
  return found == parameters.end() ? "" : found->second;
}

AbaqusLines::AbaqusLines(std::string_view text, const std::string& file, const ReadInclude& read_include,
                         MeshBuilder& builder)
    : read_include_(read_include), builder_(builder), names_{file}, open_{{TextCursor(text, file), 0}} {}

bool AbaqusLines::next_line() {
  if (kept_) {
    kept_ = false;
    return true;
  }
  while (!open_.empty()) {
    Open& open = open_.back();
    if (open.in.remaining() == 0) {
      open_.pop_back();
      continue;
    }
    at_ = {open.file, open.in.line()};
    line_ = trimmed(open.in.rest_of_line());
    if (!line_.empty() && line_.substr(0, 2) != "**") return true;
  }
  line_ = {};
  return false;
}

bool AbaqusLines::next_keyword(AbaqusKeyword& keyword) {
  do {
    if (!next_line()) return false;
  } while (!is_keyword(line_));
  keyword = {};
  keyword.at = at_;
  std::string joined(line_.substr(1));
  while (!joined.empty() && joined.back() == ',' && next_line()) {
    if (is_keyword(line_)) {
      kept_ = true;
      break;
    }
    joined += line_;
  }
  const std::vector<std::string_view> fields = split_fields(joined);
  if (fields.empty()) return true;
  for (const char c : upper(fields.front())) {
    if (static_cast<unsigned char>(c) > ' ') keyword.name += c;
  }
  for (std::size_t i = 1; i < fields.size(); ++i) {
    const auto equals = fields[i].find('=');
    const std::string_view value = equals == std::string_view::npos ? "" : fields[i].substr(equals + 1);
    keyword.parameters[upper(trimmed(fields[i].substr(0, equals)))] = without_quotes(trimmed(value));
  }
  return true;
}

bool AbaqusLines::next_data(std::vector<std::string_view>& fields) {
  if (!next_line()) return false;
  if (is_keyword(line_)) {
    kept_ = true;
    return false;
  }
  fields = split_fields(line_);
  return true;
}

void AbaqusLines::insert(const AbaqusKeyword& keyword) {
  const std::string name = keyword.value("INPUT");
  if (name.empty()) builder_.fail(keyword.at, "*INCLUDE names no file; write *INCLUDE, INPUT=file");
  const std::size_t from = static_cast<std::size_t>(keyword.at.file);
  if (open_.size() > most_nested_includes || names_.size() > most_includes) {
    builder_.fail(keyword.at,
                  fmt::format("'{}' is included too deeply: files that include one another?", printable(name)));
  }
  std::optional<IncludedFile> file;
  if (read_include_) file = read_include_(name, names_[from]);
  if (!file) {
    builder_.fail(keyword.at, fmt::format("the included file '{}' cannot be read; put it beside this file", name));
  }
  texts_.push_back(std::move(file->text));
  names_.push_back(file->name);
  open_.push_back({TextCursor(texts_.back(), file->name), builder_.add_file(file->name)});
}

}  // namespace scabo::files
