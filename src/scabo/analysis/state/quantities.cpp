#include "scabo/analysis/state/quantities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/analysis/state/balance.hpp"
#include "scabo/analysis/state/cracks.hpp"
#include "scabo/analysis/state/step_factors.hpp"
#include "scabo/base/components.hpp"
#include "scabo/element/cell_locator.hpp"
#include "scabo/element/plane/elasticity.hpp"
#include "scabo/linalg/general_solver.hpp"
#include "scabo/mesh/plane/output_points.hpp"

namespace scabo::analysis {

namespace {

using Kind = model::Quantity::Kind;

/// Bodies that hold the point of a quantity.
std::vector<int> bodies_of(const model::Model& model, const model::Quantity& quantity) {
  if (quantity.index >= 0) return {quantity.index};
  std::vector<int> bodies;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (mesh::holds(model.bodies[b], quantity.at)) bodies.push_back(static_cast<int>(b));
  return bodies;
}

/// Whether a crack tip has the name of a quantity, which may leave out the end if the crack has one tip only.
bool is_named(const std::string& tip, const model::Model& model, const model::Quantity& quantity) {
  const std::string name = model.bodies[static_cast<std::size_t>(quantity.index)].name + "." + quantity.crack;
  return tip == name || tip == name + ".start" || tip == name + ".end";
}

/// Displacement of a place in a cell, for displacements of the nodes of the cell.
Vec2 displacement_at(const Discretisation& discretisation, std::size_t b, const element::CellPlace& place,
                     const Vector& u, const element::InteriorLoads& interior) {
  const mesh::BodyMesh& mesh = discretisation.mesh.bodies[b];
  if (const auto& cell = discretisation.cells[b][place.cell]) {
    const Vec2& centre = mesh.cells[place.cell].centre;
    const element::RadialField field(cell->solution(), cell->modes(),
                                     interior.without_particular(cell->ring, centre, u), interior.loads,
                                     interior.motion);
    const Vec2 relative = element::point_values(cell->ring, field.at(place.scaled.xi), cell->sectors.D,
                                                place.scaled.element, place.scaled.eta)
                              .displacement;
    if (interior.remainders.empty()) return relative;
    const Vec2 x =
        centre + place.scaled.xi * element::boundary_position(cell->ring, place.scaled.element, place.scaled.eta);
    return relative + interior.particular_displacement(x);
  }
  const element::FiniteElement of = element::finite_element_of(mesh.cells[place.cell], mesh.nodes);
  return element::finite_element_values(of, u, element::SectionLaw(), place.natural).displacement;
}

std::vector<int> dofs_at(const Discretisation& discretisation, std::size_t b, std::size_t cell) {
  const mesh::BodyMesh& mesh = discretisation.mesh.bodies[b];
  return discretisation.cells[b][cell] ? element::dofs_of(mesh.cells[cell])
                                       : element::dofs_of(element::finite_element_of(mesh.cells[cell], mesh.nodes));
}

std::optional<double> displacement_of_point(const Discretisation& discretisation, const IncrementResult& increment,
                                            const model::Quantity& quantity) {
  const auto b = static_cast<std::size_t>(bodies_of(discretisation.model, quantity).front());
  const model::Body& body = discretisation.model.bodies[b];
  if (increment.is_absent(static_cast<int>(b))) return std::nullopt;
  const Vector& u = increment.fields.displacements[b];
  Vec2 at = Vec2::Zero();
  if (body.rigid) {
    const Vec2 arm = quantity.at - body.outline.centroid();
    at = Vec2(u[0] - u[2] * arm.y(), u[1] + u[2] * arm.x());
  } else {
    const auto place =
        element::CellLocator(discretisation.mesh.bodies[b], discretisation.cells[b]).nearest(quantity.at);
    at = displacement_at(discretisation, b, place, u(dofs_at(discretisation, b, place.cell)),
                         element::loads_in(increment.fields.interior[b], place.cell));
  }
  return (at - increment.fields.reference_displacement(b))[quantity.component];
}

/// The results at the tip or corner that a quantity names; null where its body is absent.
const CrackResult* tip_of(const model::Model& model, const IncrementResult& increment,
                          const model::Quantity& quantity) {
  const auto found = std::find_if(increment.cracks.begin(), increment.cracks.end(),
                                  [&](const CrackResult& crack) { return is_named(crack.name, model, quantity); });
  return found == increment.cracks.end() ? nullptr : &*found;
}

/// Whether a tip of this kind has the figure; summary.json gives each kind other ones.
bool has_figure(element::CornerKind kind, const model::Quantity& quantity) {
  switch (quantity.kind) {
    case Kind::corner_stress:
      return kind == element::CornerKind::corner;
    case Kind::t_stress:
      return kind == (quantity.component == 0 ? element::CornerKind::crack : element::CornerKind::interface_crack);
    default:
      return kind != element::CornerKind::corner;
  }
}

std::optional<double> figure_of(const element::StressIntensity& factors, const model::Quantity& quantity) {
  if (!has_figure(factors.kind, quantity)) return std::nullopt;
  switch (quantity.kind) {
    case Kind::t_stress:
      return quantity.component == 2 ? factors.T_right : factors.T_left;
    case Kind::energy_release:
      return quantity.component == 0 ? factors.G : factors.J;
    default: {
      const double factor = quantity.component == 0 ? factors.K_I : factors.K_II;
      return std::isfinite(factor) ? std::optional(factor) : std::nullopt;
    }
  }
}

}  // namespace

std::optional<double> value_of(const Discretisation& discretisation, const IncrementResult& increment,
                               const model::Quantity& quantity) {
  const auto index = static_cast<std::size_t>(std::max(quantity.index, 0));
  switch (quantity.kind) {
    case Kind::normal_force:
    case Kind::tangential_force:
    case Kind::max_gap:
    case Kind::contact_force:
    case Kind::contact_moment:
    case Kind::centre_of_pressure:
    case Kind::max_pressure:
    case Kind::pairs_in_state:
    case Kind::broken_pairs:
    case Kind::end_pair:
    case Kind::pore_force:
    case Kind::total_normal_force:
      return value_in(increment.contacts[index], quantity);
    case Kind::reaction:
      return increment.reactions[index][quantity.component];
    case Kind::support_moment:
      return increment.moments[index];
    case Kind::spring_force:
      return increment.springs[index][quantity.component];
    case Kind::bar_tension:
      return increment.bars[index];
    case Kind::displacement:
      return displacement_of_point(discretisation, increment, quantity);
    case Kind::velocity:
      return displacement_of_point(discretisation, with_velocities(increment), quantity);
    case Kind::stress:
      break;  // result/history.cpp, which recovers it
    case Kind::ground_velocity:
      return ground_velocity(discretisation.model, static_cast<std::size_t>(increment.step) - 1, increment.reached,
                             static_cast<std::size_t>(quantity.component));
    case Kind::stress_intensity:
    case Kind::t_stress:
    case Kind::energy_release:
    case Kind::corner_stress:
      if (const CrackResult* tip = tip_of(discretisation.model, increment, quantity))
        return figure_of(tip->factors, quantity);
      return std::nullopt;
    case Kind::elastic_energy:
      return increment.energy.elastic;
    case Kind::external_energy:
      return increment.energy.external;
    case Kind::friction_energy:
      return increment.energy.friction;
    case Kind::energy_in_time: {
      const Energy& energy = increment.energy;
      const double in_time[] = {energy.kinetic, energy.damping, energy.impact, energy.projection, energy.massless};
      return in_time[quantity.component];
    }
  }
  return std::nullopt;
}

double rounding_of(const Discretisation& discretisation, const IncrementResult& increment,
                   const model::Quantity& quantity, double tolerance) {
  double largest = 0.0;
  const auto take = [&](double value) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  };
  switch (quantity.kind) {
    case Kind::normal_force:
    case Kind::tangential_force:
    case Kind::reaction:
      for (const ContactResult& contact : increment.contacts)
        take(contact.normal_force), take(contact.tangential_force);
      for (const Vec2& reaction : increment.reactions) take(reaction.x()), take(reaction.y());
      break;
    case Kind::max_gap:
    case Kind::displacement:
      for (std::size_t b = 0; b < increment.fields.displacements.size(); ++b)
        if (!discretisation.model.bodies[b].rigid && increment.fields.displacements[b].size() > 0)
          take(increment.fields.displacements[b].lpNorm<Eigen::Infinity>());
      break;
    case Kind::stress_intensity:
      for (const CrackResult& crack : increment.cracks)
        if (is_named(crack.name, discretisation.model, quantity)) take(crack.factors.K_I), take(crack.factors.K_II);
      break;
    case Kind::elastic_energy:
      take(increment.energy.elastic);
      break;
    default:
      throw BrokenInvariant("a number without an error bar");
  }
  return tolerance * largest;
}

