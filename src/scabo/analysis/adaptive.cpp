#include "scabo/analysis/adaptive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "scabo/analysis/refinement.hpp"
#include "scabo/base/components.hpp"
#include "scabo/element/finite_element.hpp"
#include "scabo/element/two_orders.hpp"
#include "scabo/mesh/crack_faces.hpp"
#include "scabo/mesh/match.hpp"

namespace scabo::analysis {

namespace {

/// Fraction of the tolerance that the estimate must reach, because it is smaller than the error; 0.77 is the least
/// effectivity measured on meshes produced by refinement.
constexpr double aim = 0.7;
/// Fraction of the largest nodal force below which a reaction is rounding.
constexpr double some_reaction = 1e-6;

using Flags = std::vector<std::vector<bool>>;  // [body][cell], or [body][boundary element of all cells, in their order]

/// Displacements of a cell's own nodes.
Vector displacement_of(const StaticSolution& solution, const IncrementResult& increment, std::size_t body,
                       std::size_t cell) {
  return increment.fields.displacements[body](element::dofs_of(solution.mesh.bodies[body].cells[cell]));
}

std::size_t boundary_elements(const mesh::BodyMesh& mesh) {
  std::size_t count = 0;
  for (const mesh::Cell& cell : mesh.cells) count += cell.boundary.size();
  return count;
}

bool is_point(const model::Place& place) {
  return place.kind == model::Place::Kind::corner || place.kind == model::Place::Kind::near;
}

/// Largest reaction of every support over all increments, and the largest force on a node.
struct Reactions {
  std::vector<double> largest;
  double scale = 0.0;
};
Reactions reactions_of(const StaticSolution& solution) {
  Reactions reactions;
  reactions.largest.assign(solution.model.supports.size(), 0.0);
  for (const IncrementResult& increment : solution.increments) {
    for (std::size_t i = 0; i < increment.reactions.size(); ++i) {
      reactions.largest[i] = std::max(reactions.largest[i], increment.reactions[i].norm());
      reactions.scale = std::max(reactions.scale, increment.reactions[i].norm());
    }
    for (std::size_t b = 0; b < solution.cells.size(); ++b)
      for (std::size_t c = 0; c < solution.cells[b].size(); ++c)
        if (const auto& cell = solution.cells[b][c]) {
          const Vector forces = cell->K() * displacement_of(solution, increment, b, c);
          reactions.scale = std::max(reactions.scale, forces.lpNorm<Eigen::Infinity>());
        }
  }
  return reactions;
}

/// Point forces, and similar places with infinite stress (adaptive.hpp).
std::vector<model::Place> singular_places(const StaticSolution& solution) {
  std::vector<model::Place> places;
  for (const model::Load& load : solution.model.loads)
    if (load.on && is_point(*load.on) && std::holds_alternative<model::Force>(load.kind)) places.push_back(*load.on);
  for (const model::Spring& spring : solution.model.springs)
    if (is_point(spring.on)) places.push_back(spring.on);
  const Reactions reactions = reactions_of(solution);
  for (std::size_t i = 0; i < solution.model.supports.size(); ++i) {
    const model::Place& place = solution.model.supports[i].on;
    if (place.kind == model::Place::Kind::near ||
        (place.kind == model::Place::Kind::corner && reactions.largest[i] > some_reaction * reactions.scale))
      places.push_back(place);
  }
  return places;
}

/// Length around a point force in which cells are left out, relative to the size of the first mesh.
constexpr double spread_of_force = 0.15;

/// Cells beside singular places, in bodies of many cells.
Flags left_out_cells(const StaticSolution& solution) {
  const mesh::Mesh& mesh = solution.mesh;
  Flags left_out(mesh.bodies.size());
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) left_out[b].assign(mesh.bodies[b].cells.size(), false);
  for (const model::Place& place : singular_places(solution)) {
    const auto b = static_cast<std::size_t>(place.body);
    const model::Body& body = solution.model.bodies[b];
    if (!has_estimate(solution, b) || !model::is_divided_inside(body)) continue;
    const double radius = body.mesh.tolerance ? spread_of_force * body.mesh.size : 0.0;
    for (const int node : mesh::nodes_of(place, mesh).nodes) {
      const Vec2 at = mesh.bodies[b].nodes[static_cast<std::size_t>(node)];
      for (std::size_t c = 0; c < left_out[b].size(); ++c)
        for (const mesh::LineElement& element : mesh.bodies[b].cells[c].boundary) {
          const int first = element.nodes.front();
          if (first == node || (mesh.bodies[b].nodes[static_cast<std::size_t>(first)] - at).norm() < radius)
            left_out[b][c] = true;
        }
    }
  }
  return left_out;
}

/// Elements of the faces of cracks that face each other are frozen together where tip rings are added.
void freeze_faces_alike(const model::Model& model, const mesh::Mesh& mesh, std::size_t body,
                        std::vector<bool>& frozen) {
  const std::vector<int> cracks = mesh::cracks_with_tractions(model, static_cast<int>(body));
  if (cracks.empty() || frozen.empty()) return;
  std::map<std::vector<int>, std::size_t>
      number;  // of an element, by its nodes; faces run as the boundaries of cells do
  for (const mesh::Cell& cell : mesh.bodies[body].cells)
    for (const mesh::LineElement& element : cell.boundary) number.emplace(element.nodes, number.size());
  for (const int crack : cracks) {
    const auto& right = mesh.bodies[body].faces[static_cast<std::size_t>(2 * crack)];
    const auto& left = mesh.bodies[body].faces[static_cast<std::size_t>(2 * crack + 1)];
    for (std::size_t k = 0; k < left.size(); ++k) {
      const std::size_t a = number.at(left[k].nodes), b = number.at(right[right.size() - 1 - k].nodes);
      frozen[a] = frozen[b] = frozen[a] || frozen[b];
    }
  }
}

}  // namespace

