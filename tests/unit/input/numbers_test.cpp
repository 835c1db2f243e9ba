// Strict numbers.
#include "scabo/input/numbers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scabo::input {
namespace {

using testing::HasSubstr;

TEST(Numbers, AreReadInEveryDecimalForm) {
  const std::vector<std::pair<const char*, double>> numbers{
      {"3", 3.0},     {"-3", -3.0},     {"+1", 1.0},   {".5", 0.5},       {"5.", 5.0},
      {"10e9", 1e10}, {"1e-3", 1e-3},   {"1E+3", 1e3}, {"-.25e2", -25.0}, {"007", 7.0},
      {"0", 0.0},     {"1e100", 1e100}, {"0.1", 0.1},  {"0e999", 0.0},    {"1e-100", 1e-100}};
  for (const auto& [text, value] : numbers) {
    const auto number = parse_number(text);
    ASSERT_TRUE(std::holds_alternative<double>(number)) << text << ": " << std::get<std::string>(number);
    EXPECT_EQ(std::get<double>(number), value) << text;
  }
}

TEST(Numbers, WhatIsNoneIsToldWithItsRemedy) {
  const std::vector<std::pair<const char*, const char*>> texts{{"", "must be a number"},
                                                               {"abc", "must be a number, not 'abc'"},
                                                               {".nan", "finite"},
                                                               {"-.inf", "finite"},
                                                               {"nan", "finite"},
                                                               {"Infinity", "finite"},
                                                               {"1e999", "larger in size than 1e100"},
                                                               {"-1e101", "larger in size than 1e100"},
                                                               {"1e-999", "smaller in size than 1e-100"},
                                                               {"1e-101", "smaller in size than 1e-100"},
                                                               {"1,5", "write 1.5"},
                                                               {"10 GPa", "leave out the unit"},
                                                               {"10e9 Pa", "leave out the unit"},
                                                               {"10mm", "leave out the unit"},
                                                               {"5%", "leave out the unit"},
                                                               {"20 °C", "leave out the unit"},
                                                               {"0x10", "in decimal"},
                                                               {"0b1", "in decimal"},
                                                               {"1_000", "without '_'"},
                                                               {"2*3", "write its value"},
                                                               {"1/3", "write its value"},
                                                               {"1e", "leave out the unit"},
                                                               {"--1", "must be a number"},
                                                               {"1.2.3", "must be a number"},
                                                               {"1 2", "must be a number"},
                                                               {"e5", "must be a number"},
                                                               {".", "must be a number"},
                                                               {"+", "must be a number"},
                                                               {"1,", "must be a number"},
                                                               {"1e-9,", "must be a number"},
                                                               {"10 ", "must be a number"},
                                                               {"1,2,3", "must be a number"}};
  for (const auto& [text, reason] : texts) {
    const auto number = parse_number(text);
    ASSERT_TRUE(std::holds_alternative<std::string>(number)) << text;
    EXPECT_THAT(std::get<std::string>(number), HasSubstr(reason)) << text;
  }
}

TEST(Numbers, LongTextsAreNotRepeatedInMessages) {
  const auto number = parse_number(std::string(100'000, 'x'));
  EXPECT_LT(std::get<std::string>(number).size(), 200u);
  EXPECT_LT(std::get<std::string>(parse_number(std::string(100'000, '9'))).size(), 200u);
}

}  // namespace
}  // namespace scabo::input
