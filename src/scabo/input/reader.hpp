// Functions that convert the tree of a model file to values of the right type and collect all mistakes.
//
// A function that finds a mistake reports it once and returns nothing; its caller continues without the value, so that
// one mistake leads to one message.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scabo/base/error.hpp"
#include "scabo/base/types.hpp"
#include "scabo/input/yaml_document.hpp"
#include "scabo/model/limits.hpp"
#include "scabo/model/validate.hpp"

namespace scabo::input {

/// A node of the tree with its path.
struct Value {
  NodePtr node;
  std::string path;  ///< `bodies.upper.mesh`

  Source source() const;
  Value item(std::size_t index) const;  ///< item of a sequence
};

/// One entry of a map.
struct Entry {
  std::string key;
  Source key_source;
  Value value;
};

/// The mistakes found so far.
class Report {
 public:
  static constexpr std::size_t most = 200;  ///< more are counted, not kept

  void error(const Source& at, std::string message);
  /// Adds the formula from which a wrong number was computed.
  void error(const Value& at, std::string message);
  /// Adds what validate says about the model read from `root`, each at its place in the file. Left out are mistakes of
  /// parts that could not be read, which have been reported.
  void add(const Value& root, const std::vector<model::Mistake>& mistakes);
  /// A value is missing because of a mistake that was reported at another place, as a file that several bodies name:
  /// nothing more is said about its part of the model.
  void told_elsewhere(const Value& at);
  /// Whether there is a mistake with this path.
  bool is_told(const Source& at) const;
  std::size_t count() const { return count_; }
  bool clean() const { return count_ == 0; }
  /// Whether further mistakes are only counted: their messages, and suggestions in them, need not be made.
  bool full() const { return diagnostics_.size() >= most; }
  /// Throws InputError with all mistakes in the order of the file, unless there are none.
  void throw_if_any(const std::string& file);

 private:
  std::vector<Diagnostic> diagnostics_;
  std::set<std::string> paths_;  // of the mistakes, without `--set`
  std::size_t count_ = 0;
};

/// What a node is, for messages of the form "must be ..., not ...": `a map`, `a list`, `'text'`, `nothing`.
std::string describe(const Node& node);

// Scalars. Anything else is reported as `must be ...`, and nothing is returned.
std::optional<double> read_number(Report& report, const Value& value);
std::optional<long> read_integer(Report& report, const Value& value, const model::limits::Range& range);
std::optional<bool> read_flag(Report& report, const Value& value);
/// The text of any scalar.
std::optional<std::string> read_text(Report& report, const Value& value);
/// `text` with the path of a file at its begin as the model file spells it.
std::string as_given(std::string text, const std::string& path, const std::string& name);
/// `[x, y]`.
std::optional<Vec2> read_vector(Report& report, const Value& value);
/// One of `known`. Choices in `later` are not available in this version and are reported with their remedy.
using Later = std::vector<std::pair<std::string, std::string>>;  // name, remedy
std::optional<std::string> read_choice(Report& report, const Value& value, const std::vector<std::string>& known,
                                       const Later& later = {});
/// Items of a list. Anything else is reported with `example`, and nothing is returned.
std::optional<std::vector<Value>> read_list(Report& report, const Value& value, std::string_view example);
/// Entries of a map whose keys are names chosen by the user. Invalid names are reported and left out.
std::vector<Entry> read_named(Report& report, const Value& value, std::string_view what, std::string_view example);

/// Whether `text` is a name (model/wording.hpp); reports it at `at` if it is not.
bool check_name(Report& report, const Source& at, std::string_view text);

/// A map with known keys. The constructor reports all other keys, and keys without a value: what was meant to be given
/// must not be taken for its default. Only sections of the model may be empty, as where all of their entries are
/// comments.
class MapReader {
 public:
  /// `example` is shown if the value is not a map.
  MapReader(Report& report, Value map, std::vector<std::string> known, std::string_view example,
            const Later& later = {});

  bool is_map() const { return is_map_; }
  bool all_known() const { return !broken_ && misspelt_.empty(); }
  const Value& map() const { return map_; }
  /// The value of a key; nothing if the key is absent or has no value, which the constructor has reported.
  std::optional<Value> get(std::string_view key) const;
  /// The same, but an absent key, and an empty section of the model, is reported.
  std::optional<Value> need(std::string_view key) const;
  bool has(std::string_view key) const { return get(key).has_value(); }
  Source key_source(std::string_view key) const;
  /// Reports a key that is present but not allowed here, at the position of the key.
  void refuse(std::string_view key, std::string_view why) const;

 private:
  Report& report_;
  Value map_;
  bool is_map_ = false;
  void refuse_empty(const MapEntry& entry) const;
  /// The entry of a key, or nullptr. Writers of YAML 1.1 turn the key `on` into `true`, so that both are accepted.
  const MapEntry* entry_of(std::string_view key) const;
  bool broken_ = false;                // some unknown key resembles no known one and may stand for a missing key
  std::vector<std::string> misspelt_;  // known keys that were probably meant by unknown ones
};

}  // namespace scabo::input
