#include "scabo/analysis/quasistatic/large_slip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scabo/analysis/state/carried_over.hpp"
#include "scabo/base/stopwatch.hpp"
#include "scabo/linalg/decompositions.hpp"

namespace scabo::analysis {

namespace {

/// The sides pass each other by this part of an element until their pairs are found anew, and by no more in one
/// attempt.
constexpr double part_of_element = 0.5;
constexpr double near_to_part = 0.01;     // elastic slip makes parts of increments that end there a little shorter
constexpr double part_of_overlap = 1e-3;  // by which it may change with the same pairs, and the forces with it

const model::Edge& edge_of(const model::Model& model, const model::Place& place) {
  return model.bodies[static_cast<std::size_t>(place.body)].outline.edges[static_cast<std::size_t>(place.index)];
}

/// Along the straight edges of a contact; if both are straight, halfway between them.
Vec2 direction_of(const model::Model& model, const model::Contact& contact) {
  Vec2 along = Vec2::Zero();
  const model::Edge &a = edge_of(model, contact.a), &b = edge_of(model, contact.b);
  if (geometry::runs_straight(a)) along -= (a.end - a.start).normalized();  // t: n is the outward normal of A
  if (geometry::runs_straight(b)) along += (b.end - b.start).normalized();
  return along.normalized();
}

/// Interval of an edge along a direction.
std::array<double, 2> extent_along(const model::Edge& edge, const Vec2& along) {
  constexpr int samples = 64;
  std::array<double, 2> extent{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (int k = 0; k <= samples; ++k) {
    const double s = edge.at(k / static_cast<double>(samples)).dot(along);
    extent = {std::min(extent[0], s), std::max(extent[1], s)};
  }
  return extent;
}

/// Length over which the two sides face each other.
double facing_length(const model::Model& model, const model::Contact& contact, const Vec2& along,
                     const std::array<Vec2, 2>& moved) {
  const auto a = extent_along(edge_of(model, contact.a), along), b = extent_along(edge_of(model, contact.b), along);
  const double by_a = moved[0].dot(along), by_b = moved[1].dot(along);
  return std::max(0.0, std::min(a[1] + by_a, b[1] + by_b) - std::max(a[0] + by_a, b[0] + by_b));
}

/// Length of the shortest element of the elastic sides.
double shortest_element(const model::Model& model, const model::Contact& contact,
                        const std::vector<mesh::BodyMesh>& bodies) {
  double shortest = std::numeric_limits<double>::max();
  for (const model::Place* place : {&contact.a, &contact.b}) {
    const auto b = static_cast<std::size_t>(place->body);
    if (model.bodies[b].rigid) continue;
    for (const mesh::LineElement& element : bodies[b].edges[static_cast<std::size_t>(place->index)])
      shortest = std::min(shortest, (bodies[b].nodes[static_cast<std::size_t>(element.nodes.back())] -
                                     bodies[b].nodes[static_cast<std::size_t>(element.nodes.front())])
                                        .norm());
  }
  return shortest;
}

/// Mean displacement along a direction of the points on sides A and B of the pairs of a contact, weighted by their
/// normal forces; of all pairs alike if none presses.
std::array<double, 2> mean_displacements(const Prepared& prepared, const State& state, std::size_t contact,
                                         const Vec2& along) {
  std::array<double, 2> weighted{}, plain{};
  double weights = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    const system::ContactSystem::Pair& at = prepared.contact.pairs[i];
    if (static_cast<std::size_t>(at.contact) != contact) continue;
    const mesh::ContactPair& pair = prepared.mesh.interfaces[contact].pairs[static_cast<std::size_t>(at.index)];
    const double weight = std::max(state.p[static_cast<Eigen::Index>(2 * i)], 0.0);
    for (const int side : {0, 1}) {
      const double u = displacement_of(prepared, state, at.contact, pair, side).dot(along);
      weighted[static_cast<std::size_t>(side)] += weight * u;
      plain[static_cast<std::size_t>(side)] += u;
    }
    weights += weight;
    ++count;
  }
  if (count == 0) {  // the sides have left each other: as far as their parts have moved
    const model::Contact& named = prepared.model.contacts[contact];
    for (const int side : {0, 1}) {
      const int body = side == 0 ? named.a.body : named.b.body;
      const system::Dofs& dofs = prepared.structure.dofs;
      const std::size_t part = dofs.part_of(body);
      Vec2 u = dofs.is_rigid(part) ? Vec2(state.u[part].head<2>())
                                   : Vec2(state.u[part].reshaped(2, state.u[part].size() / 2).rowwise().mean());
      if (!state.replaced.moved.empty()) u += state.replaced.moved[part];
      plain[static_cast<std::size_t>(side)] = u.dot(along);
    }
    count = 1;
  }
  if (weights > 0.0) return {weighted[0] / weights, weighted[1] / weights};
  return {plain[0] / count, plain[1] / count};
}

/// Translations that displacements need not contain (Replacing::moved).
std::vector<Vec2> translations(const Prepared& prepared, const State& state, const mesh::Placement& placement) {
  const system::Dofs& dofs = prepared.structure.dofs;
  std::vector<Vec2> moved(dofs.parts(), Vec2::Zero());
  std::vector<bool> slides(dofs.parts(), false);
  for (std::size_t c = 0; c < placement.size(); ++c) {
    const model::Contact& contact = prepared.model.contacts[c];
    if (!contact.large_slip) continue;
    for (const int side : {0, 1}) {
      const std::size_t part = dofs.part_of(side == 0 ? contact.a.body : contact.b.body);
      const Vec2& by = placement[c][static_cast<std::size_t>(side)];
      slides[part] = true;
      if (by.norm() > moved[part].norm()) moved[part] = by;
    }
  }
  for (std::size_t p = 0; p < moved.size(); ++p) {
    if (dofs.is_unbounded(p) || prepared.structure.parts[p]->has_springs()) {
      moved[p] = Vec2::Zero();
    } else if (!slides[p]) {
      if (!state.replaced.moved.empty()) moved[p] = state.replaced.moved[p];
      moved[p] += dofs.is_rigid(p) ? Vec2(state.u[p].head<2>())
                                   : Vec2(state.u[p].reshaped(2, state.u[p].size() / 2).rowwise().mean());
    }
  }
  return moved;
}

/// Resultant on B of every contact.
std::vector<Vec2> resultants(const Prepared& prepared, const State& state) {
  std::vector<Vec2> sums(prepared.model.contacts.size(), Vec2::Zero());
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    const system::ContactSystem::Pair& at = prepared.contact.pairs[i];
    const Vec2& n =
        prepared.mesh.interfaces[static_cast<std::size_t>(at.contact)].pairs[static_cast<std::size_t>(at.index)].normal;
    const auto k = static_cast<Eigen::Index>(2 * i);
    sums[static_cast<std::size_t>(at.contact)] += state.p[k] * n + state.p[k + 1] * tangent_of(n);
  }
  return sums;
}

/// The contact of every pair has large slip.
std::vector<bool> on_large_slip(const Prepared& prepared) {
  std::vector<bool> large;
  for (const system::ContactSystem::Pair& at : prepared.contact.pairs)
    large.push_back(prepared.model.contacts[static_cast<std::size_t>(at.contact)].large_slip);
  return large;
}

/// Relative motion, B less A, that the translations of the parts give a pair: the displacements do not contain it.
Vec2 motion_of_parts(const Prepared& prepared, const Replacing& replaced, int contact) {
  const std::array<Vec2, 2>& by = replaced.placement[static_cast<std::size_t>(contact)];
  return unplaced_motion(prepared, replaced, contact) + by[1] - by[0];
}

/// Largest mean, of all contacts with large slip, of the slip of closed pairs from the motion that is carried over to
/// `motion`.
double largest_mean_slip(const Prepared& prepared, const std::vector<CarriedPair>& carried, const State& state,
                         const Vector& motion) {
  std::vector<double> sum(prepared.model.contacts.size(), 0.0);
  std::vector<int> count(sum.size(), 0);
  for (std::size_t i = 0; i < carried.size(); ++i) {
    const system::ContactSystem::Pair& at = prepared.contact.pairs[i];
    const auto c = static_cast<std::size_t>(at.contact);
    if (!carried[i].closed || !prepared.model.contacts[c].large_slip) continue;
    const Vec2 t = tangent_of(prepared.mesh.interfaces[c].pairs[static_cast<std::size_t>(at.index)].normal);
    sum[c] += motion[static_cast<Eigen::Index>(2 * i + 1)] -
              (carried[i].motion - motion_of_parts(prepared, state.replaced, at.contact)).dot(t);
    ++count[c];
  }
  double largest = 0.0;
  for (std::size_t c = 0; c < sum.size(); ++c)
    if (count[c] > 0) largest = std::max(largest, std::abs(sum[c]) / count[c]);
  return largest;
}

/// Rigid motions that close the pairs that were closed and that let those of large slip be where they were, in the
/// mean; `motion`: of the pairs without rigid motions.
Vector fitting_motions(const Prepared& prepared, const std::vector<CarriedPair>& carried, const State& state,
                       const Vector& motion) {
  const contact::RigidMap& G = prepared.contact.G;
  if (G.cols() == 0) return Vector::Zero(0);
  Vector weight = Vector::Zero(G.rows()), target = Vector::Zero(G.rows());
  for (std::size_t i = 0; i < carried.size(); ++i) {
    if (!carried[i].closed) continue;
    const system::ContactSystem::Pair& at = prepared.contact.pairs[i];
    const mesh::ContactPair& pair =
        prepared.mesh.interfaces[static_cast<std::size_t>(at.contact)].pairs[static_cast<std::size_t>(at.index)];
    const auto n = static_cast<Eigen::Index>(2 * i);
    const Vec2 of_parts = motion_of_parts(prepared, state.replaced, at.contact);
    weight[n] = weight[n + 1] = 1.0;
    target[n] = -(gap_at(prepared, state.factors, n / 2) + state.replaced.offset[n] + motion[n]);
    target[n + 1] = (carried[i].motion - of_parts).dot(tangent_of(pair.normal)) - motion[n + 1];
  }
  const Eigen::SparseMatrix<double> weighted = weight.asDiagonal() * G.sparse();
  Matrix normal = Matrix(weighted.transpose() * weighted);
  normal.diagonal().array() += 1e-12 * std::max(normal.diagonal().maxCoeff(), std::numeric_limits<double>::min());
  return normal.ldlt().solve(weighted.transpose() * target);
}

/// Changes the forces of the pairs so that their sums on every contact are those that are carried over.
void keep_sums(const Prepared& prepared, const std::vector<Vec2>& sums, Vector& p) {
  std::vector<Vec2> now(sums.size(), Vec2::Zero());
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i)
    now[static_cast<std::size_t>(prepared.contact.pairs[i].contact)] += p.segment<2>(static_cast<Eigen::Index>(2 * i));
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    const auto c = static_cast<std::size_t>(prepared.contact.pairs[i].contact);
    if (!(now[c][0] > 0.0) || !(sums[c][0] > 0.0)) continue;
    double &normal = p[static_cast<Eigen::Index>(2 * i)], &tangential = p[static_cast<Eigen::Index>(2 * i + 1)];
    tangential += (sums[c][1] - now[c][1]) * normal / now[c][0];
    normal *= sums[c][0] / now[c][0];
  }
}

