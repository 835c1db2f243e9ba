#include "scabo/analysis/diagnostics/large_rotations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/base/components.hpp"
#include "scabo/geometry/plane/outline.hpp"

namespace scabo::analysis {

namespace {

constexpr double largest_small_rotation = 0.1;  // rad, as of prescribed rotations
constexpr double largest_tilt = 0.02;           // rad, of normals

/// The rigid motion nearest to displacements of nodes, and how far they are from it.
struct Moved {
  Vec2 along = Vec2::Zero();
  double rotation = 0.0;  ///< rad
  double deformed = 0.0;  ///< largest component that is left
};
Moved rigid_part(const std::vector<Vec2>& nodes, const Vector& u) {
  Vec2 centre = Vec2::Zero();
  Moved found;
  const auto count = static_cast<double>(nodes.size());
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    centre += nodes[node] / count;
    found.along += u.segment<2>(place_of(node)) / count;
  }
  double turning = 0.0, inertia = 0.0;
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    const Vec2 arm = nodes[node] - centre;
    turning += cross(arm, Vec2(u.segment<2>(place_of(node))));
    inertia += arm.squaredNorm();
  }
  found.rotation = turning / inertia;
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    const Vec2 arm = nodes[node] - centre;
    const Vec2 rigid = found.along + found.rotation * Vec2(-arm.y(), arm.x());
    found.deformed = std::max(found.deformed, (Vec2(u.segment<2>(place_of(node))) - rigid).lpNorm<Eigen::Infinity>());
  }
  return found;
}

/// What holds a body: words that follow "it is held by".
std::string what_holds(const Prepared& prepared, std::size_t part) {
  const system::BodySystem& of = *prepared.structure.parts[part];
  if (of.rigid_motions().cols() > 0) return "contact alone";
  return of.has_springs() && of.constraints().empty() ? "springs" : "its supports";
}

/// Rotation of a body, rad; 0 of one that is unbounded or not there.
double rotation_of(const Prepared& prepared, const State& state, int body) {
  const system::Dofs& dofs = prepared.structure.dofs;
  const std::size_t part = dofs.part_of(body);
  const auto b = static_cast<std::size_t>(body);
  if (prepared.model.bodies[b].outside || prepared.is_absent(part)) return 0.0;
  return dofs.is_rigid(part) ? state.u[part][2] / part_of(prepared, body).lever()
                             : rigid_part(prepared.mesh.bodies[b].nodes, dofs.of_body(body, state.u[part])).rotation;
}

/// A side of a contact with large slip.
struct Turned {
  const model::Body* body = nullptr;
  bool straight = false;
  double rotation = 0.0;  ///< rad
};
Turned turned_at(const Prepared& prepared, const State& state, const model::Place& side) {
  const model::Body& body = prepared.model.bodies[static_cast<std::size_t>(side.body)];
  return {&body, geometry::runs_straight(body.outline.edges[static_cast<std::size_t>(side.index)]),
          rotation_of(prepared, state, side.body)};
}

/// Angle between the normals of the pairs, which are those of the sides as they are drawn, and that of the straight
/// side as it is. A round side meets it in a point whose normal has turned onto it; normals bisect both, or are those
/// of the rigid one.
double wrong_by(const Turned& a, const Turned& b) {
  if (a.straight && b.straight) return std::min(std::abs(a.rotation), std::abs(b.rotation));
  if (a.body->rigid != b.body->rigid) return std::abs((a.body->rigid ? a : b).rotation);
  return 0.5 * std::abs(a.rotation + b.rotation);
}

