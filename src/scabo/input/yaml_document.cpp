#include "scabo/input/yaml_document.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <istream>
#include <streambuf>
#include <unordered_map>
#include <utility>

namespace scabo::input {

const MapEntry* Node::find(std::string_view key) const {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const MapEntry& entry) { return entry.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

namespace {

struct Position {
  int line = 1;
  int column = 1;
};

/// Length of the UTF-8 character at the start of `text`; 0 if it is not valid.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  if (first == 0xe0 && byte(1) < 0xa0) return 0;
  if (first == 0xed && byte(1) >= 0xa0) return 0;  // half of a surrogate pair
  if (first == 0xf0 && byte(1) < 0x90) return 0;
  if (first == 0xf4 && byte(1) >= 0x90) return 0;
  return length;
}

/// The text in the form on which yaml-cpp and editors agree: no byte order mark, lines end with \n. Throws a Diagnostic
/// for bytes that are not text: yaml-cpp would continue and report something else.
std::string clean_text(std::string_view text) {
  if (text.substr(0, 3) == "\xef\xbb\xbf") text.remove_prefix(3);
  std::string clean;
  clean.reserve(text.size());
  Position at;
  bool indents = true;  // nothing but spaces in this line so far
  while (!text.empty()) {
    std::size_t plain = 0;  // characters of one byte that are kept: nearly all
    while (plain < text.size() && text[plain] >= 0x20 && text[plain] < 0x7f) ++plain;
    indents = indents && text.substr(0, plain).find_first_not_of(' ') == std::string_view::npos;
    clean.append(text.substr(0, plain));
    text.remove_prefix(plain);
    at.column += static_cast<int>(plain);
    if (text.empty()) break;
    const std::size_t length = character_length(text);
    const auto byte = static_cast<unsigned char>(text[0]);
    const bool control = (byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r') || byte == 0x7f;
    if (length == 0 || control) {
      throw Diagnostic{{at.line, at.column, ""},
                       fmt::format("byte 0x{:02x} is not text: a model file must be YAML in UTF-8", byte)};
    }
    if (indents && text.starts_with("\xc2\xa0"))
      throw Diagnostic{{at.line, at.column, ""},
                       "a no-break space indents this line, as in text from a web page: use spaces"};
    indents = byte == '\n' || byte == '\r';
    if (indents) {
      const bool pair = byte == '\r' && text.size() > 1 && text[1] == '\n';
      text.remove_prefix(pair ? 2 : 1);
      clean += '\n';
      at = {at.line + 1, 1};
      continue;
    }
    clean.append(text.substr(0, length));
    text.remove_prefix(length);
    ++at.column;
  }
  return clean;
}

/// Messages of yaml-cpp in the terms of someone who writes a model.
std::string explain(const std::string& message) {
  static const std::array<std::pair<const char*, const char*>, 13> known{{
      {YAML::ErrorMsg::MAP_VALUE, "a ':' cannot stand here: check the indentation, or quote a text with ': ' in it"},
      {YAML::ErrorMsg::END_OF_MAP, "this line belongs to none of the keys above: check the indentation"},
      {YAML::ErrorMsg::END_OF_SEQ, "this line belongs to none of the lists above: check the indentation and the '- '"},
      {YAML::ErrorMsg::END_OF_MAP_FLOW, "the '{' before this is not closed, or a ',' is missing"},
      {YAML::ErrorMsg::END_OF_SEQ_FLOW, "the '[' before this is not closed, or a ',' is missing"},
      {YAML::ErrorMsg::FLOW_END, "this bracket was never opened"},
      {YAML::ErrorMsg::BLOCK_ENTRY, "a '- ' cannot stand here: check the indentation"},
      {YAML::ErrorMsg::MAP_KEY, "a '? ' cannot stand here"},
      {YAML::ErrorMsg::TAB_IN_INDENTATION, "tabs are not allowed in the indentation: use spaces"},
      {YAML::ErrorMsg::UNKNOWN_TOKEN, "this character cannot start a value: put the text in quotes"},
      {YAML::ErrorMsg::UNKNOWN_ANCHOR, "no anchor of this name is defined before"},
      {YAML::ErrorMsg::EOF_IN_SCALAR, "the quote before this is not closed"},
      {YAML::ErrorMsg::DOC_IN_SCALAR, "the quote before this is not closed"},
  }};
  for (const auto& [theirs, ours] : known) {
    if (message == theirs) return fmt::format("not valid YAML: {}", ours);
  }
  return fmt::format("not valid YAML: {}", message);
}

/// Passes the text to yaml-cpp in pieces, and ends it if there was no value for too long: yaml-cpp would otherwise read
/// a text of any length to its end.
class BoundedText : public std::streambuf {
 public:
  BoundedText(const std::string& text, long most) : text_(text), most_(static_cast<std::size_t>(most)) {}

  void value_came() { at_last_value_ = given_; }
  bool cut() const { return cut_; }

 private:
  int_type underflow() override {
    constexpr std::size_t piece = 1 << 14;
    if (given_ == text_.size()) return traits_type::eof();
    if (given_ - at_last_value_ > most_) {
      cut_ = true;
      return traits_type::eof();
    }
    const std::size_t length = std::min(piece, text_.size() - given_);
    char* const begin = const_cast<char*>(text_.data()) + given_;  // only read
    setg(begin, begin, begin + length);
    given_ += length;
    return traits_type::to_int_type(*begin);
  }

  const std::string& text_;
  std::size_t most_, given_ = 0, at_last_value_ = 0;
  bool cut_ = false;
};

/// The keys of a map that is being read, by their places among its entries: a table with open addressing, which needs
/// no memory of its own for a key.
class KeyTable {
 public:
  /// The entry with this key; nullptr if there is none.
  const MapEntry* find(const std::vector<MapEntry>& entries, std::string_view key) const {
    if (slots_.empty()) {
      for (const MapEntry& entry : entries)
        if (entry.key == key) return &entry;
      return nullptr;
    }
    const std::size_t slot = slot_of(entries, key);
    return slots_[slot] == 0 ? nullptr : &entries[slots_[slot] - 1];
  }
  /// After a new key has been added at the end.
  void added(const std::vector<MapEntry>& entries) {
    if (entries.size() <= few) return;
    if (2 * entries.size() <= slots_.size()) {
      slots_[slot_of(entries, entries.back().key)] = static_cast<std::uint32_t>(entries.size());
      return;
    }
    slots_.assign(8 * entries.size(), 0);
    for (std::size_t i = 0; i < entries.size(); ++i)
      slots_[slot_of(entries, entries[i].key)] = static_cast<std::uint32_t>(i + 1);
  }

 private:
  static constexpr std::size_t few = 8;  // are searched one by one

  /// That of the key, or the free one where it belongs.
  std::size_t slot_of(const std::vector<MapEntry>& entries, std::string_view key) const {
    std::size_t slot = std::hash<std::string_view>()(key) % slots_.size();
    while (slots_[slot] != 0 && entries[slots_[slot] - 1].key != key) slot = slot + 1 == slots_.size() ? 0 : slot + 1;
    return slot;
  }

  std::vector<std::uint32_t> slots_;  // 1 + the place of an entry; 0: free
};

/// Builds the tree from yaml-cpp's events. A Diagnostic thrown from an event ends the reading.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& text, BoundedText& source, std::vector<Diagnostic>& diagnostics,
              const YamlLimits& limits)
      : text_(text), source_(source), diagnostics_(diagnostics), limits_(limits) {
    line_starts_.push_back(0);
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\n') line_starts_.push_back(i + 1);
      if ((static_cast<unsigned char>(text[i]) & 0xc0) == 0x80) continuations_.push_back(i);
    }
  }

