#include "scabo/analysis/diagnostics/warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "scabo/base/components.hpp"
#include "scabo/element/plane/conditioning.hpp"
#include "scabo/geometry/box.hpp"
#include "scabo/model/materials_of.hpp"

namespace scabo::analysis {

namespace {

constexpr double most_overlap = 0.01;   // relative to the size of the body: a strain
constexpr double most_pressure = 0.05;  // relative to Young's modulus: a strain
constexpr int fewest_pairs = 5;         // two quadratic edges
constexpr std::size_t most_names = 3;

/// A contact and a measure of its deviation.
struct Finding {
  std::size_t contact = 0;
  double figure = 0.0;
};

/// `contact 'joint'`, or `contacts 'a', 'b' and 7 more`.
std::string contacts_of(const Discretisation& discretisation, const std::vector<Finding>& findings) {
  std::string text = findings.size() == 1 ? "contact " : "contacts ";
  const std::size_t named = findings.size() <= most_names + 1 ? findings.size() : most_names;
  for (std::size_t i = 0; i < named; ++i) {
    if (i > 0) text += i + 1 == findings.size() ? " and " : ", ";
    text += fmt::format("'{}'", discretisation.model.contacts[findings[i].contact].name);
  }
  return named == findings.size() ? text : text + fmt::format(" and {} more", findings.size() - named);
}

const Finding& worst_of(const std::vector<Finding>& findings) {
  return *std::max_element(findings.begin(), findings.end(),
                           [](const Finding& a, const Finding& b) { return a.figure < b.figure; });
}

std::string in_worst(const Discretisation& discretisation, const std::vector<Finding>& findings) {
  if (findings.size() == 1) return "";
  return fmt::format(" in '{}'", discretisation.model.contacts[worst_of(findings).contact].name);
}

/// Smallest stiffness of a material against compression.
double stiffness_of(const model::Material& material) {
  if (!material.law) return material.young;
  if (const auto* orthotropic = std::get_if<model::Orthotropic>(&*material.law))
    return std::min(orthotropic->E1, orthotropic->E2);
  const auto& anisotropic = std::get<model::Anisotropic>(*material.law);
  return std::min(anisotropic.D11, anisotropic.D22);
}

/// The elastic bodies of a contact.
std::vector<std::size_t> elastic_bodies(const Discretisation& discretisation, std::size_t contact) {
  std::vector<std::size_t> bodies;
  for (const model::Place* side :
       {&discretisation.model.contacts[contact].a, &discretisation.model.contacts[contact].b}) {
    const auto body = static_cast<std::size_t>(side->body);
    if (!discretisation.model.bodies[body].rigid) bodies.push_back(body);
  }
  return bodies;
}

/// Largest initial overlap relative to the size, along the normal, of the smaller elastic body.
struct Overlap {
  double strain = 0.0, depth = 0.0;
};
Overlap overlap_of(const Discretisation& discretisation, std::size_t contact) {
  Overlap overlap;
  for (const mesh::ContactPair& pair : discretisation.mesh.interfaces[contact].pairs) {
    if (pair.gap >= 0.0) continue;
    double size = std::numeric_limits<double>::infinity();
    for (const std::size_t body : elastic_bodies(discretisation, contact)) {
      if (discretisation.model.bodies[body].outside) continue;
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Vec2& x : discretisation.mesh.bodies[body].nodes) {
        low = std::min(low, x.dot(pair.normal));
        high = std::max(high, x.dot(pair.normal));
      }
      size = std::min(size, high - low);
    }
    overlap.strain = std::max(overlap.strain, -pair.gap / size);
    overlap.depth = std::max(overlap.depth, -pair.gap);
  }
  return overlap;
}

/// Largest pressure of all increments relative to the smaller Young's modulus of the two sides.
double pressure_strain(const StaticSolution& solution, std::size_t contact, double& pressure) {
  pressure = 0.0;
  for (const IncrementResult& increment : solution.increments)
    if (increment.converged) pressure = std::max(pressure, increment.contacts[contact].max_pressure);
  double stiffness = std::numeric_limits<double>::infinity();
  for (const std::size_t body : elastic_bodies(solution, contact))
    stiffness = std::min(
        stiffness,
        stiffness_of(solution.model.materials[static_cast<std::size_t>(solution.model.bodies[body].material)]));
  return pressure / stiffness;
}

void warn_of_large_strains(const StaticSolution& solution, std::vector<Warning>& warnings) {
  std::vector<Finding> overlapping, pressed;
  for (std::size_t c = 0; c < solution.model.contacts.size(); ++c) {
    double pressure = 0.0;
    const double strain = overlap_of(solution, c).strain, by_pressure = pressure_strain(solution, c, pressure);
    if (strain > most_overlap)
      overlapping.push_back({c, strain});
    else if (by_pressure > most_pressure)
      pressed.push_back({c, by_pressure});
  }
  if (!overlapping.empty()) {
    const Finding& worst = worst_of(overlapping);
    double pressure = 0.0;
    pressure_strain(solution, worst.contact, pressure);
    const std::string pressing = pressure > 0.0 ? fmt::format(", which presses with {:.3g} there", pressure) : "";
    warnings.push_back({WarningKind::overlap, contacts_of(solution, overlapping),
                        fmt::format("{}: the bodies overlap at the start by up to {:.3g}{}, {:.3g} % of the smaller "
                                    "body's size{}: small strains are assumed",
                                    contacts_of(solution, overlapping), overlap_of(solution, worst.contact).depth,
                                    in_worst(solution, overlapping), 100.0 * worst.figure, pressing)});
  }
  if (!pressed.empty()) {
    const Finding& worst = worst_of(pressed);
    double pressure = 0.0;
    pressure_strain(solution, worst.contact, pressure);
    warnings.push_back(
        {WarningKind::pressure, contacts_of(solution, pressed),
         fmt::format("{}: the pressure reaches {:.3g}{}, {:.3g} % of Young's modulus: small strains are assumed",
                     contacts_of(solution, pressed), pressure, in_worst(solution, pressed), 100.0 * worst.figure)});
  }
}

/// Whether the two sides of a contact touch at this gap but for rounding, or overlap.
bool touches(const Discretisation& discretisation, std::size_t contact, double gap) {
  constexpr double rounding = 1e-9;  // of the size of a body
  const auto body = static_cast<std::size_t>(discretisation.model.contacts[contact].a.body);
  return gap <= rounding * geometry::outline_size(discretisation.model.bodies[body].outline);
}

/// Smallest gap before the first increment.
double gap_as_drawn(const Discretisation& discretisation, std::size_t contact) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const mesh::ContactPair& pair : discretisation.mesh.interfaces[contact].pairs)
    smallest = std::min(smallest, pair.gap);
  return smallest;
}