namespace {

/// Force of the contact on a pair, or its gap, as a function of p and u.
void add_contact(const Prepared& prepared, const State& state, const model::Quantity& quantity, Functional& of) {
  int widest = -1;  // the open pair with the largest gap
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    if (prepared.contact.pairs[i].contact != quantity.index) continue;
    const auto k = static_cast<Eigen::Index>(i);
    if (quantity.kind == Kind::normal_force) of.c_p[place_of(k)] = 1.0;
    if (quantity.kind == Kind::tangential_force) of.c_p[place_of(k, 1)] = 1.0;
    if (state.states[i] == contact::ContactState::open && (widest < 0 || state.gap[k] > state.gap[widest]))
      widest = static_cast<int>(i);
  }
  if (quantity.kind != Kind::max_gap || widest < 0) return;
  Vector gap = Vector::Zero(of.c_p.size());
  gap[place_of(widest)] = 1.0;
  for (std::size_t p = 0; p < of.c.size(); ++p) of.c[p] += prepared.contact.motion[p].transpose() * gap;
}

/// The displacement phi of every part with its support moved by 1. The reaction does the work of all other forces on
/// phi, with the opposite sign.
void add_reaction(const Prepared& prepared, const model::Quantity& quantity, Functional& of) {
  for (std::size_t p = 0; p < of.c.size(); ++p) {
    const system::BodySystem& part = *prepared.structure.parts[p];
    Vector moved = Vector::Zero(static_cast<Eigen::Index>(part.constraints().size()));
    for (std::size_t c = 0; c < part.constraints().size(); ++c) {
      const system::Constraint& constraint = part.constraints()[c];
      if (constraint.support == quantity.index && !constraint.rotation)
        moved[static_cast<Eigen::Index>(c)] = constraint.direction()[quantity.component];
    }
    if (moved.isZero()) continue;
    const Vector phi = part.displacement(Vector::Zero(part.size()), moved);
    of.r[p] -= phi;
    of.c_p -= prepared.contact.motion[p] * phi;
  }
}

