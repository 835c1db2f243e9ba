// YAML text -> a small tree that knows where everything stands.
//
// yaml-cpp's own tree forgets repeated keys and the places of keys, so its events are read into our own.
// One document, UTF-8; anchors, aliases and merge keys (`<<`) are understood, tags are not. Bounds on size
// and depth keep a small file with nested aliases from growing without end.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "scabo/base/error.hpp"

namespace scabo::model {

struct Node;
using NodePtr = std::shared_ptr<const Node>;

struct MapEntry {
  std::string key;
  int line = 0;  ///< of the key
  int column = 0;
  NodePtr value;
};

struct Node {
  enum class Kind { null, scalar, sequence, map };
  Kind kind = Kind::null;
  std::string text;               ///< of a scalar
  bool quoted = false;            ///< a scalar in quotes, or a block of text
  std::vector<NodePtr> items;     ///< of a sequence
  std::vector<MapEntry> entries;  ///< of a map, keys all different
  int line = 0;                   ///< from 1; 0: from an override
  int column = 0;
  std::string override_path;  ///< of an override: the path it was given with
  long expanded = 1;          ///< nodes in this tree, every alias counted in full
  int depth = 1;              ///< levels in this tree

  const MapEntry* find(std::string_view key) const;
};

/// What a model file may hold at most.
struct YamlLimits {
  long bytes = 64L << 20;
  long nodes = 500'000;
  int depth = 50;
  long scalar = 1L << 20;  ///< bytes from one value to the next: yaml-cpp takes a fifth of a second for each MB of one
};

/// The tree of `text`; null node when it is empty. Mistakes are added to `diagnostics`; returns nothing when
/// there is no tree to go on with.
NodePtr parse_yaml(std::string_view text, std::vector<Diagnostic>& diagnostics, const YamlLimits& limits = {});

/// Throws the InputError of a file that is wrong as a whole.
[[noreturn]] void refuse_file(const std::string& file, std::string message);

/// The bytes of a file. Throws InputError for what is missing, no file, unreadable or larger than the limit.
std::string read_text_file(const std::string& file, const YamlLimits& limits = {});

}  // namespace scabo::model