  NodePtr root() const { return root_; }
  Position last_value() const { return last_value_; }

  /// yaml-cpp counts bytes from 0, editors characters from 1.
  Position position(const YAML::Mark& mark) const {
    if (mark.line < 0 || mark.line >= static_cast<int>(line_starts_.size())) return {};
    const std::size_t start = line_starts_[static_cast<std::size_t>(mark.line)];
    const std::size_t count =
        std::min<std::size_t>(static_cast<std::size_t>(std::max(mark.column, 0)), text_.size() - start);
    const long continuation = continuations_before(start + count) - continuations_before(start);
    return {mark.line + 1, static_cast<int>(static_cast<long>(count) - continuation) + 1};
  }

  /// The white space at the start of the line.
  std::string_view indentation(const YAML::Mark& mark) const {
    if (mark.line < 0 || mark.line >= static_cast<int>(line_starts_.size())) return {};
    const std::string_view rest = std::string_view(text_).substr(line_starts_[static_cast<std::size_t>(mark.line)]);
    return rest.substr(0, rest.find_first_not_of(" \t"));
  }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (root_) fail(mark, "a second document starts here, but a model file must contain only one");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Open open = start(mark, anchor, Node::Kind::null);
    close(open);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    if (anchor == 0 && !open_.empty() && open_.back().node->kind == Node::Kind::map && !open_.back().has_key) {
      Node key;  // is not kept
      key.kind = Node::Kind::scalar;
      key.text = value;
      key.quoted = tag == "!";
      source_.value_came();
      last_value_ = position(mark);
      check_tag(mark, tag);
      check_closed_quote(mark);
      add_key(open_.back(), key, last_value_);
      return;
    }
    Open open = start(mark, anchor, Node::Kind::scalar);
    check_tag(mark, tag);
    check_closed_quote(mark);
    open.node->text = value;
    open.node->quoted = tag == "!";
    close(open);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    source_.value_came();
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) fail(mark, "this alias refers to a value that contains it");
    add(found->second, position(mark));
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open_.push_back(start(mark, anchor, Node::Kind::sequence));
    check_tag(mark, tag);
    check_depth(mark);
  }
  void OnSequenceEnd() override { close_last(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open_.push_back(start(mark, anchor, Node::Kind::map));
    check_tag(mark, tag);
    check_depth(mark);
  }
  void OnMapEnd() override { close_last(); }

 private:
  struct Open {
    std::shared_ptr<Node> node;
    YAML::anchor_t anchor = 0;
    std::string key;       // of a map: the last one read
    bool has_key = false;  // of a map: the next node is the value of that key
    bool merges = false;   // of a map: that key is `<<`
    bool repeats = false;  // of a map: that key occurred before; its value is dropped
    KeyTable keys;         // of a map
    std::vector<NodePtr> merged;
  };

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& message) const {
    const Position at = position(mark);
    throw Diagnostic{{at.line, at.column, ""}, message};
  }

  /// Number of bytes before `end` that do not start a character.
  long continuations_before(std::size_t end) const {
    return std::lower_bound(continuations_.begin(), continuations_.end(), end) - continuations_.begin();
  }

  void check_tag(const YAML::Mark& mark, const std::string& tag) const {
    if (!tag.empty() && tag != "?" && tag != "!") fail(mark, "tags ('!...') are not supported: leave the tag out");
  }

  void check_depth(const YAML::Mark& mark) const {
    if (static_cast<int>(open_.size()) > limits_.depth) {
      fail(mark, fmt::format("values are nested deeper than {} levels", limits_.depth));
    }
  }

  /// yaml-cpp accepts the end of the file as a closing quote.
  void check_closed_quote(const YAML::Mark& mark) const {
    if (mark.pos < 0 || mark.pos >= static_cast<int>(text_.size())) return;
    const char quote = text_[static_cast<std::size_t>(mark.pos)];
    if (quote != '"' && quote != '\'') return;
    for (std::size_t i = static_cast<std::size_t>(mark.pos) + 1; i < text_.size(); ++i) {
      if (quote == '"' && text_[i] == '\\') {
        ++i;
      } else if (text_[i] == quote) {
        if (quote == '"' || i + 1 >= text_.size() || text_[i + 1] != quote) return;
        ++i;
      }
    }
    fail(mark, "not valid YAML: this quote is not closed");
  }

  Open start(const YAML::Mark& mark, YAML::anchor_t anchor, Node::Kind kind) {
    source_.value_came();
    Open open;
    open.node = std::make_shared<Node>();
    open.node->kind = kind;
    const Position at = last_value_ = position(mark);
    open.node->line = at.line;
    open.node->column = at.column;
    open.anchor = anchor;
    return open;
  }

  void close_last() {
    Open open = std::move(open_.back());
    open_.pop_back();
    for (const NodePtr& merged : open.merged) {
      for (const MapEntry& entry : merged->entries) {
        if (open.keys.find(open.node->entries, entry.key) == nullptr) {
          open.node->entries.push_back(entry);
          open.keys.added(open.node->entries);
          grow(*open.node, *entry.value, {open.node->line, open.node->column});
        }
      }
    }
    close(open);
  }

  void close(const Open& open) {
    const Position at{open.node->line, open.node->column};
    if (open.anchor != 0) anchors_[open.anchor] = open.node;
    add(open.node, at);
  }

  /// Adds a finished node to its parent: as the root, an item, a key or a value.
  void add(const NodePtr& node, const Position& at) {
    if (open_.empty()) {
      root_ = node;
      return;
    }
    Open& parent = open_.back();
    if (parent.node->kind == Node::Kind::sequence) {
      grow(*parent.node, *node, at);
      parent.node->items.push_back(node);
    } else if (!parent.has_key) {
      add_key(parent, *node, at);
    } else {
      parent.has_key = false;
      if (parent.merges) {
        merge(parent, node, at);
      } else if (!parent.repeats) {
        grow(*parent.node, *node, at);
        parent.node->entries.back().value = node;
      }
    }
  }

  void add_key(Open& map, const Node& key, const Position& at) {
    if (key.kind != Node::Kind::scalar && key.kind != Node::Kind::null) {
      throw Diagnostic{{at.line, at.column, ""}, "a key must be a word, not a list or a map"};
    }
    map.has_key = true;
    map.key = key.text;
    map.merges = key.text == "<<" && !key.quoted;
    if (map.merges) return;
    const std::string name = key.kind == Node::Kind::null ? "null" : key.text;
    std::vector<MapEntry>& entries = map.node->entries;
    const MapEntry* first = map.keys.find(entries, name);
    map.repeats = first != nullptr;
    if (map.repeats) {
      diagnostics_.push_back({{at.line, at.column, path_to(name)},
                              fmt::format("is given twice (first in line {}): remove one", first->line)});
    } else {
      entries.push_back({name, at.line, at.column, nullptr});
      map.keys.added(entries);
    }
  }

  /// Path of a key of the innermost open map.
  std::string path_to(const std::string& key) const {
    std::string path;
    for (std::size_t i = 0; i + 1 < open_.size(); ++i) {
      const Node& node = *open_[i].node;
      path += node.kind == Node::Kind::map ? open_[i].key : std::to_string(node.items.size());
      path += '.';
    }
    return path + key;
  }

  void merge(Open& map, const NodePtr& node, const Position& at) const {
    std::vector<NodePtr> sources = node->kind == Node::Kind::sequence ? node->items : std::vector{node};
    for (const NodePtr& source : sources) {
      if (source->kind != Node::Kind::map) {
        throw Diagnostic{{at.line, at.column, ""}, "'<<' takes a map or a list of maps"};
      }
      map.merged.push_back(source);
    }
  }

  void grow(Node& parent, const Node& child, const Position& at) const {
    parent.expanded += child.expanded;
    parent.depth = std::max(parent.depth, child.depth + 1);
    if (parent.expanded > limits_.nodes) {
      throw Diagnostic{{at.line, at.column, ""},
                       fmt::format("the file has more than {} values, aliases counted in full", limits_.nodes)};
    }
    if (parent.depth > limits_.depth) {
      throw Diagnostic{{at.line, at.column, ""}, fmt::format("values are nested deeper than {} levels", limits_.depth)};
    }
  }

  const std::string& text_;
  BoundedText& source_;
  Position last_value_;
  std::vector<Diagnostic>& diagnostics_;
  const YamlLimits& limits_;
  std::vector<std::size_t> line_starts_;
  std::vector<std::size_t> continuations_;  // for the columns of files with very long lines
  std::vector<Open> open_;
  std::unordered_map<YAML::anchor_t, NodePtr> anchors_;
  NodePtr root_;
};

}  // namespace

