#include "scabo/input/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <utility>

#include "scabo/input/suggestions.hpp"

namespace scabo::input {

namespace {

/// An operation without a finite result; thrown through muParser.
struct NoNumber {
  std::string why;
};

double finite(double value, const char* what) {
  if (std::isfinite(value)) return value;
  throw NoNumber{fmt::format("has {} that is too large for a number", what)};
}

double add(double a, double b) { return finite(a + b, "a sum"); }
double subtract(double a, double b) { return finite(a - b, "a difference"); }
double multiply(double a, double b) { return finite(a * b, "a product"); }
double divide(double a, double b) {
  if (b == 0.0) throw NoNumber{"divides by zero"};
  return finite(a / b, "a quotient");
}
double power(double a, double b) {
  if (a == 0.0 && b < 0.0) throw NoNumber{"divides by zero"};
  const double value = std::pow(a, b);
  if (std::isnan(value)) throw NoNumber{fmt::format("has no real value: {}^{}", a, b)};
  return finite(value, "a power");
}

/// A function of one number that is defined everywhere or fails.
template <double (*F)(double)>
double checked(double x) {
  const double value = F(x);
  if (std::isnan(value)) throw NoNumber{fmt::format("calls a function outside its range, at {}", x)};
  return finite(value, "a value of a function");
}
double logarithm(double x) {
  if (x <= 0.0) throw NoNumber{fmt::format("takes the logarithm of {}, which is not positive", x)};
  return std::log(x);
}
double decimal_logarithm(double x) { return logarithm(x), std::log10(x); }
double tangent(double x) { return std::tan(x); }
double sine(double x) { return std::sin(x); }
double cosine(double x) { return std::cos(x); }
double arcsine(double x) { return std::asin(x); }
double arccosine(double x) { return std::acos(x); }
double arctangent(double x) { return std::atan(x); }
double arctangent_of(double y, double x) { return std::atan2(y, x); }
double exponential(double x) { return std::exp(x); }
double root(double x) {
  if (x < 0.0) throw NoNumber{fmt::format("takes the square root of {}", x)};
  return std::sqrt(x);
}
double magnitude(double x) { return std::abs(x); }
double whole(double x) { return std::round(x); }
double below(double x) { return std::floor(x); }
double above(double x) { return std::ceil(x); }
double smallest(double a, double b) { return std::min(a, b); }
double largest(double a, double b) { return std::max(a, b); }
double minus(double x) { return -x; }
double plus(double x) { return x; }

constexpr std::array<std::pair<const char*, double (*)(double)>, 14> functions{{{"sqrt", root},
                                                                                {"abs", magnitude},
                                                                                {"exp", checked<exponential>},
                                                                                {"ln", logarithm},
                                                                                {"log10", decimal_logarithm},
                                                                                {"sin", sine},
                                                                                {"cos", cosine},
                                                                                {"tan", checked<tangent>},
                                                                                {"asin", checked<arcsine>},
                                                                                {"acos", checked<arccosine>},
                                                                                {"atan", arctangent},
                                                                                {"round", whole},
                                                                                {"floor", below},
                                                                                {"ceil", above}}};
constexpr std::array<std::pair<const char*, double (*)(double, double)>, 3> functions_of_two{
    {{"min", smallest}, {"max", largest}, {"atan2", arctangent_of}}};
constexpr const char* circle_constant = "pi";

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit_of_formula(char c) { return c >= '0' && c <= '9'; }

/// A name, a number or a single character of a formula.
struct Token {
  enum class Kind { name, number, sign } kind = Kind::sign;
  std::string_view text;
};

std::vector<Token> tokens_of(std::string_view formula) {
  std::vector<Token> tokens;
  for (std::size_t i = 0; i < formula.size();) {
    std::size_t end = i + 1;
    const char c = formula[i];
    const auto at = [&](std::size_t k) { return k < formula.size() ? formula[k] : '\0'; };
    Token::Kind kind = Token::Kind::sign;
    if (begins_name(c)) {
      kind = Token::Kind::name;
      while (begins_name(at(end)) || is_digit_of_formula(at(end))) ++end;
    } else if (is_digit_of_formula(c) || (c == '.' && is_digit_of_formula(at(i + 1)))) {
      kind = Token::Kind::number;
      while (is_digit_of_formula(at(end)) || at(end) == '.') ++end;
      if (at(end) == 'e' || at(end) == 'E') {
        std::size_t digits = end + 1;
        if (at(digits) == '+' || at(digits) == '-') ++digits;
        if (is_digit_of_formula(at(digits))) {
          end = digits;
          while (is_digit_of_formula(at(end))) ++end;
        }
      }
    }
    if (c != ' ' && c != '\n' && c != '\t') tokens.push_back({kind, formula.substr(i, end - i)});
    i = end;
  }
  return tokens;
}

template <typename Table>
bool has(const Table& table, std::string_view name) {
  return std::any_of(table.begin(), table.end(), [&](const auto& entry) { return entry.first == name; });
}

bool is_function(std::string_view name) { return has(functions, name) || has(functions_of_two, name); }

/// What muParser would not refuse, or refuse with words of its own; empty if there is nothing.
std::string first_mistake(std::string_view formula) {
  if (formula.size() > longest_formula)
    return fmt::format("is longer than {} characters: use a parameter for a part of it", longest_formula);
  const std::vector<Token> tokens = tokens_of(formula);
  if (tokens.empty()) return "is empty: write a number or a parameter";
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const auto [kind, text] = tokens[i];
    const bool called = i + 1 < tokens.size() && tokens[i + 1].text == "(";
    if (kind == Token::Kind::name && called && !is_function(text))
      return fmt::format("has no function {}{}", quoted_name(text), suggestion(text, words_of_formulas()));
    if (kind == Token::Kind::name && !called && is_function(text))
      return fmt::format("needs arguments in parentheses after '{0}', as in {0}(2)", text);
    if (kind == Token::Kind::number && std::count(text.begin(), text.end(), '.') > 1)
      return fmt::format("has no number {}", quoted_name(text));
    if (kind != Token::Kind::sign) continue;
    if (text == "*" && i > 0 && tokens[i - 1].text == "*") return "has no operator '**': write ^ for a power";
    if (std::string_view("+-*/^(),").find(text) == std::string_view::npos)
      return fmt::format("can have numbers, parameters, + - * / ^, parentheses and functions, not {}",
                         static_cast<unsigned char>(text[0]) < 0x80 ? quoted_name(text) : "other characters");
  }
  return {};
}

/// A reason of muParser in the terms of someone who writes a model.
std::string explain_formula(const mu::ParserError& error) {
  switch (error.GetCode()) {
    case mu::ecUNEXPECTED_EOF:
      return "ends too early: a value is missing";
    case mu::ecMISSING_PARENS:
      return "has a parenthesis that is not closed";
    case mu::ecUNEXPECTED_PARENS:
      return "has a parenthesis where none can stand";
    case mu::ecTOO_MANY_PARAMS:
    case mu::ecTOO_FEW_PARAMS:
      return "gives a function another number of arguments than it takes";
    case mu::ecUNEXPECTED_ARG_SEP:
    case mu::ecUNEXPECTED_ARG:
      return "has a ',' outside the arguments of a function: write numbers with a decimal point";
    default:
      return "cannot be read: an operator or a value is missing, or one is too many";
  }
}

}  // namespace

