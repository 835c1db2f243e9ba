#include "scabo/analysis/state/outside.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "scabo/base/disjoint_sets.hpp"
#include "scabo/element/plane/interior_field.hpp"

namespace scabo::analysis {

namespace {

/// The super-element that is an unbounded body.
const mesh::Cell& unbounded_cell(const mesh::BodyMesh& mesh) {
  ensure(mesh.cells.size() == 1, "an unbounded body is one super-element");
  return mesh.cells.front();
}

}  // namespace

void check_references(const model::Model& model, const mesh::Mesh& mesh) {
  std::vector<Diagnostic> mistakes;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const model::Body& body = model.bodies[b];
    if (!body.reference) continue;
    const mesh::Cell& cell = unbounded_cell(mesh.bodies[b]);
    if (!element::locate(element::ring_of(cell, mesh.bodies[b].nodes), *body.reference - cell.centre, true))
      mistakes.push_back({body.source, fmt::format("the reference point ({:.6g}, {:.6g}) does not lie in this body: "
                                                   "choose a point of the body far from the hole",
                                                   body.reference->x(), body.reference->y())});
  }
  if (!mistakes.empty()) throw InputError(model.file, std::move(mistakes));
}

std::string without_reference(const Prepared& prepared, const State& state) {
  for (std::size_t b = 0; b < prepared.model.bodies.size(); ++b) {
    const model::Body& body = prepared.model.bodies[b];
    if (!body.outside || body.reference) continue;
    const std::size_t part = prepared.structure.dofs.part_of(static_cast<int>(b));
    const Vector forces = state.forces[part] + prepared.contact.motion[part].transpose() * state.p +
                          prepared.structure.parts[part]->spring_forces(state.u[part]);
    const Vec2 sum = forces.reshaped(2, forces.size() / 2).rowwise().sum();
    // Tractions of a field that cancel each other between tied bodies leave the rounding of their sum.
    double of_fields = 0.0;
    for (std::size_t load = 0; load < state.factors.loads.size(); ++load)
      for (const int of_part : prepared.structure.dofs.bodies_of(part)) {
        const auto body_of_part = static_cast<std::size_t>(of_part);
        of_fields +=
            std::abs(state.factors.loads[load]) *
            prepared.structure.initial[load][body_of_part].at(prepared.mesh.bodies[body_of_part].nodes.front()).norm();
      }
    of_fields *=
        2.0 * prepared.structure.parts[part]->lever() * model::thickness_of(prepared.model, static_cast<int>(b));
    // Supports that keep a lining from turning take what its mesh lacks in symmetry, 1e-9 to 1e-6 of the forces.
    constexpr double unsymmetric = 1e-5;
    if (sum.norm() > unsymmetric * forces.lpNorm<1>() && sum.norm() > 1e-12 * of_fields)
      return fmt::format(
          "the forces on the unbounded body '{}' have a resultant ({:.4g}, {:.4g}): in the plane its displacement is "
          "then determined only up to a translation. Here it is fixed at a distance of a thousand radii; give a "
          "'reference' point where the displacement is to be zero",
          body.name, sum.x(), sum.y());
  }
  return {};
}

namespace {

/// Bodies that contacts and ties join.
DisjointSets joined_groups(const model::Model& model) {
  DisjointSets groups(model.bodies.size());
  const auto join = [&](const auto& joints) {
    for (const auto& joint : joints)
      groups.join(static_cast<std::size_t>(joint.a.body), static_cast<std::size_t>(joint.b.body));
  };
  join(model.contacts);
  join(model.ties);
  return groups;
}

/// The point of one unbounded body.
Reference reference_at(const model::Body& body, int number, const mesh::Mesh& mesh,
                       const element::SolvedSuperElement& cell) {
  const Vec2& centre = unbounded_cell(mesh.bodies[static_cast<std::size_t>(number)]).centre;
  const auto at = element::locate(cell.ring, *body.reference - centre, true);
  ensure(at.has_value(), "the reference point of an outside body lies in it");
  const Eigen::Index n = cell.K().rows();
  Reference reference{number, Matrix(2, n), {}};
  for (Eigen::Index k = 0; k < n; ++k) {
    const Vector unit = Vector::Unit(n, k);
    const element::RadialField field(cell.solution(), cell.modes(), unit);
    reference.N.col(k) =
        element::point_values(cell.ring, field.at(at->xi), cell.sectors.D, at->element, at->eta).displacement;
  }
  return reference;
}

/// Subtracts the displacements of reference points from those of the pairs, which are in [n, t].
void take_off_pairs(const Prepared& prepared, const FieldState& fields, std::vector<ContactResult>& contacts) {
  std::vector<std::size_t> next(contacts.size(), 0);
  for (const system::ContactSystem::Pair& at : prepared.contact.pairs) {
    if (at.is_bar()) continue;
    const auto c = static_cast<std::size_t>(at.contact);
    const Vec2& normal = prepared.mesh.interfaces[c].pairs[static_cast<std::size_t>(at.index)].normal;
    const auto translation_of = [&](const model::Place& side) {
      const Vec2 translation = fields.reference_displacement(static_cast<std::size_t>(side.body));
      return Vec2(translation.dot(normal), translation.dot(tangent_of(normal)));
    };
    PairResult& pair = contacts[c].pairs[next[c]++];
    pair.displacement_a -= translation_of(prepared.model.contacts[c].a);
    pair.displacement_b -= translation_of(prepared.model.contacts[c].b);
  }
}

}  // namespace

std::vector<Reference> references_of(const model::Model& model, const mesh::Mesh& mesh,
                                     const std::vector<element::SolvedCells>& cells, const system::Dofs& dofs) {
  std::vector<Reference> references;
  const bool any = std::any_of(model.bodies.begin(), model.bodies.end(),
                               [](const model::Body& body) { return body.outside && body.reference; });
  if (!any) return references;
  DisjointSets groups = joined_groups(model);
  const auto group_of = [&](int body) { return groups.root(static_cast<std::size_t>(body)); };
  std::set<std::size_t> held;
  for (const model::Support& support : model.supports) held.insert(group_of(support.on.body));
  for (const model::Spring& spring : model.springs) held.insert(group_of(spring.on.body));
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const model::Body& body = model.bodies[b];
    if (!body.outside || !body.reference || !held.insert(groups.root(b)).second) continue;
    Reference& made = references.emplace_back(reference_at(body, static_cast<int>(b), mesh, *cells[b].front()));
    std::set<int> parts;
    for (std::size_t other = 0; other < model.bodies.size(); ++other)
      if (groups.root(other) == groups.root(b)) parts.insert(static_cast<int>(dofs.part_of(static_cast<int>(other))));
    made.parts.assign(parts.begin(), parts.end());
  }
  return references;
}

void refer_displacements(const Prepared& prepared, const State& state, IncrementResult& result) {
  if (prepared.references.empty()) return;
  result.fields.reference_displacements.assign(prepared.model.bodies.size(), Vec2::Zero());
  for (const Reference& reference : prepared.references) {
    const Vec2 moved = displacement_of(reference, prepared, state.u);
    for (const int part : reference.parts) {
      const auto p = static_cast<std::size_t>(part);
      for (const int body : prepared.structure.dofs.bodies_of(p))
        result.fields.reference_displacements[static_cast<std::size_t>(body)] =
            state.referred.empty() ? moved : Vec2(moved - state.referred[p]);
    }
  }
  take_off_pairs(prepared, result.fields, result.contacts);
}

}  // namespace scabo::analysis
