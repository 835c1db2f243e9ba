// Contacts and ties of a deck, and the laws between surfaces.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scabo/convert/deck_content.hpp"

namespace scabo::convert {

/// Contacts whose *SURFACE INTERACTION is not there.
void tell_unknown_interactions(const DeckContent& content, Remarks& remarks);

class ContactReader {
 public:
  /// `nodes`: of the node set of a name, nothing if there is none.
  using Nodes = std::function<std::optional<std::vector<int>>(const std::string& name)>;
  ContactReader(DeckContent& content, Remarks& remarks, Nodes nodes)
      : content_(content), remarks_(remarks), nodes_(std::move(nodes)) {}

  /// Takes a block if it is about contact; false if it is not.
  bool read(const files::DeckBlock& block, bool in_step);
  /// *CLEARANCE of one of the contacts before it.
  void clearance(const files::DeckBlock& block, bool in_step);

 private:
  void friction(const files::DeckBlock& block);
  void surface_behavior(const files::DeckBlock& block);
  std::optional<double> least_slope(const files::DeckBlock& block);
  void pairs(const files::DeckBlock& block, bool in_step);
  void adjust(const files::DeckBlock& block, DeckContact& contact);

  DeckContent& content_;
  Remarks& remarks_;
  Nodes nodes_;
  void change_friction(const files::DeckBlock& block, bool in_step);
  std::string interaction_;     ///< the last one, in upper case
  bool changes_ = false;        ///< its friction is that of the step, by *CHANGE FRICTION
  std::set<std::string> laws_;  ///< keywords of its laws that have been read
};

}  // namespace scabo::convert