/// Sums of the normal and tangential forces of every contact.
std::vector<Vec2> sums_of(const Prepared& prepared, const State& state) {
  std::vector<Vec2> sums(prepared.model.contacts.size(), Vec2::Zero());
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i)
    sums[static_cast<std::size_t>(prepared.contact.pairs[i].contact)] +=
        state.p.segment<2>(static_cast<Eigen::Index>(2 * i));
  return sums;
}

/// The state on new pairs from which contact is solved again; `sums`: of the forces of every contact. `astray`: by how
/// much pairs slip at most, in the mean of a contact, from where they were to where the forces carried over put them.
State start_on(const Prepared& prepared, const std::vector<CarriedPair>& carried, const State& before,
               const std::vector<Vec2>& sums, Replacing replaced, double& astray) {
  const auto N = static_cast<Eigen::Index>(carried.size());
  const std::vector<bool> large = on_large_slip(prepared);
  State state;
  state.factors = before.factors;
  state.largest_force = before.largest_force;
  state.p = Vector::Zero(2 * N);
  state.slip = Vector::Zero(N);
  state.gap = Vector::Zero(N);  // not known before contact is solved
  state.replaced = std::move(replaced);
  state.replaced.offset = Vector::Zero(2 * N);
  state.replaced.slip_before = Vector::Zero(N);
  for (Eigen::Index i = 0; i < N; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const int contact = prepared.contact.pairs[k].contact;
    const Vec2& n = prepared.mesh.interfaces[static_cast<std::size_t>(contact)]
                        .pairs[static_cast<std::size_t>(prepared.contact.pairs[k].index)]
                        .normal;
    const Vec2 unplaced = unplaced_motion(prepared, state.replaced, contact);
    state.p[2 * i] = carried[k].pressure * prepared.contact.laws.area[i];
    state.p[2 * i + 1] = carried[k].shear * prepared.contact.laws.area[i];
    state.replaced.offset[2 * i] = unplaced.dot(n);
    if (large[k]) {
      state.replaced.slip_before[i] = carried[k].slip;
    } else {
      state.replaced.offset[2 * i + 1] = unplaced.dot(tangent_of(n));
      state.slip[i] = carried[k].slip;
    }
    state.history.push_back(carried[k].history);
    state.states.push_back(contact::ContactState::open);
  }
  keep_sums(prepared, sums, state.p);
  Vector motion = Vector::Zero(2 * N);
  const std::vector<Vector> u = displacements_without_motions(prepared, state);
  for (std::size_t p = 0; p < u.size(); ++p) motion.noalias() += prepared.contact.motion[p] * u[p];
  state.rigid_motion = fitting_motions(prepared, carried, state, motion);
  if (state.rigid_motion.size() > 0) prepared.contact.G.add_motion(state.rigid_motion, motion);
  for (Eigen::Index i = 0; i < N; ++i)
    if (large[static_cast<std::size_t>(i)]) state.replaced.offset[2 * i + 1] = -motion[2 * i + 1];
  astray = largest_mean_slip(prepared, carried, state, motion);
  complete(prepared, state, &u);
  return state;
}