/// Smallest gap of a contact that is open at every pair in every increment; nothing for other contacts, and where the
/// two sides touch without a force.
std::optional<double> smallest_gap(const StaticSolution& solution, std::size_t contact) {
  if (solution.model.contacts[contact].a.kind == model::Place::Kind::face) return {};  // a crack may well be open
  double smallest = std::numeric_limits<double>::infinity();
  for (const IncrementResult& increment : solution.increments) {
    if (!increment.converged) continue;
    const ContactResult& of = increment.contacts[contact];
    if (of.first_in_contact) return {};
    smallest = std::min(smallest, of.min_gap);
  }
  return std::isfinite(smallest) && !touches(solution, contact, smallest) ? std::optional(smallest) : std::nullopt;
}

/// `; as drawn it is 0.002, so that the loads bring the sides nearer`, of the contact that comes nearest.
std::string against_drawing(const StaticSolution& solution, const Finding& nearest) {
  const double drawn = gap_as_drawn(solution, nearest.contact), reached = -nearest.figure;
  if (solution.pairings > 0 || !std::isfinite(drawn)) return "";  // the pairs are not those of the drawing
  constexpr double alike = 1e-3;
  return fmt::format("; as drawn it is {:.3g}: {}", drawn,
                     std::abs(reached - drawn) <= alike * drawn ? "the loads hardly change it"
                     : reached < drawn                          ? "the loads bring the sides nearer, but not together"
                                                                : "the loads take the sides farther apart");
}

