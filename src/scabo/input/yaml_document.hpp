// Reads YAML text into a small tree that records the position of everything in it.
//
// The tree of yaml-cpp drops repeated keys and the positions of keys; therefore its events are read into a tree of our
// own. One document in UTF-8; anchors, aliases and merge keys (`<<`) are supported, tags are not. Bounds on size and
// depth prevent small files with nested aliases from growing without limit.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "scabo/base/error.hpp"

namespace scabo::input {

struct Node;
using NodePtr = std::shared_ptr<const Node>;

struct MapEntry {
  std::string key;
  int line = 0;  ///< position of the key
  int column = 0;
  NodePtr value;
};

struct Node {
  enum class Kind { null, scalar, sequence, map };
  Kind kind = Kind::null;
  std::string text;               ///< of a scalar
  bool quoted = false;            ///< a quoted scalar or a block of text
  std::string formula;            ///< from which the number in `text` was computed; empty if it stands in the file
  bool unreadable = false;        ///< its formula is wrong, which has been reported
  std::vector<NodePtr> items;     ///< of a sequence
  std::vector<MapEntry> entries;  ///< of a map, with distinct keys
  int line = 0;                   ///< from 1; 0 for an override
  int column = 0;
  std::string override_path;  ///< path of the override; empty otherwise
  long expanded = 1;          ///< number of nodes in this tree, aliases counted in full
  int depth = 1;              ///< levels in this tree

  const MapEntry* find(std::string_view key) const;
};

/// Limits of a model file.
struct YamlLimits {
  long bytes = 64L << 20;
  long nodes = 500'000;
  int depth = 50;
  long scalar = 1L << 20;  ///< bytes from one value to the next; yaml-cpp needs 0.2 s per MB of one value
};

/// The tree of `text`, a null node if it is empty. Mistakes are added to `diagnostics`; returns nullptr if there is no
/// usable tree.
NodePtr parse_yaml(std::string_view text, std::vector<Diagnostic>& diagnostics, const YamlLimits& limits = {});

}  // namespace scabo::input