bool has_estimate(const StaticSolution& solution, std::size_t body) { return !solution.cells[body].empty(); }

namespace {

/// frozen_elements() with the places beside which elements are frozen.
Flags frozen_elements(const model::Model& model, const mesh::Mesh& mesh, const std::vector<model::Place>& singular) {
  Flags frozen(mesh.bodies.size());
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b)
    frozen[b].assign(boundary_elements(mesh.bodies[b]), false);  // none of a rigid body
  for (const model::Place& place : singular) {
    const auto b = static_cast<std::size_t>(place.body);
    if (frozen[b].empty()) continue;
    const std::vector<int> nodes = mesh::nodes_of(place, mesh).nodes;
    std::size_t place_in_body = 0;
    for (const mesh::Cell& cell : mesh.bodies[b].cells)
      for (const mesh::LineElement& element : cell.boundary) {
        for (const int node : element.nodes)
          if (std::find(nodes.begin(), nodes.end(), node) != nodes.end()) frozen[b][place_in_body] = true;
        ++place_in_body;
      }
  }
  const mesh::PairedElements paired = mesh::paired_elements(model, mesh);
  const auto flag = [&](const mesh::EdgeElement& at) -> std::vector<bool>::reference {
    const auto b = static_cast<std::size_t>(at.body);
    return frozen[b][static_cast<std::size_t>(mesh::boundary_element(mesh.bodies[b], at.edge, at.element))];
  };
  for (const mesh::EdgeElement& at : paired.alone)
    if (!frozen[static_cast<std::size_t>(at.body)].empty()) flag(at) = true;
  for (const auto& [a, b] : paired.alike) {
    const bool divided_a = !frozen[static_cast<std::size_t>(a.body)].empty(),
               divided_b = !frozen[static_cast<std::size_t>(b.body)].empty();
    if (divided_a != divided_b)
      flag(divided_a ? a : b) = true;  // the other body is rigid
    else if (divided_a && (flag(a) || flag(b)))
      flag(a) = flag(b) = true;
  }
  for (std::size_t b = 0; b < frozen.size(); ++b) freeze_faces_alike(model, mesh, b, frozen[b]);
  return frozen;
}

}  // namespace

Flags frozen_elements(const StaticSolution& solution, bool at_singular_places) {
  return frozen_elements(solution.model, solution.mesh,
                         at_singular_places ? singular_places(solution) : std::vector<model::Place>{});
}