bool is_parameter_name(std::string_view text) {
  if (text.empty() || !begins_name(text[0]) || text.size() > 100) return false;
  if (!std::all_of(text.begin(), text.end(), [](char c) { return begins_name(c) || is_digit_of_formula(c); }))
    return false;
  if (is_function(text) || text == circle_constant) return false;
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const std::vector<std::string> truths = {"true", "false", "yes", "no", "on", "off", "null"};
  return std::find(truths.begin(), truths.end(), lower) == truths.end();
}

std::vector<std::string> names_in_formula(std::string_view formula) {
  std::vector<std::string> names;
  if (formula.size() > longest_formula) return names;
  const std::vector<Token> tokens = tokens_of(formula);
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const auto [kind, text] = tokens[i];
    if (kind != Token::Kind::name || is_function(text) || text == circle_constant) continue;
    if (i + 1 < tokens.size() && tokens[i + 1].text == "(") continue;  // an unknown function
    if (std::find(names.begin(), names.end(), text) == names.end()) names.emplace_back(text);
  }
  return names;
}

std::vector<std::string> words_of_formulas() {
  std::vector<std::string> words;
  for (const auto& [name, function] : functions) words.emplace_back(name);
  for (const auto& [name, function] : functions_of_two) words.emplace_back(name);
  words.emplace_back(circle_constant);
  return words;
}

