// The tree of a YAML text: places, repeated keys, aliases, limits.
#include "scabo/input/yaml_document.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scabo/input/text_file.hpp"
#include "unit/input/models.hpp"

namespace scabo::input {
namespace {

using namespace testing_models;
using testing::HasSubstr;
using testing::IsEmpty;

NodePtr tree_of(std::string_view text, const YamlLimits& limits = {}) {
  std::vector<Diagnostic> mistakes;
  const NodePtr tree = parse_yaml(text, mistakes, limits);
  for (const Diagnostic& mistake : mistakes) ADD_FAILURE() << format_diagnostic("text", mistake);
  return tree;
}

std::string mistake_in(std::string_view text, const YamlLimits& limits = {}) {
  std::vector<Diagnostic> mistakes;
  parse_yaml(text, mistakes, limits);
  return mistakes.empty() ? "" : format_diagnostic("text", mistakes.front());
}

TEST(YamlDocument, PlacesAreLinesAndColumnsOfCharacters) {
  const NodePtr tree = tree_of("a: 1\n# comment\nb: {c: \"x\", größe: [ü, 2]}\n");
  const MapEntry* b = tree->find("b");
  ASSERT_NE(b, nullptr);
  EXPECT_EQ(b->line, 3);
  EXPECT_EQ(b->column, 1);
  const MapEntry* size = b->value->find("größe");
  ASSERT_NE(size, nullptr);
  EXPECT_EQ(size->column, 13);
  EXPECT_EQ(size->value->column, 20);
  EXPECT_EQ(size->value->items[1]->column, 24);
}

TEST(YamlDocument, KnowsWhatIsQuoted) {
  const NodePtr tree = tree_of("a: 1\nb: '1'\nc: \"1\"\nd: |\n  1\n");
  EXPECT_FALSE(tree->find("a")->value->quoted);
  for (const char* key : {"b", "c", "d"}) EXPECT_TRUE(tree->find(key)->value->quoted) << key;
}

TEST(YamlDocument, LineEndsAndByteOrderMarkChangeNothing) {
  for (const char* text : {"a: 1\nb: 2\n", "a: 1\r\nb: 2\r\n", "a: 1\rb: 2\r",
                           "\xef\xbb\xbf"
                           "a: 1\nb: 2"}) {
    const NodePtr tree = tree_of(text);
    ASSERT_EQ(tree->entries.size(), 2u);
    EXPECT_EQ(tree->find("b")->line, 2);
    EXPECT_EQ(tree->find("b")->value->text, "2");
    EXPECT_EQ(tree->find("a")->column, 1);
  }
}

TEST(YamlDocument, NothingIsAnEmptyTree) {
  for (const char* text : {"", "\n\n", "# comment\n", "---\n", "~"}) {
    EXPECT_EQ(tree_of(text)->kind, Node::Kind::null) << text;
  }
}

TEST(YamlDocument, RepeatedKeysAreReportedWithTheirPath) {
  EXPECT_EQ(mistake_in("a:\n  b:\n    - {c: 1, c: 2}\n"),
            "text:3:14: a.b.0.c: is given twice (first in line 3): remove one");
  EXPECT_EQ(mistake_in("a: 1\n'a': 2\n"), "text:2:1: a: is given twice (first in line 1): remove one");
}

// Found by the fuzzer: the path to a repeated key led through a map that had no entry yet.
TEST(YamlDocument, RepeatedKeysInsideKeysAndMerges) {
  EXPECT_THAT(mistake_in("? {a: 1, a: 2}\n: 3\n"), HasSubstr("is given twice"));
  EXPECT_THAT(mistake_in("<<: {a: 1, a: 2}\n"), HasSubstr("is given twice"));
  EXPECT_THAT(mistake_in("{: {a: 1, a: 2}}"), HasSubstr("is given twice"));
}

TEST(YamlDocument, AliasesAndMerges) {
  const NodePtr tree = tree_of("a: &a {x: 1, y: 2}\nb: *a\nc: {<<: *a, y: 3}\nd: {<<: [*a, {z: 4}]}\n");
  EXPECT_EQ(tree->find("b")->value, tree->find("a")->value);
  EXPECT_EQ(tree->find("c")->value->find("x")->value->text, "1");
  EXPECT_EQ(tree->find("c")->value->find("y")->value->text, "3");
  EXPECT_EQ(tree->find("d")->value->find("z")->value->text, "4");
}

TEST(YamlDocument, AliasesGrowToALimit) {
  const std::string text = "a: &a [1, 2, 3]\nb: &b [*a, *a, *a]\nc: [*b, *b, *b]\n";
  EXPECT_THAT(mistake_in(text), IsEmpty());
  EXPECT_EQ(tree_of(text)->find("c")->value->expanded, 1 + 3 * (1 + 3 * 4));
  YamlLimits limits;
  limits.nodes = 30;
  EXPECT_THAT(mistake_in(text, limits), HasSubstr("more than 30 values"));
}

TEST(YamlDocument, DepthHasALimitAlsoThroughAliases) {
  YamlLimits limits;
  limits.depth = 4;
  EXPECT_THAT(mistake_in("[[[[1]]]]", limits), HasSubstr("nested deeper than 4"));
  EXPECT_THAT(mistake_in("[&a [[1]], [[*a]]]", limits), HasSubstr("nested deeper than 4"));
  EXPECT_THAT(mistake_in(std::string(100'000, '[')), HasSubstr("nested deeper than 50"));
  EXPECT_THAT(mistake_in(std::string(1'000, '-') + " "), testing::Not(HasSubstr("nested")));
}

TEST(YamlDocument, BrokenTextEndsInOneMessage) {
  for (const char* text : {"a: [1, 2", "a: {b: 1", "a: \"b", "a: 'b", "a: b: c", "a:\n  b: 1\n c: 2\n", "}", "a: *b",
                           "a: &a [*a]", "a: 1\n---\nb: 2\n", "- 1\nb\n", "a: @b", "!!int 3", "%YAML 9.9\n---\na: 1\n",
                           "a: \"\\q\"", "\x01", "a: \xff", "a: \xc3", "a\tb:\n\t- c\n\td: 1\n"}) {
    EXPECT_THAT(mistake_in(text), HasSubstr("text:")) << text;
  }
}

TEST(YamlDocument, JsonWithTabsIsYaml) {
  const NodePtr tree = tree_of("{\n\t\"a\": 1,\n\t\"b\": [1,\n\t\t2], \"c\": \"\\u00e9\\/\"\n}\n");
  EXPECT_EQ(tree->find("b")->value->items.size(), 2u);
  EXPECT_EQ(tree->find("c")->value->text, "é/");
}

TEST(TextFile, WhatCannotBeReadIsOneMessage) {
  const auto folder = std::filesystem::temp_directory_path();
  const auto missing = (folder / "scabo_no_such_model.yaml").string();
  EXPECT_THROW(
      {
        try {
          read_text_file(missing);
        } catch (const InputError& error) {
          EXPECT_EQ(error.what(), missing + ": no such file");
          throw;
        }
      },
      InputError);
  EXPECT_THROW(read_text_file(folder.string()), InputError);
  EXPECT_THROW(read_text_file(""), InputError);
  const auto large = (folder / "scabo_large_model_test.yaml").string();
  std::ofstream(large) << std::string(2000, ' ');
  YamlLimits limits;
  limits.bytes = 1000;
  EXPECT_THROW(read_text_file(large, limits), InputError);
  EXPECT_EQ(read_text_file(large).size(), 2000u);
  std::filesystem::remove(large);
}

}  // namespace
}  // namespace scabo::input