mesh::Mesh raised(const model::Model& model, const mesh::Mesh& mesh) {
  return mesh::enriched(model, mesh, frozen_elements(model, mesh, {}));
}

void hold_near_places(model::Model& model, const mesh::Mesh& mesh) {
  const auto hold = [&](model::Place& place) {
    if (place.kind != model::Place::Kind::near) return;
    const std::vector<int> nodes = mesh::nodes_of(place, mesh).nodes;
    if (!nodes.empty())
      place.near = mesh.bodies[static_cast<std::size_t>(place.body)].nodes[static_cast<std::size_t>(nodes.front())];
  };
  for (model::Support& support : model.supports) hold(support.on);
  for (model::Spring& spring : model.springs) hold(spring.on);
  for (model::Load& load : model.loads)
    if (load.on) hold(*load.on);
}

Options quiet(const Options& options, const std::string& what) {
  Options silent;
  silent.threads = options.threads;
  silent.stop = options.stop;
  silent.on_iteration = options.on_iteration;
  if (options.on_stage)
    silent.on_stage = [&options, what](const std::string& stage) { options.on_stage(what + ": " + stage); };
  return silent;
}

void replay(StaticSolution& solution, const Options& options) {
  if (solution.outcome == Outcome::solved && options.stop && *options.stop) {
    solution.outcome = Outcome::interrupted;
    solution.reason = "interrupted: errors were not computed to the end";
  }
  if (options.on_mesh) options.on_mesh(solution);
  std::vector<IncrementResult> increments = std::move(solution.increments);
  solution.increments.clear();
  for (IncrementResult& increment : increments) {
    solution.increments.push_back(std::move(increment));
    if (options.on_increment) options.on_increment(solution, solution.increments.back());
  }
}

