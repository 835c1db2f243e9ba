#include "scabo/result/contact_table.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <iterator>

namespace scabo::result {

const std::string_view contact_table_header =
    "step,increment,contact,pair,x,y,gap,slip,normal_force,tangential_force,pressure,shear,state,"
    "normal_displacement_a,tangential_displacement_a,normal_displacement_b,tangential_displacement_b\n";

std::string contact_table_header_of(const model::Analysis& analysis) {
  std::string header(contact_table_header);
  if (analysis.revolved()) header.insert(header.size() - 1, radians_column);
  return header;
}

std::string radians_field(const model::Analysis& analysis) {
  return analysis.revolved() ? fmt::format(",{}", analysis.angle()) : std::string();
}

std::string csv_quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char letter : text) {
    if (letter == '"') result += '"';
    result += letter;
  }
  return result + '"';
}

std::string_view name_of(contact::ContactState state) {
  switch (state) {
    case contact::ContactState::open:
      return "open";
    case contact::ContactState::stick:
      return "stick";
    case contact::ContactState::slip:
      return "slip";
  }
  throw BrokenInvariant("a contact state without a name");
}

std::string contact_table_rows(const analysis::IncrementResult& increment, const model::Analysis& analysis) {
  const std::string radians = radians_field(analysis);
  fmt::memory_buffer rows;
  for (const analysis::ContactResult& contact : increment.contacts) {
    const std::string name = csv_quoted(contact.name);
    for (const analysis::PairResult& pair : contact.pairs)
      fmt::format_to(std::back_inserter(rows), FMT_COMPILE("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}{}\n"),
                     increment.step, increment.increment, name, pair.pair, pair.position.x(), pair.position.y(),
                     pair.gap, pair.slip, pair.normal_force, pair.tangential_force, pair.pressure, pair.shear,
                     name_of(pair.state), pair.displacement_a.x(), pair.displacement_a.y(), pair.displacement_b.x(),
                     pair.displacement_b.y(), radians);
  }
  return fmt::to_string(rows);
}

}  // namespace scabo::result