/// `; it deforms by 1e-3 of its size only`: a body that rolls or tips. Empty for a rigid body, and one that bends.
std::string deformed_in_words(const Prepared& prepared, const State& state, int body) {
  const system::Dofs& dofs = prepared.structure.dofs;
  const std::size_t part = dofs.part_of(body);
  if (dofs.is_rigid(part)) return "";
  const Moved own =
      rigid_part(prepared.mesh.bodies[static_cast<std::size_t>(body)].nodes, dofs.of_body(body, state.u[part]));
  const double size = 2.0 * part_of(prepared, body).lever(), by_rotation = 0.5 * size * std::abs(own.rotation);
  if (own.deformed >= 0.1 * by_rotation) return "";
  return fmt::format("; it deforms by {:.1g} of its size only: it rolls or tips", own.deformed / size);
}

}  // namespace

std::string large_rotation(const Prepared& prepared, const State& state) {
  std::size_t most = 0;
  double largest = 0.0;
  for (std::size_t b = 0; b < prepared.model.bodies.size(); ++b) {
    const double rotation = rotation_of(prepared, state, static_cast<int>(b));
    if (std::abs(rotation) > std::abs(largest)) largest = rotation, most = b;
  }
  // A prescribed rotation of just this size is allowed.
  if (std::abs(largest) <= largest_small_rotation * (1.0 + 1e-9)) return {};
  return fmt::format(
      "body '{}' turns by {:.3g} rad, held by {}: the theory is valid for rotations of up to {:.3g} rad, and normals "
      "of "
      "contacts and directions of loads do not turn{}",
      prepared.model.bodies[most].name, largest,
      what_holds(prepared, prepared.structure.dofs.part_of(static_cast<int>(most))), largest_small_rotation,
      deformed_in_words(prepared, state, static_cast<int>(most)));
}

std::string large_displacement(const Prepared& prepared, const State& state) {
  const system::Dofs& dofs = prepared.structure.dofs;
  for (std::size_t b = 0; b < prepared.model.bodies.size(); ++b) {
    const auto body = static_cast<int>(b);
    const std::size_t part = dofs.part_of(body);
    if (dofs.is_rigid(part) || prepared.is_absent(part)) continue;
    const double size = 2.0 * prepared.structure.parts[part]->lever();
    Vector u = dofs.of_body(body, state.u[part]);
    const Moved own = rigid_part(prepared.mesh.bodies[b].nodes, u);
    if (model::has_large_slip(prepared.model.contacts))  // bodies may slide, and others push them, as far as they like
      u.reshaped(2, u.size() / 2).colwise() -= own.along;
    const double largest = u.lpNorm<Eigen::Infinity>();
    if (!(largest > 0.1 * size)) continue;
    const std::string how = own.deformed < 0.1 * largest
                                ? fmt::format("it moves as a whole, held by {}, and deforms by {:.3g} only",
                                              what_holds(prepared, part), own.deformed)
                                : fmt::format("{:.3g} of it are deformation", own.deformed);
    return fmt::format(
        "displacements of body '{}' reach {:.3g}, more than a tenth of its size: the theory is valid for small ones "
        "only; {}",
        prepared.model.bodies[b].name, largest, how);
  }
  return {};
}

std::vector<Warning> rotations_at_large_slip(const Prepared& prepared, const State& state) {
  std::vector<Warning> warnings;
  for (const model::Contact& contact : prepared.model.contacts) {
    if (!contact.large_slip) continue;
    const Turned a = turned_at(prepared, state, contact.a), b = turned_at(prepared, state, contact.b);
    const double tilt = wrong_by(a, b);
    if (tilt <= largest_tilt) continue;
    const Turned& most = std::abs(a.rotation) > std::abs(b.rotation) ? a : b;
    warnings.push_back(
        {WarningKind::large_displacement, contact.name,
         fmt::format(
             "body '{}' turns by {:.2g} rad, and normals of contact '{}' do not turn with it: the direction of "
             "the contact forces is wrong by about {:.2g} rad{}; keep the body from turning by a support or by "
             "loads close to the contact, or draw it in the position that it takes",
             most.body->name, most.rotation, contact.name, tilt,
             contact.friction > 0.0 ? fmt::format(", {:.0f} % of friction", 100.0 * tilt / contact.friction) : "")});
  }
  return warnings;
}

}  // namespace scabo::analysis
