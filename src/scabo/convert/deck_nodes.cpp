#include "scabo/convert/deck_nodes.hpp"

#include <fmt/format.h>

#include <cmath>

#include "scabo/convert/deck_fields.hpp"
#include "scabo/convert/deck_names.hpp"
#include "scabo/files/abaqus_lines.hpp"
#include "scabo/files/text_cursor.hpp"

namespace scabo::convert {

using files::DeckLine;

DeckNodes::DeckNodes(const files::AbaqusDeck& deck, std::vector<DeckReference> references)
    : deck_(deck), references_(std::move(references)) {
  for (std::size_t i = 0; i < deck.node_numbers.size(); ++i)
    node_of_.emplace(deck.node_numbers[i], static_cast<int>(i));
}

std::vector<int> DeckNodes::references_named(const std::string& name) const {
  std::vector<std::int64_t> numbers(1, 0);
  if (const auto set = deck_.loose_sets.find(files::upper(name)); set != deck_.loose_sets.end())
    numbers = set->second;
  else if (!files::parse_number(std::string_view(name), numbers[0]))
    return {};
  std::vector<int> found;
  for (const std::int64_t number : numbers)
    if (const auto at = reference_at(references_, number))
      found.push_back(-1 - static_cast<int>(at->first) - (at->second > 0 ? count() : 0));
  return found;
}

std::vector<int> DeckNodes::named(const DeckLine& line, const char* what, Remarks& remarks) const {
  const std::string& name = line.fields[0];
  std::vector<int> references = references_named(name);
  const auto meaning = meaning_of(deck_, name, DeckNumbers::nodes);
  if (meaning && meaning->number) {
    const auto found = node_of_.find(*meaning->number);
    if (found != node_of_.end()) return {found->second};
  } else if (const auto found = meaning ? nodes_named(deck_, name) : std::nullopt) {
    references.insert(references.end(), found->begin(), found->end());
  }
  if (!references.empty()) return references;
  if (meaning && !meaning->number && nodes_named(deck_, name)) return {};
  if (meaning && !meaning->number)
    remarks.essential(line.at, fmt::format("there is no node set '{}' with nodes of elements, and {} at it is lost; "
                                           "correct its name",
                                           files::printable(name), what));
  else
    remarks.essential(line.at,
                      fmt::format("{} at node {}, which belongs to no {}, is lost; give it at a node of a body", what,
                                  files::printable(name), element()));
  return {};
}

std::optional<std::pair<int, int>> DeckNodes::component_at(int node, int freedom) const {
  if (node >= 0) return freedom < (deck_.solid ? 3 : 2) ? std::optional(std::pair(node, freedom)) : std::nullopt;
  const bool turns = -1 - node >= count();
  const int of = turns ? node + count() : node;
  const DeckReference::Kind kind = references_[static_cast<std::size_t>(-1 - of)].kind;
  const bool shifts = turns || kind == DeckReference::Kind::of_equations;
  if (freedom >= (kind == DeckReference::Kind::bolt ? 1 : shifts ? 3 : 6)) return std::nullopt;
  return std::pair(of, turns ? freedom + 3 : freedom);
}

std::vector<std::pair<int, int>> DeckNodes::components_of(int node, const HeldFreedoms& held, const DeckLine& line,
                                                          Remarks& remarks) const {
  std::vector<std::pair<int, int>> found;
  std::vector<int> freedoms;
  if (!held.word.empty())
    freedoms = (node < 0 ? components_of_reference(held.word) : convert::components_of(held.word, deck_.solid ? 3 : 2))
                   .value_or(std::vector<int>{});
  for (int k = held.first; k <= held.last; ++k) freedoms.push_back(k - 1);
  for (const int freedom : freedoms) {
    if (const auto component = component_at(node, freedom))
      found.push_back(*component);
    else if (held.value != 0.0)
      remarks.essential(line.at,
                        fmt::format("degree of freedom {} is not one of a {}, and its displacement {:g} is lost",
                                    freedom + 1, node < 0 ? "reference node" : body(), held.value));
  }
  return found;
}

DeckReference* DeckNodes::reference_of(int node) {
  return node >= 0 ? nullptr : &references_[static_cast<std::size_t>(-1 - node)];
}

std::optional<HeldFreedoms> held_freedoms(const DeckLine& line, int dimension, Remarks& remarks) {
  if (line.fields.size() < 2) {
    remarks.essential(line.at, "the degree of freedom is missing on this line; add it");
    return std::nullopt;
  }
  if (components_of(line.fields[1], dimension)) return HeldFreedoms{line.fields[1]};
  const auto first = number(remarks, line, 1, "the first degree of freedom");
  const auto last = number(remarks, line, 2, "the last degree of freedom", first);
  const auto given = number(remarks, line, 3, "the displacement", 0.0);
  if (!first || !last || !given) return std::nullopt;
  if (*first < 1.0 || *last < *first || *last > 11.0 || *first != std::floor(*first) || *last != std::floor(*last)) {
    remarks.essential(line.at,
                      "degrees of freedom are whole numbers from 1, the last not before the first; correct them");
    return std::nullopt;
  }
  return HeldFreedoms{"", static_cast<int>(*first), static_cast<int>(*last), *given};
}

}  // namespace scabo::convert
