#include "scabo/input/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>

#include "scabo/input/formula.hpp"
#include "scabo/input/numbers.hpp"
#include "scabo/input/suggestions.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::input {

namespace {

constexpr std::size_t most_parameters = 1000;
constexpr std::string_view parameters_section = "parameters";
constexpr std::string_view opening = "${";

bool has_formula(const Node& node) {
  return node.kind == Node::Kind::scalar && node.text.find(opening) != std::string::npos;
}

/// Whether a formula stands anywhere in the tree, whose size is bounded with aliases counted in full.
bool contains_formula(const Node& node) {
  return has_formula(node) ||
         std::any_of(node.items.begin(), node.items.end(), [](const NodePtr& of) { return contains_formula(*of); }) ||
         std::any_of(node.entries.begin(), node.entries.end(),
                     [](const MapEntry& of) { return contains_formula(*of.value); });
}

/// A piece of a text: what stands in `${...}`, or between two of them.
struct TextPiece {
  std::string text;
  bool formula = false;
};

/// The pieces of a text, or nothing if a `${` is not closed. A `${` within another is a parenthesis.
std::optional<std::vector<TextPiece>> pieces_of(std::string_view text) {
  std::vector<TextPiece> pieces;
  while (!text.empty()) {
    const auto begin = text.find(opening);
    if (begin > 0) pieces.push_back({std::string(text.substr(0, begin)), false});
    if (begin == std::string_view::npos) break;
    text.remove_prefix(begin + opening.size());
    std::string formula;
    int depth = 1;
    std::size_t i = 0;
    for (; i < text.size(); ++i) {
      if (text.substr(i, 2) == opening) {
        formula += '(', ++i, ++depth;
      } else if (text[i] == '}') {
        if (--depth == 0) break;
        formula += ')';
      } else {
        formula += text[i];
      }
    }
    if (depth > 0) return {};
    text.remove_prefix(i + 1);
    pieces.push_back({std::move(formula), true});
  }
  return pieces;
}

/// All pieces as one formula.
std::string joined(const std::vector<TextPiece>& pieces) {
  if (pieces.size() == 1) return pieces.front().text;
  std::string formula;
  for (const TextPiece& piece : pieces) formula += piece.formula ? "(" + piece.text + ")" : piece.text;
  return formula;
}

/// Whether only numbers and operators stand between the formulas.
bool is_arithmetic(const std::vector<TextPiece>& pieces) {
  const auto is_sum = [](const TextPiece& piece) {
    return piece.formula || (piece.text.find_first_not_of("0123456789.eE+-*/^() ") == std::string::npos &&
                             names_in_formula(piece.text).empty());
  };
  return std::all_of(pieces.begin(), pieces.end(), is_sum);
}

/// One entry of the section.
struct Parameter {
  const MapEntry* entry = nullptr;
  Value value;
  std::string formula;             ///< empty: a number
  std::vector<std::string> names;  ///< of its formula
  bool only_on_command_line = false;
  bool used = false;
};

/// The values of all parameters. A broken one is reported once, where it is given, and its uses are silent.
class Parameters {
 public:
  Parameters(Report& report, const Node& root) : report_(report) {
    const MapEntry* entry = root.kind == Node::Kind::map ? root.find(parameters_section) : nullptr;
    if (entry == nullptr || entry->value->kind == Node::Kind::null) return;
    const Value map{entry->value, std::string(parameters_section)};
    if (map.node->kind != Node::Kind::map) {
      report.error(map,
                   fmt::format("must be a map of numbers and formulas, as in {{b: 2.0, h: \"${{3 * b}}\"}}, not {}",
                               describe(*map.node)));
      all_known_ = false;
      return;
    }
    if (map.node->entries.size() > most_parameters) {
      report.error(map, fmt::format("has {} parameters, more than {}", map.node->entries.size(), most_parameters));
      all_known_ = false;
      return;
    }
    for (const MapEntry& of : map.node->entries) read(of);
    evaluate_all();
  }

  /// The value of a formula that stands at `at`; nothing if it has none, which is reported.
  std::optional<double> value_of(const Value& at, const std::string& formula) {
    bool known = true;
    for (const std::string& name : names_in_formula(formula)) known = use(at, formula, name) && known;
    if (!known) return {};
    const auto value = value_of_formula(formula, values_);
    if (const auto* why = std::get_if<std::string>(&value)) {
      report_.error(at, fmt::format("the formula {} {}", quoted_name(formula), *why));
      return {};
    }
    return std::get<double>(value);
  }

