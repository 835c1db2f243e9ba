#include "scabo/analysis/state/restart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <system_error>
#include <type_traits>

#include "scabo/analysis/state/agreements.hpp"
#include "scabo/analysis/state/fields.hpp"
#include "scabo/analysis/state/pair_motions.hpp"
#include "scabo/analysis/state/restart_points.hpp"
#include "scabo/analysis/state/sealed_file.hpp"
#include "scabo/analysis/state/step_factors.hpp"
#include "scabo/model/restart_files.hpp"

namespace scabo::analysis {

namespace {

namespace fs = std::filesystem;

constexpr const char* end_mark = "scabo_end\n";
constexpr const char* end_version = "9";

template <typename Io, typename T, typename Exchange>
void exchange_list(Io& io, const std::string& path, std::vector<T>& list, const Exchange& exchange) {
  list.resize(exchange_count(io, path + "/count", list.size()));
  for (std::size_t i = 0; i < list.size(); ++i) exchange(fmt::format("{}/{}", path, i), list[i]);
}

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

template <typename Io>
void exchange_fields(Io& io, const std::string& path, bool (*is_one)(const Field&),
                     std::map<std::string, std::vector<double>>& of) {
  for (const Field& field : fields_of_state())
    if (is_one(field)) io.numbers(path + field.name, of[field.name]);
}

template <typename Io>
void exchange_end(Io& io, EndState& end) {
  io.text("version", end.version);
  exchange_list(io, "agreements", end.agreements, [&](const std::string& path, EndState::Agreement& of) {
    io.text(path + "/what", of.what), io.text(path + "/digest", of.digest);
  });
  const auto exchange_named = [&](const std::string& section, std::vector<EndState::Of>& list,
                                  bool (*is_one)(const Field&)) {
    exchange_list(io, section, list, [&](const std::string& path, EndState::Of& of) {
      io.text(path + "/name", of.name);
      exchange_fields(io, path + "/", is_one, of.fields);
    });
  };
  exchange_named("contacts", end.contacts, is_of_contact);
  exchange_named("bars", end.bars, is_of_pair);
  exchange_named("parts", end.parts, is_of_part);
  exchange_list(io, "held", end.held, [&](const std::string& path, EndState::Held& of) {
    io.text(path + "/name", of.name);
    io.numbers(path + "/constraints", of.constraints);
    io.numbers(path + "/u", of.u);
    exchange_fields(io, path + "/", is_of_pair, of.fields);
  });
  exchange_fields(io, "state/", is_of_whole, end.whole);
}

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

/// The entries of a field at some places; nothing if the field is empty.
std::vector<double> selected(const std::vector<double>& from, const Places& places, int count) {
  return from.empty() ? from : entries_at(from, count, places);
}
void put(const std::vector<double>& some, const Places& places, int count, std::vector<double>& to, std::size_t size) {
  if (some.empty()) return;
  ensure(some.size() == static_cast<std::size_t>(count) * places.size(), "a contact or part has as many as before");
  if (to.empty()) to.resize(size, 0.0);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (int k = 0; k < count; ++k)
      to.at(static_cast<std::size_t>(places[i] * count + k)) =
          some[i * static_cast<std::size_t>(count) + static_cast<std::size_t>(k)];
}

/// Numbers that are kept under a name; nothing if there are none.
const std::vector<double>& kept(const std::map<std::string, std::vector<double>>& of, const std::string& name) {
  static const std::vector<double> none;
  const auto found = of.find(name);
  return found == of.end() ? none : found->second;
}

const EndState::Of* find(const std::vector<EndState::Of>& list, const std::string& name) {
  const auto found = std::ranges::find(list, name, &EndState::Of::name);
  return found == list.end() ? nullptr : &*found;
}

[[noreturn]] void refuse(const model::Model& model, std::vector<std::string> messages) {
  std::vector<Diagnostic> diagnostics;
  for (std::string& message : messages) diagnostics.push_back({model.restart->source, std::move(message)});
  throw InputError(model.file, std::move(diagnostics));
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
  if (!messages.empty()) refuse(model, std::move(messages));
}

EndState read_end(const model::Model& model) {
  const std::string& directory = model.restart->directory;
  EndState end;
  try {
    Unsealing io(fs::path(directory) / model::state_at_end_file, end_mark);
    if (io.first_text() != end_version)
      refuse(model,
             {fmt::format("the state at the end of {} was written by another version of Scabo: run that model again",
                          directory)});
    exchange_end(io, end);
    io.finish();
  } catch (const InputError& error) {
    if (!error.diagnostics().empty() && error.diagnostics().front().at.line == model.restart->source.line) throw;
    refuse(model, {fmt::format("the state at the end of {} is damaged: run that model again", directory)});
  } catch (const std::logic_error&) {
    refuse(model, {fmt::format("the state at the end of {} is damaged: run that model again", directory)});
  }
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

/// What of two lists of agreements differs, in sentences.
std::vector<std::string> disagreements(const std::vector<EndState::Agreement>& there,
                                       const std::vector<EndState::Agreement>& here, const std::string& directory) {
  const auto by_name = [](const std::vector<EndState::Agreement>& list) {
    std::map<std::string, std::string> map;
    for (const EndState::Agreement& of : list) map.emplace(of.what, of.digest);
    return map;
  };
  const auto digests_there = by_name(there), digests_here = by_name(here);
  std::vector<std::string> messages;
  for (const EndState::Agreement& of : there) {
    const auto found = digests_here.find(of.what);
    if (found == digests_here.end())
      messages.push_back(
          fmt::format("{} is there at the end of {}, but not at the start of this model: what the state "
                      "depends on must be in both",
                      of.what, directory));
    else if (found->second != of.digest)
      messages.push_back(fmt::format(
          "{} is not the same as in {}: what the state depends on (plane, thickness, shape, mesh, with the nodes that "
          "other bodies need on its edges, material, place, and the value of a load that acts) must not change",
          of.what, directory));
  }
  for (const EndState::Agreement& of : here)
    if (!digests_there.contains(of.what))
      messages.push_back(
          fmt::format("{} is not there at the end of {}: it, or the body that it belongs to, must be 'added' in a step "
                      "of this model, the second one or a later one",
                      of.what, directory));
  return messages;
}

}  // namespace

namespace {

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
  end.version = end_version;
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

void write_end_state(const fs::path& directory, EndState end) {
  const fs::path factors = directory / model::factors_at_end_file;
  std::ofstream stream(factors, std::ios::binary);
  stream << "# Scabo: factors at the end of this run\n";
  for (const auto& [section, list] :
       {std::pair("loads", &end.loads), std::pair("supports", &end.supports), std::pair("placed", &end.placed),
        std::pair("bars", &end.tightened), std::pair("motion", &end.motion)}) {
    if (list->empty() && list != &end.loads && list != &end.supports) continue;
    stream << section << ":\n";
    for (const EndState::Factor& factor : *list) {
      std::string quoted;
      for (const char letter : factor.name) quoted += letter == '\'' ? "''" : std::string(1, letter);
      stream << fmt::format("  '{}': {}\n", quoted, factor.value);
    }
  }
  stream.close();
  if (!stream) throw std::runtime_error(fmt::format("cannot write {}", factors.string()));
  const fs::path file = directory / model::state_at_end_file, part = file.string() + ".part";
  Sealing io(end_mark);
  exchange_end(io, end);
  io.write(part);
  std::error_code error;
  fs::rename(part, file, error);
  if (error) throw std::runtime_error(fmt::format("cannot write {}: {}", file.string(), error.message()));
}

mesh::Placement placement_of_restart(const model::Model& model) { return placement_at_end(model, read_end(model)); }

State state_of_restart(const Prepared& now) {
  const std::string& directory = now.model.restart->directory;
  const EndState end = read_end(now.model);
  State state = initial_state(now);
  state.factors.loads = now.model.restart->load_factors;
  state.factors.supports = now.model.restart->support_factors;
  if (auto messages =
          disagreements(end.agreements, agreements_of(now, state, 0, now.model.restart->motion.has_value()), directory);
      !messages.empty())
    refuse(now.model, std::move(messages));
  for (const Field& field : fields_of_state())
    if (field.lasts) continue_field(now, end, field, state);
  continue_points(now, end, state);
  complete(now, state);
  if (continue_motions(now, end, state)) complete(now, state);
  place_new_bars(now, end, state);
  return state;
}

}  // namespace scabo::analysis
