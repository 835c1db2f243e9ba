// Contacts and ties of a deck, and the laws between surfaces.
#pragma once

#include <string>

#include "scabo/convert/deck_content.hpp"

namespace scabo::convert {

class ContactReader {
 public:
  ContactReader(DeckContent& content, Remarks& remarks) : content_(content), remarks_(remarks) {}

  /// Takes a block if it is about contact; false if it is not.
  bool read(const files::DeckBlock& block, bool in_step);

 private:
  void friction(const files::DeckBlock& block);
  void surface_behavior(const files::DeckBlock& block);
  void pairs(const files::DeckBlock& block, bool in_step);

  DeckContent& content_;
  Remarks& remarks_;
  std::string interaction_;  ///< the last one, in upper case
};

}  // namespace scabo::convert