namespace {

/// Elements of refined bodies of one super-element that end at the corner of a point force.
std::vector<mesh::EdgeElement> elements_at_forces(const model::Model& model, const mesh::Division& division) {
  std::vector<mesh::EdgeElement> elements;
  for (const model::Load& load : model.loads) {
    if (!load.on || load.on->kind != model::Place::Kind::corner || !std::holds_alternative<model::Force>(load.kind))
      continue;
    const int b = load.on->body, corner = load.on->index;
    const mesh::BodyDivision& body = division[static_cast<std::size_t>(b)];
    if (!model.bodies[static_cast<std::size_t>(b)].mesh.tolerance || body.empty()) continue;
    const int count = static_cast<int>(body.size()), before = (corner + count - 1) % count;
    elements.push_back({b, corner, 0});
    elements.push_back({b, before, static_cast<int>(body[static_cast<std::size_t>(before)].orders.size()) - 1});
  }
  return elements;
}

/// The analysis on the mesh of higher order; nothing, with the reason in `why`, if it does not have the same
/// increments.
std::optional<StaticSolution> solve_wider(const StaticSolution& solution, const Options& options,
                                          const std::string& what, std::string& why) {
  try {
    mesh::Mesh mesh = mesh::enriched(solution.model, solution.mesh, frozen_elements(solution, true));
    StaticSolution wider = solve_on_mesh(solution.model, std::move(mesh), quiet(options, what));
    if (wider.outcome == Outcome::solved) return wider;
    why = wider.reason;
  } catch (const InputError& error) {
    why = error.diagnostics().empty() ? error.what() : error.diagnostics().front().message;
  }
  return std::nullopt;
}

void warn_of_point_forces(StaticSolution& solution) {
  std::map<std::string, bool> places;  // whether in a body of many cells
  const auto add = [&](const model::Place& place) {
    const auto b = static_cast<std::size_t>(place.body);
    if (has_estimate(solution, b)) places[place.text] = model::is_divided_inside(solution.model.bodies[b]);
  };
  for (const model::Load& load : solution.model.loads)
    if (load.on && is_point(*load.on) && std::holds_alternative<model::Force>(load.kind)) add(*load.on);
  for (const auto& [place, in_cells] : places)
    solution.warnings.push_back(
        {WarningKind::infinite_stress, place,
         fmt::format("stress under the point force at {} is infinite: for the estimated error {}", place,
                     in_cells ? "the adjacent cells are left out"
                              : "the force is distributed over the adjacent elements, which are not refined")});
}

/// Error measures that control refinement.
struct Judgement {
  double sum = 0.0;    ///< eq. (1) of the worst increment
  double error = 0.0;  ///< largest relative error of the whole model
  std::size_t worst = 0;
};
Judgement judge(const StaticSolution& solution) {
  Judgement judgement;
  for (std::size_t i = 0; i < solution.increments.size(); ++i) {
    const auto& error = solution.increments[i].error;
    if (!error) continue;
    double sum = 0.0;
    for (std::size_t b = 0; b < solution.model.bodies.size(); ++b)
      if (const auto& tolerance = solution.model.bodies[b].mesh.tolerance; tolerance && error->bodies[b])
        sum += std::pow(error->bodies[b]->relative / *tolerance, 2);
    if (sum > judgement.sum) judgement.sum = sum, judgement.worst = i;
    judgement.error = std::max(judgement.error, error->relative);
  }
  return judgement;
}

/// The boundary and the stiffness of a cell, in the numbers of its own nodes; of a finite element, too.
struct CellStiffness {
  std::vector<mesh::LineElement> elements;
  Matrix k;
};
CellStiffness stiffness_of(const StaticSolution& solution, std::size_t b, std::size_t c) {
  if (const auto& cell = solution.cells[b][c]) return {cell->ring.elements, cell->K()};
  const mesh::BodyMesh& mesh = solution.mesh.bodies[b];
  const mesh::Cell& cell = mesh.cells[c];
  std::map<int, int> own;
  for (const int node : cell.nodes()) own.emplace(node, static_cast<int>(own.size()));
  CellStiffness made{cell.boundary, Matrix::Zero(2 * static_cast<Eigen::Index>(own.size()),
                                                 2 * static_cast<Eigen::Index>(own.size()))};
  for (mesh::LineElement& element : made.elements)
    for (int& node : element.nodes) node = own.at(node);
  const element::FiniteElement finite = element::finite_element_of(cell, mesh.nodes);
  const model::Material& material = solution.model.materials[static_cast<std::size_t>(cell.materials.front())];
  const auto& analysis = solution.model.analysis;
  const element::ElementMatrix k = element::finite_element_stiffness(
      finite, element::elasticity_matrix(material, analysis.plane), analysis.thickness);
  std::vector<int> dofs;
  for (const int node : finite.nodes())
    for (const int component : {0, 1}) dofs.push_back(static_cast<int>(place_of(own.at(node), component)));
  made.k(dofs, dofs) = k;
  return made;
}

/// Squared errors of the cells of a body, force times length; 0 for those left out.
std::vector<double> squared_errors(const StaticSolution& solution, const IncrementResult& increment,
                                   const StaticSolution& wider, const IncrementResult& wider_increment, std::size_t b,
                                   const std::vector<bool>& left_out) {
  std::vector<double> squared;
  for (std::size_t c = 0; c < solution.cells[b].size(); ++c) {
    if (left_out[c]) {
      squared.push_back(0.0);
      continue;
    }
    // Loads inside a cell are not among the forces on its boundary.
    const bool relaxed = !element::loads_in(increment.fields.interior[b], c).acts();
    squared.push_back(squared_difference(solution, increment.fields.displacements[b], wider,
                                         wider_increment.fields.displacements[b], b, c, relaxed));
  }
  return squared;
}

/// Parts that boundary elements, or cells, have in the sum in the worst increment.
MeshErrors errors_of(const StaticSolution& solution, const StaticSolution& wider, std::size_t worst) {
  MeshErrors errors{solution.mesh, {}, frozen_elements(solution, true)};
  errors.shares.resize(solution.model.bodies.size());
  const IncrementResult &increment = solution.increments[worst], &wider_increment = wider.increments[worst];
  for (std::size_t b = 0; b < errors.shares.size(); ++b) {
    const model::Body& body = solution.model.bodies[b];
    if (!body.mesh.tolerance || !has_estimate(solution, b)) continue;
    const std::vector<double> of_parts = model::is_divided_inside(body)
                                             ? cell_errors(solution, increment, wider, wider_increment, b)
                                             : element_errors(solution, increment, wider, wider_increment, b);
    for (const double error : of_parts) errors.shares[b].push_back(std::pow(error / *body.mesh.tolerance, 2));
  }
  return errors;
}

StaticSolution not_reached(StaticSolution solution, const std::string& why) {
  if (solution.outcome != Outcome::solved) return solution;
  solution.outcome = Outcome::not_converged;
  solution.reason = fmt::format("mesh.tolerance was not reached: {}", why);
  return solution;
}

}  // namespace

