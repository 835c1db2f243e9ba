#include "scabo/analysis/diagnostics/beyond_sides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scabo::analysis {

namespace {

/// Length from the first to the last pair; 0 of a straight interface.
double curved_length(const mesh::Interface& interface) {
  constexpr double straight = 1e-6;  // radians
  const auto middle = [](const mesh::ContactPair& pair) { return Vec2(0.5 * (pair.point_a + pair.point_b)); };
  double length = 0.0;
  bool curved = false;
  for (std::size_t k = 1; k < interface.pairs.size(); ++k) {
    const mesh::ContactPair &before = interface.pairs[k - 1], &pair = interface.pairs[k];
    length += (middle(pair) - middle(before)).norm();
    // Parallel normals on sides that are apart by different amounts: two equal discs.
    curved = curved || std::abs(cross(interface.pairs.front().normal, pair.normal)) > straight ||
             std::abs(pair.normal.dot(middle(pair) - middle(interface.pairs.front()))) >
                 straight * (middle(pair) - middle(interface.pairs.front())).norm();
  }
  return curved ? length : 0.0;
}

}  // namespace

std::string slid_beyond_sides(const Prepared& prepared, const State& state) {
  if (prepared.contact.rigid_motions() == 0) return "";
  std::vector<double> slip(prepared.mesh.interfaces.size(), 0.0);
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    if (prepared.contact.pairs[i].is_bar() || state.states[i] == contact::ContactState::open) continue;
    double& largest = slip[static_cast<std::size_t>(prepared.contact.pairs[i].contact)];
    largest = std::max(largest, std::abs(state.slip[static_cast<Eigen::Index>(i)]));
  }
  for (std::size_t c = 0; c < slip.size(); ++c) {
    const model::Contact& contact = prepared.model.contacts[c];
    if (slip[c] == 0.0 || contact.large_slip) continue;
    const double length = curved_length(prepared.mesh.interfaces[c]);
    if (length > 0.0 && slip[c] > length)
      return fmt::format(
          "contact '{}' would slide by {:.3g}, farther than its sides are long ({:.3g}): hardly anything holds {}; add "
          "a support, or friction",
          contact.name, slip[c], length, describe_motions(prepared, state.rigid_motion));
  }
  return "";
}

}  // namespace scabo::analysis
