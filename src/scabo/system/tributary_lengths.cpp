#include "scabo/system/tributary_lengths.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "scabo/geometry/line_basis.hpp"
#include "scabo/mesh/plane/crack_faces.hpp"

namespace scabo::system {

namespace {

/// Integrals of N_i x,eta over an element.
std::vector<Vec2> along_nodes(const std::vector<Vec2>& points) {
  const geometry::LineBasis& basis = geometry::LineBasis::of_order(static_cast<int>(points.size()) - 1);
  std::vector<Vec2> sums(points.size(), Vec2::Zero());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < points.size(); ++j)
      sums[i] += basis.weights()[i] *
                 basis.derivatives_at_nodes()(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * points[j];
  return sums;
}

/// The same times 2 pi r: Gauss-Lobatto weights, which vanish nowhere, do not give these.
std::vector<Vec2> around_axis(const std::vector<Vec2>& points) {
  const int order = static_cast<int>(points.size()) - 1;
  const geometry::LineBasis& basis = geometry::LineBasis::of_order(order);
  const geometry::GaussRule rule = geometry::gauss_rule(3 * order / 2 + 2);
  std::vector<Vec2> sums(points.size(), Vec2::Zero());
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const Vector N = basis.values(rule.points[q]), N_eta = basis.derivatives(rule.points[q]);
    Vec2 x = Vec2::Zero(), x_eta = Vec2::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
      x += N[static_cast<Eigen::Index>(i)] * points[i];
      x_eta += N_eta[static_cast<Eigen::Index>(i)] * points[i];
    }
    const Vec2 weighted = rule.weights[q] * Extent(1.0, true).at(x.x()) * x_eta;
    for (std::size_t i = 0; i < points.size(); ++i) sums[i] += N[static_cast<Eigen::Index>(i)] * weighted;
  }
  return sums;
}

/// Eq. (1) for the nodes of one elastic side, in the given order; or of bodies of revolution eq. (3).
std::vector<double> lengths_of_side(const model::Place& place, const mesh::Mesh& mesh, const std::vector<int>& paired,
                                    bool revolved) {
  const std::vector<Vec2>& nodes = mesh.bodies[static_cast<std::size_t>(place.body)].nodes;
  std::vector<bool> takes_part(nodes.size(), false);
  for (const int node : paired) takes_part[static_cast<std::size_t>(node)] = true;
  std::vector<Vec2> whole(nodes.size(), Vec2::Zero()), covered = whole;
  for (const mesh::LineElement& element : mesh::nodes_of(place, mesh).elements) {
    std::vector<Vec2> points;
    for (const int node : element.nodes) points.push_back(nodes[static_cast<std::size_t>(node)]);
    const std::vector<Vec2> sums = revolved ? around_axis(points) : along_nodes(points);
    bool is_covered = true;
    for (const int node : element.nodes) is_covered = is_covered && takes_part[static_cast<std::size_t>(node)];
    for (std::size_t i = 0; i < element.nodes.size(); ++i) {
      const auto node = static_cast<std::size_t>(element.nodes[i]);
      whole[node] += sums[i];
      if (is_covered) covered[node] += sums[i];
    }
  }
  std::vector<double> lengths;
  for (const int node : paired) {
    const auto i = static_cast<std::size_t>(node);
    lengths.push_back((covered[i].norm() > 0.0 ? covered[i] : whole[i]).norm());
  }
  return lengths;
}

/// A tip at which the faces of a crack are closed but, over a short length, free of traction
/// (mesh/plane/tip_rings.hpp).
struct ClosedTip {
  Vec2 at = Vec2::Zero();
  double free = 0.0;  ///< length, > 0
};

