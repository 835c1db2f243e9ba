#include "scabo/input/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <tuple>

#include "scabo/input/foreign_keys.hpp"
#include "scabo/input/numbers.hpp"
#include "scabo/input/suggestions.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::input {

namespace {

std::string join_path(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

constexpr std::size_t longest_path = 300;
constexpr std::string_view of_command_line = "--set ";

Source source_of(const Node& node, const std::string& path) {
  // A value from the command line has no line; its position is the path with which it was given.
  if (!node.override_path.empty()) {
    const bool inside = path.size() > node.override_path.size();
    const std::string rest = inside ? path.substr(node.override_path.size()) : "";
    return {0, 0, std::string(of_command_line) + node.override_path + rest};
  }
  return {node.line, node.column, path};
}

}  // namespace

Source Value::source() const { return source_of(*node, path); }

Value Value::item(std::size_t index) const { return {node->items[index], join_path(path, std::to_string(index))}; }

namespace {

std::string path_in_file(const Source& at) {
  return at.path.starts_with(of_command_line) ? at.path.substr(of_command_line.size()) : at.path;
}

}  // namespace

void Report::error(const Source& at, std::string message) {
  ++count_;
  paths_.insert(path_in_file(at));
  if (full()) return;
  Source place = at;
  place.path = one_line(at.path);  // keys may be any text
  if (place.path.size() > longest_path) place.path = shortened(place.path, longest_path);
  diagnostics_.push_back({place, std::move(message)});
}

void Report::error(const Value& at, std::string message) {
  if (!at.node->formula.empty() && !at.node->unreadable)
    message += fmt::format(" (from {})", quoted_name(at.node->formula));
  error(at.source(), std::move(message));
}

bool Report::is_told(const Source& at) const { return paths_.contains(path_in_file(at)); }

void Report::told_elsewhere(const Value& at) { paths_.insert(at.path); }

void Report::throw_if_any(const std::string& file) {
  if (count_ == 0) return;
  std::stable_sort(diagnostics_.begin(), diagnostics_.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::tie(a.at.line, a.at.column) < std::tie(b.at.line, b.at.column);
  });
  if (count_ > most) {
    diagnostics_.emplace_back();
    diagnostics_.back().message = fmt::format("and {} more mistakes", count_ - most);
  }
  throw InputError(file, std::move(diagnostics_));
}

std::string describe(const Node& node) {
  switch (node.kind) {
    case Node::Kind::null:
      return "nothing";
    case Node::Kind::map:
      return "a map";
    case Node::Kind::sequence:
      return "a list";
    case Node::Kind::scalar:
      break;
  }
  return quoted_name(node.text);
}

std::optional<double> read_number(Report& report, const Value& value) {
  const Node& node = *value.node;
  if (node.unreadable) return {};
  if (node.kind != Node::Kind::scalar) {
    report.error(value, fmt::format("must be a number, not {}", describe(node)));
    return {};
  }
  const auto number = parse_number(node.text);
  if (const auto* why = std::get_if<std::string>(&number)) {
    report.error(value, *why);
    return {};
  }
  if (node.quoted) {
    report.error(value, fmt::format("the number {} is in quotation marks: remove them", quoted_name(node.text)));
    return {};
  }
  return std::get<double>(number);
}

std::optional<long> read_integer(Report& report, const Value& value, const model::limits::Range& range) {
  const auto [least, most] = range;
  const auto number = read_number(report, value);
  if (!number) return {};
  if (std::floor(*number) != *number || *number < static_cast<double>(least) || *number > static_cast<double>(most)) {
    report.error(value, fmt::format("must be a whole number from {} to {}, not {}", least, most, value.node->text));
    return {};
  }
  return static_cast<long>(*number);
}

std::optional<bool> read_flag(Report& report, const Value& value) {
  const Node& node = *value.node;
  if (node.unreadable) return {};
  if (node.kind == Node::Kind::scalar && !node.quoted) {
    if (node.text == "true") return true;
    if (node.text == "false") return false;
  }
  const bool quoted = node.quoted && (node.text == "true" || node.text == "false");
  report.error(value, fmt::format("must be true or false, {} {}", quoted ? "without the quotation marks of" : "not",
                                  describe(node)));
  return {};
}

std::string as_given(std::string text, const std::string& path, const std::string& name) {
  if (text.compare(0, path.size(), path) == 0) text.replace(0, path.size(), name);
  return text;
}

