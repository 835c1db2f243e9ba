#include "scabo/analysis/diagnostics/wedged_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "scabo/base/components.hpp"
#include "scabo/contact/questions/infeasibility.hpp"

namespace scabo::analysis {

namespace {

/// A pair as its node of the body knows it.
struct Touching {
  Eigen::Index pair = 0;
  Vec2 normal;  // into the body
};

/// Nodes at which several pairs meet, by body and node.
std::map<std::pair<int, int>, std::vector<Touching>> shared_nodes(const Prepared& prepared) {
  std::map<std::pair<int, int>, std::vector<Touching>> nodes;
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    const system::ContactSystem::Pair& at = prepared.contact.pairs[i];
    if (at.is_bar()) continue;
    const model::Contact& contact = prepared.model.contacts[static_cast<std::size_t>(at.contact)];
    const mesh::ContactPair& pair = mesh_pair(prepared, at);
    const auto number = static_cast<Eigen::Index>(i);
    if (pair.node_a >= 0) nodes[{contact.a.body, pair.node_a}].push_back({number, -pair.normal});
    if (pair.node_b >= 0) nodes[{contact.b.body, pair.node_b}].push_back({number, pair.normal});
  }
  std::erase_if(nodes, [](const auto& node) { return node.second.size() < 2; });
  return nodes;
}

/// Angle that the sides of two pairs enclose, of the body between them.
double angle_between_sides(const Touching& one, const Touching& other) {
  return std::acos(std::clamp(-one.normal.dot(other.normal), -1.0, 1.0));
}

double angles_of_friction(const contact::Problem& problem, const Touching& one, const Touching& other) {
  return std::atan(problem.largest_mu(one.pair)) + std::atan(problem.largest_mu(other.pair));
}

/// Whether a force of the pair in its friction cone works against its motion without contact forces, q.r < 0.
bool is_driven(const contact::Problem& problem, Eigen::Index pair) {
  return problem.q[place_of(pair)] < problem.largest_mu(pair) * std::abs(problem.q[place_of(pair, 1)]);
}

/// Whether forces of these two pairs move nothing while they are driven against each other. W is positive
/// semi-definite: r'W r = 0 of the two pairs is W r = 0. A rigid motion counts as an infinitely soft part of W.
bool are_wedged(const contact::Problem& problem, Eigen::Index one, Eigen::Index other) {
  if (!is_driven(problem, one) && !is_driven(problem, other)) return false;  // products with W may take long
  Matrix unit = Matrix::Zero(problem.q.size(), 4);
  const std::array<Eigen::Index, 4> rows = {place_of(one), place_of(one, 1), place_of(other), place_of(other, 1)};
  for (Eigen::Index k = 0; k < 4; ++k) unit(rows[static_cast<std::size_t>(k)], k) = 1.0;
  contact::Problem two;
  Matrix W = unit.transpose() * problem.W.times(unit);
  if (problem.G.cols() > 0) {
    const Matrix G = problem.G.transpose() * unit;
    if (const double rigid = G.squaredNorm(); rigid > 0.0) W += W.trace() / rigid * (G.transpose() * G);
  }
  two.W = std::move(W);
  two.q = unit.transpose() * problem.q;
  two.mu = Vec2(problem.mu[one], problem.mu[other]);
  if (problem.mu_backward.size() > 0) two.mu_backward = Vec2(problem.mu_backward[one], problem.mu_backward[other]);
  return contact::find_infeasibility(two).has_value();
}

std::string named(const Prepared& prepared, const Touching& touching) {
  const system::ContactSystem::Pair& at = prepared.contact.pairs[static_cast<std::size_t>(touching.pair)];
  return fmt::format("P{} of contact '{}'", at.number,
                     prepared.model.contacts[static_cast<std::size_t>(at.contact)].name);
}

}  // namespace

std::string wedged_point(const Prepared& prepared, const contact::Problem& problem) {
  if (static_cast<std::size_t>(problem.pairs()) != prepared.contact.pairs.size()) return {};
  constexpr double degree = std::numbers::pi / 180.0;
  for (const auto& [node, touching] : shared_nodes(prepared))
    for (std::size_t k = 1; k < touching.size(); ++k)
      for (std::size_t j = 0; j < k; ++j) {
        const double beta = angle_between_sides(touching[j], touching[k]),
                     friction = angles_of_friction(problem, touching[j], touching[k]);
        if (beta > friction || !are_wedged(problem, touching[j].pair, touching[k].pair)) continue;
        const Vec2& x =
            prepared.mesh.bodies[static_cast<std::size_t>(node.first)].nodes[static_cast<std::size_t>(node.second)];
        return fmt::format(
            "body '{}' is wedged at ({:.6g}, {:.6g}) between {} and {}: the sides enclose {:.3g} degrees, less than "
            "both angles of friction together, {:.3g}, so that forces of any size are in balance there and nothing "
            "gives way; make friction smaller, cut off this corner, or leave it out of one of the contacts",
            prepared.model.bodies[static_cast<std::size_t>(node.first)].name, x.x(), x.y(),
            named(prepared, touching[j]), named(prepared, touching[k]), beta / degree, friction / degree);
      }
  return {};
}

}  // namespace scabo::analysis
