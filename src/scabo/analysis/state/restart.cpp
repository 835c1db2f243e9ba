#include "scabo/analysis/state/restart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <system_error>
#include <type_traits>

#include "scabo/analysis/state/sealed_file.hpp"
#include "scabo/model/restart_files.hpp"

namespace scabo::analysis {

namespace {

namespace fs = std::filesystem;

constexpr const char* end_group = "scabo_end/";
constexpr const char* end_version = "4";

/// Digest of numbers and texts, one after the other.
class Fingerprint {
 public:
  void add(std::string_view text) { value_ = digest(text, digest(";", value_)); }
  void add(double number) {
    if (number == 0.0) number = 0.0;  // also -0
    value_ = digest({reinterpret_cast<const char*>(&number), sizeof number}, value_);
  }
  void add(const Vec2& x) { add(x.x()), add(x.y()); }
  void add(const Vector& values) {
    add(static_cast<double>(values.size()));
    for (const double value : values) add(value);
  }
  std::string text() const { return hexadecimal(value_); }

 private:
  std::uint64_t value_ = digest_start;
};

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

/// Shape, mesh and material of a body, and the bodies it is tied to.
std::string fingerprint_of_body(const Prepared& now, std::size_t b) {
  Fingerprint of;
  const model::Body& body = now.model.bodies[b];
  of.add(now.model.analysis.plane == model::Plane::strain ? "strain" : "stress");
  of.add(now.model.analysis.thickness);
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
  for (std::size_t p = 0; p < now.structure.parts.size(); ++p)
    for (const system::Constraint& constraint : now.structure.parts[p]->constraints()) {
      if (constraint.support != static_cast<int>(support)) continue;
      of.add(static_cast<double>(constraint.dof)), of.add(static_cast<double>(constraint.component));
      of.add(constraint.point), of.add(constraint.inclined), of.add(constraint.value);
      of.add(constraint.rotation ? 1.0 : 0.0);
    }
  return of.text();
}

std::string fingerprint_of_contact(const Prepared& now, const State& state, std::size_t contact) {
  Fingerprint of;
  const auto index = static_cast<int>(contact);
  for (std::size_t i = 0; i < now.contact.pairs.size(); ++i) {
    if (now.contact.pairs[i].contact != index) continue;
    const mesh::ContactPair& pair =
        now.mesh.interfaces[contact].pairs[static_cast<std::size_t>(now.contact.pairs[i].index)];
    of.add(pair.normal), of.add(pair.point_a), of.add(pair.point_b);
    of.add(gap_at(now, state.factors, static_cast<Eigen::Index>(i)));
  }
  return of.text();
}

std::string fingerprint_of_load(const Prepared& now, std::size_t load) {
  Fingerprint of;
  for (std::size_t p = 0; p < now.structure.parts.size(); ++p) {
    const Vector& forces = now.structure.loads[load][p];
    if (now.is_absent(p) || forces.size() == 0 || forces.isZero(0.0)) continue;
    of.add(now.model.bodies[static_cast<std::size_t>(now.structure.dofs.bodies_of(p).front())].name);
    of.add(forces);
  }
  return of.text();
}

std::vector<EndState::Agreement> agreements_of(const Prepared& now, const State& state) {
  const model::Model& model = now.model;
  std::vector<EndState::Agreement> agreements;
  const auto add = [&](const char* kind, const std::string& name, std::string digest) {
    agreements.push_back({fmt::format("{} '{}'", kind, name), std::move(digest)});
  };
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (body_is_there(now, static_cast<int>(b))) add("body", model.bodies[b].name, fingerprint_of_body(now, b));
  for (std::size_t i = 0; i < model.supports.size(); ++i)
    if (body_is_there(now, model.supports[i].on.body))
      add("support", model.supports[i].name, fingerprint_of_support(now, i));
  for (const model::Spring& spring : model.springs) {
    if (!body_is_there(now, spring.on.body)) continue;
    Fingerprint of;
    of.add(spring.stiffness[0]), of.add(spring.stiffness[1]);
    of.add(static_cast<double>(spring.on.kind)), of.add(static_cast<double>(spring.on.index)), of.add(spring.on.near);
    add("spring", spring.name, of.text());
  }
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    if (body_is_there(now, model.contacts[c].a.body) && body_is_there(now, model.contacts[c].b.body))
      add("contact", model.contacts[c].name, fingerprint_of_contact(now, state, c));
  for (std::size_t load = 0; load < model.loads.size(); ++load)
    if (state.factors.loads[load] != 0.0) add("load", model.loads[load].name, fingerprint_of_load(now, load));
  return agreements;
}

template <typename Io, typename T, typename Exchange>
void exchange_list(Io& io, const std::string& path, std::vector<T>& list, const Exchange& exchange) {
  list.resize(exchange_count(io, path + "/count", list.size()));
  for (std::size_t i = 0; i < list.size(); ++i) exchange(fmt::format("{}/{}", path, i), list[i]);
}

template <typename Io>
void exchange_pairs(Io& io, const std::string& path, EndState::OfContact& of) {
  io.text(path + "/name", of.name);
  exchange_vector(io, path + "/p", of.p);
  exchange_vector(io, path + "/gap", of.gap);
  exchange_vector(io, path + "/slip", of.slip);
  exchange_vector(io, path + "/offset", of.offset);
  exchange_vector(io, path + "/held_offset", of.held_offset);
  exchange_vector(io, path + "/replaced_offset", of.replaced_offset);
  exchange_vector(io, path + "/slip_before", of.slip_before);
  io.numbers(path + "/placement", of.placement);
  std::vector<int> states, flags;
  std::vector<double> accumulated;
  for (const contact::ContactState state : of.states) states.push_back(static_cast<int>(state));
  for (const contact::PairHistory& pair : of.history) {
    accumulated.push_back(pair.slip);
    flags.push_back(2 * pair.broken + pair.slipped);
  }
  io.integers(path + "/states", states);
  io.numbers(path + "/accumulated_slip", accumulated);
  io.integers(path + "/flags", flags);
  if constexpr (Io::reads) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      of.states.push_back(static_cast<contact::ContactState>(states[i]));
      of.history.push_back({accumulated.at(i), (flags.at(i) & 2) != 0, (flags.at(i) & 1) != 0});
    }
  }
}