/// A slip beyond which the elastic motions of the pairs do not go.
double beyond_elastic_motion(const std::vector<bool>& large, const Replacing& replaced, double element) {
  double least = std::numeric_limits<double>::max(), most = std::numeric_limits<double>::lowest();
  for (std::size_t i = 0; i < large.size(); ++i) {
    if (!large[i]) continue;
    const double t = replaced.offset[static_cast<Eigen::Index>(2 * i + 1)];
    least = std::min(least, t);
    most = std::max(most, t);
  }
  return most > least ? 2.0 * (most - least) : 1e-3 * element;
}

/// Forces fell while the sides slid off each other, not at once when their pairs were found anew: corrects the work of
/// friction, and of what moved the sides against it, to that of the mean of the forces. `slid`: motion of B along A of
/// every contact; `before`, `after`: resultants on B.
void count_falling_forces(const std::vector<Vec2>& slid, const std::vector<Vec2>& before,
                          const std::vector<Vec2>& after, Energy& energy) {
  for (std::size_t c = 0; c < slid.size(); ++c) {
    const double change = -0.5 * (after[c] - before[c]).dot(slid[c]);
    energy.friction += change;
    energy.external += change;
  }
}

/// Contact on new pairs under the same loads, with the direction of slip that is carried over and, where that is not
/// accepted, without.
Attempt solved_on(const Prepared& prepared, const State& start, const std::vector<CarriedPair>& carried, double astray,
                  FoundAnew& found) {
  const std::vector<bool> slides = on_large_slip(prepared);
  double element = 0.0;
  for (const std::array<Vec2, 2>& by : start.replaced.placement) element = std::max(element, (by[1] - by[0]).norm());
  const double bias = beyond_elastic_motion(slides, start.replaced, element) + 2.0 * astray;
  Attempt tried;
  for (const bool keep_directions : {true, false}) {
    State from = start;
    for (std::size_t i = 0; keep_directions && i < slides.size(); ++i)
      if (slides[i]) from.slip[static_cast<Eigen::Index>(i)] = -bias * carried[i].direction;
    tried = attempt(prepared, from, start.factors);
    found.iterations += tried.solution.iterations;
    if (tried.accepted) break;
  }
  if (!tried.accepted)
    found.reason = "pairs were found anew, but contact was not solved on them under the same loads: " +
                   (!tried.rolls.empty() ? tried.rolls
                    : tried.solution.status == contact::Status::solved
                        ? fmt::format("the largest figure of the certificate is {:.3g}", tried.certificate.worst())
                        : tried.solution.reason);
  found.certificate = tried.certificate;
  found.residual = tried.solution.residual;
  return tried;
}

