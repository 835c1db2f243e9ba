#include "scabo/convert/write_model.hpp"

#include <fmt/format.h>

#include <set>

#include "scabo/files/abaqus_lines.hpp"
#include "scabo/files/text_cursor.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::convert {

using model::number_text;
using model::Plane;

std::string yaml_word(const std::string& name) {
  static const std::set<std::string> reserved = {"TRUE", "FALSE", "NULL", "YES", "NO", "ON", "OFF", "Y", "N", "~"};
  return reserved.contains(files::upper(name)) ? '"' + name + '"' : name;
}

std::string yaml_quoted(const std::string& text) {
  std::string made = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') made += '\\';
    const bool plain = static_cast<unsigned char>(c) >= ' ' && static_cast<unsigned char>(c) < 127;
    made += plain ? std::string(1, c) : std::string("?");
  }
  return made + '"';
}

std::string yaml_point(const Vec2& x) { return fmt::format("[{}, {}]", number_text(x.x()), number_text(x.y())); }

void add_contact(ModelParts& parts, const std::string& name, const std::string& between, double friction,
                 std::optional<double> modulus, const std::string& interaction, double gap) {
  parts.contacts +=
      fmt::format("  {}: {{{}, friction: {}{}{}}}\n", name, between, number_text(friction),
                  modulus ? ", modulus: " + number_text(*modulus) : "", gap != 0.0 ? ", gap: " + number_text(gap) : "");
  parts.contacts_of.emplace(interaction, name);
}

std::string head_text(const ModelParts& parts, const Remarks& remarks, const std::string& deck_name) {
  std::string text = fmt::format("# Made by `scabo convert` from {}\n", files::printable(deck_name));
  for (const Remark& remark : remarks.all())
    if (remark.essential) text += fmt::format("# Missing ({}): {}\n", remark.at.line, remark.text);
  text += "scabo: 1\n";
  if (!parts.title.empty()) text += fmt::format("title: {}\n", yaml_quoted(parts.title));
  return text;
}

std::string model_text(const ModelParts& parts, const DeckBodies& bodies, const Remarks& remarks,
                       const std::string& deck_name, const std::string& mesh_name) {
  std::string text = head_text(parts, remarks, deck_name);
  if (parts.plane == Plane::revolution)
    text += "analysis: {plane: axisymmetric}\n";
  else
    text += fmt::format("analysis: {{plane: {}, thickness: {}}}\n", parts.plane == Plane::strain ? "strain" : "stress",
                        number_text(parts.thickness));
  text += "materials:\n" + parts.materials + "bodies:\n";
  for (const DeckBody& body : bodies.bodies) {
    text += fmt::format("  {}:\n", yaml_word(body.name));
    if (body.regions.size() == 1) {
      text += fmt::format("    material: {}\n", yaml_word(body.regions[0].material));
    } else {
      std::vector<std::string> materials;
      for (const DeckRegion& region : body.regions)
        materials.push_back(fmt::format("{}: {}", yaml_word(region.name), yaml_word(region.material)));
      text += fmt::format("    materials: {{{}}}\n", fmt::join(materials, ", "));
    }
    if (parts.plane == Plane::stress && body.thickness > 0.0 && body.thickness != parts.thickness)
      text += fmt::format("    thickness: {}\n", number_text(body.thickness));
    text += fmt::format("    mesh: {{file: {}, region: {}, elements: fem}}\n", yaml_quoted(mesh_name),
                        yaml_word(body.name));
  }
  return text + sections_text(parts);
}

std::string sections_text(const ModelParts& parts) {
  std::string text;
  const auto section = [&](const char* name, const std::string& content) {
    if (!content.empty()) text += fmt::format("{}:\n{}", name, content);
  };
  section("supports", parts.supports);
  section("loads", parts.loads);
  section("contacts", parts.contacts);
  section("ties", parts.ties);
  std::string curves;
  for (const auto& [name, table] : parts.curves) {
    std::vector<std::string> points;
    for (const auto& [part, value] : table) points.push_back(yaml_point({part, value}));
    curves += fmt::format("  {}: {{table: [{}]}}\n", name, fmt::join(points, ", "));
  }
  section("curves", curves);
  section("steps", parts.steps);
  return text;
}

}  // namespace scabo::convert