template <typename Io>
void exchange_end(Io& io, EndState& end) {
  io.text("version", end.version);
  exchange_list(io, "agreements", end.agreements, [&](const std::string& path, EndState::Agreement& of) {
    io.text(path + "/what", of.what), io.text(path + "/digest", of.digest);
  });
  exchange_list(io, "contacts", end.contacts,
                [&](const std::string& path, EndState::OfContact& of) { exchange_pairs(io, path, of); });
  exchange_list(io, "parts", end.parts, [&](const std::string& path, EndState::OfPart& of) {
    io.text(path + "/body", of.body), exchange_vector(io, path + "/a", of.a);
    io.numbers(path + "/moved", of.moved);
    io.numbers(path + "/referred", of.referred);
  });
  exchange_scalars(io, "energy",
                   {&end.energy.external, &end.energy.elastic, &end.energy.friction, &end.energy.friction_error});
  exchange_scalars(io, "largest_force", {&end.largest_force});
}

/// Positions of the pairs of a contact in the list of all.
std::vector<Eigen::Index> places_of_contact(const std::vector<system::ContactSystem::Pair>& pairs,
                                            std::size_t contact) {
  std::vector<Eigen::Index> places;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (pairs[i].contact == static_cast<int>(contact)) places.push_back(static_cast<Eigen::Index>(i));
  return places;
}