bool wants_refinement(const model::Model& model) {
  return std::any_of(model.bodies.begin(), model.bodies.end(),
                     [](const model::Body& body) { return body.mesh.tolerance.has_value(); });
}

void check_refinable(const model::Model& model, const mesh::Mesh& mesh) {
  if (!wants_refinement(model)) return;
  std::vector<Diagnostic> mistakes;
  const std::vector<mesh::Joint> joints = mesh::joints_of(model);
  const auto is_refined_alike = [&](const mesh::EdgeElement& at) {
    const auto is_side = [&](const model::Place& place) { return place.body == at.body && place.index == at.edge; };
    return std::any_of(joints.begin(), joints.end(), [&](const mesh::Joint& joint) {
      return (is_side(joint.a) || is_side(joint.b)) && mesh::is_refined_alike(model, joint);
    });
  };
  for (const mesh::EdgeElement& at : mesh::paired_elements(model, mesh).alone) {
    const model::Body& body = model.bodies[static_cast<std::size_t>(at.body)];
    if (!is_refined_alike(at) || !mistakes.empty()) continue;
    const std::string edge = body.name + "." + body.outline.edges[static_cast<std::size_t>(at.edge)].names.back();
    mistakes.push_back(
        {body.mesh.source,
         fmt::format(
             "element {} of {} has no matching element on the other side of its contact or tie, so that the two sides "
             "cannot be refined alike: give both bodies the same 'size' and 'order', and let the ends of the "
             "shorter edge fall on ends of elements of the longer one",
             at.element + 1, edge)});
  }
  if (!mistakes.empty()) throw InputError(model.file, std::move(mistakes));
}

namespace {

ErrorEstimate estimate(const StaticSolution& solution, const IncrementResult& increment, const StaticSolution& wider,
                       const IncrementResult& wider_increment, const Flags& left_out) {
  ErrorEstimate error;
  error.bodies.resize(solution.model.bodies.size());
  std::vector<double> squared(error.bodies.size(), 0.0);
  double energy = 0.0;
  for (std::size_t b = 0; b < error.bodies.size(); ++b) {
    if (!has_estimate(solution, b)) continue;
    for (const double of_cell : squared_errors(solution, increment, wider, wider_increment, b, left_out[b]))
      squared[b] += of_cell;
    for (std::size_t c = 0; c < solution.cells[b].size(); ++c) {
      const Vector U = displacement_of(wider, wider_increment, b, c);
      energy += U.dot(wider.cells[b][c]->K() * U);
    }
  }
  // Loads inside have energy too.
  energy = std::max(energy, 2.0 * wider_increment.energy.elastic);
  const double norm = std::sqrt(energy);
  const auto relative = [&](double square) { return norm > 0.0 ? std::sqrt(square) / norm : 0.0; };
  error.relative = relative(std::accumulate(squared.begin(), squared.end(), 0.0));
  for (std::size_t b = 0; b < error.bodies.size(); ++b)
    if (has_estimate(solution, b)) error.bodies[b] = BodyError{std::sqrt(squared[b]), relative(squared[b])};
  return error;
}

void estimate_all(StaticSolution& solution, const StaticSolution& wider) {
  const Flags left_out = left_out_cells(solution);
  for (std::size_t i = 0; i < std::min(solution.increments.size(), wider.increments.size()); ++i)
    if (solution.increments[i].converged && wider.increments[i].converged)
      solution.increments[i].error = estimate(solution, solution.increments[i], wider, wider.increments[i], left_out);
}

}  // namespace

