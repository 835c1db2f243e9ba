#include "scabo/files/abaqus_sets.hpp"

#include <utility>

#include "scabo/files/abaqus_lines.hpp"

namespace scabo::files {

AbaqusSet& AbaqusSets::named(const std::string& name) {
  const auto [entry, is_new] = by_name_.try_emplace(upper(name), all_.size());
  if (is_new) all_.push_back({name, {}, false});
  return all_[entry->second];
}

const AbaqusSet* AbaqusSets::find(const std::string& name) const {
  const auto found = by_name_.find(upper(name));
  return found == by_name_.end() ? nullptr : &all_[found->second];
}

}  // namespace scabo::files
