// Sets and surfaces as their keywords give them.
#include <fmt/format.h>

#include "scabo/files/abaqus_reader.hpp"

namespace scabo::files {

void AbaqusReader::count_entries(std::int64_t count) {
  const bool too_many = count > most_entries_ - entries_;
  entries_ += too_many ? 0 : count;
  if (too_many) builder_.fail(lines_.at(), "the sets of the file are too many and too large to be meant");
}

void AbaqusReader::add_listed(AbaqusSet& target, std::int64_t number, bool node) {
  count_entries(1);
  target.numbers.push_back(number);
  listed_.push_back({number, lines_.at(), node});
}

void AbaqusReader::add_numbers(AbaqusSet& target, const std::vector<std::int64_t>& numbers) {
  count_entries(static_cast<std::int64_t>(numbers.size()));
  const std::vector<std::int64_t> copy = numbers;  // a set may name itself
  target.numbers.insert(target.numbers.end(), copy.begin(), copy.end());
}

void AbaqusReader::generate(AbaqusSet& target, int instance) {
  std::vector<std::string_view> fields;
  while (next_data(fields)) {
    const std::int64_t first = integer(fields[0], "the first number of GENERATE");
    const std::int64_t last = fields.size() > 1 ? integer(fields[1], "the last number of GENERATE") : first;
    const std::int64_t step = fields.size() > 2 ? integer(fields[2], "the increment of GENERATE") : 1;
    if (first < 0 || last < first || step < 1) {
      builder_.fail(lines_.at(),
                    "GENERATE needs a first number, a last one that is not smaller, and a positive "
                    "increment");
    }
    count_entries((last - first) / step + 1);
    for (std::int64_t number = first; number <= last; number += step) {
      target.numbers.push_back(own(number, instance));
      if (last - number < step) break;
    }
  }
}

/// Whose numbers a set lists: those of the instance around it, or the one it names.
int AbaqusReader::instance_named(const AbaqusKeyword& key) const {
  if (!key.has("INSTANCE")) return instance_;
  const int instance = instances_.find(key.value("INSTANCE"));
  if (instance == AbaqusInstances::none)
    builder_.fail(key.at, fmt::format("there is no instance '{}' before this line; correct its name",
                                      printable(key.value("INSTANCE"))));
  return instance;
}

void AbaqusReader::nodes_of_elements(const AbaqusKeyword& key, AbaqusSet& target, int instance) {
  const AbaqusSet* of = set_in(element_sets_, key.value("ELSET"), instance);
  if (of == nullptr)
    builder_.fail(key.at, fmt::format("there is no element set '{}' before this line", printable(key.value("ELSET"))));
  const NumberIndex cells(cell_numbers_);
  std::vector<std::int64_t> numbers;
  for (const std::int64_t number : of->numbers) {
    const int cell = cells.find(number);
    if (cell < 0) continue;
    const auto nodes = builder_.cell_nodes(cell);
    numbers.insert(numbers.end(), nodes.begin(), nodes.end());
  }
  add_numbers(target, numbers);
}

void AbaqusReader::set(const AbaqusKeyword& key, AbaqusSets& sets, const char* parameter) {
  if (key.value(parameter).empty())
    builder_.fail(key.at, fmt::format("*{} has no name; write *{}, {}=name", parameter, parameter, parameter));
  const int instance = instance_named(key);
  const std::string name = full_name(key.value(parameter));
  if (key.has("INPUT")) lines_.insert(key);
  sets.named(name);
  if (key.has("GENERATE")) return generate(sets.named(name), instance);
  if (key.has("ELSET") && parameter == std::string("NSET")) return nodes_of_elements(key, sets.named(name), instance);
  std::vector<std::string_view> fields;
  while (next_data(fields)) {
    for (const std::string_view field : fields) {
      if (field.empty()) continue;
      const std::string entry = without_quotes(field);
      AbaqusSet& target = sets.named(name);
      if (const auto number = number_in(entry, instance)) {
        add_listed(target, *number, &sets == &node_sets_);
      } else if (const AbaqusSet* other = set_in(sets, entry, instance)) {
        add_numbers(target, other->numbers);
      } else {
        builder_.fail(lines_.at(),
                      fmt::format("'{}' is neither a number nor the name of a set before this line", printable(field)));
      }
    }
  }
}

void AbaqusReader::surface(const AbaqusKeyword& key) {
  if (key.value("NAME").empty()) builder_.fail(key.at, "*SURFACE has no name; write *SURFACE, NAME=name");
  const std::string name = full_name(key.value("NAME")), type = upper(key.value("TYPE"));
  std::vector<std::string_view> fields;
  if (type == "NODE") {
    node_sets_.named(name);
    while (next_data(fields)) {
      const std::string entry = without_quotes(fields[0]);
      AbaqusSet& target = node_sets_.named(name);
      if (const auto number = number_in(entry, instance_)) {
        add_listed(target, *number, true);
      } else if (const AbaqusSet* other = set_in(node_sets_, entry, instance_)) {
        add_numbers(target, other->numbers);
      } else {
        builder_.fail(lines_.at(), fmt::format("surface '{}': there is no node set '{}' before this line",
                                               printable(name), printable(fields[0])));
      }
    }
    return;
  }
  if (!type.empty() && type != "ELEMENT") return;  // cutting, user and revolved surfaces have no sides of cells
  for (const auto& surface : surfaces_)
    if (upper(surface.name) == upper(name))
      builder_.fail(key.at, fmt::format("there is another *SURFACE '{}' before this one; give each a name of its own",
                                        printable(key.value("NAME"))));
  surfaces_.push_back({name, fmt::format("surface '{}'", printable(name)), {}});
  while (next_data(fields))
    surfaces_.back().entries.push_back(
        {without_quotes(fields[0]), fields.size() > 1 ? upper(fields[1]) : std::string(), instance_, lines_.at()});
}

}  // namespace scabo::files
