// Helpers that turn the tree of a model file into checked values and collect every mistake on the way.
//
// Every function that finds a mistake reports it once and returns nothing; callers go on without the value,
// so that one mistake is one message.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scabo/base/error.hpp"
#include "scabo/base/types.hpp"
#include "scabo/model/yaml_document.hpp"

namespace scabo::model {

/// A node together with the way to it.
struct Value {
  NodePtr node;
  std::string path;  ///< `bodies.upper.mesh`

  Source source() const;
  Value item(std::size_t index) const;  ///< of a sequence
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
  void error(const Value& at, std::string message) { error(at.source(), std::move(message)); }
  std::size_t count() const { return count_; }
  bool clean() const { return count_ == 0; }
  /// More mistakes are counted only: their messages, and suggestions in them, need not be made.
  bool full() const { return diagnostics_.size() >= most; }
  /// Throws InputError with all mistakes in the order of the file, unless there are none.
  void throw_if_any(const std::string& file);

 private:
  std::vector<Diagnostic> diagnostics_;
  std::size_t count_ = 0;
};

/// `a map`, `a list`, `'text'`, `nothing`, for "must be ..., not ...".
std::string describe(const Node& node);

// Scalars. `must be ...` and nothing when it is something else.
std::optional<double> read_number(Report& report, const Value& value);
std::optional<double> read_positive(Report& report, const Value& value);
std::optional<double> read_not_negative(Report& report, const Value& value);
std::optional<long> read_integer(Report& report, const Value& value, long least, long most);
std::optional<bool> read_flag(Report& report, const Value& value);
/// Any scalar with a value, as text.
std::optional<std::string> read_text(Report& report, const Value& value);
/// `[x, y]`.
std::optional<Vec2> read_vector(Report& report, const Value& value);
/// One of `known`; those of `later` are not available in this version: their remedy is told.
using Later = std::vector<std::pair<std::string, std::string>>;  // name, remedy
std::optional<std::string> read_choice(Report& report, const Value& value, const std::vector<std::string>& known,
                                       const Later& later = {});
/// Items of a list; nothing (with an error that shows `example`) when it is none.
std::optional<std::vector<Value>> read_list(Report& report, const Value& value, std::string_view example);
/// Entries of a map whose keys are names chosen by the user; those that are no names are reported and left
/// out.
std::vector<Entry> read_named(Report& report, const Value& value, std::string_view what, std::string_view example);

/// Letters, digits, _ and -, no digit first. Places and paths separate names by dots.
bool is_name(std::string_view text);
/// Reports `text` at `at` unless it is a name.
bool check_name(Report& report, const Source& at, std::string_view text);

/// A map with known keys. The constructor reports whatever is not a known key.
class MapReader {
 public:
  /// `example` is shown where the value is no map.
  MapReader(Report& report, Value map, std::vector<std::string> known, std::string_view example,
            const Later& later = {});

  bool is_map() const { return is_map_; }
  bool all_known() const { return !broken_ && misspelt_.empty(); }
  const Value& map() const { return map_; }
  /// The value of a key; nothing when the key is absent or has no value.
  std::optional<Value> get(std::string_view key) const;
  /// The same; an absent or empty key is reported.
  std::optional<Value> need(std::string_view key) const;
  bool has(std::string_view key) const { return get(key).has_value(); }
  Source key_source(std::string_view key) const;
  /// Reports, at the key, a key that does not belong here.
  void refuse(std::string_view key, std::string_view why) const;

 private:
  Report& report_;
  Value map_;
  bool is_map_ = false;
  /// The entry of a key; nullptr when it is absent. A writer of YAML 1.1 turns the key `on` into `true`: both are read.
  const MapEntry* entry_of(std::string_view key) const;
  bool broken_ = false;                // an unknown key that resembles no known one may be the missing one
  std::vector<std::string> misspelt_;  // known keys that an unknown one was probably meant to be
};

}  // namespace scabo::model
