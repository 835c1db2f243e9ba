#include "scabo/mesh/plane/close_mouths.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/mesh/plane/matched_side.hpp"

namespace scabo::mesh {

namespace {

/// Mouths of cracks between these fractions of the adjacent elements from each other are neither in one place nor
/// apart. Measured with two tied bodies, on an edge of length 2 in elements of 0.3: mouths 1e-7 apart leave an
/// imbalance of 3.0e-10, above the tolerance of the certificate, 1e-10, and 2e-7 apart one of 6.1e-10.
constexpr double equal_mouths = 1e-9, close_mouths_apart = 1e-5;

/// The mouth of a crack, in which two nodes are in one place.
bool is_mouth(const MatchedSide& side, std::size_t i) {
  const BreakPoint& at = side.breaks[i];
  if (side.closed && (i == 0 || i + 1 == side.breaks.size()))
    return side.breaks.front().after != side.breaks.back().before;
  return at.before >= 0 && at.after >= 0 && at.before != at.after;
}

bool is_end(const MatchedSide& side, std::size_t i) { return !side.closed && (i == 0 || i + 1 == side.breaks.size()); }

/// A mouth of `side` that almost lies opposite a mouth or an end of `other`.
std::optional<Diagnostic> close_mouth(const MatchedSide& side, const std::string& name, const MatchedSide& other,
                                      const std::string& other_name, const Source& source) {
  for (std::size_t i = 0; i < side.breaks.size(); ++i) {
    if (!is_mouth(side, i)) continue;
    const Vec2& mouth = side.breaks[i].point;
    const std::optional<geometry::Foot> foot = geometry::foot_on(*other.edge, mouth);
    if (!foot) continue;
    const std::size_t j = other.nearest(foot->t);
    if (!is_mouth(other, j) && !is_end(other, j)) continue;
    const double distance = std::abs(foot->t - other.breaks[j].t) * other.length;
    const double element = std::min(side.length_at(i), other.length_at(j));
    // Far from the origin coordinates have fewer digits.
    const double rounding = 64.0 * std::numeric_limits<double>::epsilon() * mouth.cwiseAbs().maxCoeff();
    if (distance <= std::max(equal_mouths * element, rounding) || distance > close_mouths_apart * element) continue;
    const Vec2& there = other.breaks[j].point;
    return Diagnostic{
        source, fmt::format("a crack ends at ({:.10g}, {:.10g}) on {}, only {:.2g} from {} at ({:.10g}, {:.10g}) "
                            "on {}, which is {:.1g} of the elements there: give both the same coordinates, or "
                            "move them farther apart",
                            mouth.x(), mouth.y(), name, distance,
                            is_mouth(other, j) ? "the end of a crack" : "the end of the edge", there.x(), there.y(),
                            other_name, distance / element)};
  }
  return std::nullopt;
}

}  // namespace

std::vector<Diagnostic> close_mouths(const model::Model& model, const std::vector<BodyMesh>& bodies) {
  std::vector<Diagnostic> mistakes;
  const FixedNodes none(bodies.size());
  const auto has_cracks = [&](const model::Place& place) {
    return !model.bodies[static_cast<std::size_t>(place.body)].cracks.empty();
  };
  for (const Joint& joint : joints_of(model)) {
    if (!has_cracks(joint.a) && !has_cracks(joint.b)) continue;
    if (!sides_to_match(model, joint, bodies)) continue;
    const MatchedSide a = side_of(model, joint.a.body, joint.a.index, bodies, none, Vec2::Zero()),
                      b = side_of(model, joint.b.body, joint.b.index, bodies, none, Vec2::Zero());
    auto wrong = close_mouth(a, joint.a.text, b, joint.b.text, joint.source);
    if (!wrong) wrong = close_mouth(b, joint.b.text, a, joint.a.text, joint.source);
    if (wrong) mistakes.push_back(*std::move(wrong));
  }
  return mistakes;
}

}  // namespace scabo::mesh