/// Numbers in its part of degrees of freedom of a body.
std::vector<int> in_part(const system::Dofs& dofs, int body, std::vector<int> of_body) {
  for (int& dof : of_body) dof = dofs.of(body, plane_components.node_of(dof), plane_components.component_of(dof));
  return of_body;
}

void add_displacement(const Prepared& prepared, const model::Quantity& quantity, Functional& of) {
  const int body = bodies_of(prepared.model, quantity).front();
  const auto b = static_cast<std::size_t>(body);
  const system::Dofs& dofs_of = prepared.structure.dofs;
  Vector& c = of.c[dofs_of.part_of(body)];
  if (prepared.model.bodies[b].rigid) {
    const system::BodySystem& part = *prepared.structure.parts[dofs_of.part_of(body)];
    c += system::rigid_point(quantity.at, part.reference(), part.lever()).row(quantity.component).transpose();
    return;
  }
  const auto place =
      element::CellLocator(prepared.mesh.bodies[b], prepared.discretisation.cells[b]).nearest(quantity.at);
  const std::vector<int> dofs = in_part(dofs_of, body, dofs_at(prepared.discretisation, b, place.cell));
  Vector unit = Vector::Zero(static_cast<Eigen::Index>(dofs.size()));
  for (Eigen::Index k = 0; k < unit.size(); ++k) {
    unit[k] = 1.0;
    c[dofs[static_cast<std::size_t>(k)]] +=
        displacement_at(prepared.discretisation, b, place, unit, {})[quantity.component];
    unit[k] = 0.0;
  }
}

