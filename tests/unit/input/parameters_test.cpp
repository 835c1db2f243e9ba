// Formulas and parameters of a model file.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scabo/input/formula.hpp"
#include "unit/input/models.hpp"

namespace scabo::input {
namespace {

using namespace testing_models;
using testing::HasSubstr;

double value(const std::string& formula, const ParameterValues& values = {}) {
  const auto result = value_of_formula(formula, values);
  if (const auto* why = std::get_if<std::string>(&result)) {
    ADD_FAILURE() << formula << ": " << *why;
    return std::nan("");
  }
  return std::get<double>(result);
}

std::string why_not(const std::string& formula, const ParameterValues& values = {}) {
  const auto result = value_of_formula(formula, values);
  return std::holds_alternative<std::string>(result) ? std::get<std::string>(result) : "";
}

TEST(Formula, HasTheValuesOfArithmetic) {
  EXPECT_EQ(value("1 + 2 * 3"), 7.0);
  EXPECT_EQ(value("(1 + 2) * 3"), 9.0);
  EXPECT_EQ(value("7 - 2 - 1"), 4.0);
  EXPECT_EQ(value("8 / 4 / 2"), 1.0);
  EXPECT_EQ(value("-2^2"), -4.0);
  EXPECT_EQ(value("2^-1"), 0.5);
  EXPECT_EQ(value("2^3^2"), 512.0);
  EXPECT_EQ(value("2 * -3"), -6.0);
  EXPECT_EQ(value("1e3 + .5"), 1000.5);
  EXPECT_EQ(value("2e-3*1E3"), 2.0);
  EXPECT_EQ(value("0.1"), 0.1);
  EXPECT_EQ(value("max(2, min(5, 3))"), 3.0);
  EXPECT_EQ(value("round(0.1 * 3 * 10)"), 3.0);
  EXPECT_EQ(value("sqrt(16) + abs(-1) + floor(2.5) + ceil(2.5)"), 10.0);
  EXPECT_EQ(value("cos(pi)"), -1.0);
  EXPECT_EQ(value("atan2(1, -1)"), 0.75 * std::numbers::pi);
  EXPECT_NEAR(value("ln(exp(2)) + log10(1000)"), 5.0, 1e-15);
  EXPECT_EQ(value("b * e1 - b_2", {{"b", 3.0}, {"e1", 2.0}, {"b_2", 1.0}}), 5.0);
}

TEST(Formula, EveryOperationMustBeFinite) {
  EXPECT_EQ(why_not("1 / 0"), "divides by zero");
  EXPECT_EQ(why_not("1 / (1 / 0)"), "divides by zero");  // would be 0
  EXPECT_EQ(why_not("0 * (1 / 0)"), "divides by zero");
  EXPECT_EQ(why_not("0^-1"), "divides by zero");
  EXPECT_THAT(why_not("1 / exp(1000)"), HasSubstr("too large"));
  EXPECT_THAT(why_not("9^9^9^9"), HasSubstr("too large"));
  EXPECT_THAT(why_not("sqrt(-1)"), HasSubstr("square root of -1"));
  EXPECT_THAT(why_not("(-1)^0.5"), HasSubstr("no real value"));
  EXPECT_THAT(why_not("ln(0)"), HasSubstr("logarithm of 0"));
  EXPECT_THAT(why_not("asin(2)"), HasSubstr("outside its range"));
  EXPECT_THAT(why_not("1e99 * 1e99"), HasSubstr("larger in size than 1e100"));
}

TEST(Formula, IsNothingButAFormula) {
  for (const char* text :
       {"",       " ",         "1 +",    "* 2",    "(1",    "1)",    "1 2",       "1, 2",  "min(1)",
        "sin()",  "sin(1, 2)", "sqrt",   "foo(1)", "a = 1", "1 < 2", "1 ? 2 : 3", "\"a\"", "1; 2",
        "2 ** 3", "1.2.3",     "1 && 2", "#",      "()",    "1 2 +", "0x10",      "1e",    "\xc3\xa4"})
    EXPECT_NE(why_not(text, {{"a", 1.0}, {"x10", 1.0}, {"e", 1.0}}), "") << text;
}

TEST(Formula, IsBoundedInLengthAndDepth) {
  EXPECT_THAT(why_not(std::string(longest_formula + 1, '1')), HasSubstr("longer than"));
  const std::size_t deep = longest_formula / 2 - 1;
  EXPECT_EQ(value(std::string(deep, '(') + "1" + std::string(deep, ')')), 1.0);
  EXPECT_NE(why_not(std::string(longest_formula - 1, '-') + "1"), "");  // two signs do not follow each other
  EXPECT_NE(why_not(std::string(longest_formula, '(')), "");
}

TEST(Parameters, StandWhereNumbersStand) {
  const Model model =
      parse(block("parameters: {b: 2.0, h: \"${b} * 3\", k: \"${h + b}\"}\n"
                  "title: Block of ${b} m and ${h / 4}\n"
                  "steps: [{increments: \"${k}\"}]\n"),
            {{"loads.push.force", "[\"${b}\", \"-${h}^2 + 1\"]"}, {"materials.steel.young", "${b * 1e9}"}});
  EXPECT_EQ(model.title, "Block of 2 m and 1.5");
  EXPECT_EQ(model.steps[0].increments, 8);
  EXPECT_EQ(model.materials[0].young, 2e9);
  EXPECT_EQ(std::get<Force>(model.loads[0].kind).value, Vec2(2.0, -35.0));
}

TEST(Parameters, OfTheCommandLineChangeAllThatDependsOnThem) {
  const std::string text = block("parameters: {b: 2.0, h: \"${b * 3}\"}\nanalysis: {thickness: \"${h}\"}\n");
  EXPECT_EQ(parse(text).analysis.thickness, 6.0);
  EXPECT_EQ(parse(text, {{"parameters.b", "3"}}).analysis.thickness, 9.0);
  EXPECT_EQ(parse(text, {{"parameters.h", "4"}, {"loads.push.force", "[\"${b}\", 0]"}}).analysis.thickness, 4.0);
  EXPECT_THAT(mistakes_in(text, {{"parameters.hh", "3"}}),
              HasSubstr("--set parameters.hh: the model has and uses no parameter 'hh' (did you mean 'h'?)"));
  EXPECT_THAT(mistakes_in(text, {{"parameters.b", "two"}}), HasSubstr("--set parameters.b: must be a number"));
}

TEST(Parameters, OneMistakeLeadsToOneMessage) {
  const std::string of_broken =
      mistakes_in(block("parameters: {b: \"${1 / 0}\", h: \"${b * 3}\"}\nanalysis: {thickness: \"${h + b}\"}\n"));
  EXPECT_EQ(of_broken, "model.yaml:7:17: parameters.b: the formula '1 / 0' divides by zero");
  const std::string unknown = mistakes_in(
      block("parameters: {b: 1}\nanalysis: {thickness: \"${c + b}\"}\nsolver: {iterations: \"${b / 2}\"}\n"));
  EXPECT_THAT(unknown, HasSubstr("model.yaml:8:23: analysis.thickness: the formula 'c + b' needs a parameter 'c'"));
  EXPECT_THAT(unknown, HasSubstr("must be a whole number from 1 to 10000, not 0.5 (from '${b / 2}')"));
}

TEST(Parameters, UnusedOnesAreToldOf) {
  const Model model = parse(block("parameters: {b: 2.0, c: 1}\nanalysis: {thickness: \"${b}\"}\n"));
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_EQ(model.warnings[0].text, "parameter 'c' has no effect: nothing uses it");
}

TEST(Parameters, CyclesAreReportedOnce) {
  const std::string text = mistakes_in(
      block("parameters: {a: \"${b}\", b: \"${a}\", c: \"${a}\", d: \"${d}\"}\nanalysis: {thickness: \"${c + d}\"}\n"));
  EXPECT_THAT(text, HasSubstr("parameters.a: depends on itself (a -> b -> a)"));
  EXPECT_THAT(text, HasSubstr("parameters.d: depends on itself (d -> d)"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
}

TEST(Parameters, GrowNeitherInTimeNorInMemory) {
  // Each is twice the one before, by two uses: textual replacement would need 2^200 characters.
  std::string text = "parameters: {p0: 1e-30";
  for (int i = 1; i < 200; ++i) text += fmt::format(", p{0}: \"${{p{1} + p{1}}}\"", i, i - 1);
  const Model model = parse(block(text + "}\nanalysis: {thickness: \"${p199}\"}\n"));
  EXPECT_DOUBLE_EQ(model.analysis.thickness, 1e-30 * std::pow(2.0, 199));
  // A chain as long as allowed, given backwards.
  text = "parameters: {q999: 1";
  for (int i = 998; i >= 0; --i) text += fmt::format(", q{}: \"${{q{} + 1}}\"", i, i + 1);
  EXPECT_EQ(parse(block(text + "}\nanalysis: {thickness: \"${q0}\"}\n")).analysis.thickness, 1000.0);
  EXPECT_THAT(mistakes_in(block(text + ", one_more: 1}\n")), HasSubstr("has 1001 parameters, more than 1000"));
}

TEST(Parameters, SurviveYaml11AndJson) {
  const Model model = parse(
      R"({"scabo": 1, "parameters": {"b": 2, "n": "${b}"}, "materials": {"m": {"young": "${1e9 * n}", "poisson": 0}},
          "bodies": {"a": {"material": "m", "shape": {"rectangle": {"corner": [0, 0], "size": ["${b}", 1]}},
          "mesh": {"size": 1}}}, "supports": [{"on": "a.left", "fix": "x"}, {"on": "a.bottom", "fix": "y"}],
          "loads": {"p": {"on": "a.top", "pressure": "${b}"}}})");
  EXPECT_EQ(model.materials[0].young, 2e9);
  EXPECT_THAT(mistakes_in(block("parameters: {yes: 1}\n")), HasSubstr("'yes' is not a valid name of a parameter"));
}

}  // namespace
}  // namespace scabo::input