/// Integrals of N_i over an element of a face, with the amplification of eq. (2) where a tip is near. Near the end of
/// the free length with r - d = s^2, so that the integrand is smooth.
std::vector<double> amplified_lengths(const std::vector<Vec2>& points, const std::vector<ClosedTip>& tips) {
  constexpr double far = 3000.0;  // times the free length: there eq. (2) is 1 to 1e-8
  const geometry::LineBasis& basis = geometry::LineBasis::of_order(static_cast<int>(points.size()) - 1);
  const Vec2 &from = points.front(), &to = points.back();
  const double length = (to - from).norm();
  std::vector<double> lengths;
  for (const double weight : basis.weights()) lengths.push_back(0.5 * weight * length);
  for (const ClosedTip& tip : tips) {
    const double r_from = (from - tip.at).norm(), r_to = (to - tip.at).norm(), nearer = std::min(r_from, r_to);
    if (nearer > far * tip.free) continue;
    static const geometry::GaussRule rule = geometry::gauss_rule(40);
    std::fill(lengths.begin(), lengths.end(), 0.0);
    const double first = std::sqrt(std::max(nearer - tip.free, 0.0)),
                 last = std::sqrt(std::max(r_from, r_to) - tip.free);
    for (std::size_t k = 0; k < rule.points.size(); ++k) {
      const double s = std::lerp(first, last, 0.5 * (1.0 + rule.points[k])), r = tip.free + s * s;
      const double part = (r - nearer) / length, eta = r_from < r_to ? 2.0 * part - 1.0 : 1.0 - 2.0 * part;
      const Vector N = basis.values(eta);
      for (std::size_t i = 0; i < lengths.size(); ++i)  // dr = 2 s ds
        lengths[i] += rule.weights[k] * 0.5 * (last - first) * 2.0 * (r - 0.5 * tip.free) / std::sqrt(r) *
                      N[static_cast<Eigen::Index>(i)];
    }
  }
  return lengths;
}

std::vector<ClosedTip> closed_tips(const model::Body& body, const mesh::BodyMesh& mesh, int crack) {
  std::vector<ClosedTip> tips;
  for (const mesh::TipFace& face : mesh::tip_faces(body, mesh)) {
    if (face.crack != crack || !face.last) continue;
    const mesh::Cell& cell = mesh.cells[face.cell];
    const Vec2& end = mesh.nodes[static_cast<std::size_t>(cell.boundary.back().nodes.back())];
    tips.push_back({cell.centre, (end - cell.centre).norm()});
  }
  return tips;
}

/// Of the two faces of a crack. Where other cracks end on it, two pairs may share a node but not their lengths.
std::vector<double> lengths_of_crack(const model::Contact& contact, const mesh::Interface& interface,
                                     const model::Model& model, const mesh::Mesh& mesh) {
  const auto b = static_cast<std::size_t>(contact.a.body);
  const mesh::BodyMesh& body = mesh.bodies[b];
  const int crack = contact.a.index / 2;
  std::map<std::pair<int, int>, Vec2> of_pair;  // sums of vectors, as at a kink
  const std::vector<ClosedTip> tips = closed_tips(model.bodies[b], body, crack);
  const std::vector<mesh::LineElement>&left = body.faces[static_cast<std::size_t>(2 * crack + 1)],
        &right = body.faces[static_cast<std::size_t>(2 * crack)];
  for (std::size_t k = 0; k < left.size(); ++k) {
    const std::vector<int>&here = left[k].nodes, &there = right[right.size() - 1 - k].nodes;
    std::vector<Vec2> points;
    for (const int node : here) points.push_back(body.nodes[static_cast<std::size_t>(node)]);
    const std::vector<double> lengths = amplified_lengths(points, tips);
    const Vec2 along = (points.back() - points.front()).normalized();
    for (std::size_t i = 0; i < here.size(); ++i)
      of_pair.try_emplace(std::minmax(here[i], there[there.size() - 1 - i]), Vec2::Zero()).first->second +=
          lengths[i] * along;
  }
  std::vector<double> lengths;
  for (const mesh::ContactPair& pair : interface.pairs)
    lengths.push_back(of_pair.at(std::minmax(pair.node_a, pair.node_b)).norm());
  return lengths;
}

/// Two rigid sides have their pairs at the two ends.
std::vector<double> halves_of_stretch(const mesh::Interface& interface) {
  const mesh::ContactPair &first = interface.pairs.front(), &last = interface.pairs.back();
  return std::vector<double>(interface.pairs.size(), 0.5 * std::abs(cross(last.point_a - first.point_a, first.normal)));
}