/// Contacts that are open at every pair in every increment: those that were apart as drawn, and those that the loads
/// open.
void warn_of_open_contacts(const StaticSolution& solution, std::vector<Warning>& warnings) {
  std::vector<Finding> apart, opened;
  for (std::size_t c = 0; c < solution.model.contacts.size(); ++c)
    if (const auto gap = smallest_gap(solution, c))
      (touches(solution, c, gap_as_drawn(solution, c)) ? opened : apart).push_back({c, -*gap});
  if (!apart.empty())
    warnings.push_back({WarningKind::open_contact, contacts_of(solution, apart),
                        fmt::format("{} never {}: the smallest gap is {:.3g}{}{}", contacts_of(solution, apart),
                                    apart.size() == 1 ? "closes" : "close", -worst_of(apart).figure,
                                    in_worst(solution, apart), against_drawing(solution, worst_of(apart)))});
  if (!opened.empty())
    warnings.push_back(
        {WarningKind::open_contact, contacts_of(solution, opened),
         fmt::format("the loads open {} in the first increment, and no pair closes again: the smallest gap is {:.3g}{}",
                     contacts_of(solution, opened), -worst_of(opened).figure, in_worst(solution, opened))});
}

void warn_of_coarse_zones(const StaticSolution& solution, std::vector<Warning>& warnings) {
  const auto last = std::find_if(solution.increments.rbegin(), solution.increments.rend(),
                                 [](const IncrementResult& increment) { return increment.converged; });
  if (last == solution.increments.rend()) return;
  const auto is_rigid = [&](const model::Place& side) {
    return solution.model.bodies[static_cast<std::size_t>(side.body)].rigid;
  };
  std::vector<Finding> coarse;
  for (std::size_t c = 0; c < last->contacts.size(); ++c) {
    const model::Contact& contact = solution.model.contacts[c];
    if (is_rigid(contact.a) && is_rigid(contact.b)) continue;  // two pairs are all there are
    const int closed = last->contacts[c].stick + last->contacts[c].slip;
    if (closed > 0 && closed < fewest_pairs) coarse.push_back({c, -static_cast<double>(closed)});
  }
  if (coarse.empty()) return;
  const auto fewest = static_cast<int>(-worst_of(coarse).figure);
  warnings.push_back(
      {WarningKind::few_pairs, contacts_of(solution, coarse),
       fmt::format("{}: only {} pair{} {} in contact at the end{}, too few for a reliable pressure, and for a "
                   "reliable force where displacements are prescribed: use a smaller mesh.size or a higher mesh.order, "
                   "so that five or more pairs are in contact",
                   contacts_of(solution, coarse), fewest, fewest == 1 ? "" : "s", fewest == 1 ? "is" : "are",
                   in_worst(solution, coarse))});
}

}  // namespace