namespace {

/// Why a formula cannot be read, whatever the values of its names.
struct Unreadable {
  std::string why;
};

/// Throws Unreadable, or NoNumber where it has no value.
double evaluated(const std::string& formula, const ParameterValues& values) {
  if (std::string mistake = first_mistake(formula); !mistake.empty()) throw Unreadable{std::move(mistake)};
  try {
    mu::Parser parser;
    // Operators of our own, which fail instead of going on with an infinite number; no assignment, no comparison.
    parser.EnableBuiltInOprt(false);
    parser.ClearFun();
    parser.ClearConst();
    parser.ClearInfixOprt();
    parser.ClearPostfixOprt();
    parser.ClearOprt();
    parser.DefineOprt("+", add, mu::prADD_SUB);
    parser.DefineOprt("-", subtract, mu::prADD_SUB);
    parser.DefineOprt("*", multiply, mu::prMUL_DIV);
    parser.DefineOprt("/", divide, mu::prMUL_DIV);
    parser.DefineOprt("^", power, mu::prPOW, mu::oaRIGHT);
    parser.DefineInfixOprt("-", minus);
    parser.DefineInfixOprt("+", plus);
    for (const auto& [name, function] : functions) parser.DefineFun(name, function, false);
    for (const auto& [name, function] : functions_of_two) parser.DefineFun(name, function, false);
    parser.DefineConst(circle_constant, std::numbers::pi);
    for (const std::string& name : names_in_formula(formula)) parser.DefineConst(name, values.find(name)->second);
    parser.SetExpr(formula);
    const double value = parser.Eval();
    if (parser.GetNumResults() != 1) throw Unreadable{"has a ',' outside the arguments of a function"};
    return value;
  } catch (const mu::ParserError& error) {
    throw Unreadable{explain_formula(error)};
  }
}

}  // namespace

std::variant<double, std::string> value_of_formula(const std::string& formula, const ParameterValues& values) {
  try {
    const double value = evaluated(formula, values);
    if (std::abs(value) > 1e100) return fmt::format("is {:.6g}, larger in size than 1e100", value);
    if (value != 0.0 && std::abs(value) < 1e-100) return fmt::format("is {:.6g}, smaller in size than 1e-100", value);
    return value == 0.0 ? 0.0 : value;  // no -0
  } catch (const NoNumber& reason) {
    return reason.why;
  } catch (const Unreadable& mistake) {
    return mistake.why;
  }
}

std::string mistake_in_formula(const std::string& formula) {
  ParameterValues ones;
  for (const std::string& name : names_in_formula(formula)) ones[name] = 1.0;
  try {
    evaluated(formula, ones);
  } catch (const NoNumber&) {  // with other values it may have one
  } catch (const Unreadable& mistake) {
    return mistake.why;
  }
  return {};
}

}  // namespace scabo::input
