#include "scabo/convert/solid_model_writer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/convert/deck_names.hpp"
#include "scabo/files/text_cursor.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::convert {

using model::number_text;

std::string yaml_vector(const std::array<double, 3>& x) {
  return fmt::format("[{}, {}, {}]", number_text(x[0]), number_text(x[1]), number_text(x[2]));
}

std::string SolidModelWriter::set_of(std::map<std::string, std::vector<int>>& of, const std::vector<int>& members,
                                     const std::string& label) {
  for (const auto& [name, known] : of)
    if (known == members) return name;
  std::int64_t number = 0;
  const bool named = !files::parse_number(std::string_view(label), number) && !label.empty();
  const std::string name = set_names.take(named ? label : "set");
  of[name] = members;
  return name;
}

void SolidModelWriter::add_load(const std::string& label, const std::string& text, const Course& factors) {
  const std::string name = names.take(label);
  parts.loads += fmt::format("  {}: {{{}}}\n", yaml_word(name), text);
  driven.push_back({name, factors});
  ++result.loads;
}

void SolidModelWriter::add_vector_load(const std::string& label, const std::string& on, const char* kind,
                                       const std::array<Course, 3>& courses) {
  std::vector<std::pair<Course, std::array<double, 3>>> loads;
  for (std::size_t k = 0; k < 3; ++k) {
    if (is_zero(courses[k])) continue;
    const double scale = scale_of(courses[k]);
    const Course factors = scaled(courses[k], 1.0 / scale);
    auto same = std::find_if(loads.begin(), loads.end(), [&](const auto& load) { return load.first == factors; });
    if (same == loads.end()) same = loads.insert(same, {factors, {0.0, 0.0, 0.0}});
    same->second[k] = scale;
  }
  for (const auto& [factors, vector] : loads)
    add_load(label, fmt::format("{}{}{}: {}", on, on.empty() ? "" : ", ", kind, yaml_vector(vector)), factors);
}

std::map<int, std::vector<int>> SolidModelWriter::surface(const std::string& name, const files::DeckPlace& at) {
  std::map<int, std::vector<int>> sides;
  for (const files::Facet& facet : sides_named(deck, name).value_or(std::vector<files::Facet>{}))
    if (bodies.outer.contains(facet.start)) sides[body_of_side(facet.start)].push_back(facet.start);
  if (sides.empty())
    remarks.essential(at, fmt::format("there is no surface '{}' with outer sides of solid elements; correct it",
                                      files::printable(name)));
  return sides;
}

void SolidModelWriter::tell_stages(const Given& given) {
  if ((given.added > 0 || given.removed >= 0) && told_.insert(given.label).second)
    remarks.essential(given.at, fmt::format("the support of '{}' begins or ends in step {}, which supports in space do "
                                            "not; give it in every step",
                                            files::printable(given.label), std::max(given.added, given.removed) + 1));
}

}  // namespace scabo::convert
