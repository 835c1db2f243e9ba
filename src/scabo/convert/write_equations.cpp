#include "scabo/convert/write_equations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include "scabo/convert/deck_equations.hpp"
#include "scabo/convert/write_model.hpp"

namespace scabo::convert {

namespace {

/// A displacement: node of the mesh, or reference k as -1 - k, and its component.
using Freedom = std::pair<int, int>;

struct Equation {
  std::vector<std::pair<Freedom, double>> terms;
  files::DeckPlace at;
};

class EquationWriter {
 public:
  explicit EquationWriter(SolidModelWriter& to) : to_(to) {
    for (std::size_t i = 0; i < to.deck.node_numbers.size(); ++i)
      if (to.deck.node_numbers[i] > 0) node_of_.emplace(to.deck.node_numbers[i], static_cast<int>(i));
  }

  void write() {
    for (const files::DeckBlock& block : to_.deck.blocks)
      if (block.name == "EQUATION") read(block);
    find_ties();
    while (substitute()) {
    }
    for (const Equation& equation : open_) {
      const auto bodies = means_tie(equation);
      to_.remarks.essential(
          equation.at,
          bodies
              ? no_ties_.at(*bodies)
              : std::string("this *EQUATION neither leaves one displacement unknown nor ties the nodes of a face to "
                            "another body, and Scabo's models have no others; use *TIE, *COUPLING with *KINEMATIC, or "
                            "*BOUNDARY"));
    }
    for (const DeckReference& reference : to_.content.references)
      if (reference.kind == DeckReference::Kind::of_equations) tell_lost_forces(reference);
  }

 private:
  /// Nodes of two bodies that move alike.
  struct Tie {
    std::map<int, std::set<int>> components;  // of each dependent node
    std::set<int> masters;
    files::DeckPlace at;
  };

  void read(const files::DeckBlock& block) {
    if (block.parameters.contains("REMOVE"))
      return to_.remarks.essential(block.at,
                                   "*EQUATION, REMOVE changes the model within the analysis, which is not taken");
    const auto given = equations_of(block, to_.remarks);
    if (!given) return;
    for (const DeckEquation& of : *given) {
      Equation equation{{}, of.at};
      for (const DeckTerm& term : of.terms) {
        const auto freedom = freedom_of(term);
        if (!freedom)
          return to_.remarks.essential(
              of.at, fmt::format("node {} of *EQUATION is not there, or is that of another condition; correct it",
                                 term.number));
        if (to_.axes.contains(freedom->first))
          return to_.remarks.essential(of.at,
                                       fmt::format("node {} of *EQUATION has axes of its own by *TRANSFORM, which "
                                                   "is not taken; write it along x, y and z",
                                                   term.number));
        equation.terms.emplace_back(*freedom, term.factor);
      }
      open_.push_back(std::move(equation));
    }
  }

  std::optional<Freedom> freedom_of(const DeckTerm& term) const {
    if (const auto node = node_of_.find(term.number); node != node_of_.end())
      return Freedom{node->second, term.component};
    const auto reference = reference_at(to_.content.references, term.number);
    if (!reference || to_.content.references[reference->first].kind != DeckReference::Kind::of_equations)
      return std::nullopt;
    return Freedom{-1 - static_cast<int>(reference->first), term.component};
  }

  const Given* known(const Freedom& freedom) const {
    if (freedom.first < 0) {
      const auto& given = to_.content.references[static_cast<std::size_t>(-1 - freedom.first)].displacements;
      const auto found = given.find(freedom.second);
      return found == given.end() ? nullptr : &found->second;
    }
    const auto found = to_.content.displacements.find(freedom);
    return found == to_.content.displacements.end() ? nullptr : &found->second;
  }

  /// Turns equations with one unknown displacement into supports; whether there was one.
  bool substitute() {
    bool found = false;
    std::erase_if(open_, [&](const Equation& equation) {
      std::vector<std::pair<Freedom, double>> unknown, driven;
      const Given* last = nullptr;
      for (const auto& [freedom, factor] : equation.terms) {
        const Given* given = known(freedom);
        if (given == nullptr) unknown.emplace_back(freedom, factor);
        if (given != nullptr) last = given;
        if (given != nullptr && !is_zero(given->course)) driven.emplace_back(freedom, factor);
      }
      if (unknown.size() > 1 || driven.size() > 1) return false;
      if (unknown.empty() && !driven.empty()) return false;
      if (unknown.empty()) return true;
      Given made;
      made.course = Course(to_.content.steps.size());
      if (last != nullptr) made = *last;
      if (!driven.empty()) made = *known(driven.front().first);
      const double ratio = driven.empty() ? 0.0 : -driven.front().second / unknown.front().second;
      made.course = scaled(made.course, ratio);
      made.at = equation.at;
      made.label = "equation";
      const auto& [freedom, factor] = unknown.front();
      if (freedom.first >= 0)
        to_.content.displacements[freedom] = made;
      else
        to_.content.references[static_cast<std::size_t>(-1 - freedom.first)].displacements[freedom.second] = made;
      found = true;
      return true;
    });
    return found;
  }

