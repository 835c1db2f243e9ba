#include "scabo/convert/deck_elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "scabo/convert/deck_bodies.hpp"
#include "scabo/convert/deck_names.hpp"
#include "scabo/convert/write_mesh.hpp"
#include "scabo/convert/write_model.hpp"
#include "scabo/files/abaqus_lines.hpp"
#include "scabo/files/text_cursor.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::convert {

namespace {

using files::upper;
using model::number_text;
using model::Plane;

const DeckMaterial* material_named(const DeckContent& content, const std::string& name) {
  for (const DeckMaterial& material : content.materials)
    if (upper(material.name) == upper(name)) return &material;
  return nullptr;
}

double least_young(const DeckMaterial& material) {
  if (material.isotropic) return material.isotropic->first;
  return material.orthotropic ? std::min((*material.orthotropic)[0], (*material.orthotropic)[1]) : 0.0;
}

std::optional<Plane> family_of(const std::string& type) {
  for (const Plane plane : {Plane::stress, Plane::strain, Plane::revolution})
    if (type.starts_with(element_family(plane))) return plane;
  return std::nullopt;
}

/// Hybrid elements (H) are for materials that hardly change their volume, which elements for displacements lock at.
void tell_incompressible(const files::AbaqusDeck& deck, const DeckMaterial& material, const std::vector<int>& cells,
                         const files::DeckPlace& at, Remarks& remarks) {
  constexpr double most_poisson = 0.45;
  if (!material.isotropic || material.isotropic->second <= most_poisson) return;
  for (const int c : cells) {
    const int type = deck.type_of_cell.at(deck.mesh.cells[static_cast<std::size_t>(c)].number);
    if (deck.elements[static_cast<std::size_t>(type)].type.find('H', 4) == std::string::npos) continue;
    return remarks.essential(
        at,
        fmt::format("hybrid elements of a material with Poisson's ratio {:g} are not taken: Scabo's finite elements "
                    "are for displacements alone; use one up to {:g}",
                    material.isotropic->second, most_poisson));
  }
}

/// Empty if its law is not taken.
std::string material_line(const DeckMaterial& material, double angle, const std::string& name, Plane plane,
                          Remarks& remarks) {
  std::string text;
  if (material.isotropic)
    text = fmt::format("young: {}, poisson: {}", number_text(material.isotropic->first),
                       number_text(material.isotropic->second));
  else if (material.orthotropic) {
    const std::vector<double>& n = *material.orthotropic;
    text = fmt::format("orthotropic: {{E1: {}, E2: {}, nu12: {}, G12: {}", number_text(n[0]), number_text(n[1]),
                       number_text(n[3]), number_text(n[6]));
    if (plane != Plane::stress)
      text += fmt::format(", E3: {}, nu13: {}, nu23: {}", number_text(n[2]), number_text(n[4]), number_text(n[5]));
    if (angle != 0.0) text += fmt::format(", angle: {}", number_text(angle));
    text += "}";
  } else {
    remarks.essential(material.at, fmt::format("material '{}' has no *ELASTIC that is taken; add one",
                                               files::printable(material.name)));
    return {};
  }
  if (material.density) text += fmt::format(", density: {}", number_text(*material.density));
  if (material.expansion) text += fmt::format(", expansion: {}", number_text(*material.expansion));
  return fmt::format("  {}: {{{}}}\n", yaml_word(name), text);
}

/// Elements that an earlier section gives another material: programs differ in which of the two counts.
void tell_of_two_materials(const files::AbaqusDeck& deck, const std::vector<std::string>& of_cell,
                           const std::vector<int>& cells, const std::string& material, const files::DeckPlace& at,
                           Remarks& remarks) {
  const auto other = std::find_if(cells.begin(), cells.end(), [&](int c) {
    const std::string& before = of_cell[static_cast<std::size_t>(c)];
    return !before.empty() && before != material;
  });
  if (other == cells.end()) return;
  const auto c = static_cast<std::size_t>(*other);
  remarks.essential(
      at, fmt::format("element {} has material '{}' by a *SOLID SECTION before this one; leave it in one of them",
                      shown_number(deck, deck.mesh.cells[c].number, DeckNumbers::elements), of_cell[c]));
}

}  // namespace

