#include "scabo/files/abaqus_lines.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "scabo/files/bytes_of_file.hpp"

namespace scabo::files {

namespace {

constexpr std::size_t most_nested_includes = 20;
constexpr std::size_t most_includes = 1000;

bool is_keyword(std::string_view line) { return !line.empty() && line.front() == '*'; }

std::string without_blanks(std::string_view text) {
  std::string made;
  for (const char c : text)
    if (static_cast<unsigned char>(c) > ' ') made += c;
  return made;
}

bool is_include(std::string_view line) {
  return is_keyword(line) && upper(without_blanks(line.substr(1, line.find(',') - 1))) == "INCLUDE";
}

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

/// Upper case, single blanks.
std::string with_single_blanks(std::string_view text) {
  std::string made;
  for (const char c : upper(trimmed(text))) {
    const bool blank = static_cast<unsigned char>(c) <= ' ';
    if (!blank || made.back() != ' ') made += blank ? ' ' : c;
  }
  return made;
}

std::string why_not_included(const std::string& name, const std::string& deck) {
  if (name.find('\\') != std::string::npos) return "write / between the names of folders, not \\";
  const std::filesystem::path path = std::filesystem::path(deck).parent_path() / name;
  std::error_code error;
  return std::filesystem::exists(path, error) ? "it " + why_unreadable(path) : "put it beside this file";
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && static_cast<unsigned char>(text.front()) <= ' ') text.remove_prefix(1);
  while (!text.empty() && static_cast<unsigned char>(text.back()) <= ' ') text.remove_suffix(1);
  return text;
}

std::string without_quotes(std::string_view text) {
  std::string made(text);
  std::erase(made, '"');
  return made;
}

bool LessWithoutBlanks::operator()(const std::string& a, const std::string& b) const {
  return without_blanks(a) < without_blanks(b);
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
    : read_include_(read_include), builder_(builder), names_{file}, open_{{TextCursor(text, file)}} {}

bool AbaqusLines::next_of(Open& open) {
  if (open.lines) {
    if (open.next == open.lines->size()) return false;
    const AbaqusLine& line = (*open.lines)[open.next++];
    line_ = line.text;
    at_ = line.at;
    return true;
  }
  if (open.in.remaining() == 0) return false;
  at_ = {open.file, open.in.line()};
  line_ = trimmed(open.in.rest_of_line());
  return true;
}

bool AbaqusLines::next_line_of_any_kind() {
  if (kept_) {
    kept_ = false;
    return true;
  }
  while (!open_.empty()) {
    if (!next_of(open_.back()))
      open_.pop_back();
    else if (!line_.empty() && line_.substr(0, 2) != "**")
      return true;
  }
  line_ = {};
  return false;
}

bool AbaqusLines::next_line() {
  while (next_line_of_any_kind()) {
    if (!is_include(line_)) return true;
    insert(keyword_of_line());
  }
  return false;
}

AbaqusKeyword AbaqusLines::keyword_of_line() {
  AbaqusKeyword keyword;
  keyword.at = at_;
  std::string joined(line_.substr(1));
  while (!joined.empty() && joined.back() == ',' && next_line_of_any_kind()) {
    if (is_keyword(line_)) {
      kept_ = true;
      break;
    }
    joined += line_;
  }
  const std::vector<std::string_view> fields = split_fields(joined);
  if (fields.empty() || fields.front().empty()) builder_.fail(keyword.at, "this line names no keyword; take it out");
  keyword.name = without_blanks(upper(fields.front()));
  keyword.written = '*' + printable(with_single_blanks(fields.front()));
  for (std::size_t i = 1; i < fields.size(); ++i) {
    if (fields[i].empty()) continue;
    const auto equals = fields[i].find('=');
    const std::string_view value = equals == std::string_view::npos ? "" : fields[i].substr(equals + 1);
    const std::string parameter = with_single_blanks(fields[i].substr(0, equals));
    if (parameter.empty())
      builder_.fail(keyword.at, fmt::format("{} gives '{}' to no parameter; write its name before it", keyword.written,
                                            printable(fields[i])));
    if (keyword.has(parameter))
      builder_.fail(keyword.at, fmt::format("{} gives {} twice; keep the one that is meant", keyword.written,
                                            printable(parameter)));
    keyword.parameters[parameter] = trimmed(without_quotes(value));
  }
  return keyword;
}

bool AbaqusLines::next_keyword(AbaqusKeyword& keyword) {
  do {
    if (!next_line()) return false;
  } while (!is_keyword(line_));
  keyword = keyword_of_line();
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
  if (name.empty()) builder_.fail(keyword.at, keyword.written + " names no file; write INPUT=file");
  for (const auto& [parameter, value] : keyword.parameters)
    if (parameter != "INPUT")
      builder_.fail(keyword.at, fmt::format("{} with {} is not taken: put the text of the file into INPUT=file alone",
                                            keyword.written, printable(parameter)));
  if (open_.size() > most_nested_includes || names_.size() > most_includes)
    builder_.fail(keyword.at, fmt::format("'{}' is included by more than {} files within each other, or after more "
                                          "than {} others; put them into fewer files",
                                          printable(name), most_nested_includes, most_includes));
  std::optional<IncludedFile> file;
  // Both programs take names from the folder of the deck, wherever they stand.
  const std::size_t from = static_cast<std::size_t>(keyword.at.file);
  if (read_include_) file = read_include_(name, names_.front());
  if (read_include_ && !file) file = read_include_(name, names_[from]);
  if (!file)
    builder_.fail(keyword.at, fmt::format("the included file '{}' cannot be read; {}", printable(name),
                                          why_not_included(name, names_.front())));
  for (const Open& open : open_)
    if (!open.lines && names_[static_cast<std::size_t>(open.file)] == file->name)
      builder_.fail(keyword.at, fmt::format("'{}' is included within itself; take this line out", printable(name)));
  texts_.push_back(std::move(file->text));
  names_.push_back(file->name);
  open({TextCursor(texts_.back(), file->name), builder_.add_file(file->name)});
}

RecordedLines AbaqusLines::record_until(const std::string& name) {
  auto lines = std::make_shared<std::vector<AbaqusLine>>();
  while (next_line()) {
    if (is_keyword(line_)) {
      const std::string_view head = line_.substr(1, line_.find(',') - 1);
      if (upper(without_blanks(head)) == name) return lines;
    }
    lines->push_back({line_, at_});
  }
  return nullptr;
}

void AbaqusLines::insert(const RecordedLines& lines) { open({TextCursor({}, {}), 0, lines}); }

void AbaqusLines::open(Open source) {
  if (kept_) {
    kept_ = false;
    const auto line = std::make_shared<const std::vector<AbaqusLine>>(1, AbaqusLine{line_, at_});
    open_.push_back({TextCursor({}, {}), 0, line});
  }
  open_.push_back(std::move(source));
}

}  // namespace scabo::files