  void tell_unused(std::vector<Warning>& warnings) {
    if (!all_known_) return;
    for (const auto& [name, parameter] : parameters_) {
      if (parameter.used || broken_.contains(name)) continue;
      if (parameter.only_on_command_line) {
        std::vector<std::string> known;
        for (const auto& [other, of] : parameters_)
          if (!of.only_on_command_line) known.push_back(other);
        report_.error(parameter.value, fmt::format("the model has and uses no parameter {}{}", quoted_name(name),
                                                   suggestion(name, known)));
      } else {
        warnings.push_back({WarningKind::input, "parameters." + name,
                            fmt::format("parameter '{}' has no effect: nothing uses it", name)});
      }
    }
  }

 private:
  void read(const MapEntry& entry) {
    Parameter parameter;
    parameter.entry = &entry;
    parameter.value = {entry.value, fmt::format("{}.{}", parameters_section, entry.key)};
    parameter.only_on_command_line = entry.line == 0;
    Source key = parameter.value.source();
    if (key.line > 0) key = {entry.line, entry.column, key.path};
    const Node& node = *entry.value;
    if (!is_parameter_name(entry.key)) {
      const std::vector<std::string> words = words_of_formulas();
      const bool word = std::find(words.begin(), words.end(), entry.key) != words.end();
      report_.error(key, word ? fmt::format("'{}' has a meaning in formulas: choose another name", entry.key)
                              : fmt::format("{} is not a valid name of a parameter: use letters, digits and _, begin "
                                            "with a letter or _, and no word such as yes, no, on or off",
                                            quoted_name(entry.key)));
      broken_.insert(entry.key);
      return;
    }
    if (has_formula(node)) {
      const auto pieces = pieces_of(node.text);
      if (!pieces) {
        fail(parameter, unclosed);
        return;
      }
      parameter.formula = joined(*pieces);
      parameter.names = names_in_formula(parameter.formula);
    } else if (node.kind != Node::Kind::scalar) {
      fail(parameter, fmt::format("must be a number or a formula, as in ${{2 * b}}, not {}", describe(node)));
      return;
    } else if (const auto number = read_number(report_, parameter.value)) {
      values_.emplace(entry.key, *number);
    } else {
      broken_.insert(entry.key);
      return;
    }
    parameters_.emplace(entry.key, std::move(parameter));
  }

  void fail(const Parameter& parameter, std::string message) {
    report_.error(parameter.value, std::move(message));
    broken_.insert(parameter.entry->key);
  }

  /// Marks a parameter as used. False if it has no value, which is or has been reported.
  bool use(const Value& at, const std::string& formula, const std::string& name) {
    if (const auto found = parameters_.find(name); found != parameters_.end()) found->second.used = true;
    if (values_.contains(name)) return true;
    if (broken_.contains(name) || !all_known_) return false;
    std::vector<std::string> known;
    if (!report_.full())
      for (const auto& [other, parameter] : parameters_)
        if (parameter.value.node != at.node) known.push_back(other);
    report_.error(at, fmt::format("the formula {} needs a parameter {}, which the model does not have{}",
                                  quoted_name(formula), quoted_name(name), suggestion(name, known)));
    return false;
  }

  /// Formulas in an order in which each needs only those before it (Kahn's algorithm); what remains has a cycle.
  void evaluate_all() {
    std::map<std::string, std::vector<std::string>> needed_by;
    std::map<std::string, std::size_t> missing;
    std::vector<std::string> ready;
    for (const auto& [name, parameter] : parameters_) {
      if (parameter.formula.empty()) continue;
      for (const std::string& other : parameter.names) {
        if (!parameters_.contains(other) || parameters_.at(other).formula.empty()) continue;
        needed_by[other].push_back(name);
        ++missing[name];
      }
      if (!missing.contains(name)) ready.push_back(name);
    }
    while (!ready.empty()) {
      const std::string name = ready.back();
      ready.pop_back();
      const Parameter& parameter = parameters_.at(name);
      if (const auto value = value_of(parameter.value, parameter.formula))
        values_.emplace(name, *value);
      else
        broken_.insert(name);
      for (const std::string& other : needed_by[name])
        if (--missing[other] == 0) ready.push_back(other);
    }
    for (const auto& [name, count] : missing)
      if (count > 0) broken_.insert(name);
    for (const auto& [name, count] : missing)
      if (count > 0 && !in_told_cycle_.contains(name)) tell_cycle(name, missing);
  }