std::optional<model::Plane> plane_of(const files::AbaqusDeck& deck, Remarks& remarks) {
  std::optional<Plane> plane;
  for (const auto& elements : deck.elements) {
    const std::string& type = elements.type;
    const std::optional<Plane> family = family_of(type);
    const bool taken = family && type.size() >= 4 && std::string_view("3468").find(type[3]) != std::string_view::npos &&
                       type.find_first_not_of("RIHM", 4) == std::string::npos;
    if (!taken) {
      if (type.starts_with("T") || type.starts_with("B"))
        remarks.note(elements.at, fmt::format("elements of type {} have no section and are left out",
                                              files::printable(elements.type)));
      else if (std::any_of(deck.type_of_cell.begin(), deck.type_of_cell.end(), [&](const auto& cell) {
                 return &deck.elements[static_cast<std::size_t>(cell.second)] == &elements;
               }))
        remarks.essential(
            elements.at,
            fmt::format("elements of type {} are not taken; use those of a section with 3, 4, 6 or 8 nodes (CPS, CPE, "
                        "CAX)",
                        files::printable(elements.type)));
      continue;
    }
    if (plane && *plane != *family)
      remarks.essential(elements.at,
                        "plane stress (CPS), plane strain (CPE) and bodies of revolution (CAX) in one deck are not "
                        "taken; use one of them");
    if (!plane) plane = family;
    if (type.find_first_of("RI", 4) != std::string::npos)
      remarks.note(
          elements.at,
          fmt::format("elements of type {} become elements of the same nodes with full integration; results differ "
                      "by what the mesh does not resolve",
                      files::printable(type)));
    if (type.find_first_of("HM", 4) != std::string::npos)
      remarks.note(elements.at,
                   fmt::format("elements of type {} become elements for displacements alone; use them only where the "
                               "material can change its volume",
                               files::printable(type)));
  }
  return plane;
}

namespace {

/// Elements of no section.
void tell_without_material(const files::AbaqusDeck& deck, const std::vector<std::string>& of_cell, Remarks& remarks) {
  const auto without = std::find_if(of_cell.begin(), of_cell.end(), [](const auto& of) { return of.empty(); });
  if (without == of_cell.end()) return;
  const auto count = std::count_if(without, of_cell.end(), [](const auto& of) { return of.empty(); });
  const std::int64_t number = deck.mesh.cells[static_cast<std::size_t>(without - of_cell.begin())].number;
  remarks.essential(deck.elements[static_cast<std::size_t>(deck.type_of_cell.at(number))].at,
                    fmt::format("element {}{} no material; add a *SOLID SECTION", number,
                                count > 1 ? fmt::format(" and {} more have", count - 1) : " has"));
}

/// Two sections of the same elements.
void tell_of_two_thicknesses(const std::vector<double>& of_cell, const std::vector<int>& cells,
                             const DeckSection& section, Plane plane, Remarks& remarks) {
  if (plane == Plane::revolution) return;
  const auto other = std::find_if(cells.begin(), cells.end(), [&](int c) {
    const double before = of_cell[static_cast<std::size_t>(c)];
    return before != 0.0 && before != section.thickness;
  });
  if (other == cells.end()) return;
  remarks.essential(section.at, fmt::format("the thickness {:g} is given to elements of the thickness {:g}; give each "
                                            "element one",
                                            section.thickness, of_cell[static_cast<std::size_t>(*other)]));
}

}  // namespace

GivenMaterials materials_of(const files::AbaqusDeck& deck, const DeckContent& content, model::Plane plane,
                            Remarks& remarks) {
  GivenMaterials given;
  given.of_cell.assign(deck.mesh.cells.size(), "");
  given.young.assign(deck.mesh.cells.size(), 0.0);
  given.thickness.assign(deck.mesh.cells.size(), 0.0);
  UniqueNames names;
  std::map<std::string, std::string> made;
  std::set<std::string> used;
  for (const DeckSection& section : content.sections) {
    const DeckMaterial* material = material_named(content, section.material);
    const auto cells = cells_named(deck, section.set);
    if (!cells) continue;  // of elements that are left out
    if (material == nullptr) {
      if (!section.material.empty())
        remarks.essential(
            section.at, fmt::format("there is no material '{}'; correct its name", files::printable(section.material)));
      continue;
    }
    used.insert(upper(material->name));
    std::string key = upper(material->name);
    double angle = 0.0;
    if (!section.orientation.empty()) {
      const auto found = content.orientations.find(section.orientation);
      if (found == content.orientations.end())
        remarks.essential(section.at, fmt::format("there is no usable *ORIENTATION '{}'; correct it",
                                                  files::printable(section.orientation)));
      if (found != content.orientations.end() && material->orthotropic) angle = found->second;
    }
    if (section.orientation.empty() && section.turned && material->orthotropic)
      remarks.essential(section.at,
                        "an orthotropic material in an instance that is turned needs an *ORIENTATION; add one");
    if (angle != 0.0) key += " " + number_text(angle);
    const auto [entry, is_new] = made.try_emplace(key);
    if (is_new) {
      entry->second = names.take(material->name);
      given.lines += material_line(*material, angle, entry->second, plane, remarks);
    }
    tell_incompressible(deck, *material, *cells, section.at, remarks);
    tell_of_two_materials(deck, given.of_cell, *cells, entry->second, section.at, remarks);
    tell_of_two_thicknesses(given.thickness, *cells, section, plane, remarks);
    for (const int c : *cells) {
      given.thickness[static_cast<std::size_t>(c)] = section.thickness;
      given.of_cell[static_cast<std::size_t>(c)] = entry->second;
      given.young[static_cast<std::size_t>(c)] = least_young(*material);
    }
  }
  for (const DeckMaterial& material : content.materials)
    if (!used.contains(upper(material.name)))
      remarks.note(material.at,
                   fmt::format("material '{}' is used by no section and is left out", files::printable(material.name)));
  tell_without_material(deck, given.of_cell, remarks);
  return given;
}

}  // namespace scabo::convert