/// `values` for each of some pairs; nothing if there are none at all.
Vector selected(const Vector& from, const std::vector<Eigen::Index>& places, Eigen::Index values) {
  if (from.size() == 0) return {};
  Vector some(values * static_cast<Eigen::Index>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i)
    some.segment(values * static_cast<Eigen::Index>(i), values) = from.segment(values * places[i], values);
  return some;
}
void put(const Vector& some, const std::vector<Eigen::Index>& places, Eigen::Index values, Vector& to,
         Eigen::Index size) {
  if (some.size() == 0) return;
  ensure(some.size() == values * static_cast<Eigen::Index>(places.size()), "a contact has as many pairs as before");
  if (to.size() == 0) to = Vector::Zero(size);
  for (std::size_t i = 0; i < places.size(); ++i)
    to.segment(values * places[i], values) = some.segment(values * static_cast<Eigen::Index>(i), values);
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
    const auto of = std::find_if(end.contacts.begin(), end.contacts.end(),
                                 [&](const EndState::OfContact& there) { return there.name == contact.name; });
    if (of == end.contacts.end()) continue;
    if (!contact.large_slip &&
        std::any_of(of->placement.begin(), of->placement.end(), [](double x) { return x != 0.0; }))
      messages.push_back(
          fmt::format("the sides of contact '{}' have passed each other in {}: give it 'slip: large' here too",
                      contact.name, directory));
    if (contact.large_slip && of->offset.size() > 0)
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
    Unsealing io((fs::path(directory) / model::state_at_end_file).string(), end_group);
    if (io.text_of("version") != end_version)
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

Vec2 vector_at(const std::vector<double>& numbers, std::size_t first) {
  return {numbers.at(first), numbers.at(first + 1)};
}

/// In the placement of a model; empty if no pairs were found anew.
mesh::Placement placement_at_end(const model::Model& model, const EndState& end) {
  mesh::Placement placement;
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    for (const EndState::OfContact& of : end.contacts) {
      if (of.name != model.contacts[c].name || of.placement.empty()) continue;
      if (placement.empty()) placement.assign(model.contacts.size(), {Vec2::Zero(), Vec2::Zero()});
      placement[c] = {vector_at(of.placement, 0), vector_at(of.placement, 2)};
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
      messages.push_back(
          fmt::format("{} is not the same as in {}: what the state depends on (shape, mesh, with the nodes that other "
                      "bodies need on its edges, material, place, and the value of a load that acts) must not change",
                      of.what, directory));
  }
  for (const EndState::Agreement& of : here)
    if (!digests_there.contains(of.what))
      messages.push_back(
          fmt::format("{} is not there at the end of {}: add the body that it belongs to in a step of this "
                      "model ('added', the second one or a later one)",
                      of.what, directory));
  return messages;
}

}  // namespace

EndState end_state(const Prepared& now, const State& state) {
  EndState end;
  end.version = end_version;
  end.agreements = agreements_of(now, state);
  for (std::size_t c = 0; c < now.model.contacts.size(); ++c) {
    const auto places = places_of_contact(now.contact.pairs, c), held = places_of_contact(now.contact.held, c);
    EndState::OfContact& of = end.contacts.emplace_back();
    of.name = now.model.contacts[c].name;
    of.p = selected(state.p, places, 2);
    of.gap = selected(state.gap, places, 1);
    of.slip = selected(state.slip, places, 1);
    of.offset = selected(state.offset, places, 2);
    of.held_offset = selected(state.held_offset, held, 2);
    of.replaced_offset = selected(state.replaced.offset, places, 2);
    of.slip_before = selected(state.replaced.slip_before, places, 1);
    if (!state.replaced.placement.empty())
      for (const Vec2& by : state.replaced.placement[c]) of.placement.insert(of.placement.end(), by.begin(), by.end());
    for (const Eigen::Index place : places) {
      of.history.push_back(state.history[static_cast<std::size_t>(place)]);
      of.states.push_back(state.states[static_cast<std::size_t>(place)]);
    }
  }
  for (std::size_t p = 0; p < now.structure.parts.size(); ++p) {
    if (now.is_absent(p)) continue;
    const Eigen::Index m = now.structure.parts[p]->rigid_motions().cols();
    const auto body = static_cast<std::size_t>(now.structure.dofs.bodies_of(p).front());
    EndState::OfPart& of = end.parts.emplace_back();
    of.body = now.model.bodies[body].name;
    of.a = state.a.segment(now.contact.first_rigid[p], m);
    if (!state.replaced.moved.empty()) of.moved.assign(state.replaced.moved[p].begin(), state.replaced.moved[p].end());
    if (!state.referred.empty()) of.referred.assign(state.referred[p].begin(), state.referred[p].end());
  }
  for (std::size_t i = 0; i < now.model.loads.size(); ++i)
    end.loads.push_back({now.model.loads[i].name, state.factors.loads[i]});
  for (std::size_t i = 0; i < now.model.supports.size(); ++i)
    end.supports.push_back({now.model.supports[i].name, state.factors.supports[i]});
  end.energy = state.energy;
  end.largest_force = state.largest_force;
  return end;
}

