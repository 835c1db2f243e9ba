// `scabo exponents`: the exponents of every super-element, u ~ xi^lambda.
#include "scabo/element/exponents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "scabo/input/settings.hpp"
#include "scabo/mesh/mesh.hpp"
#include "scabo/input/read_model.hpp"
#include "scabo/result/report.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

std::string text_of(const std::string& body, const element::BodyExponents& found) {
  std::vector<std::vector<std::string>> rows = {{"real", "imaginary", "multiplicity", "meaning"}};
  for (const element::Exponent& exponent : found.exponents)
    rows.push_back({fmt::format("{:.12g}", exponent.value.real()),
                    exponent.value.imag() == 0.0 ? "0" : fmt::format("+-{:.12g}", exponent.value.imag()),
                    fmt::format("{}", exponent.multiplicity), exponent.meaning});
  return fmt::format("{}: {}, {} degrees of freedom\n", body, found.kind, found.dofs) + result::table(rows);
}

nlohmann::ordered_json json_of(const element::BodyExponents& found) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const element::Exponent& exponent : found.exponents)
    list.push_back({{"real", exponent.value.real()},
                    {"imaginary", exponent.value.imag()},
                    {"multiplicity", exponent.multiplicity},
                    {"singular", exponent.singular},
                    {"defective", exponent.defective},
                    {"meaning", exponent.meaning}});
  return {{"kind", found.kind}, {"dofs", found.dofs}, {"exponents", list}};
}

}  // namespace

ExitStatus print_exponents(const ExponentsOptions& options) {
  const model::Model model = input::read_model(options.model, input::parse_settings(options.settings));
  const std::vector<element::BodyExponents> all = element::exponents_of(model);
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  std::string text;
  for (const element::BodyExponents& found : all) {
    const std::string& name = model.bodies[static_cast<std::size_t>(found.body)].name;
    json[name] = json_of(found);
    text += (text.empty() ? "" : "\n") + text_of(name, found);
  }
  if (all.empty()) text = "No body is a super-element.\n";
  print_output(options.json ? json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n" : text);
  return ExitStatus::solved;
}

}  // namespace scabo::app
