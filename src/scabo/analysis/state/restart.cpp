#include "scabo/analysis/state/restart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "scabo/analysis/state/agreements.hpp"
#include "scabo/analysis/state/fields.hpp"
#include "scabo/analysis/state/pair_motions.hpp"
#include "scabo/analysis/state/restart_points.hpp"
#include "scabo/analysis/state/step_factors.hpp"

namespace scabo::analysis {

namespace {

/// Whether the entries of a field are kept with a contact, with a part or with neither.
bool is_of_contact(const Field& field) {
  return field.lasts &&
         (field.owner == Owner::pair || field.owner == Owner::held_pair || field.owner == Owner::contact);
}
bool is_of_pair(const Field& field) { return field.lasts && field.owner == Owner::pair; }
bool is_of_part(const Field& field) {
  return field.lasts &&
         (field.owner == Owner::part || field.owner == Owner::rigid_motion || field.owner == Owner::vector_of_part);
}
bool is_of_whole(const Field& field) { return field.lasts && field.owner == Owner::whole; }

/// Positions of the pairs of a contact in the list of all.
std::vector<Eigen::Index> places_of_contact(const std::vector<system::ContactSystem::Pair>& pairs,
                                            std::size_t contact) {
  std::vector<Eigen::Index> places;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (pairs[i].contact == static_cast<int>(contact)) places.push_back(static_cast<Eigen::Index>(i));
  return places;
}

/// Where the entries of a field are that belong to a contact, a bar or a part.
using Places = std::vector<Eigen::Index>;
/// Of a bar that is there one place.
Places place_of_bar(const Prepared& now, std::size_t bar) {
  for (std::size_t i = 0; i < now.contact.pairs.size(); ++i)
    if (now.contact.pairs[i].is_bar() && now.contact.pairs[i].index == static_cast<int>(bar))
      return {static_cast<Eigen::Index>(i)};
  return {};
}
Places places_in_contact(const Prepared& now, const Field& field, std::size_t contact) {
  if (field.owner == Owner::contact) return {static_cast<Eigen::Index>(contact)};
  return places_of_contact(field.owner == Owner::pair ? now.contact.pairs : now.contact.held, contact);
}
Places places_in_part(const Prepared& now, const Field& field, std::size_t part) {
  if (field.owner == Owner::part) return {static_cast<Eigen::Index>(part)};
  Places places;
  for (Eigen::Index k = 0; k < now.structure.parts[part]->rigid_motions().cols(); ++k)
    places.push_back(now.contact.first_rigid[part] + k);
  return places;
}

/// How many entries a field has on this structure.
std::size_t entries_of(const Prepared& now, const Field& field) {
  switch (field.owner) {
    case Owner::pair:
      return now.contact.pairs.size();
    case Owner::held_pair:
      return now.contact.held.size();
    case Owner::rigid_motion:
      return static_cast<std::size_t>(now.contact.rigid_motions());
    case Owner::contact:
      return now.model.contacts.size();
    case Owner::part:
      return now.structure.parts.size();
    case Owner::vector_of_part:
    case Owner::whole:
      break;
  }
  return 1;
}

/// Of a field with a vector for every part that of one of them; nothing if the field is empty.
std::vector<double> vector_of_part(const std::vector<double>& numbers, std::size_t part) {
  std::size_t at = 0;
  for (std::size_t p = 0; at < numbers.size(); ++p) {
    const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(at) + 1;
    const auto count = static_cast<std::ptrdiff_t>(numbers[at]);
    if (p == part) return {begin, begin + count};
    at += 1 + static_cast<std::size_t>(count);
  }
  return {};
}

/// What of the end of a run large slip cannot go on from.
void check_large_slip(const model::Model& model, const EndState& end) {
  const std::string& directory = model.restart->directory;
  std::vector<std::string> messages;
  for (const model::Contact& contact : model.contacts) {
    const EndState::Of* of = find(end.contacts, contact.name);
    if (!of) continue;
    if (!contact.large_slip &&
        std::ranges::any_of(kept(of->fields, "replaced/placement"), [](double x) { return x != 0.0; }))
      messages.push_back(
          fmt::format("the sides of contact '{}' have passed each other in {}: give it 'slip: large' here too",
                      contact.name, directory));
    if (contact.large_slip && !kept(of->fields, "offset").empty())
      messages.push_back(
          fmt::format("contact '{}' cannot have 'slip: large' here, because bodies were added or removed "
                      "in {}: make one model of both without stages",
                      contact.name, directory));
  }
  refuse_restart(model.file, *model.restart, std::move(messages));
}

EndState read_end(const model::Model& model) {
  EndState end = read_end_state(model.file, *model.restart, false);
  check_large_slip(model, end);
  return end;
}

/// In the placement of a model; empty if no pairs were found anew.
mesh::Placement placement_at_end(const model::Model& model, const EndState& end) {
  mesh::Placement placement;
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    for (const EndState::Of& of : end.contacts) {
      const std::vector<double>& by = kept(of.fields, "replaced/placement");
      if (of.name != model.contacts[c].name || by.empty()) continue;
      if (placement.empty()) placement.assign(model.contacts.size(), {Vec2::Zero(), Vec2::Zero()});
      placement[c] = {Vec2(by.at(0), by.at(1)), Vec2(by.at(2), by.at(3))};
    }
  return placement;
}

std::vector<std::size_t> present_parts(const Prepared& now) {
  std::vector<std::size_t> parts;
  for (std::size_t p = 0; p < now.structure.parts.size(); ++p)
    if (!now.is_absent(p)) parts.push_back(p);
  return parts;
}

const std::string& name_of_part(const Prepared& now, std::size_t part) {
  return now.model.bodies[static_cast<std::size_t>(now.structure.dofs.bodies_of(part).front())].name;
}

/// A field with a vector for every part, all of which are there if they move.
void continue_vectors(const Prepared& now, const EndState& end, const Field& field, State& state) {
  if (!now.model.restart->motion) return;
  std::vector<double> numbers;
  for (std::size_t p = 0; p < now.structure.parts.size(); ++p) {
    const EndState::Of* of = find(end.parts, name_of_part(now, p));
    const std::vector<double>& values = of ? kept(of->fields, field.name) : kept({}, field.name);
    numbers.push_back(static_cast<double>(values.size()));
    numbers.insert(numbers.end(), values.begin(), values.end());
  }
  field.set(state, numbers);
}

/// A field of the state at the start of a model, from the end of the other run.
void continue_field(const Prepared& now, const EndState& end, const Field& field, State& state) {
  if (field.owner == Owner::vector_of_part) return continue_vectors(now, end, field, state);
  std::vector<double> numbers = field.get(state);
  const std::size_t size = static_cast<std::size_t>(field.count) * entries_of(now, field);
  if (is_of_whole(field)) numbers = kept(end.whole, field.name);
  for (std::size_t c = 0; c < now.model.contacts.size() && is_of_contact(field); ++c)
    if (const EndState::Of* of = find(end.contacts, now.model.contacts[c].name))
      put(kept(of->fields, field.name), places_in_contact(now, field, c), field.count, numbers, size);
  for (std::size_t b = 0; b < now.model.bars.size() && is_of_pair(field); ++b)
    if (const EndState::Of* of = find(end.bars, now.model.bars[b].name))
      put(kept(of->fields, field.name), place_of_bar(now, b), field.count, numbers, size);
  for (const std::size_t p : present_parts(now))
    if (const EndState::Of* of = is_of_part(field) ? find(end.parts, name_of_part(now, p)) : nullptr) {
      const std::vector<double>& values = kept(of->fields, field.name);
      const Places places = places_in_part(now, field, p);
      // Where supports of the other run end here, its body has more motions: continue_motions().
      if (field.owner != Owner::rigid_motion || values.size() == static_cast<std::size_t>(field.count) * places.size())
        put(values, places, field.count, numbers, size);
    }
  field.set(state, numbers);
}

/// A bar that the last step of the other run tightened elongates from now on.
void place_new_bars(const Prepared& now, const EndState& end, State& state) {
  const auto size = 2 * static_cast<Eigen::Index>(now.contact.pairs.size());
  const Vector motion = motion_under(now.contact.motion, state.u, size);
  for (std::size_t b = 0; b < now.model.bars.size(); ++b) {
    if (find(end.bars, now.model.bars[b].name)) continue;
    for (const Eigen::Index place : place_of_bar(now, b)) {
      if (state.offset.size() == 0) state.offset = Vector::Zero(size);
      state.offset.segment<2>(2 * place) = -motion.segment<2>(2 * place);
    }
  }
}

}  // namespace

EndState end_state(const Prepared& now, const State& state) {
  EndState end;
  const bool in_motion = !state.velocity.empty();
  const std::size_t last = now.model.steps.size() - 1;
  end.agreements = agreements_of(now, state, static_cast<int>(last), in_motion);
  for (const model::Contact& contact : now.model.contacts) end.contacts.push_back({contact.name, {}});
  std::vector<std::size_t> bars;
  for (std::size_t b = 0; b < now.model.bars.size(); ++b)
    if (!place_of_bar(now, b).empty()) bars.push_back(b), end.bars.push_back({now.model.bars[b].name, {}});
  for (const std::size_t p : present_parts(now)) end.parts.push_back({name_of_part(now, p), {}});
  for (const Field& field : fields_of_state()) {
    const std::vector<double> numbers = field.get(state);
    if (is_of_whole(field)) end.whole[field.name] = numbers;
    for (std::size_t c = 0; c < end.contacts.size() && is_of_contact(field); ++c)
      end.contacts[c].fields[field.name] = selected(numbers, places_in_contact(now, field, c), field.count);
    for (std::size_t k = 0; k < bars.size() && is_of_pair(field); ++k)
      end.bars[k].fields[field.name] = selected(numbers, place_of_bar(now, bars[k]), field.count);
    std::size_t number = 0;
    for (const std::size_t p : present_parts(now))
      if (is_of_part(field))
        end.parts[number++].fields[field.name] = field.owner == Owner::vector_of_part
                                                     ? vector_of_part(numbers, p)
                                                     : selected(numbers, places_in_part(now, field, p), field.count);
  }
  for (std::size_t i = 0; i < now.model.loads.size(); ++i)
    end.loads.push_back({now.model.loads[i].name, state.factors.loads[i]});
  for (std::size_t i = 0; i < now.model.supports.size(); ++i)
    end.supports.push_back({now.model.supports[i].name, state.factors.supports[i]});
  for (const model::Bar& bar : now.model.bars)
    if (bar.preload != 0.0)
      end.tightened.push_back({bar.name, bar.tightened - static_cast<double>(now.model.steps.size())});
  for (const model::Support& support : now.model.supports)
    if (support.is_staged() && support.is_there(static_cast<int>(last))) end.placed.push_back({support.name, 1.0});
  end.held = held_at_end(now, state);
  if (in_motion)
    end.motion = {{"time", state.time},
                  {"ground_x", ground_velocity(now.model, last, 1.0, 0)},
                  {"ground_y", ground_velocity(now.model, last, 1.0, 1)}};
  return end;
}

mesh::Placement placement_of_restart(const model::Model& model) { return placement_at_end(model, read_end(model)); }

State state_of_restart(const Prepared& now) {
  const EndState end = read_end(now.model);
  State state = initial_state(now);
  state.factors.loads = now.model.restart->load_factors;
  state.factors.supports = now.model.restart->support_factors;
  refuse_restart(
      now.model.file, *now.model.restart,
      disagreements(
          end.agreements, agreements_of(now, state, 0, now.model.restart->motion.has_value()),
          now.model.restart->directory,
          "plane, thickness, shape, mesh, with the nodes that other bodies need on its edges, material, place, "
          "and the value of a load that acts"));
  for (const Field& field : fields_of_state())
    if (field.lasts) continue_field(now, end, field, state);
  continue_points(now, end, state);
  complete(now, state);
  if (continue_motions(now, end, state)) complete(now, state);
  place_new_bars(now, end, state);
  return state;
}

}  // namespace scabo::analysis