void add_stress_intensity(const Prepared& prepared, const model::Quantity& quantity, Functional& of) {
  const auto b = static_cast<std::size_t>(quantity.index);
  const mesh::BodyMesh& mesh = prepared.mesh.bodies[b];
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto& cell = prepared.discretisation.cells[b][c];
    if (!cell || !cell->ring.is_open()) continue;
    if (!is_named(name_of_tip(prepared.model.bodies[b], mesh.cells[c].centre), prepared.model, quantity)) continue;
    const system::Dofs& dofs_of = prepared.structure.dofs;
    const std::vector<int> dofs = in_part(dofs_of, quantity.index, element::dofs_of(mesh.cells[c]));
    Vector& c_part = of.c[dofs_of.part_of(quantity.index)];
    Vector unit = Vector::Zero(static_cast<Eigen::Index>(dofs.size()));
    for (Eigen::Index k = 0; k < unit.size(); ++k) {
      unit[k] = 1.0;
      const element::StressIntensity factors = cell->factors(unit);
      c_part[dofs[static_cast<std::size_t>(k)]] += quantity.component == 0 ? factors.K_I : factors.K_II;
      unit[k] = 0.0;
    }
    return;
  }
}

/// K u, the forces on all nodes, less those of temperatures. What a spring between sides takes of one it stores itself.
void add_energy(const Prepared& prepared, const State& state, Functional& of) {
  Vector of_pairs = state.p;
  for (Eigen::Index i = 0; i < prepared.contact.softness.size(); ++i)
    if (prepared.contact.softness[i] > 0.0) of_pairs[place_of(i)] = 0.0;
  for (std::size_t p = 0; p < of.c.size(); ++p) {
    of.c[p] += state.forces[p] + prepared.contact.motion[p].transpose() * of_pairs;
    if (const Vector thermal = thermal_forces(prepared, state.factors, p); thermal.size() > 0) of.c[p] -= thermal;
    if (!prepared.structure.dofs.is_rigid(p))
      system::add_reactions(prepared.structure.parts[p]->constraints(), state.reactions[p], of.c[p]);
  }
}

/// T and S of eq. (2): forces that change and motions that do not, 2N x k.
struct HeldPairs {
  Eigen::SparseMatrix<double> T, S;
};
HeldPairs held_pairs(const Prepared& prepared, const State& state) {
  std::vector<Eigen::Triplet<double>> of_T, of_S;
  const contact::JointLaws laws = laws_at(prepared, state.factors);
  int column = 0;
  for (std::size_t i = 0; i < state.states.size(); ++i) {
    const int n = 2 * static_cast<int>(i), t = n + 1;
    if (state.states[i] == contact::ContactState::open) continue;
    of_T.emplace_back(n, column, 1.0);
    of_S.emplace_back(n, column, 1.0);
    if (state.states[i] == contact::ContactState::slip) {
      const contact::Limits limits = laws.of_pair[i]->limits(state.history[i]);
      const double p_t = state.p[t], mu = p_t > 0.0 ? limits.mu_backward.value_or(limits.mu) : limits.mu;
      if (mu > 0.0 && p_t != 0.0) of_T.emplace_back(t, column, std::copysign(mu, p_t));
    } else {
      of_T.emplace_back(t, ++column, 1.0);
      of_S.emplace_back(t, column, 1.0);
    }
    ++column;
  }
  HeldPairs held;
  for (auto [matrix, entries] : {std::pair(&held.T, &of_T), std::pair(&held.S, &of_S)}) {
    matrix->resize(state.p.size(), column);
    matrix->setFromTriplets(entries->begin(), entries->end());
  }
  return held;
}

}  // namespace