namespace {

// Rounding of the forces of one load changes what another causes by about this part of their ratio (errors of half of
// it were seen); it is told from `worth_saying` on.
constexpr double rounding_beside = 1e-14, worth_saying = 3e-5;

/// Largest nodal force of every load, with its largest factor at the end of a step.
std::vector<double> sizes_of_loads(const model::Model& model, const system::Structure& structure) {
  std::vector<double> sizes;
  for (std::size_t load = 0; load < model.loads.size(); ++load) {
    double largest = 0.0, factor = 0.0;
    for (const Vector& forces : structure.loads[load])
      if (forces.size() > 0) largest = std::max(largest, forces.lpNorm<Eigen::Infinity>());
    for (const model::Step& step : model.steps) factor = std::max(factor, std::abs(step.load_factors[load]));
    sizes.push_back(largest * (factor > 0.0 ? factor : 1.0));  // a curve may end at 0
  }
  return sizes;
}

/// Whether temperature strains one of the materials of a body.
bool expands(const model::Model& model, const model::Body& body) {
  const std::set<int> materials = model::materials_of(model, body);
  return std::any_of(materials.begin(), materials.end(), [&](int material) {
    const auto& expansion = model.materials[static_cast<std::size_t>(material)].expansion;
    return expansion && std::any_of(expansion->begin(), expansion->end(), [](double alpha) { return alpha != 0.0; });
  });
}

/// Why a load has neither forces nor strains.
const char* why_zero(const model::Load& load) {
  if (const auto* gravity = std::get_if<model::Gravity>(&load.kind); gravity && !gravity->value.isZero(0.0))
    return "has no effect because the density of all materials that it acts on is 0: give them a density, or leave the "
           "load out";
  if (std::holds_alternative<model::Spin>(load.kind))
    return "has no effect because the spin, or the density of all materials that it acts on, is 0";
  if (std::holds_alternative<model::Temperature>(load.kind))
    return "has no effect because the temperature does not change, or the expansion of all materials that it acts on "
           "is 0";
  return "is zero and has no effect";
}

/// Loads that are so small beside another one that rounding changes or hides what they cause.
void warn_of_lost_loads(const model::Model& model, const system::Structure& structure, std::vector<Warning>& warnings) {
  const std::vector<double> sizes = sizes_of_loads(model, structure);
  if (sizes.empty()) return;
  const auto largest = std::max_element(sizes.begin(), sizes.end());
  std::vector<std::size_t> lost;
  double least = *largest;
  for (std::size_t load = 0; load < sizes.size(); ++load) {
    if (!(sizes[load] > 0.0) || rounding_beside * *largest < worth_saying * sizes[load]) continue;
    lost.push_back(load);
    least = std::min(least, sizes[load]);
  }
  if (lost.empty()) return;
  std::string names = lost.size() == 1 ? "load " : "loads ";
  const std::size_t named = lost.size() <= most_names + 1 ? lost.size() : most_names;
  for (std::size_t i = 0; i < named; ++i) {
    if (i > 0) names += i + 1 == lost.size() ? " and " : ", ";
    names += fmt::format("'{}'", model.loads[lost[i]].name);
  }
  if (named < lost.size()) names += fmt::format(" and {} more", lost.size() - named);
  const double part = rounding_beside * *largest / least;
  const std::string effect = part < 1.0 ? fmt::format("changes what {} by a part of about {:.0e}",
                                                      lost.size() == 1 ? "it causes" : "they cause", part)
                                        : fmt::format("hides what {}", lost.size() == 1 ? "it causes" : "they cause");
  warnings.push_back(
      {WarningKind::rounding, names,
       fmt::format("{}: the nodal forces are only {:.0e} times those of load '{}', whose rounding {}", names,
                   least / *largest, model.loads[static_cast<std::size_t>(largest - sizes.begin())].name, effect)});
}

/// Stiffness of a part against the motion of one node alone; 0 of a rigid one.
double stiffness_of(const system::BodySystem& part) { return part.stiff_force(Vector::Ones(part.size())); }

}  // namespace

std::string stiff_springs(const model::Model& model, const system::Structure& structure, double least) {
  if (model.springs.empty()) return {};
  double stiffest_body = 0.0;
  for (const auto& part : structure.parts) stiffest_body = std::max(stiffest_body, stiffness_of(*part));
  double largest = 0.0;
  std::size_t found = 0;
  for (std::size_t s = 0; s < model.springs.size(); ++s) {
    const std::size_t p = structure.dofs.part_of(model.springs[s].on.body);
    const double held = structure.dofs.is_rigid(p) ? stiffest_body : stiffness_of(*structure.parts[p]);
    const double ratio = held > 0.0 ? Vector(structure.springs.of_spring[s].diagonal()).maxCoeff() / held : 0.0;
    if (ratio > largest) largest = ratio, found = s;
  }
  if (!(largest > least)) return {};
  const model::Spring& spring = model.springs[found];
  const model::Body& body = model.bodies[static_cast<std::size_t>(spring.on.body)];
  return fmt::format(
      "springs '{}' are {:.0e} times as stiff as {}: the rounding of their stiffness may leave forces "
      "unbalanced, except on edges along x or y; use a support instead, or a stiffness of at most {:.0e}",
      spring.name, largest, body.rigid ? std::string("the stiffest elastic body") : fmt::format("body '{}'", body.name),
      std::max(spring.stiffness[0], spring.stiffness[1]) * stiff_beside / largest);
}