void write_end_state(const fs::path& directory, EndState end) {
  const fs::path factors = directory / model::factors_at_end_file;
  std::ofstream stream(factors, std::ios::binary);
  stream << "# Scabo: factors at the end of this run\n";
  for (const auto& [section, list] : {std::pair("loads", &end.loads), std::pair("supports", &end.supports)}) {
    stream << section << ":\n";
    for (const EndState::Factor& factor : *list) {
      std::string quoted;
      for (const char letter : factor.name) quoted += letter == '\'' ? "''" : std::string(1, letter);
      stream << fmt::format("  '{}': {}\n", quoted, factor.value);
    }
  }
  stream.close();
  if (!stream) throw std::runtime_error(fmt::format("cannot write {}", factors.string()));
  const fs::path file = directory / model::state_at_end_file, part = directory / "end.hdf5.part";
  Sealing io(part.string(), end_group);
  exchange_end(io, end);
  io.finish();
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
  if (auto messages = disagreements(end.agreements, agreements_of(now, state), directory); !messages.empty())
    refuse(now.model, std::move(messages));
  state.replaced.placement = placement_at_end(now.model, end);
  if (!state.replaced.placement.empty()) state.replaced.moved.assign(now.structure.parts.size(), Vec2::Zero());
  const auto N = static_cast<Eigen::Index>(now.contact.pairs.size());
  for (std::size_t c = 0; c < now.model.contacts.size(); ++c) {
    const auto found = std::find_if(end.contacts.begin(), end.contacts.end(), [&](const EndState::OfContact& of) {
      return of.name == now.model.contacts[c].name;
    });
    const auto places = places_of_contact(now.contact.pairs, c), held = places_of_contact(now.contact.held, c);
    if (found == end.contacts.end() || (places.empty() && held.empty())) continue;
    put(found->p, places, 2, state.p, 2 * N);
    put(found->gap, places, 1, state.gap, N);
    put(found->slip, places, 1, state.slip, N);
    put(found->offset, places, 2, state.offset, 2 * N);
    put(found->held_offset, held, 2, state.held_offset, static_cast<Eigen::Index>(2 * now.contact.held.size()));
    put(found->replaced_offset, places, 2, state.replaced.offset, 2 * N);
    put(found->slip_before, places, 1, state.replaced.slip_before, N);
    for (std::size_t i = 0; i < places.size(); ++i) {
      state.history[static_cast<std::size_t>(places[i])] = found->history.at(i);
      state.states[static_cast<std::size_t>(places[i])] = found->states.at(i);
    }
  }
  for (const EndState::OfPart& of : end.parts)
    for (std::size_t p = 0; p < now.structure.parts.size(); ++p) {
      const auto body = static_cast<std::size_t>(now.structure.dofs.bodies_of(p).front());
      if (now.is_absent(p) || now.model.bodies[body].name != of.body) continue;
      if (!of.moved.empty() && !state.replaced.moved.empty()) state.replaced.moved[p] = vector_at(of.moved, 0);
      if (!of.referred.empty()) {
        state.referred.resize(now.structure.parts.size(), Vec2::Zero());
        state.referred[p] = vector_at(of.referred, 0);
      }
      if (of.a.size() == 0) continue;
      state.a.segment(now.contact.first_rigid[p], of.a.size()) = of.a;
    }
  state.energy = end.energy;
  state.largest_force = end.largest_force;
  complete(now, state);
  return state;
}

}  // namespace scabo::analysis