/// The state on new pairs, whose slip counts from here on; work so far is that of the state before.
State settled(const Prepared& prepared, State now, const State& start, const Energy& before) {
  const std::vector<bool> slides = on_large_slip(prepared);
  for (std::size_t i = 0; i < slides.size(); ++i) {
    if (!slides[i]) continue;
    const auto k = static_cast<Eigen::Index>(i);
    now.replaced.offset[2 * k + 1] -= now.slip[k];
    now.slip[k] = 0.0;
  }
  now.history = start.history;
  const double elastic = now.energy.elastic;
  now.energy = before;
  now.energy.elastic = elastic;
  return now;
}

}  // namespace

LargeSlip::LargeSlip(const model::Model& model) : bodies_(mesh::divided_bodies(model)) {
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const model::Contact& contact = model.contacts[c];
    if (!contact.large_slip) continue;
    const Vec2 along = direction_of(model, contact);
    contacts_.push_back({c, along, shortest_element(model, contact, bodies_),
                         facing_length(model, contact, along, {Vec2::Zero(), Vec2::Zero()})});
  }
}

double LargeSlip::lag(const Prepared& prepared, const State& state, const Of& of) const {
  const auto [a, b] = mean_displacements(prepared, state, of.contact, of.along);
  const mesh::Placement& placement = state.replaced.placement;
  if (placement.empty()) return b - a;
  return b - a - (placement[of.contact][1] - placement[of.contact][0]).dot(of.along);
}