double stiffened_in_bending(const mesh::BodyMesh& mesh) {
  constexpr double least_slenderness = 5.0;
  if (mesh.cells.size() != 1 || mesh.cells.front().kind != mesh::CellKind::superelement) return 0.0;
  const mesh::Cell& cell = mesh.cells.front();
  if (cell.is_open()) return 0.0;
  double area = 0.0, perimeter = 0.0, longest = 0.0;
  std::size_t order = 16;
  for (const mesh::LineElement& element : cell.boundary) {
    for (std::size_t i = 0; i + 1 < element.nodes.size(); ++i) {
      const Vec2 from = mesh.nodes[static_cast<std::size_t>(element.nodes[i])] - cell.centre,
                 to = mesh.nodes[static_cast<std::size_t>(element.nodes[i + 1])] - cell.centre;
      area += 0.5 * cross(from, to);
      perimeter += (to - from).norm();
    }
    const double side = (mesh.nodes[static_cast<std::size_t>(element.nodes.back())] -
                         mesh.nodes[static_cast<std::size_t>(element.nodes.front())])
                            .norm();
    if (const std::size_t of_element = element.nodes.size() - 1; of_element < order || side > longest) {
      order = std::min(order, of_element);
      longest = std::max(longest, side);
    }
  }
  if (!(area > 0.0) || order > 2) return 0.0;  // of an unbounded body the ring runs around its hole
  const double slenderness = element::slenderness_of(area, perimeter), depth = std::sqrt(area / slenderness);
  if (slenderness < least_slenderness) return 0.0;
  const double ratio = longest / depth,
               x = order == 1 ? 0.08 * std::pow(ratio * slenderness, 2) : std::min(0.0022 * std::pow(ratio, 3), 0.06);
  return x / (1.0 + x);
}

std::vector<Warning> slender_warnings(const model::Model& model, const mesh::Mesh& mesh) {
  constexpr double worth_telling = 0.01;
  std::vector<std::size_t> found;
  double largest = 0.0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].rigid || model.bodies[b].outside) continue;
    const double part = stiffened_in_bending(mesh.bodies[b]);
    if (!(part > worth_telling)) continue;
    found.push_back(b);
    largest = std::max(largest, part);
  }
  if (found.empty()) return {};
  std::string names = found.size() == 1 ? "body " : "bodies ";
  const std::size_t named = found.size() <= most_names + 1 ? found.size() : most_names;
  for (std::size_t i = 0; i < named; ++i) {
    if (i > 0) names += i + 1 == found.size() ? " and " : ", ";
    names += fmt::format("'{}'", model.bodies[found[i]].name);
  }
  if (named < found.size()) names += fmt::format(" and {} more", found.size() - named);
  return {{WarningKind::slender, names,
           fmt::format("{}: a slender super-element of order 1 or 2 with sides this long bends too little, by up to "
                       "about {:.1g} %: give it mesh {{order: 3}}, or {{kind: fem}}",
                       names, 100.0 * largest)}};
}

