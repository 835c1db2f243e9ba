// contact.csv: one line for every contact pair after every increment (docs/results.md).
#pragma once

#include <string>
#include <string_view>

#include "scabo/analysis/state/solution.hpp"

namespace scabo::result {

/// First line, with the names of the columns.
extern const std::string_view contact_table_header;

/// A field of a CSV table: in quotation marks, with those inside doubled, if it contains separators.
std::string csv_quoted(const std::string& text);

/// `open`, `stick` or `slip`.
std::string_view name_of(contact::ContactState state);

/// Lines of an increment, with the shortest numbers that read back exactly.
std::string contact_table_rows(const analysis::IncrementResult& increment);

}  // namespace scabo::result
