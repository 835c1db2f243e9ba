#include "scabo/analysis/space/solid_restart.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/analysis/space/solid_bars.hpp"
#include "scabo/analysis/space/solid_factors.hpp"
#include "scabo/analysis/space/solid_fields.hpp"
#include "scabo/analysis/space/solid_restart_points.hpp"
#include "scabo/analysis/state/fingerprint.hpp"
#include "scabo/analysis/state/pair_motions.hpp"

namespace scabo::analysis {

namespace {

using Pair = system::ContactSystem::Pair;
constexpr const char* shortening_name = "shortening";

std::string fingerprint_of_body(const SolidBody& body) {
  Fingerprint of;
  of.add(body.mesh.nodes);
  for (const std::vector<int>& cell : body.mesh.cells) {
    of.add(static_cast<double>(cell.size()));
    for (const int node : cell) of.add(static_cast<double>(node));
  }
  if (body.rigid_at)
    of.add(Vector(*body.rigid_at));
  else
    for (const double constant : {body.young, body.poisson, body.expansion}) of.add(constant);
  return of.text();
}

std::string fingerprint_of_support(const SolidModel& model, std::size_t body, std::size_t support) {
  Fingerprint of;
  const auto add = [&](const system::Constraint& held) {
    if (held.support != static_cast<int>(support)) return;
    const int node = held.dof < 0 ? -1 : in_space.node_of(held.dof);
    for (const double number : {1.0 * node, held.rotation ? 1.0 : 0.0, held.value}) of.add(number);
    of.add(Vector(held.direction_in_space()));
  };
  for (const system::Constraint& held : model.bodies[body].supports) add(held);
  for (const SolidHeldPoint& point : model.held_points) add(point.held);
  return of.text();
}

std::string fingerprint_of_spring(const system::SolidSpring& spring) {
  Fingerprint of;
  for (Eigen::Index k = 0; k < spring.on_nodes.outerSize(); ++k)
    for (linalg::SparseMatrix::InnerIterator it(spring.on_nodes, k); it; ++it)
      of.add(static_cast<double>(it.row())), of.add(it.value());
  of.add(Vector(spring.stiffness));
  return of.text();
}

std::string fingerprint_of_bar(const SolidBar& bar) {
  Fingerprint of;
  for (const system::PairSide* side : {&bar.a, &bar.b}) {
    of.add(side->part == system::PairSide::ground ? -1.0 : static_cast<double>(side->part));
    for (const system::PairSide::Node& node : side->nodes) of.add(static_cast<double>(node.node)), of.add(node.weight);
  }
  of.add(Vector(bar.direction)), of.add(bar.softness), of.add(bar.preload);
  return of.text();
}

std::string fingerprint_of_contact(const PreparedSolids& now, const SolidFactors& factors, std::size_t contact) {
  Fingerprint of;
  for (const Pair& pair : now.contact().pairs) {
    if (pair.contact != static_cast<int>(contact)) continue;
    const auto i = static_cast<std::size_t>(pair.index);
    of.add(now.paired.points[i].softness);
    of.add(Vector(now.paired.points[i].directions.reshaped())), of.add(Vector(now.paired.pairs[i].point));
    of.add(now.paired.pairs[i].area), of.add(gap_of_solids(now, factors, i));
  }
  return of.text();
}

std::string fingerprint_of_load(const PreparedSolids& now, std::size_t load) {
  Fingerprint of;
  for (std::size_t b = 0; b < now.model.bodies.size(); ++b) {
    const Vector& forces = now.model.loads[load][b];
    if (now.is_absent(b) || forces.size() == 0 || forces.isZero(0.0)) continue;
    of.add(now.model.bodies[b].name);
    of.add(forces);
  }
  return of.text();
}

bool is_there(const PreparedSolids& now, int body) { return !now.is_absent(static_cast<std::size_t>(body)); }

std::vector<EndState::Agreement> agreements_of_solids(const PreparedSolids& now, const model::SpaceModel& model,
                                                      const SolidFactors& factors) {
  const int step = std::max(factors.step, 0);
  const SolidModel& solids = now.model;
  std::vector<EndState::Agreement> agreements;
  const auto add = [&](const char* kind, const std::string& name, std::string digest) {
    agreements.push_back({fmt::format("{} '{}'", kind, name), std::move(digest)});
  };
  for (std::size_t b = 0; b < solids.bodies.size(); ++b)
    if (!now.is_absent(b)) add("body", solids.bodies[b].name, fingerprint_of_body(solids.bodies[b]));
  for (std::size_t i = 0; i < model.supports.size(); ++i)
    if (const int body = model.supports[i].on.body; is_there(now, body) && model.supports[i].stay.is_there(step))
      add("support", model.supports[i].name, fingerprint_of_support(solids, static_cast<std::size_t>(body), i));
  for (std::size_t i = 0; i < solids.springs.size(); ++i)
    if (is_there(now, solids.springs[i].body))
      add("spring", model.springs[i].name, fingerprint_of_spring(solids.springs[i].spring));
  for (std::size_t i = 0; i < solids.preloads.size(); ++i) {
    if (!is_there(now, solids.preloads[i].body) || factors.tightened[static_cast<Eigen::Index>(i)] == 0.0) continue;
    Fingerprint of;
    of.add(solids.preloads[i].cut.forces);
    add("preload of body", solids.bodies[static_cast<std::size_t>(solids.preloads[i].body)].name, of.text());
  }
  for (std::size_t i = 0; i < solids.bars.size(); ++i)
    if (has_both_ends(now, solids.bars[i]) && factors.bars[static_cast<Eigen::Index>(i)] != 0.0)
      add("bar", model.bars[i].name, fingerprint_of_bar(solids.bars[i]));
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    if (is_there(now, model.contacts[c].a.body) && is_there(now, model.contacts[c].b.body))
      add(model.contacts[c].tied ? "tie" : "contact", model.contacts[c].name, fingerprint_of_contact(now, factors, c));
  for (std::size_t load = 0; load < model.loads.size(); ++load)
    if (factors.loads[static_cast<Eigen::Index>(load)] != 0.0)
      add("load", model.loads[load].name, fingerprint_of_load(now, load));
  return agreements;
}

/// Where entries of a field are that belong to a contact or to a body.
std::vector<Eigen::Index> places_in_contact(const PreparedSolids& now, const SolidField& field, std::size_t contact) {
  std::vector<Eigen::Index> places;
  const std::vector<Pair>& pairs = field.owner == Owner::pair ? now.contact().pairs : now.contact().held;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (pairs[i].contact == static_cast<int>(contact)) places.push_back(static_cast<Eigen::Index>(i));
  return places;
}
std::vector<Eigen::Index> place_of_bar(const PreparedSolids& now, std::size_t bar) {
  const std::vector<Pair>& pairs = now.contact().pairs;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (now.is_bar(pairs[i]) && now.bar(pairs[i]) == bar) return {static_cast<Eigen::Index>(i)};
  return {};
}
std::vector<Eigen::Index> places_in_body(const PreparedSolids& now, std::size_t body) {
  std::vector<Eigen::Index> places;
  for (Eigen::Index k = 0; k < now.structure.parts[body]->rigid_motions().cols(); ++k)
    places.push_back(now.contact().first_rigid[body] + k);
  return places;
}

bool is_of_contact(const SolidField& field) {
  return field.lasts && (field.owner == Owner::pair || field.owner == Owner::held_pair);
}

/// Whether the stiffness of a bar acted at the end, or begins with this run: it was tightened in the last step.
bool acted(const EndState::Of& bar) { return !kept(bar.fields, "gap").empty(); }

void begin_bars(const PreparedSolids& now, const model::SpaceModel& model, const EndState& end, SolidState& state) {
  std::vector<Eigen::Index> places;
  for (std::size_t i = 0; i < model.bars.size(); ++i)
    if (const EndState::Of* of = find(end.bars, model.bars[i].name_at_end()); of != nullptr && !acted(*of))
      for (const Eigen::Index place : place_of_bar(now, i)) places.push_back(place);
  if (places.empty()) return;
  const MovedSolids moved =
      moved_solids(now, applied_to_solids(now, state.factors, state.shortening, state.released), state.p, state.a);
  const Vector motion = motion_under(now.contact().motion, moved.u, state.p.size());
  if (state.offset.size() == 0) state.offset = Vector::Zero(state.p.size());
  for (const Eigen::Index place : places)
    state.offset.segment<3>(in_space.of(place)) = -motion.segment<3>(in_space.of(place));
}

void continue_field(const PreparedSolids& now, const model::SpaceModel& model, const EndState& end,
                    const SolidField& field, SolidState& state) {
  std::vector<double> numbers = field.owner == Owner::whole ? kept(end.whole, field.name) : field.get(state);
  const std::size_t entries = field.owner == Owner::pair ? now.contact().pairs.size()
                              : field.owner == Owner::held_pair
                                  ? now.contact().held.size()
                                  : static_cast<std::size_t>(now.contact().rigid_motions());
  const std::size_t size = static_cast<std::size_t>(field.count) * entries;
  for (std::size_t c = 0; c < model.contacts.size() && is_of_contact(field); ++c)
    if (const EndState::Of* of = find(end.contacts, model.contacts[c].name))
      put(kept(of->fields, field.name), places_in_contact(now, field, c), field.count, numbers, size);
  for (std::size_t i = 0; i < model.bars.size() && field.owner == Owner::pair; ++i)
    if (const EndState::Of* of = find(end.bars, model.bars[i].name_at_end()))
      if (const auto place = place_of_bar(now, i); acted(*of) && !place.empty())
        put(kept(of->fields, field.name), place, field.count, numbers, size);
  for (std::size_t b = 0; b < model.bodies.size() && field.owner == Owner::rigid_motion; ++b)
    if (const EndState::Of* of = now.is_absent(b) ? nullptr : find(end.parts, model.bodies[b].name)) {
      const std::vector<double>& values = kept(of->fields, field.name);
      const std::vector<Eigen::Index> places = places_in_body(now, b);
      // Where supports of the other run end here, its body has more motions: continue_motions().
      if (values.size() == places.size()) put(values, places, field.count, numbers, size);
    }
  field.set(state, numbers);
}

}  // namespace

EndState end_state_of_solids(const PreparedSolids& now, const model::SpaceModel& model, const SolidState& state) {
  EndState end;
  end.in_space = true;
  end.agreements = agreements_of_solids(now, model, state.factors);
  for (const model::SpaceContact& contact : model.contacts) end.contacts.push_back({contact.name, {}});
  for (const model::SpaceBar& bar : model.bars) {
    end.bars.push_back({bar.name_at_end(), {}});
    end.tightened.push_back({bar.name_at_end(), bar.tightened - static_cast<double>(model.steps.size())});
  }
  for (const SolidField& field : fields_of_solid_state()) {
    const std::vector<double> numbers = field.get(state);
    if (field.lasts && field.owner == Owner::whole) end.whole[field.name] = numbers;
    for (std::size_t c = 0; c < end.contacts.size() && is_of_contact(field); ++c)
      end.contacts[c].fields[field.name] = selected(numbers, places_in_contact(now, field, c), field.count);
    for (std::size_t i = 0; i < model.bars.size() && field.lasts && field.owner == Owner::pair; ++i)
      end.bars[i].fields[field.name] = selected(numbers, place_of_bar(now, i), field.count);
    for (std::size_t b = 0; b < model.bodies.size() && field.owner == Owner::rigid_motion; ++b)
      if (!now.is_absent(b))
        end.parts.push_back({model.bodies[b].name, {{field.name, selected(numbers, places_in_body(now, b), 1)}}});
  }
  for (std::size_t i = 0; i < now.model.preloads.size(); ++i) {
    const auto body = static_cast<std::size_t>(now.model.preloads[i].body);
    if (now.is_absent(body)) continue;
    const std::string& name = model.bodies[body].name;
    end.bars.push_back({name, {{shortening_name, {state.shortening[static_cast<Eigen::Index>(i)]}}}});
    end.tightened.push_back({name, model.bodies[body].preload->step - static_cast<double>(model.steps.size())});
  }
  for (std::size_t i = 0; i < model.loads.size(); ++i)
    end.loads.push_back({model.loads[i].name, state.factors.loads[static_cast<Eigen::Index>(i)]});
  for (std::size_t i = 0; i < model.supports.size(); ++i)
    end.supports.push_back({model.supports[i].name, state.factors.supports[static_cast<Eigen::Index>(i)]});
  end.held = solids_held_at_end(now, state);
  for (const model::SpaceSupport& support : model.supports)
    if (support.is_staged() && support.stay.is_there(state.factors.step)) end.placed.push_back({support.name, 1.0});
  return end;
}

SolidState state_of_restart(const PreparedSolids& now, const model::SpaceModel& model, const PosedSolids& posed) {
  const EndState end = read_end_state(model.file, *model.restart, true);
  SolidState state = solid_state_at_rest(now);
  state.factors = factors_at_start(model, posed);
  refuse_restart(
      model.file, *model.restart,
      disagreements(end.agreements, agreements_of_solids(now, model, state.factors), model.restart->directory,
                    "shape, mesh, material, place, and the value of a load that acts"));
  for (const SolidField& field : fields_of_solid_state())
    if (field.lasts) continue_field(now, model, end, field, state);
  for (std::size_t i = 0; i < now.model.preloads.size(); ++i)
    if (const auto* of = find(end.bars, model.bodies[static_cast<std::size_t>(now.model.preloads[i].body)].name))
      state.shortening[static_cast<Eigen::Index>(i)] = kept(of->fields, shortening_name).at(0);
  continue_held_points(now, end, state);
  begin_bars(now, model, end, state);
  return state;
}

}  // namespace scabo::analysis
