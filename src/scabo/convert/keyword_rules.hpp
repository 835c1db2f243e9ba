// What each keyword that becomes part of a model may say: its parameters, those without effect on results, and whether
// it needs data lines. docs/convert.md lists the same; a parameter that stands nowhere is an essential remark.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scabo/convert/remark.hpp"
#include "scabo/files/abaqus.hpp"

namespace scabo::convert {

enum class ParameterUse {
  taken,     ///< becomes part of the model
  harmless,  ///< the results are the same without it
  refused,
};

struct ParameterRule {
  std::string name;
  ParameterUse use = ParameterUse::taken;
  std::vector<std::string> values = {};  ///< that are taken, compared without blanks; any if there are none
  std::string why = "";                  ///< it is refused: the rest of a sentence that begins with the keyword
};

enum class DataLines {
  optional,
  needed,
  needed_unless_new,   ///< OP=NEW alone takes back what was given before
  needed_unless_elset  ///< ELSET names the elements whose nodes are meant
};

struct KeywordRule {
  DataLines data = DataLines::optional;
  std::size_t most_entries = 0;  ///< on a line; 0: any number
  std::size_t most_lines = 0;    ///< 0: any number
  std::vector<ParameterRule> parameters;
  bool any_parameter = false;  ///< none has an effect on results, but for those that are refused
};

/// By keyword, in upper case and without blanks.
const std::map<std::string, KeywordRule>& keyword_rules();
/// Null for a keyword that is not part of a model.
const KeywordRule* rule_of(const std::string& name);

/// An essential remark for each parameter, missing data and entry that is not taken.
void check_block(const files::DeckBlock& block, Remarks& remarks);

}  // namespace scabo::convert