  /// Follows unresolved names until one returns: these form a cycle.
  void tell_cycle(const std::string& start, const std::map<std::string, std::size_t>& missing) {
    std::vector<std::string> path;
    std::string name = start;
    while (std::find(path.begin(), path.end(), name) == path.end()) {
      if (in_told_cycle_.contains(name)) {  // it only leads to a cycle that has been reported
        in_told_cycle_.insert(path.begin(), path.end());
        return;
      }
      path.push_back(name);
      for (const std::string& other : parameters_.at(name).names)
        if (const auto found = missing.find(other); found != missing.end() && found->second > 0) {
          name = other;
          break;
        }
    }
    in_told_cycle_.insert(path.begin(), path.end());
    const auto begin = std::find(path.begin(), path.end(), name);
    std::string cycle;
    const std::size_t most_shown = 10;
    std::size_t shown = 0;
    for (auto it = begin; it != path.end() && shown < most_shown; ++it, ++shown) cycle += *it + " -> ";
    if (shown == most_shown) cycle += "... -> ";
    cycle += name;
    report_.error(parameters_.at(name).value,
                  fmt::format("depends on itself ({}): give one of these parameters a number", cycle));
    for (auto it = begin; it != path.end(); ++it) parameters_.at(*it).used = true;
  }

 public:
  static constexpr const char* unclosed =
      "has a '${' without its '}': close it, and put the text in quotes within [ ] or { }";

 private:
  Report& report_;
  std::map<std::string, Parameter> parameters_;
  ParameterValues values_;
  std::set<std::string> broken_, in_told_cycle_;
  bool all_known_ = true;
};

/// Replaces formulas in a tree. Nodes that aliases share are replaced once.
class FormulaReplacement {
 public:
  FormulaReplacement(Report& report, Parameters& parameters) : report_(report), parameters_(parameters) {}

  /// The same node if it has no formula.
  NodePtr in(const Value& value) {
    const auto done = done_.find(value.node.get());
    if (done != done_.end()) return done->second;
    NodePtr replaced = replace(value);
    done_.emplace(value.node.get(), replaced);
    return replaced;
  }

 private:
  NodePtr replace(const Value& value) {
    const Node& node = *value.node;
    std::shared_ptr<Node> copy;
    const auto changed = [&]() -> Node& {
      if (!copy) copy = std::make_shared<Node>(node);
      return *copy;
    };
    for (std::size_t i = 0; i < node.items.size(); ++i)
      if (NodePtr item = in(value.item(i)); item != node.items[i]) changed().items[i] = std::move(item);
    for (std::size_t i = 0; i < node.entries.size(); ++i) {
      const MapEntry& entry = node.entries[i];
      if (value.path.empty() && entry.key == parameters_section) continue;
      const Value inner{entry.value, value.path.empty() ? entry.key : value.path + "." + entry.key};
      if (NodePtr replaced = in(inner); replaced != entry.value) changed().entries[i].value = std::move(replaced);
    }
    if (has_formula(node)) compute(value, changed());
    return copy ? NodePtr(copy) : value.node;
  }

  void compute(const Value& value, Node& node) {
    node.formula = node.text;
    const auto pieces = pieces_of(node.text);
    if (!pieces) {
      report_.error(value, Parameters::unclosed);
      node.unreadable = true;
      return;
    }
    if (is_arithmetic(*pieces) && value.path != "title") {
      const auto number = parameters_.value_of(value, joined(*pieces));
      node.unreadable = !number;
      node.text = model::number_text(number.value_or(0.0));
      node.quoted = false;
      return;
    }
    node.text.clear();
    node.formula.clear();
    for (const TextPiece& piece : *pieces) {
      const auto number = piece.formula ? parameters_.value_of(value, piece.text) : std::nullopt;
      if (piece.formula && !number) node.unreadable = true;
      node.text += piece.formula ? model::number_text(number.value_or(0.0)) : piece.text;
    }
  }

  Report& report_;
  Parameters& parameters_;
  std::unordered_map<const Node*, NodePtr> done_;
};

}  // namespace

NodePtr apply_parameters(const NodePtr& root, Report& report, std::vector<Warning>& warnings) {
  Parameters parameters(report, *root);
  const NodePtr replaced = contains_formula(*root) ? FormulaReplacement(report, parameters).in({root, ""}) : root;
  parameters.tell_unused(warnings);
  return replaced;
}

}  // namespace scabo::input
