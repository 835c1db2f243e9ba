#include "scabo/convert/deck_equations.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "scabo/convert/deck_fields.hpp"
#include "scabo/files/abaqus_lines.hpp"
#include "scabo/files/text_cursor.hpp"

namespace scabo::convert {

namespace {

using files::DeckBlock;
using files::DeckLine;
using files::printable;

/// The term whose first entry is this one of a line; nothing, with a remark.
std::optional<DeckTerm> term_of(const DeckLine& line, std::size_t field, Remarks& remarks) {
  DeckTerm term;
  if (!files::parse_number(std::string_view(line.fields[field]), term.number)) {
    remarks.essential(line.at, fmt::format("'{}' of *EQUATION is not the number of a node; write an equation for each "
                                           "node of a set",
                                           printable(line.fields[field])));
    return std::nullopt;
  }
  const auto freedom = number(remarks, line, field + 1, "the degree of freedom"),
             factor = number(remarks, line, field + 2, "the coefficient");
  if (!freedom || !factor) return std::nullopt;
  if (*freedom != 1.0 && *freedom != 2.0 && *freedom != 3.0) {
    remarks.essential(
        line.at, fmt::format("degree of freedom {:g} of *EQUATION is not a displacement 1 to 3 of a solid", *freedom));
    return std::nullopt;
  }
  term.component = static_cast<int>(*freedom) - 1;
  term.factor = *factor;
  return term;
}

}  // namespace

std::optional<std::vector<DeckEquation>> equations_of(const DeckBlock& block, Remarks& remarks) {
  std::vector<DeckEquation> equations;
  std::size_t wanted = 0;  // terms that the last equation still needs
  for (const DeckLine& line : block.lines) {
    if (wanted == 0) {
      const auto count = number(remarks, line, 0, "the number of terms of *EQUATION");
      if (!count) return std::nullopt;
      if (!(*count >= 1.0 && *count <= 1e6 && *count == std::floor(*count))) {
        remarks.essential(line.at, fmt::format("{:g} is no number of terms of *EQUATION; correct it", *count));
        return std::nullopt;
      }
      wanted = static_cast<std::size_t>(*count);
      equations.push_back({{}, line.at});
      continue;
    }
    for (std::size_t field = 0; field < line.fields.size(); field += 3) {
      if (field + 1 == line.fields.size() && line.fields[field].empty()) break;  // a comma at the end
      if (wanted == 0) {
        remarks.essential(line.at, "there are more terms on this line than the *EQUATION says; correct the number");
        return std::nullopt;
      }
      const auto term = term_of(line, field, remarks);
      if (!term) return std::nullopt;
      if (term->factor != 0.0) equations.back().terms.push_back(*term);
      --wanted;
    }
  }
  if (wanted == 0) return equations;
  remarks.essential(block.at, "the last *EQUATION has fewer terms than it says; add them, or correct the number");
  return std::nullopt;
}

}  // namespace scabo::convert