double squared_difference(const StaticSolution& solution, const Vector& u, const StaticSolution& wider, const Vector& U,
                          std::size_t body, std::size_t cell, bool relaxed) {
  const CellStiffness narrow = stiffness_of(solution, body, cell);
  const element::SolvedSuperElement& wide = *wider.cells[body][cell];
  return element::squared_difference({narrow.elements, narrow.k,
                                      u(element::dofs_of(solution.mesh.bodies[body].cells[cell])), wide.ring.elements,
                                      wide.K(), U(element::dofs_of(wider.mesh.bodies[body].cells[cell])), relaxed});
}

ErrorEstimate estimate(const StaticSolution& solution, const IncrementResult& increment, const StaticSolution& wider,
                       const IncrementResult& wider_increment) {
  return estimate(solution, increment, wider, wider_increment, left_out_cells(solution));
}

std::vector<double> element_errors(const StaticSolution& solution, const IncrementResult& increment,
                                   const StaticSolution& wider, const IncrementResult& wider_increment,
                                   std::size_t body) {
  std::vector<double> errors;
  for (std::size_t c = 0; c < solution.cells[body].size(); ++c) {
    const element::SolvedSuperElement &narrow = *solution.cells[body][c], &wide = *wider.cells[body][c];
    const Vector u = displacement_of(solution, increment, body, c),
                 U = displacement_of(wider, wider_increment, body, c);
    for (const double error :
         element::sector_differences({narrow.ring, narrow.solution(), narrow.modes(), u},
                                     {wide.ring, wide.solution(), wide.modes(), U}, wide.sectors.D))
      errors.push_back(error);
  }
  const double sum = std::accumulate(errors.begin(), errors.end(), 0.0);
  for (double& error : errors)
    error = sum > 0.0 ? increment.error->bodies[body]->relative * std::sqrt(error / sum) : 0.0;
  return errors;
}

std::vector<double> cell_errors(const StaticSolution& solution, const IncrementResult& increment,
                                const StaticSolution& wider, const IncrementResult& wider_increment, std::size_t body) {
  const BodyError& whole = *increment.error->bodies[body];
  std::vector<double> errors =
      squared_errors(solution, increment, wider, wider_increment, body, left_out_cells(solution)[body]);
  for (double& error : errors) error = error > 0.0 ? std::sqrt(error) * whole.relative / whole.absolute : 0.0;
  return errors;
}

StaticSolution solve_with_error(model::Model model, mesh::Mesh mesh, const Options& options) {
  hold_near_places(model, mesh);
  StaticSolution solution = solve_on_mesh(std::move(model), std::move(mesh), quiet(options, "mesh"));
  std::string why;
  if (solution.outcome == Outcome::solved) {
    if (const auto wider = solve_wider(solution, options, "error", why))
      estimate_all(solution, *wider);
    else
      solution.warnings.push_back(
          {WarningKind::no_estimate, "", fmt::format("no error was estimated: on the mesh of higher order, {}", why)});
    warn_of_point_forces(solution);
  }
  replay(solution, options);
  return solution;
}

