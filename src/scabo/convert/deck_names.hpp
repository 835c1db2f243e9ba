// What the names and numbers in a deck mean: `5`, `Set-1`, and of an instance of a part `Block-1.5`, `Block-1.Set-1`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scabo/files/abaqus.hpp"

namespace scabo::convert {

/// A name of a set as the mesh of the deck has it, and a number; one of the two.
struct DeckName {
  std::string set;
  std::optional<std::int64_t> number;
};

enum class DeckNumbers { nodes, elements };

/// Nothing for a number that the instance does not have, or that belongs to none of several instances.
std::optional<DeckName> meaning_of(const files::AbaqusDeck& deck, const std::string& field, DeckNumbers of);

/// `105`, or `5 of 'Block-1'`.
std::string shown_number(const files::AbaqusDeck& deck, std::int64_t number, DeckNumbers of);

/// Sides of the facet set of this name in any case; nothing if there is none.
std::optional<std::vector<files::Facet>> surface_named(const files::AbaqusDeck& deck, const std::string& name);

/// Sides of the facet set, or between nodes of the node set, of this name in any case; nothing if there is neither.
std::optional<std::vector<files::Facet>> sides_named(const files::AbaqusDeck& deck, const std::string& name);
/// Nodes of the node set, or the node, of this name; nothing if there is none.
std::optional<std::vector<int>> nodes_named(const files::AbaqusDeck& deck, const std::string& name);
/// Cells of the cell set, or the cell, of this name; nothing if there is none. All of them for an empty name.
std::optional<std::vector<int>> cells_named(const files::AbaqusDeck& deck, const std::string& name);

}  // namespace scabo::convert
