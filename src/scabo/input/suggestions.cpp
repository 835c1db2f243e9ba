#include "scabo/input/suggestions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "scabo/model/wording.hpp"

namespace scabo::input {

namespace {

constexpr std::size_t longest_name = 60;  // compared and shown; the cost of a distance is the product of the lengths

char fold(char c) {
  if (c == '-') return '_';
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

/// Damerau distance (optimal string alignment), ignoring case and treating - as _.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = fold(a[i - 1]) == fold(b[j - 1]);
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && fold(a[i - 1]) == fold(b[j - 2]) && fold(a[i - 2]) == fold(b[j - 1]);
      if (swapped) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, now);
  }
  return last[b.size()];
}

struct Synonym {
  std::string_view key, name;  ///< `name` without capitals, spaces, _ and -
};

/// Names of keys in textbooks and in the input of other programs.
constexpr Synonym synonyms[] = {
    {"young", "e"},
    {"young", "emod"},
    {"young", "emodulus"},
    {"young", "modulus"},
    {"young", "elasticmodulus"},
    {"young", "modulusofelasticity"},
    {"young", "youngsmodulus"},
    {"young", "youngmodulus"},
    {"young", "stiffness"},
    {"poisson", "nu"},
    {"poisson", "v"},
    {"poisson", "poissonsratio"},
    {"poisson", "poissonratio"},
    {"density", "rho"},
    {"density", "massdensity"},
    {"expansion", "alpha"},
    {"expansion", "cte"},
    {"expansion", "thermalexpansion"},
    {"friction", "mu"},
    {"friction", "frictioncoefficient"},
    {"friction", "coefficientoffriction"},
    {"friction", "cof"},
    {"cohesion", "c"},
    {"tension", "ft"},
    {"tension", "tensilestrength"},
    {"gap", "clearance"},
    {"gap", "interference"},
    {"gap", "overclosure"},
    {"bond", "tied"},
    {"bond", "bonded"},
    {"bond", "glue"},
    {"bond", "glued"},
    {"between", "pairs"},
    {"between", "surfaces"},
    {"along", "positions"},
    {"supports", "bc"},
    {"supports", "bcs"},
    {"supports", "boundary"},
    {"supports", "boundaryconditions"},
    {"supports", "constraints"},
    {"supports", "restraints"},
    {"bars", "bolts"},
    {"bars", "bolt"},
    {"bars", "trusses"},
    {"springs", "foundation"},
    {"springs", "foundations"},
    {"springs", "elasticfoundation"},
    {"springs", "winkler"},
    {"field", "initialstress"},
    {"field", "insitu"},
    {"field", "prestress"},
    {"field", "farfield"},
    {"contacts", "interfaces"},
    {"contacts", "interactions"},
    {"bodies", "parts"},
    {"loads", "forces"},
    {"steps", "stages"},
    {"shape", "geometry"},
    {"mesh", "elements"},
    {"size", "h"},
    {"size", "elementsize"},
    {"size", "meshsize"},
    {"order", "degree"},
    {"order", "p"},
    {"on", "at"},
    {"on", "where"},
    {"on", "place"},
    {"on", "location"},
    {"fix", "fixed"},
    {"fix", "dof"},
    {"fix", "dofs"},
    {"fix", "constrain"},
    {"displacement", "u"},
    {"force", "f"},
    {"pressure", "p"},
    {"gravity", "g"},
    {"gravity", "acceleration"},
    {"thickness", "t"},
    {"thickness", "depth"},
    {"tolerance", "tol"},
    {"tolerance", "eps"},
    {"iterations", "maxiter"},
    {"iterations", "maxiterations"},
    {"increments", "substeps"},
    {"increments", "n"},
    {"every", "interval"},
    {"every", "frequency"},
};

}  // namespace

std::string key_of_synonym(std::string_view name, const std::vector<std::string>& known) {
  std::string plain;
  for (const char c : name.substr(0, longest_name))
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const Synonym& synonym : synonyms)
    if (synonym.name == plain && std::find(known.begin(), known.end(), synonym.key) != known.end())
      return std::string(synonym.key);
  return "";
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& known) {
  if (name.empty() || name.size() > longest_name) return "";
  std::string nearest;
  std::size_t smallest = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const std::string& candidate : known) {
    if (candidate.size() > longest_name) continue;
    const std::size_t d = distance(name, candidate);
    if (d < smallest && d < std::max(name.size(), candidate.size())) {
      smallest = d;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(name, known);
  if (!nearest.empty()) return fmt::format(" (did you mean '{}'?)", nearest);
  if (known.empty()) return "";
  return fmt::format(" (available: {})", model::name_list(known));
}

std::string one_line(std::string_view text) {
  std::string line(text);
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 0x20; }, ' ');
  return line;
}

std::string shortened(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  std::size_t end = most;  // never within a character
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  return std::string(text.substr(0, end)) + "...";
}

std::string quoted_name(std::string_view name) { return fmt::format("'{}'", one_line(shortened(name, longest_name))); }

}  // namespace scabo::input