NodePtr parse_yaml(std::string_view text, std::vector<Diagnostic>& diagnostics, const YamlLimits& limits) {
  std::string clean;
  try {
    clean = clean_text(text);
  } catch (const Diagnostic& diagnostic) {
    diagnostics.push_back(diagnostic);
    return nullptr;
  }
  BoundedText source(clean, limits.scalar);
  TreeBuilder builder(clean, source, diagnostics, limits);
  const auto cut = [&] {
    if (!source.cut()) return false;
    const Position at = builder.last_value();
    diagnostics.push_back({{at.line, at.column, ""},
                           fmt::format("more than {} MB of text or comment follow here without a value: shorten them",
                                       limits.scalar >> 20)});
    return true;
  };
  try {
    std::istream stream(&source);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const Diagnostic& diagnostic) {
    if (!cut()) diagnostics.push_back(diagnostic);
    return nullptr;
  } catch (const YAML::Exception& error) {
    if (cut()) return nullptr;
    const Position at = builder.position(error.mark);
    // An error caused by a tab is reported later, as an error of indentation.
    const bool tab = builder.indentation(error.mark).find('\t') != std::string_view::npos;
    diagnostics.push_back({{at.line, at.column, ""}, explain(tab ? YAML::ErrorMsg::TAB_IN_INDENTATION : error.msg)});
    return nullptr;
  }
  if (cut()) return nullptr;
  if (builder.root()) return builder.root();
  return std::make_shared<Node>();
}

}  // namespace scabo::input
