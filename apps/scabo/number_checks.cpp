#include "number_checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "scabo/model/wording.hpp"

namespace scabo::app {

namespace {

/// `what` completes the sentence `must be ...`.
template <typename Number, typename Condition>
CLI::Validator check(Condition condition, const std::string& what) {
  return {[=](const std::string& text) {
            Number value{};
            const bool good = CLI::detail::lexical_cast(text, value) && condition(value);
            return good ? std::string() : fmt::format("must be {}, not '{}'", what, text);
          },
          ""};
}

}  // namespace

CLI::Validator whole_number(long least, long most) {
  return check<long>([=](long value) { return value >= least && value <= most; },
                     fmt::format("a whole number from {} to {}", least, most));
}

CLI::Validator number_from(double least, double most) {
  return check<double>([=](double value) { return value >= least && value <= most; },
                       fmt::format("a number from {} to {}", model::number_text(least), model::number_text(most)));
}

CLI::Validator positive_number() {
  return check<double>([](double value) { return std::isfinite(value) && value > 0.0; }, "a number greater than 0");
}

CLI::Validator number_from_zero() {
  return check<double>([](double value) { return std::isfinite(value) && value >= 0.0; }, "0 or a larger number");
}

}  // namespace scabo::app