Functional derivative_of(const Prepared& prepared, const State& state, const model::Quantity& quantity) {
  Functional of;
  for (const auto& part : prepared.structure.parts) of.c.push_back(Vector::Zero(part->size()));
  of.r = of.c;
  of.c_p = Vector::Zero(state.p.size());
  switch (quantity.kind) {
    case Kind::normal_force:
    case Kind::tangential_force:
    case Kind::max_gap:
      add_contact(prepared, state, quantity, of);
      break;
    case Kind::reaction:
      add_reaction(prepared, quantity, of);
      break;
    case Kind::displacement:
      add_displacement(prepared, quantity, of);
      break;
    case Kind::stress_intensity:
      add_stress_intensity(prepared, quantity, of);
      break;
    case Kind::elastic_energy:
      add_energy(prepared, state, of);
      break;
    default:
      throw BrokenInvariant("a number without an error bar");
  }
  return of;
}

std::vector<Vector> dual_displacements(const Prepared& prepared, const State& state, const Functional& functional) {
  const system::ContactSystem& contact = prepared.contact;
  const auto& parts = prepared.structure.parts;
  const auto free = [&](std::size_t p, const Vector& forces) {
    return parts[p]->displacement(forces, Vector::Zero(static_cast<Eigen::Index>(parts[p]->constraints().size())));
  };
  const HeldPairs held = held_pairs(prepared, state);
  const Eigen::Index k = held.T.cols(), m = contact.rigid_motions();

  // Right-hand side and matrix of eq. (2).
  std::vector<Vector> z;
  Vector on_pairs = functional.c_p, on_motions = Vector::Zero(m);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    z.push_back(free(p, functional.c[p]));
    on_pairs += contact.motion[p] * z[p];
    const Matrix& rigid = parts[p]->rigid_motions();
    on_motions.segment(contact.first_rigid[p], rigid.cols()) = rigid.transpose() * functional.c[p];
  }
  Vector w = Vector::Zero(k), v = Vector::Zero(m);
  if (k + m > 0) {
    Matrix matrix = Matrix::Zero(k + m, k + m);
    const Matrix S(held.S);
    matrix.topLeftCorner(k, k) = held.T.transpose() * contact.W.times(S);
    const Matrix G(contact.G.sparse());
    matrix.topRightCorner(k, m) = held.T.transpose() * G;
    matrix.bottomLeftCorner(m, k) = G.transpose() * S;
    // Pairs of three bodies at one point are redundant, and a motion that nothing determines has no row.
    const double soft = k > 0 ? 1e-12 * matrix.diagonal().head(k).cwiseAbs().maxCoeff() : 0.0;
    matrix.diagonal().head(k).array() += soft;
    matrix.diagonal().tail(m).array() -= 1e-12 * (m > 0 ? matrix.cwiseAbs().maxCoeff() : 0.0);
    Vector x(k + m);
    x << held.T.transpose() * on_pairs, on_motions;
    linalg::GeneralSolver solver;
    if (solver.factorise(matrix, k + m)) {
      solver.solve_in_place(x);
      w = x.head(k), v = x.tail(m);
    }
  }
  const Vector forces = held.S * w;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    z[p] = free(p, functional.c[p] - contact.motion[p].transpose() * forces) + functional.r[p];
    const Matrix& rigid = parts[p]->rigid_motions();
    if (rigid.cols() > 0) z[p] -= rigid * v.segment(contact.first_rigid[p], rigid.cols());
  }
  return z;
}

