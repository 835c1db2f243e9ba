// contact.csv: one line for every contact pair after every increment (docs/results.md).
#pragma once

#include <string>
#include <string_view>

#include "scabo/analysis/state/solution.hpp"

namespace scabo::result {

/// First line, with the names of the columns, in the plane.
extern const std::string_view contact_table_header;
std::string contact_table_header_of(const model::Analysis& analysis);

/// Last column of tables of bodies of revolution: the angle whose forces are in the table, 2 pi or 1.
inline constexpr std::string_view radians_column = ",forces_of_radians";
/// What stands there in every row; nothing in the plane.
std::string radians_field(const model::Analysis& analysis);

/// A field of a CSV table: in quotation marks, with those inside doubled, if it contains separators.
std::string csv_quoted(const std::string& text);

/// `open`, `stick` or `slip`.
std::string_view name_of(contact::ContactState state);

/// Lines of an increment, with the shortest numbers that read back exactly.
std::string contact_table_rows(const analysis::IncrementResult& increment, const model::Analysis& analysis);

}  // namespace scabo::result
