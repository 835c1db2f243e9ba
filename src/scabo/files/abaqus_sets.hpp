// Sets of nodes or elements, by name, of an input file for Abaqus or CalculiX.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace scabo::files {

struct AbaqusSet {
  std::string name;                   ///< as first written
  std::vector<std::int64_t> numbers;  ///< of nodes or elements
  bool of_element_line = false;       ///< named by *ELEMENT itself
};

/// Names are the same in upper and lower case.
class AbaqusSets {
 public:
  /// In the order in which they were first named.
  const std::vector<AbaqusSet>& all() const { return all_; }

  /// The set `name`, empty if it is new. Valid until the next new one.
  AbaqusSet& named(const std::string& name);

  /// Null if there is none.
  const AbaqusSet* find(const std::string& name) const;

 private:
  std::vector<AbaqusSet> all_;
  std::unordered_map<std::string, std::size_t> by_name_;  // in upper case
};

}  // namespace scabo::files