void check_quantities(const model::Model& model, const mesh::Mesh& mesh) {
  std::vector<const model::Quantity*> all;
  for (const model::Quantity& quantity : model.output.error_of) all.push_back(&quantity);
  if (model.tolerance) all.push_back(&model.tolerance->of);
  for (const model::HistoryItem& item : model.output.history)
    if (const auto* quantity = std::get_if<model::Quantity>(&item.of))
      all.push_back(quantity);
    else if (const auto* place = std::get_if<model::PlaceDisplacement>(&item.of))
      for (const model::Quantity* of : {&place->of, place->relative_to ? &*place->relative_to : nullptr})
        if (of) all.push_back(of);
  std::vector<Diagnostic> mistakes;
  for (const model::Quantity* quantity : all) {
    if (quantity->kind == Kind::displacement || quantity->kind == Kind::velocity || quantity->kind == Kind::stress) {
      const std::vector<int> bodies = bodies_of(model, *quantity);
      if (bodies.size() == 1) continue;
      if (bodies.empty())
        mistakes.push_back({quantity->source, "the point lies in no body"});
      else
        mistakes.push_back(
            {quantity->source,
             fmt::format("the point lies in body '{}' and in body '{}', which may move apart: give it a 'body'",
                         model.bodies[static_cast<std::size_t>(bodies[0])].name,
                         model.bodies[static_cast<std::size_t>(bodies[1])].name)});
    } else if (quantity->is_of_tip()) {
      const auto b = static_cast<std::size_t>(quantity->index);
      std::vector<std::string> tips;
      for (const mesh::Cell& cell : mesh.bodies[b].cells)
        if (cell.kind == mesh::CellKind::superelement && cell.is_open())
          if (std::string name = name_of_tip(model.bodies[b], cell.centre); is_named(name, model, *quantity))
            tips.push_back(std::move(name));
      if (tips.size() == 1) continue;
      const std::string word = quantity->name.substr(quantity->name.rfind('.') + 1);
      mistakes.push_back(
          {quantity->source,
           tips.empty() ? fmt::format("'{}' is no crack tip: this end lies on the boundary or on another "
                                      "crack",
                                      quantity->crack)
                        : fmt::format("the crack has two tips: write {1}.{0} or {2}.{0}", word, tips[0], tips[1])});
    }
  }
  if (!mistakes.empty()) throw InputError(model.file, std::move(mistakes));
}

std::vector<Warning> quantity_warnings(const model::Model& model, const IncrementResult& increment) {
  std::vector<Warning> warnings;
  for (const model::HistoryItem& item : model.output.history) {
    const auto* quantity = std::get_if<model::Quantity>(&item.of);
    const CrackResult* tip = quantity && quantity->is_of_tip() ? tip_of(model, increment, *quantity) : nullptr;
    if (!tip || has_figure(tip->factors.kind, *quantity)) continue;
    const auto [what, figures] = [&]() -> std::pair<const char*, const char*> {
      switch (tip->factors.kind) {
        case element::CornerKind::crack:
          return {"crack in one material", "K_I, K_II, T, G and J"};
        case element::CornerKind::interface_crack:
          return {"crack between two materials", "K_I, K_II, T_left, T_right, G and J"};
        case element::CornerKind::corner:
          break;
      }
      return {"corner", "K_tt and K_rt"};
    }();
    warnings.push_back({WarningKind::crack, item.name + " history",
                        fmt::format("the column '{}' of history.csv stays empty: '{}' is a {}, which has {}", item.name,
                                    tip->name, what, figures)});
  }
  return warnings;
}

}  // namespace scabo::analysis
