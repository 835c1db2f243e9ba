#include "scabo/input/overrides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "scabo/input/numbers.hpp"
#include "scabo/input/suggestions.hpp"
#include "scabo/input/text_file.hpp"

namespace scabo::input {

namespace {

std::vector<std::string> split_path(std::string_view path) {
  std::vector<std::string> keys;
  while (true) {
    const auto dot = path.find('.');
    keys.emplace_back(path.substr(0, dot));
    if (dot == std::string_view::npos) return keys;
    path.remove_prefix(dot + 1);
  }
}

/// A copy in which every node is marked as coming from the command line, not from a line of the file.
NodePtr mark_as_override(const NodePtr& node, const std::string& path) {
  auto copy = std::make_shared<Node>(*node);
  copy->line = copy->column = 0;
  copy->override_path = path;
  for (NodePtr& item : copy->items) item = mark_as_override(item, path);
  for (MapEntry& entry : copy->entries) {
    entry.line = entry.column = 0;
    entry.value = mark_as_override(entry.value, path);
  }
  return copy;
}

/// Why a list has no entry of that number.
std::string why_not(const Node& list, const std::string& path, const std::string& number) {
  const std::size_t count = list.items.size();
  if (count == 0) return fmt::format("{} is an empty list", path);
  if (count == 1) return fmt::format("{} is a list of one entry: write 0, not {}", path, quoted_name(number));
  return fmt::format("{} is a list: write a number from 0 to {}, not {}", path, count - 1, quoted_name(number));
}

/// `null` or `~` was written: the key or the item is to be taken away. A value left out is not that, but a mistake.
bool takes_away(const Override& override, const Node& value) {
  return value.kind == Node::Kind::null && override.value.find_first_not_of(" \t\r\n") != std::string::npos;
}

/// Whether the item of a list stands for its place, as in `displacement: [null, 1e-3]`: others may not move up.
bool holds_a_place(const Node& item) {
  if (item.kind == Node::Kind::null) return true;
  return item.kind == Node::Kind::scalar && !item.quoted &&
         (item.text.starts_with("${") || std::holds_alternative<double>(parse_number(item.text)));
}

/// Replaces or takes away one value; copies the nodes on its path, since aliases share nodes.
class Replacement {
 public:
  Replacement(const Override& override, NodePtr value)
      : keys_(split_path(override.path)), value_(std::move(value)), takes_away_(takes_away(override, *value_)) {}

  /// The new tree, or nullptr with the reason in why() if the path does not exist.
  NodePtr in(const NodePtr& root) { return replace(root, 0, ""); }
  const std::string& why() const { return why_; }

 private:
  NodePtr replace(const NodePtr& node, std::size_t level, const std::string& path) {
    if (level == keys_.size()) return value_;
    const std::string& key = keys_[level];
    auto copy = std::make_shared<Node>(*node);
    const std::string here = path.empty() ? key : path + "." + key;
    if (node->kind == Node::Kind::map) {
      const auto find = [&](std::string_view name) {
        return std::find_if(copy->entries.begin(), copy->entries.end(),
                            [&](const MapEntry& candidate) { return candidate.key == name; });
      };
      auto entry = find(key);
      if (entry == copy->entries.end() && key == "on") entry = find("true");  // as changed by writers of YAML 1.1
      if (entry != copy->entries.end()) {
        if (ends_at(level)) {
          copy->entries.erase(entry);
          return copy;
        }
        const NodePtr inner = replace(entry->value, level + 1, here);
        if (!inner) return nullptr;
        entry->value = inner;
        return copy;
      }
      const NodePtr inner = add(*node, level, path);
      if (!inner) return nullptr;
      copy->entries.push_back({key, 0, 0, inner});
      return copy;
    }
    if (node->kind == Node::Kind::sequence) {
      std::size_t index = 0;
      const auto [end, code] = std::from_chars(key.data(), key.data() + key.size(), index);
      if (code != std::errc() || end != key.data() + key.size() || index >= node->items.size()) {
        why_ = why_not(*node, path, key);
        return nullptr;
      }
      if (ends_at(level) && !holds_a_place(*node->items[index])) {
        copy->items.erase(copy->items.begin() + static_cast<std::ptrdiff_t>(index));
        return copy;
      }
      const NodePtr inner = replace(node->items[index], level + 1, here);
      if (!inner) return nullptr;
      copy->items[index] = inner;
      return copy;
    }
    if (node->kind == Node::Kind::scalar)
      why_ = fmt::format("{} is {}, which has no keys: replace it as a whole", path, quoted_name(node->text));
    else
      why_ = path.empty() ? std::string("the model file is empty") : fmt::format("{} is empty", path);
    return nullptr;
  }

  /// What stands at this level is to be taken away.
  bool ends_at(std::size_t level) const { return takes_away_ && level + 1 == keys_.size(); }

  /// Adds a key that does not exist yet.
  NodePtr add(const Node& map, std::size_t level, const std::string& path) {
    if (level + 1 == keys_.size() && !takes_away_) return value_;
    // Sections may be absent from the file, but an absent body or contact is a mistake in the path.
    if (!takes_away_ && level == 0 && level + 2 == keys_.size()) {
      auto section = std::make_shared<Node>();
      section->kind = Node::Kind::map;
      section->override_path = value_->override_path;
      section->entries.push_back({keys_[level + 1], 0, 0, value_});
      return section;
    }
    std::vector<std::string> known;
    for (const MapEntry& entry : map.entries) known.push_back(entry.key);
    why_ = fmt::format("{} has no {}{}", path.empty() ? "the model" : path, quoted_name(keys_[level]),
                       suggestion(keys_[level], known));
    return nullptr;
  }

  std::vector<std::string> keys_;
  NodePtr value_;
  bool takes_away_;
  std::string why_;
};

}  // namespace

Override parse_override(std::string_view text) {
  const auto equals = text.find('=');
  const auto fail = [&](const std::string& why) {
    refuse_file("--set",
                fmt::format("{} {}: write path=value, as in contacts.joint.friction=0.5", quoted_name(text), why));
  };
  if (equals == std::string_view::npos) fail("has no '='");
  Override result{std::string(text.substr(0, equals)), std::string(text.substr(equals + 1))};
  const auto first = result.path.find_first_not_of(' ');
  const auto last = result.path.find_last_not_of(' ');
  result.path = first == std::string::npos ? "" : result.path.substr(first, last - first + 1);
  const std::vector<std::string> keys = split_path(result.path);
  if (result.path.empty()) fail("has no path before '='");
  if (std::find(keys.begin(), keys.end(), "") != keys.end()) fail("has an empty key in its path");
  if (keys.size() > 50) fail("has a path that is too long");
  return result;
}

NodePtr apply_overrides(NodePtr root, const std::vector<Override>& overrides, Report& report) {
  for (const Override& override : overrides) {
    const Source at{0, 0, "--set " + override.path};
    std::vector<Diagnostic> mistakes;
    const NodePtr value = parse_yaml(override.value, mistakes);
    for (const Diagnostic& mistake : mistakes) report.error(at, mistake.message);
    if (!value || !mistakes.empty()) continue;
    Replacement replacement(override, mark_as_override(value, override.path));
    if (const NodePtr replaced = replacement.in(root)) {
      root = replaced;
    } else {
      report.error(at, replacement.why());
    }
  }
  return root;
}

}  // namespace scabo::input