/// The mean of the sides, for every pair.
std::vector<double> means_of_sides(const model::Contact& named, const model::Model& model, const mesh::Mesh& mesh,
                                   const mesh::Interface& interface, bool revolved) {
  const auto is_rigid = [&](const model::Place& side) {
    return model.bodies[static_cast<std::size_t>(side.body)].rigid;
  };
  if (is_rigid(named.a) && is_rigid(named.b)) return halves_of_stretch(interface);
  std::vector<double> means(interface.pairs.size(), 0.0);
  std::vector<int> sides(means.size(), 0);
  for (const bool on_b : {false, true}) {
    const model::Place& place = on_b ? named.b : named.a;
    if (is_rigid(place)) continue;
    std::vector<int> paired;
    for (const mesh::ContactPair& pair : interface.pairs) paired.push_back(on_b ? pair.node_b : pair.node_a);
    const std::vector<double> of_side = lengths_of_side(place, mesh, paired, revolved);
    std::map<int, int> pairs_of;
    for (const int node : paired) ++pairs_of[node];
    for (std::size_t i = 0; i < means.size(); ++i) {
      if (pairs_of[paired[i]] > 1) continue;  // it faces the mouth of a crack, whose two nodes divide its length
      means[i] += of_side[i];
      ++sides[i];
    }
  }
  for (std::size_t i = 0; i < means.size(); ++i) means[i] /= sides[i];
  return means;
}

/// Distance of a pair from the nearest other one.
double distance_from_others(std::size_t pair, const mesh::Interface& interface) {
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < interface.pairs.size(); ++i)
    if (i != pair) least = std::min(least, (interface.pairs[i].point_a - interface.pairs[pair].point_a).norm());
  return least;
}

}  // namespace

std::vector<double> tributary_lengths(int contact, const model::Model& model, const mesh::Mesh& mesh) {
  const model::Contact& named = model.contacts[static_cast<std::size_t>(contact)];
  const mesh::Interface& interface = mesh.interfaces[static_cast<std::size_t>(contact)];
  if (named.a.kind == model::Place::Kind::face) return lengths_of_crack(named, interface, model, mesh);
  const std::vector<double> lengths = means_of_sides(named, model, mesh, interface, false);
  for (const double length : lengths) ensure(length > 0.0, "a node of a contact has no tributary length");
  return lengths;
}

bool is_on_axis(const mesh::ContactPair& pair, const mesh::Interface& interface, const model::Model& model) {
  if (!model.analysis.revolved()) return false;
  double largest = 0.0;
  for (const mesh::ContactPair& other : interface.pairs)
    largest = std::max(largest, other.point_a.lpNorm<Eigen::Infinity>());
  return pair.point_a.x() <= 1e-9 * largest;
}

std::vector<double> tributary_areas(int contact, const model::Model& model, const mesh::Mesh& mesh) {
  const mesh::Interface& interface = mesh.interfaces[static_cast<std::size_t>(contact)];
  std::vector<double> areas;
  if (!model.analysis.revolved()) {
    areas = tributary_lengths(contact, model, mesh);
    const double thickness = model::thickness_between(model, model.contacts[static_cast<std::size_t>(contact)]);
    for (double& area : areas) area *= thickness;
    return areas;
  }
  areas = means_of_sides(model.contacts[static_cast<std::size_t>(contact)], model, mesh, interface, true);
  for (std::size_t i = 0; i < areas.size(); ++i) {
    if (is_on_axis(interface.pairs[i], interface, model)) {
      const double radius = 0.5 * distance_from_others(i, interface);
      const double disc = std::isfinite(radius) ? std::numbers::pi * radius * radius : 1.0;
      if (areas[i] <= 1e-9 * disc) areas[i] = disc;  // order 2
    }
    ensure(areas[i] > 0.0, "a node of a contact has no tributary area");
    if (model.analysis.per_radian) areas[i] /= 2.0 * std::numbers::pi;
  }
  return areas;
}

}  // namespace scabo::system
