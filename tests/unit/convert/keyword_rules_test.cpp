// The table of parameters of docs/convert.md has every keyword and every parameter that the converter knows, in its
// column. That each parameter of the table does what it says is tested by regression/convert_parameters_test.py.
#include "scabo/convert/keyword_rules.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <sstream>

namespace scabo::convert {
namespace {

using Row = std::array<std::string, 3>;  // taken, without effect, refused

std::string without_blanks(std::string text) {
  std::erase(text, ' ');
  return text;
}

std::map<std::string, Row> rows_of_page() {
  std::ifstream page(SCABO_CONVERT_PAGE);
  std::map<std::string, Row> rows;
  for (std::string line; std::getline(page, line) && line != "## What is not converted";) {
    if (!line.starts_with("| `*") || std::count(line.begin(), line.end(), '|') != 5) continue;
    std::istringstream cells(line);
    std::string cell, keyword;
    std::getline(cells, cell, '|');
    std::getline(cells, keyword, '|');
    Row row;
    for (std::string& column : row) std::getline(cells, column, '|');
    keyword = without_blanks(keyword);
    rows[keyword.substr(2, keyword.size() - 3)] = row;
  }
  return rows;
}

TEST(KeywordRules, AreThoseOfThePage) {
  const std::map<std::string, Row> rows = rows_of_page();
  for (const auto& [keyword, rule] : keyword_rules()) {
    const auto row = rows.find(keyword);
    ASSERT_NE(row, rows.end()) << keyword;
    for (const ParameterRule& parameter : rule.parameters) {
      const std::string& column = row->second[static_cast<std::size_t>(parameter.use)];
      const bool listed = column.find("`" + parameter.name + "`") != std::string::npos ||
                          column.find("`" + parameter.name + "=") != std::string::npos;
      EXPECT_TRUE(listed) << "*" << keyword << ", " << parameter.name;
      for (const std::string& value : parameter.values)
        EXPECT_TRUE(column.find("`" + parameter.name + "=" + value + "`") != std::string::npos ||
                    column.find("`" + value + "`") != std::string::npos)
            << "*" << keyword << ", " << parameter.name << "=" << value;
    }
  }
  EXPECT_EQ(rows.size(), keyword_rules().size());
}

}  // namespace
}  // namespace scabo::convert