bool LargeSlip::is_due(const Prepared& prepared, const State& state) const {
  return std::any_of(contacts_.begin(), contacts_.end(), [&](const Of& of) {
    return std::abs(lag(prepared, state, of)) >= part_of_element * (1.0 - near_to_part) * of.element;
  });
}

double LargeSlip::passed(const Prepared& prepared, const State& from, const State& to) const {
  double most = 0.0;
  for (const Of& of : contacts_)
    most = std::max(most, std::abs(lag(prepared, to, of) - lag(prepared, from, of)) / (part_of_element * of.element));
  return most <= 1.0 + near_to_part ? std::min(most, 1.0) : most;
}

bool LargeSlip::overlap_changed(const Prepared& prepared, const State& state) const {
  const mesh::Placement now = placement_of(prepared, state), &found = state.replaced.placement;
  return std::any_of(contacts_.begin(), contacts_.end(), [&](const Of& of) {
    const model::Contact& contact = prepared.model.contacts[of.contact];
    const double before =
        found.empty() ? of.facing : facing_length(prepared.model, contact, of.along, found[of.contact]);
    return std::abs(facing_length(prepared.model, contact, of.along, now[of.contact]) - before) >
           part_of_overlap * before;
  });
}

std::vector<Vec2> LargeSlip::motions(const Prepared& prepared, const State& from, const State& to) const {
  std::vector<Vec2> motions(prepared.model.contacts.size(), Vec2::Zero());
  for (const Of& of : contacts_) motions[of.contact] = (lag(prepared, to, of) - lag(prepared, from, of)) * of.along;
  return motions;
}

