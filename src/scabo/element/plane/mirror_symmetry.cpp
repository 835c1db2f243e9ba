#include "scabo/element/plane/mirror_symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "scabo/base/components.hpp"

namespace scabo::element {

namespace {

/// Nodes onto which a mirror line maps nodes 0, 1, 2 ...
using Images = std::vector<int>;

Vec2 mirrored(const Vec2& x, const Vec2& axis) { return 2.0 * x.dot(axis) * axis - x; }

/// A mirror reverses the sense of the boundary: node i goes to node (shift - i) mod n. `axis` is a unit vector.
std::optional<Images> images_under(const Ring& ring, const Vec2& axis, int shift, double tolerance) {
  const int n = static_cast<int>(ring.nodes.size());
  Images images(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const int image = ((shift - i) % n + n) % n;
    const Vec2 error =
        mirrored(ring.nodes[static_cast<std::size_t>(i)], axis) - ring.nodes[static_cast<std::size_t>(image)];
    if (error.squaredNorm() > tolerance * tolerance) return std::nullopt;
    images[static_cast<std::size_t>(i)] = image;
  }
  return images;
}

/// Reflected elasticity for the mirror line with unit vector `axis`: D' = T'D T, where T transforms the strain of the
/// image back.
Mat3 mirrored(const Mat3& D, const Vec2& axis) {
  // Cosine and sine of twice the angle of the axis.
  const double c = 2.0 * axis.x() * axis.x() - 1.0, s = 2.0 * axis.x() * axis.y();
  Mat3 T;  // [xx, yy, gamma_xy] of Q eps Q, Q = [[c, s], [s, -c]]
  T << c * c, s * s, c * s, s * s, c * c, -c * s, 2.0 * c * s, -2.0 * c * s, s * s - c * c;
  return T.transpose() * D * T;
}

/// Whether the elements, as sets of nodes and with their elasticity, are also mapped onto each other.
bool maps_elements(const Ring& ring, const Elasticity& D, const Vec2& axis, const Images& images) {
  const int n = static_cast<int>(ring.nodes.size());
  std::vector<int> element_from(static_cast<std::size_t>(n), -1);  // by first node: elements are counter-clockwise
  for (std::size_t e = 0; e < ring.elements.size(); ++e)
    element_from[static_cast<std::size_t>(ring.elements[e].nodes.front())] = static_cast<int>(e);
  for (std::size_t e = 0; e < ring.elements.size(); ++e) {
    const mesh::LineElement& element = ring.elements[e];
    const int first = images[static_cast<std::size_t>(element.nodes.back())];
    const int other = element_from[static_cast<std::size_t>(first)];
    if (other < 0) return false;
    const auto o = static_cast<std::size_t>(other);
    if (ring.elements[o].nodes.size() != element.nodes.size() ||
        ring.elements[o].nodes.back() != images[static_cast<std::size_t>(element.nodes.front())] ||
        (mirrored(D.of(e), axis) - D.of(o)).cwiseAbs().maxCoeff() > 1e-13 * D.of(o).cwiseAbs().maxCoeff())
      return false;
  }
  return true;
}

struct Mirror {
  Vec2 axis;
  Images images;
};

/// Whether the boundary nodes are numbered 0 .. n-1 counter-clockwise along the ring.
bool is_plain_ring(const Ring& ring) {
  int next = 0;
  const int n = static_cast<int>(ring.nodes.size());
  for (const mesh::LineElement& element : ring.elements)
    for (std::size_t i = 0; i + 1 < element.nodes.size(); ++i)
      if (element.nodes[i] != next++) return false;
  return ring.is_open() ? next == n - 1 && ring.last_node() == n - 1 : next == n;
}

/// The line that exchanges the two ends of an open ring.
std::vector<Mirror> mirror_of_open_ring(const Ring& ring, const Elasticity& D, double tolerance) {
  const int last = static_cast<int>(ring.nodes.size()) - 1;
  const Vec2 ends = ring.nodes.front().normalized() + ring.nodes.back().normalized();
  // The ends of a half plane are opposite to each other, and the line is perpendicular to them.
  const Vec2 axis =
      ends.norm() > 1e-6 ? Vec2(ends.normalized()) : Vec2(-ring.nodes.front().y(), ring.nodes.front().x()).normalized();
  auto images = images_under(ring, axis, last, tolerance);
  if (!images || !maps_elements(ring, D, axis, *images)) return {};
  return {{axis, std::move(*images)}};
}

/// A mirror line and, if there is one, the mirror line perpendicular to it. A pair is preferred.
std::vector<Mirror> find_mirrors(const Ring& ring, const Elasticity& D) {
  const int n = static_cast<int>(ring.nodes.size());
  if (!is_plain_ring(ring) || n < 4) return {};
  double size = 0.0;
  for (const Vec2& node : ring.nodes) size = std::max(size, node.norm());
  // Rounding of coordinates given to about 12 digits; the error in K is of the same relative size.
  const double tolerance = 1e-13 * size;
  if (ring.is_open()) return mirror_of_open_ring(ring, D, tolerance);
  std::vector<Mirror> found;
  std::optional<Mirror> to_opposite;  // maps node 0 to the opposite one: the partner of the line through both, or alone
  for (int shift = 0; shift < n; ++shift) {  // node 0 is mapped to node `shift`, which determines the line
    const Vec2 &from = ring.nodes[0],
               sum = from.normalized() + ring.nodes[static_cast<std::size_t>(shift)].normalized();
    if (sum.norm() < 1e-6) {
      const Vec2 across = Vec2(-from.y(), from.x()).normalized();
      auto images = images_under(ring, across, shift, tolerance);
      if (images && maps_elements(ring, D, across, *images)) to_opposite = Mirror{across, std::move(*images)};
      continue;
    }
    const Vec2 axis = sum.normalized();
    const auto images = images_under(ring, axis, shift, tolerance);
    if (!images || !maps_elements(ring, D, axis, *images)) continue;
    const Vec2 perpendicular(-axis.y(), axis.x());
    for (int other = 0; other < n; ++other) {
      const auto second = images_under(ring, perpendicular, other, tolerance);
      if (second && maps_elements(ring, D, perpendicular, *second)) return {{axis, *images}, {perpendicular, *second}};
    }
    if (found.empty()) found.push_back({axis, *images});
  }
  if (found.empty() && to_opposite) found.push_back(std::move(*to_opposite));
  return found;
}

}  // namespace

int symmetry_block_count(const Ring& ring, const Elasticity& D) { return 1 << find_mirrors(ring, D).size(); }

std::vector<Eigen::SparseMatrix<double>> symmetry_blocks(const Ring& ring, const Elasticity& D) {
  const int nodes = static_cast<int>(ring.nodes.size());
  const std::vector<Mirror> mirrors = find_mirrors(ring, D);
  if (mirrors.empty()) {
    Eigen::SparseMatrix<double> identity(places_of(nodes), places_of(nodes));
    identity.setIdentity();
    return {identity};
  }
  // In the frame of the first line, mirror g takes displacement component c (0 along the first line, 1 across) to
  // component_sign[g][c] times itself at the image node. Block k holds the fields that mirror g multiplies by
  // character(k, g) = +1 or -1.
  const std::size_t group = mirrors.size();
  const Vec2 along = mirrors[0].axis, across(-along.y(), along.x());
  const double component_sign[2][2] = {{1.0, -1.0}, {-1.0, 1.0}};
  std::vector<Eigen::SparseMatrix<double>> blocks;
  std::vector<std::pair<int, double>> terms, vector;  // kept for their memory
  for (int k = 0; k < (1 << group); ++k) {
    std::vector<Eigen::Triplet<double>> entries;
    int columns = 0;
    for (int node = 0; node < nodes; ++node)
      for (int component = 0; component < 2; ++component) {
        // The unit displacement of this node, projected on the block: images under all products of the mirrors.
        terms.assign({{node, 1.0}});
        for (std::size_t g = 0; g < group; ++g) {
          const double character = (k >> g) & 1 ? -1.0 : 1.0;
          const std::size_t count = terms.size();
          for (std::size_t t = 0; t < count; ++t)
            terms.emplace_back(mirrors[g].images[static_cast<std::size_t>(terms[t].first)],
                               terms[t].second * character * component_sign[g][component]);
        }
        std::sort(terms.begin(), terms.end());
        if (terms.front().first != node) continue;  // this orbit was handled at its lowest node
        vector.clear();
        for (const auto& [at, value] : terms) {
          if (!vector.empty() && vector.back().first == at)
            vector.back().second += value;
          else
            vector.emplace_back(at, value);
        }
        const double norm =
            std::sqrt(std::accumulate(vector.begin(), vector.end(), 0.0,
                                      [](double sum, const auto& term) { return sum + term.second * term.second; }));
        if (norm == 0.0) continue;  // a node on a mirror line has no such field
        const Vec2 direction = component == 0 ? along : across;
        for (const auto& [at, value] : vector) {
          entries.emplace_back(place_of(at), columns, value / norm * direction.x());
          entries.emplace_back(place_of(at, 1), columns, value / norm * direction.y());
        }
        ++columns;
      }
    if (columns == 0) continue;
    Eigen::SparseMatrix<double> T(places_of(nodes), columns);
    T.setFromTriplets(entries.begin(), entries.end());
    T.prune(0.0);
    blocks.push_back(std::move(T));
  }
  return blocks;
}

}  // namespace scabo::element