std::optional<std::string> read_text(Report& report, const Value& value) {
  if (value.node->unreadable) return {};
  if (value.node->kind == Node::Kind::scalar) return value.node->text;
  report.error(value, fmt::format("must be text, not {}", describe(*value.node)));
  return {};
}

std::optional<Vec2> read_vector(Report& report, const Value& value) {
  const Node& node = *value.node;
  if (node.kind != Node::Kind::sequence || node.items.size() != 2) {
    const std::string what =
        node.kind == Node::Kind::sequence ? fmt::format("a list of {}", node.items.size()) : describe(node);
    report.error(value, fmt::format("must be two numbers, as in [x, y], not {}", what));
    return {};
  }
  const auto x = read_number(report, value.item(0));
  const auto y = read_number(report, value.item(1));
  if (!x || !y) return {};
  return Vec2(*x, *y);
}

std::optional<std::string> read_choice(Report& report, const Value& value, const std::vector<std::string>& known,
                                       const Later& later) {
  auto text = read_text(report, value);
  if (!text) return {};
  if (std::find(known.begin(), known.end(), *text) != known.end()) return text;
  for (const auto& [name, remedy] : later) {
    if (*text == name) {
      report.error(value, fmt::format("'{}' is not available in this version: {}", name, remedy));
      return {};
    }
  }
  std::string choice = known.front();
  for (std::size_t i = 1; i < known.size(); ++i) {
    choice += (i + 1 == known.size() ? " or " : ", ") + known[i];
  }
  const std::string nearest = nearest_name(*text, known);
  const std::string hint = nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest);
  report.error(value, fmt::format("must be {}, not {}{}", choice, quoted_name(*text), hint));
  return {};
}

std::optional<std::vector<Value>> read_list(Report& report, const Value& value, std::string_view example) {
  const Node& node = *value.node;
  if (node.kind == Node::Kind::null) return std::vector<Value>{};
  if (node.kind != Node::Kind::sequence) {
    report.error(value, fmt::format("must be a list, as in {}, not {}", example, describe(node)));
    return {};
  }
  std::vector<Value> items;
  items.reserve(node.items.size());
  for (std::size_t i = 0; i < node.items.size(); ++i) items.push_back(value.item(i));
  return items;
}

namespace {

Source source_of_key(const Value& map, const MapEntry& entry) {
  const std::string path = join_path(map.path, entry.key);
  if (!entry.value->override_path.empty()) return source_of(*entry.value, path);
  return {entry.line, entry.column, path};
}

/// What writers of YAML 1.1 turn the key `on` into, because they treat it as a truth value.
constexpr std::string_view written_for_on = "true";

}  // namespace

