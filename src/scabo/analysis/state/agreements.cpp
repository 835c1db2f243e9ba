#include "scabo/analysis/state/agreements.hpp"

#include <fmt/format.h>

#include "scabo/analysis/state/fingerprint.hpp"

namespace scabo::analysis {

namespace {

void add_material(const model::Material& material, Fingerprint& to) {
  to.add(material.young), to.add(material.poisson);
  if (!material.law) return;
  if (const auto* of = std::get_if<model::Orthotropic>(&*material.law)) {
    for (const double value : {of->E1, of->E2, of->E3, of->nu12, of->nu13, of->nu23, of->G12, of->angle}) to.add(value);
    return;
  }
  const auto& of = std::get<model::Anisotropic>(*material.law);
  for (const double value : {of.D11, of.D12, of.D22, of.D16, of.D26, of.D66}) to.add(value);
}

bool body_is_there(const Prepared& now, int body) { return !now.is_absent(now.structure.dofs.part_of(body)); }

/// What the energies of a body in motion depend on.
void add_inertia(const Prepared& now, std::size_t b, Fingerprint& to) {
  const model::Body& body = now.model.bodies[b];
  to.add(body.density.value_or(0.0));
  for (const mesh::Cell& cell : now.mesh.bodies[b].cells)
    for (const int index : cell.materials) {
      const model::Material& material = now.model.materials[static_cast<std::size_t>(index)];
      to.add(material.density.value_or(0.0));
      if (const auto& damping = material.damping)
        for (const double value : {damping->ratio, damping->from, damping->to}) to.add(value);
    }
  for (const model::AddedMass& water : now.model.added_masses) {
    if (water.on->body != static_cast<int>(b)) continue;
    to.add(static_cast<double>(water.on->index));
    for (const double value : {water.level, water.bottom.value_or(water.level), water.density}) to.add(value);
    to.add(water.up);
  }
  for (const model::PointMass& point : model::point_masses_on(now.model, static_cast<int>(b))) {
    to.add(static_cast<double>(point.on->index));
    to.add(point.mass);
  }
}

/// Shape, mesh and material of a body, and the bodies it is tied to.
std::string fingerprint_of_body(const Prepared& now, std::size_t b, bool in_motion) {
  Fingerprint of;
  if (in_motion) add_inertia(now, b, of);
  const model::Body& body = now.model.bodies[b];
  of.add(now.model.analysis.revolved()                      ? "axisymmetric"
         : now.model.analysis.plane == model::Plane::strain ? "strain"
                                                            : "stress");
  of.add(model::thickness_of(now.model, static_cast<int>(b)));
  if (now.model.analysis.per_radian) of.add("per radian");
  const std::size_t part = now.structure.dofs.part_of(static_cast<int>(b));
  for (const int other : now.structure.dofs.bodies_of(part))
    of.add(now.model.bodies[static_cast<std::size_t>(other)].name);
  of.add(static_cast<double>(now.structure.dofs.size(part)));
  if (body.rigid) {
    of.add(body.outline.centroid());
    of.add(system::half_size(body.outline));
    return of.text();
  }
  for (const Vec2& node : now.mesh.bodies[b].nodes) of.add(node);
  for (const mesh::Cell& cell : now.mesh.bodies[b].cells) {
    of.add(static_cast<double>(cell.kind));
    of.add(static_cast<double>(cell.boundary.size()));
    for (const int material : cell.materials) add_material(now.model.materials[static_cast<std::size_t>(material)], of);
  }
  return of.text();
}

std::string fingerprint_of_support(const Prepared& now, std::size_t support) {
  Fingerprint of;
  const auto held = system::constraints_of_support(now.model, now.mesh, now.structure.dofs, support);
  for (const std::vector<system::Constraint>& of_part : held)
    for (const system::Constraint& constraint : of_part) {
      of.add(static_cast<double>(constraint.dof)), of.add(constraint.direction());
      of.add(constraint.point), of.add(constraint.value);
      of.add(constraint.rotation ? 1.0 : 0.0);
    }
  return of.text();
}

std::string fingerprint_of_contact(const Prepared& now, const State& state, std::size_t contact) {
  Fingerprint of;
  const auto index = static_cast<int>(contact);
  for (std::size_t i = 0; i < now.contact.pairs.size(); ++i) {
    if (now.contact.pairs[i].contact != index) continue;
    of.add(now.contact.softness[static_cast<Eigen::Index>(i)]);
    const mesh::ContactPair& pair =
        now.mesh.interfaces[contact].pairs[static_cast<std::size_t>(now.contact.pairs[i].index)];
    of.add(pair.normal), of.add(pair.point_a), of.add(pair.point_b);
    of.add(gap_at(now, state.factors, static_cast<Eigen::Index>(i)));
  }
  return of.text();
}

std::string fingerprint_of_load(const Prepared& now, std::size_t load) {
  Fingerprint of;
  if (const auto& moving = now.model.loads[load].moving) of.add(moving->velocity), of.add(moving->from);
  for (std::size_t p = 0; p < now.structure.parts.size(); ++p) {
    const Vector& forces = now.structure.loads[load][p];
    if (now.is_absent(p) || forces.size() == 0 || forces.isZero(0.0)) continue;
    of.add(now.model.bodies[static_cast<std::size_t>(now.structure.dofs.bodies_of(p).front())].name);
    of.add(forces);
  }
  return of.text();
}

}  // namespace

std::vector<EndState::Agreement> agreements_of(const Prepared& now, const State& state, int step, bool in_motion) {
  const model::Model& model = now.model;
  std::vector<EndState::Agreement> agreements;
  const auto add = [&](const char* kind, const std::string& name, std::string digest) {
    agreements.push_back({fmt::format("{} '{}'", kind, name), std::move(digest)});
  };
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (body_is_there(now, static_cast<int>(b)))
      add("body", model.bodies[b].name, fingerprint_of_body(now, b, in_motion));
  for (std::size_t i = 0; i < model.supports.size(); ++i)
    if (body_is_there(now, model.supports[i].on.body) && model.supports[i].is_there(step))
      add("support", model.supports[i].name, fingerprint_of_support(now, i));
  for (const model::Spring& spring : model.springs) {
    if (!body_is_there(now, spring.on.body)) continue;
    Fingerprint of;
    of.add(spring.stiffness[0]), of.add(spring.stiffness[1]);
    of.add(static_cast<double>(spring.on.kind)), of.add(static_cast<double>(spring.on.index)), of.add(spring.on.near);
    add("spring", spring.name, of.text());
  }
  for (std::size_t b = 0; b < model.bars.size(); ++b) {
    const bool has_ends = std::ranges::all_of(
        model.bars[b].between, [&](const model::Bar::End& end) { return !end.on || body_is_there(now, end.on->body); });
    const bool tightened = model.bars[b].preload == 0.0 || state.factors.preloads[b] != 0.0;
    if (!has_ends || !tightened) continue;
    Fingerprint of;
    of.add(now.structure.bars[b].softness), of.add(now.structure.bars[b].direction), of.add(model.bars[b].preload);
    add("bar", model.bars[b].name, of.text());
  }
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    if (body_is_there(now, model.contacts[c].a.body) && body_is_there(now, model.contacts[c].b.body))
      add("contact", model.contacts[c].name, fingerprint_of_contact(now, state, c));
  for (std::size_t load = 0; load < model.loads.size(); ++load)
    if (state.factors.loads[load] != 0.0) add("load", model.loads[load].name, fingerprint_of_load(now, load));
  return agreements;
}

}  // namespace scabo::analysis