namespace {

/// Solution and estimate of one pass; without `wider` the loop ends with `solution`.
struct SolvedPass {
  StaticSolution solution;
  std::optional<StaticSolution> wider;
};

/// Solve and estimate.
SolvedPass solve_pass(const model::Model& model, mesh::Mesh mesh, const Options& options, const std::string& name) {
  SolvedPass pass{solve_on_mesh(model, std::move(mesh), quiet(options, name)), {}};
  if (pass.solution.outcome != Outcome::solved) return pass;
  std::string why;
  pass.wider = solve_wider(pass.solution, options, name + ", error", why);
  if (pass.wider) {
    estimate_all(pass.solution, *pass.wider);
  } else if (options.stop && *options.stop) {
    pass.solution.outcome = Outcome::interrupted;
    pass.solution.reason = "interrupted: the results are those of a mesh whose error is not known";
  } else {
    pass.solution =
        not_reached(std::move(pass.solution), "no error was estimated: on the mesh of higher order, " + why);
  }
  return pass;
}

/// Why no further pass is made after those of which `sums` are those of eq. (1); empty if one is.
std::string obstacle_after(const std::vector<double>& sums, const RefinementLimits& limits, const std::string& at) {
  const auto back = static_cast<std::size_t>(limits.without_progress);
  if (sums.size() > back && sums.back() > 0.8 * sums[sums.size() - 1 - back])
    return at + ", and further refinement does not reduce it";
  if (static_cast<int>(sums.size()) == limits.passes) return fmt::format("after {} passes {}", limits.passes, at);
  return {};
}

/// Why the next mesh is not made; empty if it is.
std::string too_fine(const ModelRefinement& next, const mesh::Mesh& mesh, const RefinementLimits& limits,
                     const std::string& at) {
  int present = 0;
  for (const mesh::BodyMesh& body : mesh.bodies)
    if (body.cells.size() == 1) present = std::max(present, 2 * static_cast<int>(body.nodes.size()));
  const int dofs = next.boundaries.largest_body(), of_cells = next.cells.largest_body();
  const auto text = [&](const char* about, int would, int most) {
    return fmt::format("{}; a finer mesh would have {}{} in one body, more than {}", at, about, would, most);
  };
  if (dofs > std::max(limits.dofs, present)) return text("", dofs, limits.dofs);
  if (of_cells > limits.dofs_of_cells) return text("about ", of_cells, limits.dofs_of_cells);
  return {};
}

}  // namespace

StaticSolution solve_refined(model::Model model, const Options& options, const RefinementLimits& limits) {
  ModelRefinement refinement(model);
  mesh::Mesh mesh = refinement.mesh();
  hold_near_places(model, mesh);
  refinement.boundaries.divide_at_corners(mesh, elements_at_forces(model, refinement.boundaries.division()));
  for (const model::Load& load : model.loads)
    if (load.on && is_point(*load.on) && std::holds_alternative<model::Force>(load.kind))
      refinement.cells.divide_at(mesh, *load.on, spread_of_force);
  mesh = refinement.mesh();
  std::vector<RefinementPass> passes;
  std::vector<double> sums;
  const auto end = [&](StaticSolution solution) {
    solution.passes = passes;
    if (solution.outcome != Outcome::interrupted) warn_of_point_forces(solution);
    replay(solution, options);
    return solution;
  };
  std::optional<StaticSolution> last;
  while (true) {
    SolvedPass pass;
    try {
      if (last) mesh = refinement.mesh();
      pass = solve_pass(model, std::move(mesh), options, fmt::format("pass {}", passes.size() + 1));
    } catch (const InputError& error) {
      if (!last) throw;
      return end(not_reached(std::move(*last), error.diagnostics().front().message));
    }
    auto& [solution, wider] = pass;
    if (!wider && last && solution.outcome == Outcome::interrupted && solution.increments.empty()) {
      last->outcome = Outcome::interrupted;
      last->reason = "interrupted: the tolerance is not reached";
      return end(std::move(*last));
    }
    if (!wider) return end(std::move(solution));
    const Judgement judgement = judge(solution);
    passes.push_back({2 * solution.mesh.nodes(), judgement.error, 0, 0});
    sums.push_back(judgement.sum);
    if (judgement.sum <= aim * aim) return end(std::move(solution));

    const std::string at =
        fmt::format("the estimated error is {:.3g} with {} degrees of freedom", judgement.error, passes.back().dofs);
    std::string obstacle = obstacle_after(sums, limits, at);
    if (obstacle.empty()) {
      const MeshErrors errors = errors_of(solution, *wider, judgement.worst);
      const RefinementPass refined = refinement.refine(errors, mark(refinement.parts(errors)));
      passes.back().raised = refined.raised;
      passes.back().divided = refined.divided;
      obstacle = refined.raised + refined.divided == 0 ? at + ", and no element can be refined further"
                                                       : too_fine(refinement, solution.mesh, limits, at);
    }
    // Where refinement cannot continue, an estimate between the aim and the tolerance is accepted.
    if (!obstacle.empty())
      return end(judgement.sum <= 1.0 ? std::move(solution) : not_reached(std::move(solution), obstacle));
    last = std::move(solution);
  }
}

}  // namespace scabo::analysis
