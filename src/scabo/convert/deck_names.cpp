#include "scabo/convert/deck_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <unordered_set>

#include "scabo/files/abaqus_lines.hpp"
#include "scabo/files/text_cursor.hpp"

namespace scabo::convert {

namespace {

using files::AbaqusDeck;
using files::DeckInstance;
using files::upper;

const DeckInstance::Numbers& numbers_of(const DeckInstance& instance, DeckNumbers of) {
  return of == DeckNumbers::nodes ? instance.nodes : instance.elements;
}

bool has(const DeckInstance::Numbers& numbers, std::int64_t number) {
  return number > numbers.offset && number <= numbers.offset + numbers.largest;
}

template <class Set>
const Set* set_named(const std::vector<Set>& sets, const std::string& name) {
  for (const Set& set : sets)
    if (upper(set.name) == upper(name)) return &set;
  return nullptr;
}

/// A set by its name; a set of the only instance may be called by its short name, and a file without instances may have
/// sets whose names begin with one.
template <class Set>
const Set* set_in(const AbaqusDeck& deck, const std::vector<Set>& sets, const std::string& name) {
  if (const Set* set = set_named(sets, name)) return set;
  if (deck.instances.size() == 1) return set_named(sets, deck.instances.front().name + "." + name);
  const auto dot = name.rfind('.');
  return deck.instances.empty() && dot != std::string::npos ? set_named(sets, name.substr(dot + 1)) : nullptr;
}

}  // namespace

std::optional<DeckName> meaning_of(const AbaqusDeck& deck, const std::string& field, DeckNumbers of) {
  std::int64_t number = 0;
  if (files::parse_number(std::string_view(field), number)) {
    if (deck.instances.size() == 1 && has(numbers_of(deck.instances.front(), of), number)) return DeckName{"", number};
    for (const DeckInstance& instance : deck.instances)
      if (has(numbers_of(instance, of), number)) return std::nullopt;
    return DeckName{"", number};
  }
  for (const DeckInstance& instance : deck.instances) {
    const std::string prefix = upper(instance.name) + ".";
    if (!upper(field).starts_with(prefix)) continue;
    if (!files::parse_number(std::string_view(field).substr(prefix.size()), number)) break;
    const DeckInstance::Numbers& numbers = numbers_of(instance, of);
    if (number < 1 || number > numbers.largest) return std::nullopt;
    return DeckName{"", number + numbers.offset};
  }
  return DeckName{field, std::nullopt};
}

std::string shown_number(const AbaqusDeck& deck, std::int64_t number, DeckNumbers of) {
  for (const DeckInstance& instance : deck.instances)
    if (const auto& numbers = numbers_of(instance, of); has(numbers, number))
      return fmt::format("{} of '{}'", number - numbers.offset, files::printable(instance.name));
  return fmt::format("{}", number);
}

std::optional<std::vector<files::Facet>> surface_named(const AbaqusDeck& deck, const std::string& name) {
  const files::FacetSet* set = set_in(deck, deck.mesh.facet_sets, name);
  return set == nullptr ? std::nullopt : std::optional(set->facets);
}

std::optional<std::vector<files::Facet>> sides_named(const AbaqusDeck& deck, const std::string& name) {
  if (auto surface = surface_named(deck, name)) return surface;
  const files::NodeSet* set = set_in(deck, deck.mesh.node_sets, name);
  if (set == nullptr) return std::nullopt;
  const std::unordered_set<int> nodes(set->nodes.begin(), set->nodes.end());
  std::vector<files::Facet> sides;
  if (deck.solid) {
    for (int c = 0; c < static_cast<int>(deck.solid->cells.size()); ++c)
      for (int side = 0; side < 4; ++side) {
        const auto corners = files::corners_of(deck.solid->cells[static_cast<std::size_t>(c)], side);
        if (std::all_of(corners.begin(), corners.end(), [&](int node) { return nodes.contains(node); }))
          sides.push_back(files::facet_of_solid({c, side}));
      }
    return sides;
  }
  for (const files::BoundaryLoop& loop : files::boundary_facets(deck.mesh))
    for (const files::Facet& side : loop.facets)
      if (nodes.contains(side.start) && nodes.contains(side.end)) sides.push_back(side);
  return sides;
}

std::optional<std::vector<int>> nodes_named(const AbaqusDeck& deck, const std::string& name) {
  const auto meaning = meaning_of(deck, name, DeckNumbers::nodes);
  if (!meaning) return std::nullopt;
  if (!meaning->number) {
    const files::NodeSet* set = set_in(deck, deck.mesh.node_sets, meaning->set);
    return set == nullptr ? std::nullopt : std::optional(set->nodes);
  }
  const auto found = std::find(deck.node_numbers.begin(), deck.node_numbers.end(), *meaning->number);
  if (found == deck.node_numbers.end()) return std::nullopt;
  return std::vector<int>{static_cast<int>(found - deck.node_numbers.begin())};
}

std::optional<std::vector<int>> cells_named(const AbaqusDeck& deck, const std::string& name) {
  if (name.empty()) {
    std::vector<int> all(deck.mesh.cells.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  const auto meaning = meaning_of(deck, name, DeckNumbers::elements);
  if (!meaning) return std::nullopt;
  if (!meaning->number) {
    const files::CellSet* set = set_in(deck, deck.mesh.cell_sets, meaning->set);
    return set == nullptr ? std::nullopt : std::optional(set->cells);
  }
  std::vector<int> cells;  // several parts of an element that is divided
  for (std::size_t c = 0; c < deck.mesh.cells.size(); ++c)
    if (deck.mesh.cells[c].number == *meaning->number) cells.push_back(static_cast<int>(c));
  return cells.empty() ? std::nullopt : std::optional(std::move(cells));
}

}  // namespace scabo::convert