std::vector<Warning> load_warnings(const model::Model& model, const system::Structure& structure) {
  std::vector<Warning> warnings;
  warn_of_lost_loads(model, structure, warnings);
  if (std::string text = stiff_springs(model, structure, very_stiff); !text.empty())
    warnings.push_back({WarningKind::rounding, "springs", std::move(text)});
  for (std::size_t load = 0; load < model.loads.size(); ++load) {
    const auto& entering = structure.entering[load];
    if (std::any_of(entering.begin(), entering.end(), [](const auto& of) { return !of.forces.isZero(0.0); })) continue;
    double largest = 0.0, moving = 0.0;
    const auto& initial = structure.initial[load];
    bool inside = std::any_of(initial.begin(), initial.end(), [](const auto& body) { return !body.is_zero(); });
    for (std::size_t b = 0; b < structure.interior[load].size(); ++b)
      for (const element::InteriorLoads& cell : structure.interior[load][b]) {
        const bool heated = !cell.remainders.empty() || !cell.temperature.is_zero();
        inside = inside || !cell.loads.empty() || (heated && expands(model, model.bodies[b]));
      }
    for (std::size_t p = 0; p < structure.parts.size(); ++p) {
      Vector forces = structure.loads[load][p];
      if (forces.size() == 0) continue;
      largest = std::max(largest, forces.lpNorm<Eigen::Infinity>());
      const system::BodySystem& part = *structure.parts[p];
      if (structure.dofs.is_rigid(p)) {
        const Matrix& motions = part.rigid_motions();
        if (motions.cols() > 0) moving = std::max(moving, (motions.transpose() * forces).lpNorm<Eigen::Infinity>());
        if (part.is_flexible()) {
          const Matrix A = part.flexibility({0, 1, 2});
          moving = std::max(moving, (A * forces).lpNorm<Eigen::Infinity>() / A.lpNorm<Eigen::Infinity>());
        }
        continue;
      }
      for (std::size_t c = 0; c < part.constraints().size(); ++c) {
        const system::Constraint& constraint = part.constraints()[c];
        const auto both = [&](const system::Constraint& other) { return other.dof == (constraint.dof ^ 1); };
        auto at = forces.segment<2>(plane_components.first_of_node(constraint.dof));
        if (constraint.component < 0 && std::any_of(part.constraints().begin(), part.constraints().end(), both))
          at.setZero();
        else
          at -= Vec2(constraint.direction().dot(at) * constraint.direction());
      }
      moving = std::max(moving, forces.lpNorm<Eigen::Infinity>());
    }
    if (inside || moving > 1e-12 * largest) continue;
    warnings.push_back({WarningKind::load_without_effect, model.loads[load].name,
                        fmt::format("load '{}' {}", model.loads[load].name,
                                    largest == 0.0 ? why_zero(model.loads[load])
                                                   : "has no effect because all its forces act on supported nodes: "
                                                     "move the load, or free the support there")});
  }
  return warnings;
}

namespace {

/// A point of an elastic body gives way without limit under a force: what moves it by so much has no force of its own.
void warn_of_moved_points(const StaticSolution& solution, std::vector<Warning>& warnings) {
  const auto last = std::find_if(solution.increments.rbegin(), solution.increments.rend(),
                                 [](const IncrementResult& increment) { return increment.converged; });
  if (last == solution.increments.rend()) return;
  constexpr double least = 1e-6;  // of the largest reaction
  double largest = 0.0;
  for (const Vec2& reaction : last->reactions) largest = std::max(largest, reaction.norm());
  for (std::size_t s = 0; s < solution.model.supports.size(); ++s) {
    const model::Support& support = solution.model.supports[s];
    const bool moves = support.displacement[0].value_or(0.0) != 0.0 || support.displacement[1].value_or(0.0) != 0.0;
    const bool point = support.on.kind == model::Place::Kind::corner || support.on.kind == model::Place::Kind::near;
    const model::Body& body = solution.model.bodies[static_cast<std::size_t>(support.on.body)];
    if (!moves || !point || body.rigid || !(last->reactions[s].norm() > least * largest)) continue;
    warnings.push_back(
        {WarningKind::infinite_stress, support.name,
         fmt::format("support '{}' moves a single point of body '{}': its force depends on the mesh, and "
                     "falls with every finer one; move an edge, or give a force",
                     support.name, body.name)});
  }
}

}  // namespace

std::vector<Warning> contact_warnings(const StaticSolution& solution) {
  std::vector<Warning> warnings;
  warn_of_moved_points(solution, warnings);
  warn_of_large_strains(solution, warnings);
  warn_of_open_contacts(solution, warnings);
  warn_of_coarse_zones(solution, warnings);
  return warnings;
}

}  // namespace scabo::analysis
