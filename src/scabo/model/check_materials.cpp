// Validation of materials: elastic constants, density and thermal expansion, and whether loads find what they need.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <set>

#include "scabo/model/checking.hpp"
#include "scabo/model/materials_of.hpp"

namespace scabo::model {

namespace {

void check_poisson(Checking& checking, const std::string& path, double poisson) {
  if (!checking.number(path, "poisson", poisson)) return;
  const Plane plane = checking.model.analysis.plane;
  const bool strain = plane != Plane::stress;
  if (poisson > -1.0 && (poisson < 0.5 || (!strain && poisson == 0.5))) return;
  const char* range = plane == Plane::revolution ? "greater than -1 and less than 0.5"
                      : strain                   ? "greater than -1 and less than 0.5 (plane strain)"
                                                 : "greater than -1 and at most 0.5 (plane stress)";
  checking.error(path, "poisson",
                 fmt::format("must be {}, not {}{}", range, number_text(poisson),
                             poisson == 0.5 ? ": use 0.4999 for incompressible material" : ""),
                 number_text(poisson));
}

void check_law(Checking& checking, const std::string& path, const Orthotropic& o) {
  const bool second = checking.positive(path, "E2", o.E2);
  const bool third = o.E3 == o.E2 ? second : checking.positive(path, "E3", o.E3);  // E2 stands for E3 in plane stress
  bool good = checking.positive(path, "E1", o.E1) && second && third;
  good = checking.positive(path, "G12", o.G12) && good;
  good = checking.number(path, "nu12", o.nu12) && good;
  good = checking.number(path, "nu13", o.nu13) && good;
  good = checking.number(path, "nu23", o.nu23) && good;
  good = checking.number(path, "angle", o.angle) && good;
  if (!good) return;
  // The compliance is positive definite if its leading minors are positive.
  const double minor = 1.0 - o.nu12 * o.nu12 * o.E2 / o.E1;
  if (!(minor > 0.0)) {
    checking.error(path, "nu12",
                   fmt::format("must be less than sqrt(E1 / E2) = {:.4g} in size, not {}: otherwise the elastic "
                               "energy would be negative",
                               std::sqrt(o.E1 / o.E2), number_text(o.nu12)),
                   number_text(o.nu12));
    return;
  }
  const double a = o.nu13 / o.E1, b = o.nu23 / o.E2, c = o.nu12 / o.E1;
  const double determinant =
      (1.0 / o.E1) * (1.0 / (o.E2 * o.E3) - b * b) + c * (-c / o.E3 - a * b) - a * (c * b + a / o.E2);
  if (!(determinant > 0.0) || !(o.nu13 * o.nu13 < o.E1 / o.E3) || !(o.nu23 * o.nu23 < o.E2 / o.E3))
    checking.error(path, "",
                   "E1, E2, E3, nu12, nu13 and nu23 are not compatible: the elastic energy would be negative for "
                   "some strains; use smaller Poisson's ratios");
}

void check_law(Checking& checking, const std::string& path, const Anisotropic& a) {
  bool good = checking.positive(path, "D11", a.D11);
  good = checking.positive(path, "D22", a.D22) && good;
  good = checking.positive(path, "D66", a.D66) && good;
  good = checking.number(path, "D12", a.D12) && good;
  good = checking.number(path, "D16", a.D16) && good;
  good = checking.number(path, "D26", a.D26) && good;
  if (!good) return;
  const double minor = a.D11 * a.D22 - a.D12 * a.D12;
  const double determinant =
      a.D66 * minor - a.D16 * (a.D16 * a.D22 - a.D12 * a.D26) + a.D26 * (a.D16 * a.D12 - a.D11 * a.D26);
  if (!(minor > 1e-12 * a.D11 * a.D22) || !(determinant > 1e-12 * a.D66 * a.D11 * a.D22))
    checking.error(path, "",
                   "is not positive definite: the elastic energy would not be positive for some strains; use "
                   "smaller D12, D16 or D26");
}

/// First and last + 1 of the bodies on which a load on whole bodies acts.
std::pair<std::size_t, std::size_t> bodies_under(const Checking& checking, const Load& load) {
  if (!load.on) return {0, checking.model.bodies.size()};
  if (!checking.is_body(load.on->body)) return {0, 0};
  const auto body = static_cast<std::size_t>(load.on->body);
  return {body, body + 1};
}

/// Reports a property that a material lacks, once for each material.
void report_lack(Checking& checking, int index, std::string message) {
  const Material& material = checking.model.materials[static_cast<std::size_t>(index)];
  checking.enter(material.source);
  checking.error_of_key(path_of("materials", material.name, static_cast<std::size_t>(index)), "", std::move(message));
}

/// Whether supports on the whole body hold it along x and y.
bool is_held(const Model& model, int body) {
  bool along[2] = {false, false};
  for (const Support& support : model.supports)
    if (support.on.body == body && support.on.kind == Place::Kind::body)
      for (std::size_t k = 0; k < 2; ++k) along[k] = along[k] || support.displacement[k].has_value();
  return along[0] && along[1];
}

/// A body without mass has no frequencies.
void check_density_of_modal_analysis(Checking& checking) {
  const Model& model = checking.model;
  std::set<int> told;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body& body = model.bodies[b];
    checking.enter(body.source);
    if (body.outside)
      checking.error_of_key(path_of("bodies", body.name, b), "",
                            "an unbounded body has no natural frequencies: leave it out of a modal analysis");
    if (body.rigid || body.outside) continue;
    for (const int index : materials_of(model, body)) {
      const auto& density = model.materials[static_cast<std::size_t>(index)].density;
      if ((density && *density != 0.0) || !told.insert(index).second) continue;
      report_lack(checking, index,
                  fmt::format("'density' {}: a modal analysis needs the mass of body '{}'",
                              density ? "is 0" : "is missing", body.name));
    }
  }
}

/// In time every body needs a mass, be it none.
void check_density_in_time(Checking& checking) {
  const Model& model = checking.model;
  std::set<int> told;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body& body = model.bodies[b];
    if (body.outside) continue;
    checking.enter(body.source);
    if (body.rigid && !body.density && !is_held(model, static_cast<int>(b)))
      checking.error_of_key(path_of("bodies", body.name, b), "",
                            "'density' is missing: a step in time needs the mass of a rigid body that no support holds "
                            "as a whole");
    if (body.rigid) continue;
    for (const int index : materials_of(model, body)) {
      if (model.materials[static_cast<std::size_t>(index)].density || !told.insert(index).second) continue;
      report_lack(checking, index,
                  fmt::format("'density' is missing: a step in time needs the mass of body '{}'; 0 makes it massless",
                              body.name));
    }
  }
}

}  // namespace

