// `materials`.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "scabo/input/reading.hpp"

namespace scabo::input {

namespace {

constexpr const char* material_example = "{young: 10e9, poisson: 0.3}";

std::optional<double> read_poisson(Reading& reading, const Value& value) {
  const auto poisson = read_number(reading.report, value);
  if (!poisson) return {};
  const bool strain = reading.model.analysis.plane == Plane::strain;
  if (*poisson > -1.0 && (*poisson < 0.5 || (!strain && *poisson == 0.5))) return poisson;
  const char* range =
      strain ? "greater than -1 and less than 0.5 (plane strain)" : "greater than -1 and at most 0.5 (plane stress)";
  reading.report.error(value, fmt::format("must be {}, not {}{}", range, value.node->text,
                                          *poisson == 0.5 ? ": use 0.4999 for incompressible material" : ""));
  return {};
}

std::optional<double> read_key(Reading& reading, const MapReader& map, const char* key, bool positive) {
  const auto value = map.need(key);
  if (!value) return {};
  return positive ? read_positive(reading.report, *value) : read_number(reading.report, *value);
}

std::optional<Orthotropic> read_orthotropic(Reading& reading, const Value& value) {
  const std::size_t before = reading.report.count();
  const MapReader map(reading.report, value, {"E1", "E2", "E3", "nu12", "nu13", "nu23", "G12", "angle"},
                      "{E1: 40e9, E2: 10e9, nu12: 0.25, G12: 5e9, angle: 30}");
  if (!map.is_map()) return {};
  const bool strain = reading.model.analysis.plane == Plane::strain;
  Orthotropic o;
  o.E1 = read_key(reading, map, "E1", true).value_or(1.0);
  o.E2 = read_key(reading, map, "E2", true).value_or(1.0);
  o.G12 = read_key(reading, map, "G12", true).value_or(1.0);
  o.nu12 = read_key(reading, map, "nu12", false).value_or(0.0);
  if (strain || map.has("E3") || map.has("nu13") || map.has("nu23")) {
    o.E3 = read_key(reading, map, "E3", true).value_or(1.0);
    o.nu13 = read_key(reading, map, "nu13", false).value_or(0.0);
    o.nu23 = read_key(reading, map, "nu23", false).value_or(0.0);
  } else {
    o.E3 = o.E2;
  }
  if (const auto angle = map.get("angle"))
    o.angle = read_number(reading.report, *angle).value_or(0.0) * std::numbers::pi / 180.0;
  if (reading.report.count() > before) return {};
  // The compliance is positive definite if its leading minors are positive.
  const double minor = 1.0 - o.nu12 * o.nu12 * o.E2 / o.E1;
  if (!(minor > 0.0)) {
    reading.report.error(
        *map.get("nu12"),
        fmt::format(
            "must be less than sqrt(E1 / E2) = {:.4g} in size, not {}: otherwise the elastic energy would be negative",
            std::sqrt(o.E1 / o.E2), map.get("nu12")->node->text));
    return {};
  }
  const double a = o.nu13 / o.E1, b = o.nu23 / o.E2, c = o.nu12 / o.E1;
  const double determinant =
      (1.0 / o.E1) * (1.0 / (o.E2 * o.E3) - b * b) + c * (-c / o.E3 - a * b) - a * (c * b + a / o.E2);
  if (!(determinant > 0.0) || !(o.nu13 * o.nu13 < o.E1 / o.E3) || !(o.nu23 * o.nu23 < o.E2 / o.E3)) {
    reading.report.error(value,
                         "E1, E2, E3, nu12, nu13 and nu23 are not compatible: the elastic energy would be negative for "
                         "some strains; use smaller Poisson's ratios");
    return {};
  }
  return o;
}

std::optional<Anisotropic> read_anisotropic(Reading& reading, const Value& value) {
  const std::size_t before = reading.report.count();
  const MapReader map(reading.report, value, {"D11", "D12", "D22", "D16", "D26", "D66"},
                      "{D11: 40e9, D12: 3e9, D22: 10e9, D16: 1e9, D26: 0, D66: 5e9}");
  if (!map.is_map()) return {};
  Anisotropic a;
  a.D11 = read_key(reading, map, "D11", true).value_or(1.0);
  a.D22 = read_key(reading, map, "D22", true).value_or(1.0);
  a.D66 = read_key(reading, map, "D66", true).value_or(1.0);
  a.D12 = read_key(reading, map, "D12", false).value_or(0.0);
  a.D16 = read_key(reading, map, "D16", false).value_or(0.0);
  a.D26 = read_key(reading, map, "D26", false).value_or(0.0);
  if (reading.report.count() > before) return {};
  const double minor = a.D11 * a.D22 - a.D12 * a.D12;
  const double determinant =
      a.D66 * minor - a.D16 * (a.D16 * a.D22 - a.D12 * a.D26) + a.D26 * (a.D16 * a.D12 - a.D11 * a.D26);
  if (!(minor > 1e-12 * a.D11 * a.D22) || !(determinant > 1e-12 * a.D66 * a.D11 * a.D22)) {
    reading.report.error(value,
                         "is not positive definite: the elastic energy would not be positive for some strains; use "
                         "smaller D12, D16 or D26");
    return {};
  }
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

std::optional<Material> read_material(Reading& reading, const Entry& entry) {
  const std::size_t before = reading.report.count();
  const MapReader map(reading.report, entry.value,
                      {"young", "poisson", "density", "orthotropic", "anisotropic", "expansion"}, material_example);
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
    if (orthotropic) {
      if (const auto law = read_orthotropic(reading, *orthotropic)) material.law = *law;
    } else if (const auto law = read_anisotropic(reading, *anisotropic)) {
      material.law = *law;
    }
  } else {
    if (const auto value = map.need("young")) material.young = read_positive(reading.report, *value).value_or(1.0);
    if (const auto value = map.need("poisson")) material.poisson = read_poisson(reading, *value).value_or(0.0);
  }
  if (const auto value = map.get("density")) material.density = read_not_negative(reading.report, *value);
  if (const auto value = map.get("expansion")) {
    material.expansion = read_expansion(reading, *value);
    // For an anisotropic law the third is the shear strain.
    if (anisotropic && material.expansion &&
        (value->node->kind == Node::Kind::scalar || value->node->items.size() == 2))
      (*material.expansion)[2] = 0.0;
  }
  if (reading.report.count() > before) return {};
  return material;
}

}  // namespace

void read_materials(Reading& reading, const Value& value) {
  const std::size_t before = reading.report.count();
  const auto entries = read_named(reading.report, value, "materials", "{concrete: {young: 10e9, poisson: 0.3}}");
  // A material with an invalid name is not in the list, but bodies may refer to it.
  if (reading.report.count() > before) reading.materials_known = false;
  for (const Entry& entry : entries) {
    const auto material = read_material(reading, entry);
    reading.index_of_material.emplace(entry.key, static_cast<int>(reading.material_names.size()));
    reading.material_names.push_back(entry.key);
    reading.material_index.push_back(material ? static_cast<int>(reading.model.materials.size()) : -1);
    if (material) reading.model.materials.push_back(*material);
  }
}

}  // namespace scabo::input
