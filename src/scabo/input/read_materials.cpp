// `materials`.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "scabo/input/reading.hpp"

namespace scabo::input {

namespace {

constexpr const char* material_example = "{young: 10e9, poisson: 0.3}";

Orthotropic read_orthotropic(Reading& reading, const Value& value) {
  const MapReader map(reading.report, value, {"E1", "E2", "E3", "nu12", "nu13", "nu23", "G12", "angle"},
                      "{E1: 40e9, E2: 10e9, nu12: 0.25, G12: 5e9, angle: 30}");
  const auto number = [&](const char* key) { return number_or_unread(reading, map.need(key)); };
  const bool strain = reading.model.analysis.plane != Plane::stress;
  Orthotropic o;
  o.E1 = number("E1");
  o.E2 = number("E2");
  o.G12 = number("G12");
  o.nu12 = number("nu12");
  if (strain || map.has("E3") || map.has("nu13") || map.has("nu23")) {
    o.E3 = number("E3");
    o.nu13 = number("nu13");
    o.nu23 = number("nu23");
  } else {
    o.E3 = o.E2;
  }
  if (const auto angle = map.get("angle")) o.angle = number_or_unread(reading, angle) * std::numbers::pi / 180.0;
  return o;
}

Anisotropic read_anisotropic(Reading& reading, const Value& value) {
  const MapReader map(reading.report, value, {"D11", "D12", "D22", "D16", "D26", "D66"},
                      "{D11: 40e9, D12: 3e9, D22: 10e9, D16: 1e9, D26: 0, D66: 5e9}");
  const auto number = [&](const char* key) { return number_or_unread(reading, map.need(key)); };
  Anisotropic a;
  a.D11 = number("D11");
  a.D22 = number("D22");
  a.D66 = number("D66");
  a.D12 = number("D12");
  a.D16 = number("D16");
  a.D26 = number("D26");
  return a;
}

/// A number, or one for each axis of the material: [a1, a2] or [a1, a2, a3].
std::optional<std::array<double, 3>> read_expansion(Reading& reading, const Value& value) {
  if (value.node->kind == Node::Kind::scalar) {
    const auto number = read_number(reading.report, value);
    if (!number) return {};
    return std::array{*number, *number, *number};
  }
  const auto items = read_list(reading.report, value, "[10e-6, 30e-6]");
  if (!items) return {};
  if (items->size() != 2 && items->size() != 3) {
    reading.report.error(
        value, fmt::format("must be a number, or one for each axis of the material, [a1, a2] or [a1, a2, a3], not "
                           "a list of {}",
                           items->size()));
    return {};
  }
  std::array<double, 3> expansion{};
  for (std::size_t i = 0; i < items->size(); ++i) {
    const auto number = read_number(reading.report, (*items)[i]);
    if (!number) return {};
    expansion[i] = *number;
  }
  if (items->size() == 2) expansion[2] = expansion[1];
  return expansion;
}

/// `{ratio: 0.05, between: [1, 10]}`.
Damping read_damping(Reading& reading, const Value& value) {
  const MapReader map(reading.report, value, {"ratio", "between"}, "{ratio: 0.05, between: [1, 10]}");
  Damping damping{unread, unread, unread};
  damping.ratio = number_or_unread(reading, map.need("ratio"));
  if (const auto between = map.need("between"))
    if (const auto frequencies = read_vector(reading.report, *between))
      damping.from = frequencies->x(), damping.to = frequencies->y();
  return damping;
}

Material read_material(Reading& reading, const Entry& entry) {
  const MapReader map(reading.report, entry.value,
                      {"young", "poisson", "density", "damping", "orthotropic", "anisotropic", "expansion"},
                      material_example);
  Material material;
  material.name = entry.key;
  material.source = entry.key_source;
  const auto orthotropic = map.get("orthotropic"), anisotropic = map.get("anisotropic");
  if (orthotropic && anisotropic) {
    map.refuse("anisotropic", "a material is either orthotropic or anisotropic: remove one of the two");
  } else if (orthotropic || anisotropic) {
    for (const char* key : {"young", "poisson"})
      map.refuse(key, fmt::format("applies only to an isotropic material: leave it out if {} is given",
                                  orthotropic ? "orthotropic" : "anisotropic"));
    if (orthotropic)
      material.law = read_orthotropic(reading, *orthotropic);
    else
      material.law = read_anisotropic(reading, *anisotropic);
  } else {
    material.young = number_or_unread(reading, map.need("young"));
    material.poisson = number_or_unread(reading, map.need("poisson"));
  }
  if (const auto value = map.get("density")) material.density = number_or_unread(reading, value);
  if (const auto value = map.get("damping")) material.damping = read_damping(reading, *value);
  if (const auto value = map.get("expansion")) {
    material.expansion = read_expansion(reading, *value).value_or(std::array{unread, unread, unread});
    // For an anisotropic law the third is the shear strain.
    if (anisotropic && (value->node->kind == Node::Kind::scalar || value->node->items.size() == 2))
      (*material.expansion)[2] = 0.0;
  }
  return material;
}

}  // namespace

void read_materials(Reading& reading, const Value& value) {
  const std::size_t before = reading.report.count();
  const auto entries = read_named(reading.report, value, "materials", "{concrete: {young: 10e9, poisson: 0.3}}");
  // A material with an invalid name is not in the list, but bodies may refer to it.
  if (reading.report.count() > before) reading.materials_known = false;
  for (const Entry& entry : entries) {
    reading.index_of_material.emplace(entry.key, static_cast<int>(reading.model.materials.size()));
    reading.model.materials.push_back(read_material(reading, entry));
  }
}

}  // namespace scabo::input