double Damping::of_mass() const { return 4.0 * std::numbers::pi * ratio * from * to / (from + to); }
double Damping::of_stiffness() const { return ratio / (std::numbers::pi * (from + to)); }

std::set<int> materials_of(const Model& model, const Body& body) {
  std::set<int> materials(body.sector_materials.begin(), body.sector_materials.end());
  materials.insert(body.region_materials.begin(), body.region_materials.end());
  if (materials.empty()) materials.insert(body.material);
  for (const Region& region : body.regions) materials.insert(region.material);
  if (body.image)
    for (const auto& [label, material] : body.image->materials) materials.insert(material);
  std::erase_if(materials, [&](int i) { return i < 0 || static_cast<std::size_t>(i) >= model.materials.size(); });
  return materials;
}

void check_materials(Checking& checking) {
  std::unordered_set<std::string> names;
  for (std::size_t i = 0; i < checking.model.materials.size(); ++i) {
    const Material& material = checking.model.materials[i];
    const std::string path = path_of("materials", material.name, i);
    checking.enter(material.source);
    check_name(checking, path, material.name, "material", names);
    if (!material.law) {
      checking.positive(path, "young", material.young);
      check_poisson(checking, path, material.poisson);
    } else if (const auto* orthotropic = std::get_if<Orthotropic>(&*material.law)) {
      check_law(checking, path + ".orthotropic", *orthotropic);
    } else {
      check_law(checking, path + ".anisotropic", std::get<Anisotropic>(*material.law));
    }
    if (material.density) checking.not_negative(path, "density", *material.density);
    if (material.damping) {
      const Damping& damping = *material.damping;
      if (checking.not_negative(path, "damping.ratio", damping.ratio) && damping.ratio >= 1.0)
        checking.error(path, "damping.ratio",
                       fmt::format("is the part of critical damping and must be below 1, not {}; 5 % is 0.05",
                                   number_text(damping.ratio)));
      if (checking.positive(path, "damping.between.0", damping.from) &&
          checking.positive(path, "damping.between.1", damping.to) && damping.from >= damping.to)
        checking.error(path, "damping.between", "must be two ascending frequencies");
    }
    if (!material.expansion) continue;
    for (std::size_t k = 0; k < 3; ++k)
      if (!checking.number(path, fmt::format("expansion.{}", k), (*material.expansion)[k])) break;
  }
}

void check_density(Checking& checking) {
  const Model& model = checking.model;
  if (model.analysis.type == AnalysisType::modal) {
    check_density_of_modal_analysis(checking);
    return;
  }
  if (is_dynamic(model)) check_density_in_time(checking);
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    const Load& load = model.loads[l];
    const bool spins = std::holds_alternative<Spin>(load.kind);
    if (!checking.load[l] || !(spins || std::holds_alternative<Gravity>(load.kind))) continue;
    std::set<int> told;
    const auto [first, last] = bodies_under(checking, load);
    for (std::size_t i = first; i < last; ++i) {
      const Body& body = model.bodies[i];
      if (body.rigid || body.outside) continue;
      for (const int index : materials_of(model, body)) {
        if (model.materials[static_cast<std::size_t>(index)].density || !told.insert(index).second) continue;
        report_lack(checking, index,
                    fmt::format("'density' is missing: gravity of load '{}' acts on body '{}'", load.name, body.name));
      }
    }
  }
}

void check_expansion(Checking& checking) {
  const Model& model = checking.model;
  std::set<int> told;
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    const Load& load = model.loads[l];
    if (!checking.load[l] || !std::holds_alternative<Temperature>(load.kind)) continue;
    const auto [first, last] = bodies_under(checking, load);
    for (std::size_t i = first; i < last; ++i) {
      const Body& body = model.bodies[i];
      if (body.rigid || body.outside) continue;
      for (const int index : materials_of(model, body)) {
        if (model.materials[static_cast<std::size_t>(index)].expansion || !told.insert(index).second) continue;
        report_lack(
            checking, index,
            fmt::format("'expansion' is missing: temperature of load '{}' acts on body '{}'", load.name, body.name));
      }
    }
  }
}

}  // namespace scabo::model
