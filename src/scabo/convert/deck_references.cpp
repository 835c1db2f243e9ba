#include "scabo/convert/deck_references.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "scabo/convert/deck_equations.hpp"
#include "scabo/convert/deck_fields.hpp"
#include "scabo/files/abaqus_lines.hpp"
#include "scabo/files/text_cursor.hpp"

namespace scabo::convert {

namespace {

using files::DeckBlock;
using files::DeckLine;
using files::upper;
using Kind = DeckReference::Kind;
using On = DeckReference::On;

class ReferenceReader {
 public:
  ReferenceReader(const files::AbaqusDeck& deck, Remarks& remarks) : deck_(deck), remarks_(remarks) {}

  std::vector<DeckReference> read() {
    for (std::size_t b = 0; b < deck_.blocks.size(); ++b) {
      const DeckBlock& block = deck_.blocks[b];
      if (block.name == "PRE-TENSIONSECTION" || block.name == "PRETENSIONSECTION") bolt(block);
      if (block.name == "COUPLING") coupling(block, b + 1 < deck_.blocks.size() ? &deck_.blocks[b + 1] : nullptr);
      if (block.name == "RIGIDBODY") rigid_body(block);
    }
    for (const DeckBlock& block : deck_.blocks)
      if (block.name == "EQUATION") nodes_of_equations(block);
    return std::move(references_);
  }

 private:
  /// False, with a remark, if there is a parameter that is not listed.
  bool has_only(const DeckBlock& block, const std::set<std::string>& known) {
    bool fine = true;
    for (const auto& parameter : block.parameters) {
      const auto& name = parameter.first;
      const bool is_known = std::any_of(known.begin(), known.end(), [&](const std::string& word) {
        const files::LessWithoutBlanks less;
        return !less(word, name) && !less(name, word);
      });
      if (is_known) continue;
      fine = false;
      remarks_.essential(block.at, fmt::format("{} with {} is not taken; take it out, or write what it says otherwise",
                                               block.written, files::printable(name)));
    }
    return fine;
  }

  /// The number of a node of no element; nothing, with a remark, if it is another one.
  std::optional<std::int64_t> node_of(const DeckBlock& block, const std::string& name) {
    const std::string text = parameter(block, name);
    std::int64_t number = 0;
    if (const auto set = deck_.loose_sets.find(upper(text)); set != deck_.loose_sets.end() && set->second.size() == 1) {
      number = set->second.front();
    } else if (!files::parse_number(std::string_view(text), number)) {
      remarks_.essential(block.at,
                         fmt::format("{} has no {} that is the number of a node; write it", block.written, name));
      return std::nullopt;
    }
    if (deck_.loose_nodes.contains(number)) {
      if (!reference_at(references_, number)) return number;
      remarks_.essential(block.at,
                         fmt::format("node {} is that of another condition too; give each a node of its own", number));
      return std::nullopt;
    }
    remarks_.essential(
        block.at, fmt::format("node {} of {} is not there, or belongs to an element; give it a node of its own", number,
                              block.written));
    return std::nullopt;
  }

  /// Those of no element; what is wrong with the equations is told where they are written.
  void nodes_of_equations(const DeckBlock& block) {
    Remarks told_later;
    for (const DeckEquation& equation : equations_of(block, told_later).value_or(std::vector<DeckEquation>{}))
      for (const DeckTerm& term : equation.terms)
        if (deck_.loose_nodes.contains(term.number) && !reference_at(references_, term.number))
          references_.push_back(begun(block, Kind::of_equations, term.number));
  }

  DeckReference begun(const DeckBlock& block, Kind kind, std::int64_t node) const {
    DeckReference made;
    made.kind = kind;
    made.node = node;
    made.place = deck_.loose_nodes.at(node);
    made.at = block.at;
    made.written = block.written;
    return made;
  }

  void bolt(const DeckBlock& block) {
    if (!has_only(block, {"SURFACE", "NODE"})) return;
    const auto node = node_of(block, "NODE");
    if (!node) return;
    DeckReference made = begun(block, Kind::bolt, *node);
    made.of = parameter(block, "SURFACE");
    if (!block.lines.empty() && !block.lines.front().fields.empty()) {
      Eigen::Vector3d normal;
      for (int k = 0; k < 3; ++k) {
        const auto value =
            number(remarks_, block.lines.front(), static_cast<std::size_t>(k), "the normal of the section", 0.0);
        if (!value) return;
        normal[k] = *value;
      }
      if (normal.norm() > 0.0) made.normal = normal.normalized();
    }
    references_.push_back(std::move(made));
  }