mesh::Placement LargeSlip::placement_of(const Prepared& prepared, const State& state) const {
  mesh::Placement placement(prepared.model.contacts.size(), {Vec2::Zero(), Vec2::Zero()});
  for (const Of& of : contacts_) {
    const auto [a, b] = mean_displacements(prepared, state, of.contact, of.along);
    placement[of.contact] = {Vec2(a * of.along), Vec2(b * of.along)};
  }
  return placement;
}

std::variant<mesh::Mesh, std::vector<Diagnostic>> LargeSlip::mesh_in(const model::Model& model,
                                                                     mesh::Placement placement) const {
  return mesh::pair_in(model, bodies_, std::move(placement));
}

std::vector<std::pair<std::size_t, std::string>> LargeSlip::slid_off(const model::Model& model,
                                                                     const mesh::Placement& placement) const {
  std::vector<std::pair<std::size_t, std::string>> sentences;
  for (const Of& of : contacts_) {
    const double facing = facing_length(model, model.contacts[of.contact], of.along, placement[of.contact]);
    if (facing >= of.facing - 0.1 * of.element) continue;
    sentences.emplace_back(of.contact, fmt::format("the sides of contact '{}' slide off each other: they face each "
                                                   "other over {:.4g}, at the start over {:.4g}; pairs beyond the "
                                                   "end of a side are dropped",
                                                   model.contacts[of.contact].name, facing, of.facing));
  }
  return sentences;
}

FoundAnew find_pairs_anew(const LargeSlip& large, const Prepared& at, const State& since, State& state,
                          Timing& timing) {
  FoundAnew found;
  const bool slides_off = large.overlap_changed(at, state);
  const std::vector<Vec2> slid = large.motions(at, since, state);
  Replacing replaced;
  replaced.placement = large.placement_of(at, state);
  replaced.moved = translations(at, state, replaced.placement);
  const CarriedPairs before = pairs_to_carry(at, state);
  const std::vector<Vec2> forces = resultants(at, state), sums = sums_of(at, state);

  auto divided = timed(timing.mesh, [&] { return large.mesh_in(at.model, replaced.placement); });
  if (const auto* wrong = std::get_if<std::vector<Diagnostic>>(&divided)) {
    found.reason = "pairs were not found where the sides have moved: " + wrong->front().message;
    return found;
  }
  found.discretisation = remesh(at.discretisation, at.model, std::get<mesh::Mesh>(std::move(divided)), timing);
  const Prepared prepared(found.discretisation, at.on_iteration);

  const std::vector<CarriedPair> carried = carried_to(prepared, before);
  double astray = 0.0;
  const State start = start_on(prepared, carried, state, sums, std::move(replaced), astray);
  Attempt tried = timed(timing.newton, [&] { return solved_on(prepared, start, carried, astray, found); });
  if (!found.reason.empty()) return found;

  State now = settled(prepared, std::move(tried.state), start, state.energy);
  const std::vector<Vec2> after = resultants(prepared, now);
  if (slides_off) count_falling_forces(slid, forces, after, now.energy);
  for (std::size_t c = 0; c < forces.size(); ++c)
    if (forces[c].norm() > 1e-9 * state.largest_force)
      found.jump = std::max(found.jump, (after[c] - forces[c]).norm() / forces[c].norm());
  state = std::move(now);
  return found;
}

}  // namespace scabo::analysis
