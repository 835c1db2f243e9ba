// What the tests of tests/verification compare, kept for the verification manual (docs/site/verification_manual.py).
//
// EXPECT_NEAR, EXPECT_LT and EXPECT_LE are those of googletest. Where the environment names a directory,
// SCABO_RECORDED_CHECKS, each comparison of numbers is noted as well, and when the program ends, the worst one of every
// line of every test is written to a file there; without that variable nothing is kept.
// tests/verification/CMakeLists.txt includes this header before every source of that folder, so that a new test is in
// the manual without a word in it.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <type_traits>
#include <vector>

namespace scabo::test {

/// |value - reference| <= bound; the texts are the expressions in the test.
void record_difference(const char* value_text, const char* reference_text, double value, double reference,
                       double bound);

/// value < bound or value <= bound, of floating-point numbers: usually an error that the test computes itself.
void record_below(const char* value_text, double value, double bound);

/// A model that the test runs, as text, and the settings `path=value` with which it does; the first few of every test.
void record_model(const std::string& text, const std::vector<std::string>& settings);

inline testing::AssertionResult near(const char* value_text, const char* reference_text, const char* bound_text,
                                     double value, double reference, double bound) {
  record_difference(value_text, reference_text, value, reference, bound);
  return testing::internal::DoubleNearPredFormat(value_text, reference_text, bound_text, value, reference, bound);
}

template <class A, class B>
void record_if_real(const char* value_text, const A& value, const B& bound) {
  if constexpr (std::is_floating_point_v<A> && std::is_arithmetic_v<B>)
    record_below(value_text, static_cast<double>(value), static_cast<double>(bound));
}

template <class A, class B>
testing::AssertionResult less(const char* value_text, const char* bound_text, const A& value, const B& bound) {
  record_if_real(value_text, value, bound);
  return testing::internal::CmpHelperLT(value_text, bound_text, value, bound);
}

template <class A, class B>
testing::AssertionResult less_or_equal(const char* value_text, const char* bound_text, const A& value, const B& bound) {
  record_if_real(value_text, value, bound);
  return testing::internal::CmpHelperLE(value_text, bound_text, value, bound);
}

}  // namespace scabo::test

#undef EXPECT_NEAR
#undef EXPECT_LT
#undef EXPECT_LE
#define EXPECT_NEAR(value, reference, bound) EXPECT_PRED_FORMAT3(::scabo::test::near, value, reference, bound)
#define EXPECT_LT(value, bound) EXPECT_PRED_FORMAT2(::scabo::test::less, value, bound)
#define EXPECT_LE(value, bound) EXPECT_PRED_FORMAT2(::scabo::test::less_or_equal, value, bound)