  /// Which degrees of freedom the lines of *KINEMATIC and *DISTRIBUTING name; all without a line.
  std::set<int> freedoms_of(const DeckBlock& block) {
    std::set<int> freedoms;
    for (const DeckLine& line : block.lines) {
      const auto first = number(remarks_, line, 0, "the first degree of freedom"),
                 last = number(remarks_, line, 1, "the last degree of freedom", first);
      if (!first || !last) return {1, 2, 3};
      for (int k = 1; k <= 6; ++k)
        if (k >= *first && k <= *last) freedoms.insert(k);
    }
    return freedoms.empty() ? std::set<int>{1, 2, 3} : freedoms;
  }

  void coupling(const DeckBlock& block, const DeckBlock* next) {
    if (!has_only(block, {"SURFACE", "REF NODE", "CONSTRAINT NAME"})) return;
    if (next == nullptr || (next->name != "KINEMATIC" && next->name != "DISTRIBUTING"))
      return remarks_.essential(block.at, "neither *KINEMATIC nor *DISTRIBUTING follows *COUPLING; add one of them");
    if (!has_only(*next, {})) return;
    const auto node = node_of(block, "REF NODE");
    if (!node) return;
    const bool kinematic = next->name == "KINEMATIC";
    const std::set<int> freedoms = freedoms_of(*next);
    if (kinematic && !(freedoms.contains(1) && freedoms.contains(2) && freedoms.contains(3)))
      return remarks_.essential(
          next->at,
          "*KINEMATIC couples the displacements along some axes only, and a rigid plate has all of them; "
          "couple degrees of freedom 1 to 3");
    DeckReference made = begun(block, kinematic ? Kind::rigid : Kind::distributing, *node);
    made.of = parameter(block, "SURFACE");
    references_.push_back(std::move(made));
  }

  void rigid_body(const DeckBlock& block) {
    if (!has_only(block, {"NSET", "ELSET", "REF NODE", "ROT NODE"})) return;
    const auto node = node_of(block, "REF NODE");
    if (!node) return;
    DeckReference made = begun(block, Kind::rigid, *node);
    const bool by_nodes = block.parameters.contains("NSET");
    made.on = by_nodes ? On::nodes : On::elements;
    made.of = parameter(block, by_nodes ? "NSET" : "ELSET");
    if (block.parameters.contains("ROT NODE")) {
      made.turning = node_of(block, "ROT NODE");
      if (!made.turning) return;
    }
    references_.push_back(std::move(made));
  }

  const files::AbaqusDeck& deck_;
  Remarks& remarks_;
  std::vector<DeckReference> references_;
};

}  // namespace

bool is_of_reference(const std::string& keyword) {
  static const std::set<std::string> known = {"PRE-TENSIONSECTION", "PRETENSIONSECTION", "COUPLING", "KINEMATIC",
                                              "DISTRIBUTING",       "RIGIDBODY",         "EQUATION", "TRANSFORM"};
  return known.contains(keyword);
}

std::vector<DeckReference> references_of(const files::AbaqusDeck& deck, Remarks& remarks) {
  return ReferenceReader(deck, remarks).read();
}

std::optional<std::pair<std::size_t, int>> reference_at(const std::vector<DeckReference>& references,
                                                        std::int64_t number) {
  for (std::size_t k = 0; k < references.size(); ++k) {
    if (references[k].node == number) return std::pair(k, 0);
    if (references[k].turning == number) return std::pair(k, 3);
  }
  return std::nullopt;
}

std::optional<std::vector<int>> components_of_reference(const std::string& word) {
  static const std::map<std::string, std::vector<int>> held = {{"ENCASTRE", {0, 1, 2, 3, 4, 5}},
                                                               {"PINNED", {0, 1, 2}},
                                                               {"XSYMM", {0, 4, 5}},
                                                               {"YSYMM", {1, 3, 5}},
                                                               {"ZSYMM", {2, 3, 4}},
                                                               {"XASYMM", {1, 2, 3}},
                                                               {"YASYMM", {0, 2, 4}},
                                                               {"ZASYMM", {0, 1, 5}}};
  const auto found = held.find(upper(word));
  return found == held.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace scabo::convert
