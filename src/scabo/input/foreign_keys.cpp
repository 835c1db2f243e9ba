#include "scabo/input/foreign_keys.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace scabo::input {

namespace {

constexpr const char* about_yield =
    "bodies are linear elastic and do not yield: leave it out, and compare it with the von Mises stress of the results";
constexpr const char* about_heat =
    "no flow of heat is computed: leave it out, and give the change of temperature as a load, 'temperature'";
constexpr const char* about_angle =
    "friction is a key of a contact, 'friction', the tangent of this angle: 0.577 for 30 degrees";
constexpr const char* about_contact_stiffness =
    "the sides of a contact do not give way, so that it has no stiffness: leave it out, and draw a soft layer as a "
    "body";
constexpr const char* about_anchor =
    "an anchor is an entry of 'bars', with its preload: {between: [wall.head, [8, -2]], area: 1.2e-3, young: 195e9, "
    "preload: 400e3}";

struct ForeignKey {
  std::string_view key;         ///< without capitals, blanks, _ and -
  std::string_view beside;      ///< only in a map that knows this key; empty: in any
  std::string_view not_beside;  ///< not in a map that knows this key
  std::string_view sentence;
};

/// The first that fits counts.
constexpr ForeignKey foreign_keys[] = {
    {"yield", "", "", about_yield},
    {"yieldstress", "", "", about_yield},
    {"yieldstrength", "", "", about_yield},
    {"plastic", "", "", about_yield},
    {"plasticity", "", "", about_yield},
    {"hardening", "", "", about_yield},
    {"conductance", "", "", about_heat},
    {"conductivity", "", "", about_heat},
    {"thermalconductivity", "", "", about_heat},
    {"specificheat", "", "", about_heat},
    {"frictionangle", "friction", "", "write its tangent as 'friction', 0.577 for 30 degrees"},
    {"frictionangle", "", "", about_angle},
    {"angleoffriction", "friction", "", "write its tangent as 'friction', 0.577 for 30 degrees"},
    {"angleoffriction", "", "", about_angle},
    {"phi", "friction", "", "write its tangent as 'friction', 0.577 for 30 degrees"},
    {"phi", "young", "", about_angle},
    {"anchor", "", "", about_anchor},
    {"anchors", "", "", about_anchor},
    {"stiffness", "friction", "increments", about_contact_stiffness},
    {"contactstiffness", "", "", about_contact_stiffness},
    {"normalstiffness", "", "", about_contact_stiffness},
    {"penalty", "", "", about_contact_stiffness},
    {"penaltystiffness", "", "", about_contact_stiffness},
    {"stiffness", "fix", "",
     "a support does not give way: write an entry of 'springs' instead, {on: beam.bottom, k_n: 50e6}"},
    {"stiffness", "young", "", "the stiffness of a material is 'young' and 'poisson': leave it out"},
    {"stiffness", "", "",
     "stiffness is that of a material, 'young', or of 'springs', 'k_n' and 'k_t' or 'k_x' and 'k_y'"},
};

std::string plain(std::string_view key) {
  std::string text;
  for (const char c : key)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

std::string about_foreign_key(std::string_view key, const std::vector<std::string>& known) {
  constexpr std::size_t longest = 40;
  if (key.size() > longest) return "";
  const std::string name = plain(key);
  const auto knows = [&](std::string_view other) {
    return std::find(known.begin(), known.end(), other) != known.end();
  };
  for (const ForeignKey& foreign : foreign_keys)
    if (foreign.key == name && (foreign.beside.empty() || knows(foreign.beside)) &&
        (foreign.not_beside.empty() || !knows(foreign.not_beside)))
      return std::string(foreign.sentence);
  return "";
}

}  // namespace scabo::input
