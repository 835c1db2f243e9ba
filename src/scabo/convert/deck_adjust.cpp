#include "scabo/convert/deck_adjust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "scabo/convert/deck_names.hpp"
#include "scabo/files/text_cursor.hpp"

namespace scabo::convert {

namespace {

using files::Facet;
using files::ImportedMesh;

struct SideFoot {
  Vec2 point = Vec2::Zero(), normal = Vec2::Zero();  // unit, out of the body
  double distance = HUGE_VAL;
  bool perpendicular = false;  // false beyond the ends
};

/// A side of a cell, straight or a parabola through three nodes, for t from 0 to 1.
struct Curve {
  Vec2 a, b, c;  // a + b t + c t^2
  Vec2 at(double t) const { return a + t * (b + t * c); }
  Vec2 slope(double t) const { return b + 2.0 * t * c; }
};

Curve curve_of(const ImportedMesh& mesh, const Facet& side) {
  const auto x = [&mesh](int node) { return mesh.nodes[static_cast<std::size_t>(node)]; };
  const Vec2 start = x(side.start), end = x(side.end);
  if (side.middle < 0) return {start, end - start, Vec2::Zero()};
  const Vec2 bow = x(side.middle) - 0.5 * (start + end);
  return {start, end - start + 4.0 * bow, -4.0 * bow};
}

/// The closest point by Newton's method from several starts: sides are short against their curvature.
SideFoot foot_on(const Curve& curve, const Vec2& x) {
  constexpr int starts = 4, steps = 20;
  SideFoot best;
  for (int k = 0; k <= starts; ++k) {
    double t = static_cast<double>(k) / starts;
    for (int i = 0; i < steps; ++i) {
      const Vec2 r = curve.at(t) - x, along = curve.slope(t);
      const double curvature = along.squaredNorm() + 2.0 * r.dot(curve.c);
      if (!(curvature > 0.0)) break;
      t = std::clamp(t - r.dot(along) / curvature, 0.0, 1.0);
    }
    const double distance = (curve.at(t) - x).norm();
    if (!(distance < best.distance)) continue;
    const Vec2 along = curve.slope(t).normalized();
    const double length = curve.b.norm() + curve.c.norm();
    best = {curve.at(t), Vec2(along.y(), -along.x()), distance,
            std::abs((x - curve.at(t)).dot(along)) <= 1e-6 * std::max(length, distance)};
  }
  return best;
}

class Adjustment {
 public:
  Adjustment(files::AbaqusDeck& deck, const DeckContact& contact, Remarks& remarks)
      : deck_(deck), mesh_(deck.mesh), contact_(contact), remarks_(remarks) {}

  void run() {
    const auto slave = sides_named(deck_, contact_.slave), master = sides_named(deck_, contact_.master);
    if (!slave || !master || slave->empty() || master->empty()) return;  // told where contacts are written
    for (const Facet& side : *master) count_ends(side);
    for (const Facet& side : *slave) {
      const Curve curve = curve_of(mesh_, side);
      for (const auto& [node, t] : {std::pair(side.start, 0.0), std::pair(side.end, 1.0), std::pair(side.middle, 0.5)})
        if (node >= 0)
          normals_.try_emplace(node, Vec2::Zero()).first->second +=
              Vec2(curve.slope(t).y(), -curve.slope(t).x()).normalized();
    }
    std::map<int, Vec2> moved;
    for (const auto& [node, normal] : normals_)
      if (const auto foot = foot_of(node, normal, *master))
        if (moves(node, *foot)) moved[node] = foot->point;
    for (const auto& [node, point] : moved) mesh_.nodes[static_cast<std::size_t>(node)] = point;
    if (too_far_ > 0) tell_too_far();
  }

 private:
  void count_ends(const Facet& side) {
    ++ends_[side.start];
    ++ends_[side.end];
    length_ += files::length_of(mesh_, side);
    ++sides_;
  }

  /// The foot of a slave node on the master that faces it; nothing beyond the ends of the master.
  std::optional<SideFoot> foot_of(int node, const Vec2& normal, const std::vector<Facet>& master) const {
    const Vec2& x = mesh_.nodes[static_cast<std::size_t>(node)];
    SideFoot best;
    for (const Facet& side : master) {
      SideFoot foot = foot_on(curve_of(mesh_, side), x);
      if (!(foot.distance < best.distance)) continue;
      const int end = (foot.point - mesh_.nodes[static_cast<std::size_t>(side.start)]).norm() <
                              (foot.point - mesh_.nodes[static_cast<std::size_t>(side.end)]).norm()
                          ? side.start
                          : side.end;
      foot.perpendicular = foot.perpendicular || ends_.at(end) > 1;
      best = foot;
    }
    if (!best.perpendicular || normal.dot(best.normal) >= 0.0) return std::nullopt;
    return best;
  }

  double gap_of(int node, const SideFoot& foot) const {
    const Vec2 r = mesh_.nodes[static_cast<std::size_t>(node)] - foot.point;
    return r.dot(foot.normal) < 0.0 ? -foot.distance : foot.distance;
  }

  bool moves(int node, const SideFoot& foot) {
    const double gap = gap_of(node, foot);
    if (contact_.tie) {
      const double typical = length_ / sides_;
      const double tolerance = contact_.tolerance.value_or(least_tolerance * typical);
      if (std::abs(gap) <= tolerance) return contact_.adjusts;
      largest_ = std::max(largest_, std::abs(gap));
      too_far_ += std::abs(gap) > 1e-6 * typical;
      return false;
    }
    if (contact_.adjusted_nodes) return contact_.adjusted_nodes->contains(node);
    return contact_.adjust_within && gap <= *contact_.adjust_within;
  }

  void tell_too_far() {
    remarks_.essential(
        contact_.at,
        contact_.tolerance
            ? fmt::format("{} nodes of '{}' are up to {:g} away from '{}', more than the POSITION "
                          "TOLERANCE, and would stay free; give a larger one, or a smaller surface",
                          too_far_, files::printable(contact_.slave), largest_, files::printable(contact_.master))
            : fmt::format("{} nodes of '{}' are up to {:g} away from '{}', and it depends on the program "
                          "whether these are tied; give a POSITION TOLERANCE",
                          too_far_, files::printable(contact_.slave), largest_, files::printable(contact_.master)));
  }

  /// Of the length of a side of the master: CalculiX ties nodes this close, Abaqus those up to twice as far.
  static constexpr double least_tolerance = 0.025;

  const files::AbaqusDeck& deck_;
  ImportedMesh& mesh_;
  const DeckContact& contact_;
  Remarks& remarks_;
  std::map<int, int> ends_;  // how many sides of the master end at a node
  std::map<int, Vec2> normals_;
  double length_ = 0.0, largest_ = 0.0;
  int sides_ = 0, too_far_ = 0;
};

}  // namespace

void adjust_nodes(files::AbaqusDeck& deck, const DeckContent& content, Remarks& remarks) {
  for (const DeckContact& contact : content.contacts)
    if (contact.tie || contact.adjust_within || contact.adjusted_nodes) Adjustment(deck, contact, remarks).run();
}

}  // namespace scabo::convert
