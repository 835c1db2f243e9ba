#include "scabo/convert/deck_materials.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "scabo/convert/deck_fields.hpp"
#include "scabo/convert/keywords.hpp"
#include "scabo/files/abaqus_instances.hpp"
#include "scabo/files/abaqus_lines.hpp"

namespace scabo::convert {

namespace {

using files::DeckBlock;
using files::upper;

class MaterialReader {
 public:
  MaterialReader(const files::AbaqusDeck& deck, DeckContent& content, Remarks& remarks)
      : deck_(deck), content_(content), remarks_(remarks) {}

  bool read(const DeckBlock& block) {
    const std::string& name = block.name;
    if (name == "MATERIAL") {
      material(block);
    } else if (name == "ELASTIC") {
      elastic(block);
    } else if (name == "DENSITY") {
      density(block);
    } else if (name == "EXPANSION") {
      expansion(block);
    } else if (name == "ORIENTATION") {
      orientation(block);
    } else if (name == "SOLIDSECTION" || name == "SHELLSECTION" || name == "MEMBRANESECTION" ||
               is_unknown_section(name)) {
      section(block);
    } else {
      return false;
    }
    return true;
  }

 private:
  static bool is_unknown_section(const std::string& name) {
    return name.ends_with("SECTION") && text_of_keyword(name).text.find("known to") != std::string::npos;
  }

  void density(const DeckBlock& block) {
    DeckMaterial* material = material_of(block);
    if (!material) return;
    tell_of_second(block, material->density.has_value());
    if (const auto n = numbers_of(remarks_, block, 1, "*DENSITY")) material->density = (*n)[0];
  }

  void expansion(const DeckBlock& block) {
    if (upper(parameter(block, "TYPE", "ISO")) != "ISO")
      remarks_.note(block.at, "thermal expansion by axes is left out; temperatures are not taken either");
    else if (DeckMaterial* material = material_of(block))
      if (const auto n = numbers_of(remarks_, block, 1, "*EXPANSION")) material->expansion = (*n)[0];
  }

  void material(const DeckBlock& block) {
    DeckMaterial read;
    read.name = parameter(block, "NAME");
    read.at = block.at;
    if (read.name.empty()) remarks_.essential(block.at, "*MATERIAL has no name; write *MATERIAL, NAME=name");
    for (const DeckMaterial& other : content_.materials)
      if (upper(other.name) == upper(read.name)) tell_of_two(block, "*MATERIAL", read.name);
    content_.materials.push_back(read);
  }

  void tell_of_two(const DeckBlock& block, const char* keyword, const std::string& name) {
    remarks_.essential(block.at, fmt::format("there is another {} '{}' before this one; give each a name of its own",
                                             keyword, files::printable(name)));
  }

  /// Tells of a property that the material has already.
  void tell_of_second(const DeckBlock& block, bool has_one) {
    if (has_one)
      remarks_.essential(block.at, fmt::format("{} of material '{}' stands before this one too; leave one of them",
                                               block.written, files::printable(content_.materials.back().name)));
  }

  DeckMaterial* material_of(const DeckBlock& block) {
    if (!content_.materials.empty()) return &content_.materials.back();
    remarks_.essential(block.at,
                       fmt::format("{} stands before any *MATERIAL and is lost; name the material", block.written));
    return nullptr;
  }

  void elastic(const DeckBlock& block) {
    DeckMaterial* material = material_of(block);
    if (!material) return;
    tell_of_second(block, material->isotropic || material->orthotropic);
    const std::string type = upper(parameter(block, "TYPE", "ISO"));
    if (type == "ISO" || type == "ISOTROPIC") {
      if (const auto n = numbers_of(remarks_, block, 2, "*ELASTIC")) material->isotropic = {(*n)[0], (*n)[1]};
    } else if (type == "ENGINEERINGCONSTANTS" || type == "ENGINEERING CONSTANTS") {
      if (const auto n = numbers_of(remarks_, block, 9, "*ELASTIC"))
        material->orthotropic = {(*n)[0], (*n)[1], (*n)[2], (*n)[3], (*n)[4], (*n)[5], (*n)[6]};
    } else if (type == "ORTHO" || type == "ORTHOTROPIC") {
      if (const auto n = numbers_of(remarks_, block, 9, "*ELASTIC"))
        material->orthotropic = engineering_constants(block, *n);
    } else {
      remarks_.essential(block.at,
                         fmt::format("*ELASTIC of TYPE={} is not taken; there are ISO, ORTHO and ENGINEERING CONSTANTS",
                                     files::printable(type)));
    }
  }