  /// The bodies of the first node and of all others, if an equation says that the former moves as a mean of the latter.
  std::optional<std::pair<int, int>> means_tie(const Equation& equation) const {
    double sum = 0.0, largest = 0.0;
    std::set<int> masters, components;
    for (std::size_t i = 0; i < equation.terms.size(); ++i) {
      const auto& [freedom, factor] = equation.terms[i];
      if (freedom.first < 0) return std::nullopt;
      components.insert(freedom.second);
      if (i > 0) masters.insert(to_.bodies.of_node[static_cast<std::size_t>(freedom.first)]);
      sum += factor;
      largest = std::max(largest, std::abs(factor));
    }
    if (components.size() != 1 || masters.size() != 1 || std::abs(sum) > 1e-3 * largest) return std::nullopt;
    const int slave = to_.bodies.of_node[static_cast<std::size_t>(equation.terms.front().first.first)];
    if (slave == *masters.begin()) return std::nullopt;
    return std::pair(slave, *masters.begin());
  }

  /// Writes ties, and takes their equations out, also those of displacements that are held.
  void find_ties() {
    std::map<std::pair<int, int>, Tie> ties;
    for (const Equation& equation : open_) {
      const auto bodies = means_tie(equation);
      if (!bodies) continue;
      Tie& tie = ties[*bodies];
      if (tie.components.empty()) tie.at = equation.at;
      tie.components[equation.terms.front().first.first].insert(equation.terms.front().first.second);
      for (std::size_t i = 1; i < equation.terms.size(); ++i) tie.masters.insert(equation.terms[i].first.first);
    }
    for (const auto& [bodies, tie] : ties)
      if (std::string why = write_tie(bodies, tie); !why.empty()) no_ties_[bodies] = std::move(why);
    std::erase_if(open_, [&](const Equation& equation) {
      const auto bodies = means_tie(equation);
      return bodies && !no_ties_.contains(*bodies);
    });
  }

  /// Outer sides of a body whose corners are all among some nodes.
  std::vector<int> sides_among(int body, const std::set<int>& nodes) const {
    std::vector<int> sides;
    for (const int side : to_.bodies.outer) {
      if (to_.body_of_side(side) != body) continue;
      const std::vector<int> corners =
          files::corners_of(to_.deck.solid->cells[static_cast<std::size_t>(side / 4)], side % 4);
      if (std::all_of(corners.begin(), corners.end(), [&](int node) { return nodes.contains(node); }))
        sides.push_back(side);
    }
    return sides;
  }

  /// Or says why there is none.
  std::string write_tie(const std::pair<int, int>& bodies, const Tie& tie) {
    std::set<int> slaves;
    for (const auto& [node, components] : tie.components) {
      slaves.insert(node);
      if (components.size() < 3)
        return fmt::format(
            "equations join node {} to another body along some axes only, and a tie along all; give "
            "equations for degrees of freedom 1 to 3",
            to_.deck.node_numbers[static_cast<std::size_t>(node)]);
    }
    const std::vector<int> b = sides_among(bodies.first, slaves), a = sides_among(bodies.second, tie.masters);
    std::set<int> left = slaves;
    for (const int side : b)
      for (const int node : files::nodes_of_side(to_.deck.solid->cells[static_cast<std::size_t>(side / 4)], side % 4))
        left.erase(node);
    if (b.empty() || a.empty() || !left.empty())
      return fmt::format(
          "equations join node {} to another body, and these nodes are not all of a face; use *TIE of two "
          "surfaces",
          to_.deck.node_numbers[static_cast<std::size_t>(left.empty() ? *slaves.begin() : *left.begin())]);
    to_.remarks.note(tie.at,
                     fmt::format("the equations join a face of body '{}' to body '{}': they become a tie, which "
                                 "holds in the mean of every pair and not at each node",
                                 to_.name_of(bodies.first), to_.name_of(bodies.second)));
    to_.parts.ties += fmt::format("  {}: {{between: [{}.{}, {}.{}]}}\n", yaml_word(to_.contact_names.take("equations")),
                                  to_.name_of(bodies.second), to_.set_of(to_.sets.sides, a, "master"),
                                  to_.name_of(bodies.first), to_.set_of(to_.sets.sides, b, "slave"));
    ++to_.result.ties;
    return "";
  }

  /// Of a reference node whose displacement is known, a force acts on what holds it; else an equation is left over.
  void tell_lost_forces(const DeckReference& reference) {
    const int of = -1 - static_cast<int>(&reference - to_.content.references.data());
    for (const auto& [component, given] : reference.forces)
      if (!is_zero(given.course) && known({of, component}) == nullptr)
        to_.remarks.essential(given.at,
                              fmt::format("the force at node {} acts on what *EQUATION joins to it, and is lost; "
                                          "use *COUPLING",
                                          reference.node));
  }

  SolidModelWriter& to_;
  std::unordered_map<std::int64_t, int> node_of_;
  std::vector<Equation> open_;
  std::map<std::pair<int, int>, std::string> no_ties_;  // by the bodies of the dependent nodes and of others: why
};

}  // namespace

void write_equations(SolidModelWriter& writer) { EquationWriter(writer).write(); }

}  // namespace scabo::convert