namespace {

/// Where a path leads: to a value, or to the innermost part of the file that contains what it names.
struct Located {
  Value value;
  Source key;            ///< of the value; the value itself for items of lists
  std::string key_text;  ///< as written
  bool complete = true;  ///< the path leads to the value
};

/// The entry with a key; powers of xi may be spelled differently.
const MapEntry* entry_called(const Node& map, std::string_view key) {
  if (const MapEntry* entry = map.find(key)) return entry;
  if (key == "on") return map.find(written_for_on);
  const auto number = parse_number(key);
  if (!std::holds_alternative<double>(number)) return nullptr;
  for (const MapEntry& entry : map.entries)
    if (parse_number(entry.key) == number) return &entry;
  return nullptr;
}

/// The entry of `contact_properties` that a contact names.
std::optional<Value> property_of(const Value& root, const Value& contact) {
  constexpr const char* section = "contact_properties";
  if (!contact.path.starts_with("contacts.") || contact.node->kind != Node::Kind::map) return {};
  const MapEntry* name = contact.node->find("property");
  const MapEntry* properties = root.node->find(section);
  if (name == nullptr || properties == nullptr || properties->value->kind != Node::Kind::map) return {};
  const MapEntry* property = properties->value->find(name->value->text);
  if (property == nullptr) return {};
  return Value{property->value, join_path(section, property->key)};
}

Located locate(const Value& root, std::string_view path) {
  Located at{root, root.source(), "", true};
  while (!path.empty()) {
    const Node& node = *at.value.node;
    std::string_view key = path;  // a power of xi contains a dot
    const MapEntry* entry = node.kind == Node::Kind::map ? entry_called(node, key) : nullptr;
    if (entry == nullptr) {
      key = path.substr(0, path.find('.'));
      if (node.kind == Node::Kind::map) entry = entry_called(node, key);
    }
    if (entry != nullptr) {
      at.key = source_of_key(at.value, *entry);
      at.key_text = entry->key;
      at.value = {entry->value, join_path(at.value.path, key)};
    } else if (const auto property = property_of(root, at.value)) {
      at.value = *property;  // the law of a contact
      continue;
    } else {
      std::size_t index = 0;
      const auto [end, code] = std::from_chars(key.data(), key.data() + key.size(), index);
      if (node.kind != Node::Kind::sequence || code != std::errc() || end != key.data() + key.size() ||
          index >= node.items.size()) {
        at.complete = false;
        return at;
      }
      at.value = at.value.item(index);
      at.key = at.value.source();
      at.key_text.clear();
    }
    path.remove_prefix(std::min(path.size(), key.size() + 1));
  }
  return at;
}

/// A mistake of a whole shape is shown at the points or pieces that make it.
Value part_of_shape(const Value& shape) {
  Value part = shape;
  for (const char* key : {"rectangle", "outline", "polygon", "vertices"})
    if (part.node->kind == Node::Kind::map)
      if (const MapEntry* entry = part.node->find(key); entry != nullptr)
        part = {entry->value, join_path(part.path, key)};
  return part;
}

/// The message, with the wrong number as it is written in the file.
std::string as_written(const model::Mistake& mistake, const Located& at) {
  std::string message = mistake.message;
  if (mistake.given.empty() || !at.complete) return message;
  const bool scalar = at.value.node->kind == Node::Kind::scalar;
  if (!mistake.of_key && !scalar) return message;
  const std::string shown = ", not " + mistake.given;
  if (const auto found = message.find(shown); found != std::string::npos)
    message.replace(found, shown.size(), ", not " + (mistake.of_key ? at.key_text : at.value.node->text));
  const std::string& formula = at.value.node->formula;
  if (scalar && !mistake.of_key && !formula.empty()) message += fmt::format(" (from {})", quoted_name(formula));
  return message;
}

}  // namespace

void Report::add(const Value& root, const std::vector<model::Mistake>& mistakes) {
  const std::set<std::string> told = paths_;
  const auto is_told = [&](const std::string& path, bool with_parts) {
    if (told.contains(path) || !with_parts) return told.contains(path);
    const auto below = told.lower_bound(path + ".");
    return below != told.end() && below->starts_with(path + ".");
  };
  const auto is_within_told = [&](std::string path) {
    if (is_told(path, true)) return true;
    for (auto dot = path.rfind('.'); dot != std::string::npos; dot = path.rfind('.')) {
      path.resize(dot);
      if (told.contains(path)) return true;
    }
    return false;
  };
  std::set<std::string> told_here;
  for (const model::Mistake& mistake : mistakes) {
    if (mistake.given == "nan") continue;  // stands for a number that could not be read
    if (full()) {                          // without looking them up
      if (!is_within_told(mistake.at.path)) ++count_;
      continue;
    }
    const Located at = locate(root, mistake.at.path);
    if (at.value.path.empty()) {
      if (told.contains(mistake.at.path)) continue;
      Source place = root.source();
      place.path = mistake.at.path;
      error(place, mistake.message);
      continue;
    }
    if (is_told(at.value.path, !mistake.of_whole)) continue;
    // Several contacts may share the property that is wrong, and several steps be cycles of one.
    if (!told_here.insert(at.value.path + '\n' + mistake.message).second) continue;
    const bool whole_shape = at.complete && !mistake.of_key && at.value.path.ends_with(".shape");
    error(mistake.of_key && at.complete ? at.key : (whole_shape ? part_of_shape(at.value) : at.value).source(),
          as_written(mistake, at));
  }
}

std::vector<Entry> read_named(Report& report, const Value& value, std::string_view what, std::string_view example) {
  const Node& node = *value.node;
  std::vector<Entry> entries;
  if (node.kind == Node::Kind::null) return entries;
  if (node.kind != Node::Kind::map) {
    report.error(value, fmt::format("must be a map of named {}, as in {}, not {}", what, example, describe(node)));
    return entries;
  }
  for (const MapEntry& entry : node.entries) {
    const Source at = source_of_key(value, entry);
    check_name(report, at, entry.key);  // what is meant by it elsewhere is there all the same
    entries.push_back({entry.key, at, {entry.value, join_path(value.path, entry.key)}});
  }
  return entries;
}