  /// From D1111, D1122, D2222, D1133, D2233, D3333, D1212, ... by the inverse of the normal part.
  std::optional<std::vector<double>> engineering_constants(const DeckBlock& block, const std::vector<double>& D) {
    const double a = D[0], b = D[1], c = D[3], d = D[2], e = D[4], f = D[5];
    const double determinant = a * (d * f - e * e) - b * (b * f - c * e) + c * (b * e - c * d);
    const double S11 = (d * f - e * e) / determinant, S22 = (a * f - c * c) / determinant,
                 S33 = (a * d - b * b) / determinant, S12 = (c * e - b * f) / determinant,
                 S13 = (b * e - c * d) / determinant, S23 = (b * c - a * e) / determinant;
    if (!(S11 > 0.0 && S22 > 0.0 && S33 > 0.0 && std::isfinite(S11 + S22 + S33))) {
      remarks_.essential(block.at,
                         "the stiffness of *ELASTIC, TYPE=ORTHO is not positive definite; correct its numbers");
      return std::nullopt;
    }
    return std::vector<double>{1.0 / S11, 1.0 / S22, 1.0 / S33, -S12 / S11, -S13 / S11, -S23 / S22, D[6]};
  }

  std::string full_name(const DeckBlock& block, const std::string& name) const {
    return block.instance < 0 || name.empty()
               ? name
               : deck_.instances[static_cast<std::size_t>(block.instance)].name + "." + name;
  }

  /// Three numbers of a line from `first` on.
  std::optional<files::Vec3> point(const files::DeckLine& line, std::size_t first) {
    files::Vec3 x = files::Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto value = number(remarks_, line, first + k, "a point of *ORIENTATION");
      if (!value) return std::nullopt;
      x[static_cast<Eigen::Index>(k)] = *value;
    }
    return x;
  }

  /// Axis 1 goes to the first point, axis 2 lies with it in the plane of both, towards the second; a second line turns
  /// both about one of the three axes. Within an instance all this turns with it.
  void orientation(const DeckBlock& block) {
    if (block.lines.empty()) return;
    const auto a = point(block.lines[0], 0), b = point(block.lines[0], 3);
    if (!a || !b) return;
    files::Vec3 first = a->normalized(), third = a->cross(*b).normalized();
    if (block.lines.size() > 1) {
      const auto axis = number(remarks_, block.lines[1], 0, "the axis of the second turn", 1.0),
                 angle = number(remarks_, block.lines[1], 1, "the angle of the second turn", 0.0);
      if (!axis || !angle) return;
      if (*angle != 0.0 && *axis != 3.0)
        return remarks_.essential(block.lines[1].at, "a turn of *ORIENTATION is taken about axis 3 only; correct it");
      if (*angle != 0.0 && third.norm() > 0.0) first = *files::turn_about(files::Vec3::Zero(), third, *angle) * first;
    }
    if (block.instance >= 0) {
      const Eigen::Matrix3d& turn = deck_.instances[static_cast<std::size_t>(block.instance)].turn;
      first = turn * first;
      third = turn * third;
    }
    if (!(third.norm() > 0.0) || std::abs(first.z()) > 1e-9 || third.head<2>().norm() > 1e-9)
      return remarks_.essential(block.at, "the axes of *ORIENTATION do not lie in the plane; turn them");
    const std::string name = full_name(block, parameter(block, "NAME"));
    const double angle = std::atan2(first.y(), first.x()) * 180.0 / std::numbers::pi;
    if (!content_.orientations.emplace(upper(name), angle).second) tell_of_two(block, "*ORIENTATION", name);
  }

  void section(const DeckBlock& block) {
    if (block.name != "SOLIDSECTION")
      return remarks_.essential(
          block.at, fmt::format("{} is not taken; use plane elements (CPS, CPE) with *SOLID SECTION", block.written));
    DeckSection read{full_name(block, parameter(block, "ELSET")), parameter(block, "MATERIAL"),
                     upper(full_name(block, parameter(block, "ORIENTATION"))), 1.0, block.at};
    read.turned = block.instance >= 0 && !deck_.instances[static_cast<std::size_t>(block.instance)].turn.isIdentity();
    if (read.material.empty() && !block.parameters.contains("COMPOSITE"))
      remarks_.essential(block.at, "*SOLID SECTION names no material; add MATERIAL=name");
    if (!block.lines.empty()) read.thickness = number(remarks_, block.lines[0], 0, "the thickness", 1.0).value_or(1.0);
    content_.sections.push_back(std::move(read));
  }

  const files::AbaqusDeck& deck_;
  DeckContent& content_;
  Remarks& remarks_;
};

}  // namespace

bool read_material_block(const files::AbaqusDeck& deck, const DeckBlock& block, DeckContent& content,
                         Remarks& remarks) {
  return MaterialReader(deck, content, remarks).read(block);
}

}  // namespace scabo::convert
