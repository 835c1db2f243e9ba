// Keywords of Abaqus and CalculiX that have no counterpart in a model of Scabo, and what is lost without each.
#pragma once

#include <string>

namespace scabo::convert {

enum class KeywordLoss {
  none,       ///< only structures the file
  note,       ///< the model is the same without it
  essential,  ///< the model would be another one
};

struct KeywordText {
  KeywordLoss loss = KeywordLoss::essential;
  std::string text;  ///< ends the sentence that begins with the keyword
};

/// `name`: upper case, without spaces.
KeywordText text_of_keyword(const std::string& name);

/// Whether the keyword belongs to the *MATERIAL before it, although it is not taken.
bool is_of_material(const std::string& name);

}  // namespace scabo::convert