bool check_name(Report& report, const Source& at, std::string_view text) {
  if (model::is_name(text)) return true;
  const char* why = "";
  if (text.find('.') != std::string_view::npos) why = "; a dot separates a body from its edge";
  if (text.find(':') != std::string_view::npos) why = "; put a space after the colon";
  report.error(at, fmt::format("{} is not a valid name: use letters, digits, _ and -, and begin with a letter or _{}",
                               quoted_name(text), why));
  return false;
}

MapReader::MapReader(Report& report, Value map, std::vector<std::string> known, std::string_view example,
                     const Later& later)
    : report_(report), map_(std::move(map)) {
  const Node& node = *map_.node;
  if (node.kind != Node::Kind::map) {
    report_.error(map_, fmt::format("must be a map, as in {}, not {}", example, describe(node)));
    return;
  }
  is_map_ = true;
  std::vector<std::string> absent;  // a key that is present was not meant
  for (const std::string& key : known) {
    if (entry_of(key) == nullptr) absent.push_back(key);
  }
  const bool takes_on = std::find(known.begin(), known.end(), "on") != known.end();
  for (const MapEntry& entry : node.entries) {
    if (std::find(known.begin(), known.end(), entry.key) != known.end()) {
      refuse_empty(entry);
      continue;
    }
    if (report_.full()) {
      broken_ = true;
      report_.error(map_, "");  // counted
      continue;
    }
    const Source at = source_of_key(map_, entry);
    if (takes_on && entry.key == written_for_on) {
      if (node.find("on") != nullptr)
        report_.error(at, "is read as 'on', which is given as well: remove one of the two");
      refuse_empty(entry);
      continue;
    }
    const auto planned =
        std::find_if(later.begin(), later.end(), [&](const auto& pair) { return pair.first == entry.key; });
    if (planned != later.end()) {
      broken_ = true;
      report_.error(at, fmt::format("'{}' is not available in this version: {}", entry.key, planned->second));
      continue;
    }
    const auto colon = entry.key.find(':');
    if (entry.value->kind == Node::Kind::null && colon != std::string::npos) {
      broken_ = true;
      report_.error(at, fmt::format("unknown key {}: put a space after the colon", quoted_name(entry.key)));
      continue;
    }
    const std::string synonym = key_of_synonym(entry.key, absent);
    if (const std::string about = synonym.empty() ? about_foreign_key(entry.key, known) : ""; !about.empty()) {
      broken_ = true;
      report_.error(at, fmt::format("unknown key {}: {}", quoted_name(entry.key), about));
      continue;
    }
    const std::string nearest = synonym.empty() ? nearest_name(entry.key, absent) : synonym;
    const std::string hint = nearest.empty() ? suggestion("", known) : fmt::format(" (did you mean '{}'?)", nearest);
    if (nearest.empty()) broken_ = true;
    misspelt_.push_back(nearest);
    report_.error(at, fmt::format("unknown key {}{}", quoted_name(entry.key), hint));
  }
}

void MapReader::refuse_empty(const MapEntry& entry) const {
  if (entry.value->kind != Node::Kind::null || map_.path.empty()) return;
  const Source at = source_of_key(map_, entry);
  if (!report_.is_told(at)) report_.error(at, "has no value: give one");  // some maps are read twice
}

const MapEntry* MapReader::entry_of(std::string_view key) const {
  const MapEntry* entry = map_.node->find(key);
  return entry == nullptr && key == "on" ? map_.node->find(written_for_on) : entry;
}

std::optional<Value> MapReader::get(std::string_view key) const {
  if (!is_map_) return {};
  const MapEntry* entry = entry_of(key);
  if (entry == nullptr || entry->value->kind == Node::Kind::null) return {};
  return Value{entry->value, join_path(map_.path, key)};
}

std::optional<Value> MapReader::need(std::string_view key) const {
  auto value = get(key);
  if (value || !is_map_) return value;
  if (entry_of(key) != nullptr) {
    if (map_.path.empty()) report_.error(key_source(key), "has no value: give one");
  } else if (!broken_ && std::find(misspelt_.begin(), misspelt_.end(), key) == misspelt_.end()) {
    report_.error(map_, fmt::format("'{}' is missing", key));
  }
  return {};
}

Source MapReader::key_source(std::string_view key) const {
  const MapEntry* entry = is_map_ ? entry_of(key) : nullptr;
  return entry == nullptr ? map_.source() : source_of_key(map_, *entry);
}

void MapReader::refuse(std::string_view key, std::string_view why) const {
  if (is_map_ && entry_of(key) != nullptr) report_.error(key_source(key), std::string(why));
}

}  // namespace scabo::input
