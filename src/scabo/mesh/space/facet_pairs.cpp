#include "scabo/mesh/space/facet_pairs.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "scabo/base/error.hpp"
#include "scabo/geometry/box_tree.hpp"
#include "scabo/geometry/facet_basis.hpp"
#include "scabo/geometry/frame.hpp"
#include "scabo/mesh/space/balls_near_lines.hpp"

namespace scabo::mesh {

namespace {

using Eigen::Vector3d;
using CommonPart = std::vector<Vec2>;  // a convex polygon, counter-clockwise

/// 3 x 3 or 4.
Matrix corners_of(const Face& face, const SolidFacet& facet) {
  return nodes_of(face.mesh, {facet.begin(), facet.begin() + static_cast<std::ptrdiff_t>(mesh::corners_of(facet))});
}

Vector3d area_of(const Face& face, const SolidFacet& facet) {
  return area_between_corners(corners_of(face, facet), mesh::corners_of(facet));
}

Vector3d normal_of(const Face& face) {
  Vector3d sum = Vector3d::Zero();
  for (const SolidFacet& facet : face.facets) sum += area_of(face, facet);
  return sum.normalized();
}

/// The normal, and two tangents.
Eigen::Matrix3d directions_of(const Vector3d& normal) {
  const Eigen::Matrix3d frame = geometry::frame_along(normal);
  Eigen::Matrix3d directions;
  directions << frame.col(2), frame.col(0), frame.col(1);
  return directions;
}

double area_of(const CommonPart& polygon) {
  double twice = 0.0;
  for (std::size_t k = 2; k < polygon.size(); ++k) twice += cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  return 0.5 * twice;
}

/// A facet seen along a normal: corners counter-clockwise, and how far each node lies along the normal.
struct Seen {
  std::vector<int> nodes;
  CommonPart corners;
  Vector heights;
  Matrix places;  // 2 x n, of the nodes of a curved facet; empty: the edges are seen as straight

  double area() const { return area_of(corners); }
  const geometry::FacetBasis& basis() const { return geometry::FacetBasis::of(static_cast<int>(nodes.size())); }
  const geometry::FacetBasis& basis_of_corners() const {
    return geometry::FacetBasis::of(static_cast<int>(corners.size()));
  }
  /// Where the facet is seen at x, if its edges are straight.
  Vec2 place_at(const Vec2& x) const {
    if (corners.size() == 3)
      return 0.5 / area() * Vec2(cross(corners[2] - x, corners[0] - x), cross(corners[0] - x, corners[1] - x));
    constexpr int steps = 6;  // quadratic convergence of what a parallelogram has after one
    const Matrix at = Eigen::Map<const Eigen::Matrix<double, 2, 4>>(corners.front().data());
    return found(at, basis_of_corners(), x, Vec2::Zero(), steps);
  }
  /// Where the curved facet itself is seen at x, from where its corners have it.
  Vec2 curved_place_at(const Vec2& x) const {
    constexpr int steps = 4;  // from a distance of the square of the size
    return places.size() == 0 ? place_at(x) : found(places, basis(), x, place_at(x), steps);
  }
  /// Whether shape functions are polynomials of what is seen.
  bool is_affine() const {
    constexpr double rounding = 1e-12;
    return corners.size() == 3 ||
           (corners[0] + corners[2] - corners[1] - corners[3]).norm() <= rounding * (corners[2] - corners[0]).norm();
  }
  geometry::Box box() const {
    geometry::Box box;
    for (const Vec2& corner : corners) box.add(corner);
    return box;
  }

 private:
  /// By Newton's method.
  static Vec2 found(const Matrix& at, const geometry::FacetBasis& basis, const Vec2& x, Vec2 place, int steps) {
    for (int step = 0; step < steps; ++step) {
      const Eigen::Matrix2d J = at * basis.derivatives(place);
      place -= J.inverse() * Vec2(at * basis.values(place) - x);
    }
    return place;
  }
};

/// Orthonormal directions and an origin, which keeps the digits of bodies that lie far from that of the axes.
struct View {
  Eigen::Matrix3d directions;  // the normal, and two tangents
  Vector3d origin;

  Vector3d operator()(const Vector3d& x) const { return directions.transpose() * (x - origin); }
};

/// `curved`: the middle nodes are where they are, else halfway between corners, whose coordinates have more digits.
Seen seen_along(const Face& face, const SolidFacet& facet, const View& view, bool curved) {
  Seen seen{facet, {}, Vector(static_cast<Eigen::Index>(facet.size())), {}};
  const auto corners = static_cast<Eigen::Index>(mesh::corners_of(facet));
  if (area_of(face, facet).dot(view.directions.col(0)) < 0.0) {  // side B is seen from inside
    std::reverse(seen.nodes.begin() + 1, seen.nodes.begin() + corners);
    std::reverse(seen.nodes.begin() + corners, seen.nodes.end());
  }
  for (Eigen::Index k = 0; k < corners; ++k) {
    const Vector3d x = view(face.mesh.nodes.col(seen.nodes[static_cast<std::size_t>(k)]));
    seen.heights[k] = x[0];
    seen.corners.emplace_back(x.tail<2>());
  }
  if (curved) seen.places.resize(2, seen.heights.size());
  for (Eigen::Index k = 0; k < seen.heights.size(); ++k) {
    const Vector3d x = view(face.mesh.nodes.col(seen.nodes[static_cast<std::size_t>(k)]));
    if (curved) seen.places.col(k) = x.tail<2>();
    if (k >= corners)
      seen.heights[k] = curved ? x[0] : 0.5 * (seen.heights[k - corners] + seen.heights[(k - corners + 1) % corners]);
  }
  return seen;
}

/// What two convex polygons have in common; both counter-clockwise (Sutherland and Hodgman).
CommonPart clipped(CommonPart polygon, const CommonPart& other) {
  for (std::size_t k = 0; k < other.size() && !polygon.empty(); ++k) {
    const Vec2 start = other[k], along = other[(k + 1) % other.size()] - start;
    CommonPart inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 from = polygon[i], to = polygon[(i + 1) % polygon.size()];
      const double d_from = cross(along, from - start), d_to = cross(along, to - start);
      if (d_from >= 0.0) inside.push_back(from);
      if ((d_from >= 0.0) != (d_to >= 0.0)) inside.push_back(from + d_from / (d_from - d_to) * (to - from));
    }
    polygon = std::move(inside);
  }
  return polygon;
}

/// Integrals of one pair, not yet divided by the area.
struct Sums {
  std::map<int, double> a, b;
  double area = 0.0, gap = 0.0;
  Vector3d point = Vector3d::Zero(), normal = Vector3d::Zero();

  void add(const Sums& other) {
    for (const auto& [node, weight] : other.a) a[node] += weight;
    for (const auto& [node, weight] : other.b) b[node] += weight;
    area += other.area, gap += other.gap, point += other.point, normal += other.normal;
  }
};

using Triangle = std::array<Vec2, 3>;

double area_of(const Triangle& triangle) { return 0.5 * cross(triangle[1] - triangle[0], triangle[2] - triangle[0]); }

/// Triangles of a convex polygon between its corners and its centroid. Which ones they are depends neither on where the
/// polygon begins nor on corners that rounding alone makes, at which it turns by less than `least`, an area.
std::vector<Triangle> triangles_around_centroid(CommonPart polygon, double least) {
  const auto size = [&] { return polygon.size(); };
  const auto turn = [&](std::size_t i) {
    return area_of(Triangle{polygon[(i + size() - 1) % size()], polygon[i], polygon[(i + 1) % size()]});
  };
  while (size() > 2) {
    std::size_t straightest = 0;
    for (std::size_t i = 1; i < size(); ++i)
      if (turn(i) < turn(straightest)) straightest = i;
    if (turn(straightest) > least) break;
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(straightest));
  }
  if (size() < 3) return {};
  Vec2 centroid = Vec2::Zero();
  double area = 0.0;
  for (std::size_t k = 2; k < size(); ++k) {
    const Triangle part{polygon[0], polygon[k - 1], polygon[k]};
    centroid += area_of(part) / 3.0 * (part[0] + part[1] + part[2]);
    area += area_of(part);
  }
  std::vector<Triangle> triangles;
  for (std::size_t k = 0; k < size(); ++k)
    triangles.push_back({centroid / area, polygon[k], polygon[(k + 1) % size()]});
  return triangles;
}

/// Barycentric coordinates of the points of a triangle, exact for what is integrated there or, of quadrilaterals that
/// are no parallelograms, so fine that its errors are within rounding.
geometry::FacetRule rule_for(const Seen& a, const Seen& b) {
  if (a.corners.size() == 3 && b.corners.size() == 3) return geometry::FacetBasis::of(3).rule();
  static const geometry::FacetRule fine = geometry::triangle_rule(4), finest = geometry::triangle_rule(8);
  return a.is_affine() && b.is_affine() ? fine : finest;
}

/// Adds the integrals over a triangle that lies on both facets, whose pairs have the functions `phi` of the place on b.
template <class Functions>
void integrate(const Triangle& triangle, const Seen& a, const Seen& b, const View& view, const Functions& phi,
               std::map<int, Sums>& sums) {
  const geometry::FacetRule& rule = rule_for(a, b);
  for (Eigen::Index i = 0; i < rule.weights.size(); ++i) {
    const Vec2 at = rule.places.col(i), x = (1.0 - at.sum()) * triangle[0] + at[0] * triangle[1] + at[1] * triangle[2];
    const Vector phi_at_x = phi(b.place_at(x)), N_a = a.basis().values(a.curved_place_at(x)),
                 N_b = b.basis().values(b.curved_place_at(x));
    const double height = N_b.dot(b.heights), gap = height - N_a.dot(a.heights);
    const Vector3d point = view.origin + view.directions * Vector3d(height, x.x(), x.y());
    for (std::size_t k = 0; k < b.corners.size(); ++k) {
      const double weight = 2.0 * rule.weights[i] * area_of(triangle) * phi_at_x[static_cast<Eigen::Index>(k)];
      Sums& of_pair = sums[b.nodes[k]];
      for (std::size_t j = 0; j < a.nodes.size(); ++j)
        of_pair.a[a.nodes[j]] += weight * N_a[static_cast<Eigen::Index>(j)];
      for (std::size_t j = 0; j < b.nodes.size(); ++j)
        of_pair.b[b.nodes[j]] += weight * N_b[static_cast<Eigen::Index>(j)];
      of_pair.area += weight;
      of_pair.gap += weight * gap;
      of_pair.point += weight * point;
      of_pair.normal += weight * view.directions.col(0);
    }
  }
}

/// Of the corners at a place. `local`: those that act beside their corner.
Vector functions_of_corners(const Seen& facet, const Vec2& place, bool local) {
  const Vector psi = facet.basis_of_corners().values(place);
  if (!local) return psi;
  if (psi.size() == 3) return 0.5 * (5.0 * psi.array() - 1.0);
  return facet.basis_of_corners().values(2.0 * place);
}

/// What a facet of side B has in common with those of side A, as triangles. `local`: whether phi is orthogonal to the
/// middle nodes opposite, on a facet that is covered wholly.
class CommonTriangles {
 public:
  CommonTriangles(const Seen& b, const View& view, bool local) : b_(b), view_(view), local_(local) {}

  void add(const Seen& a) {
    constexpr double least = 1e-12;  // of the smaller facet: rounding, where facets only touch
    const double rounding = least * std::min(a.area(), b_.area());
    const CommonPart common = clipped(a.corners, b_.corners);
    if (b_.places.size() > 0) {  // on curved facets what is integrated is no polynomial
      for (const Triangle& triangle : triangles_around_centroid(common, rounding)) triangles_.emplace_back(triangle, a);
      return;
    }
    for (std::size_t k = 2; k < common.size(); ++k) {
      const Triangle triangle{common[0], common[k - 1], common[k]};
      if (area_of(triangle) > rounding) triangles_.emplace_back(triangle, a);
    }
  }

  void add_integrals(std::map<int, Sums>& sums) const {
    constexpr double least = 0.99;  // of the area: at a common edge of faces with a gap, oblique lines miss a strip
    double covered = 0.0;
    for (const auto& [triangle, a] : triangles_) covered += area_of(triangle);
    const bool local = local_ && covered >= least * b_.area();
    const auto phi = [&](const Vec2& place) { return functions_of_corners(b_, place, local); };
    for (const auto& [triangle, a] : triangles_) integrate(triangle, a, b_, view_, phi, sums);
  }

 private:
  const Seen& b_;
  const View& view_;
  bool local_;
  std::vector<std::pair<Triangle, Seen>> triangles_;
};

/// Of plane and parallel faces, seen along their normal.
std::map<int, Sums> plane_integrals(const Face& a, const Face& b) {
  const View view{directions_of(normal_of(a)), a.mesh.nodes.col(a.facets.front().front())};
  std::map<int, Sums> sums;
  std::vector<Seen> seen;
  std::vector<geometry::Box> boxes;
  for (const SolidFacet& facet : a.facets) {
    seen.push_back(seen_along(a, facet, view, false));
    boxes.push_back(seen.back().box());
  }
  const geometry::BoxTree tree(std::move(boxes));
  for (const SolidFacet& facet : b.facets) {
    const Seen of_b = seen_along(b, facet, view, false);
    const geometry::Box box = of_b.box();
    const Vec2 centre = 0.5 * (box.low + box.high);
    CommonTriangles common(of_b, view, false);
    tree.within(centre, 0.5 * (box.high - box.low).norm(), [&](std::size_t i) { common.add(seen[i]); });
    common.add_integrals(sums);
  }
  return sums;
}

std::vector<Ball> balls_of(const Face& face) {
  std::vector<Ball> balls;
  for (const SolidFacet& facet : face.facets) {
    const Matrix x = corners_of(face, facet);
    const Vector3d centre = x.rowwise().mean();
    balls.push_back({centre, area_of(face, facet).normalized(), (x.colwise() - centre).colwise().norm().maxCoeff()});
  }
  return balls;
}

/// The facets of a face that others see along lines.
class Opposite {
 public:
  explicit Opposite(const Face& face) : face_(face), balls_(balls_of(face)), near_(balls_) {}

  /// `visit(index)` of those that face `from` where it sees them along a direction.
  template <class Visit>
  void seen_from(const Ball& from, const Vector3d& direction, const Visit& visit) const {
    constexpr double most_turned = -0.5;  // cosine of the angle between outward normals: 60 degrees from opposite ones
    for (const std::size_t i : near_.near(from.centre, direction, from.radius)) {
      if (balls_[i].normal.dot(from.normal) > most_turned) continue;
      const Vector3d apart = balls_[i].centre - from.centre;
      if ((apart - apart.dot(direction) * direction).norm() <= balls_[i].radius + from.radius) visit(i);
    }
  }

  Seen seen(std::size_t i, const View& view) const { return seen_along(face_, face_.facets[i], view, true); }

  /// The mean outward normal of what a facet `of_b`, which is at `from`, sees along its own; 0 if that is nothing.
  Vector3d normal_seen(const Ball& from, const Seen& of_b, const View& view) const {
    Vector3d sum = Vector3d::Zero();
    seen_from(from, from.normal, [&](std::size_t i) {
      const CommonPart common = clipped(seen(i, view).corners, of_b.corners);
      if (common.size() > 2) sum += area_of(common) * balls_[i].normal;
    });
    return sum.stableNormalized();
  }

 private:
  const Face& face_;
  std::vector<Ball> balls_;
  BallsNearLines near_;
};

/// Of faces of any form: every facet of B sees those of A that face it, along the line that bisects the normals of
/// both; along that of A, if A alone is rigid.
std::map<int, Sums> curved_integrals(const Face& a, const Face& b, bool local) {
  std::map<int, Sums> sums;
  const std::vector<Ball> of_b = balls_of(b);
  const Opposite opposite(a);
  for (std::size_t j = 0; j < of_b.size(); ++j) {
    const Ball& at = of_b[j];
    const View own{directions_of(-at.normal), at.centre};
    const Vector3d of_a = opposite.normal_seen(at, seen_along(b, b.facets[j], own, true), own);
    if (of_a.isZero()) continue;
    const View view{directions_of((a.rigid && !b.rigid ? of_a : of_a - at.normal).normalized()), at.centre};
    const Seen seen = seen_along(b, b.facets[j], view, true);
    CommonTriangles common(seen, view, local);
    opposite.seen_from(at, view.directions.col(0), [&](std::size_t i) { common.add(opposite.seen(i, view)); });
    common.add_integrals(sums);
  }
  return sums;
}

/// Unites the pairs that have too little of their corner's area with the largest one beside them.
void unite_small(std::map<int, Sums>& sums, const Face& b) {
  constexpr double least = 1e-6;
  std::map<int, double> whole;
  std::map<int, std::set<int>> beside;
  for (const SolidFacet& facet : b.facets)
    for (std::size_t k = 0, count = mesh::corners_of(facet); k < count; ++k) {
      whole[facet[k]] += area_of(b, facet).norm() / static_cast<double>(count);
      beside[facet[k]].insert({facet[(k + 1) % count], facet[(k + count - 1) % count]});
    }
  std::vector<int> small;
  for (const auto& [corner, of_pair] : sums)
    if (of_pair.area < least * whole[corner]) small.push_back(corner);
  for (const int corner : small) {
    const Sums of_small = sums[corner];
    sums.erase(corner);
    auto largest = sums.end();
    for (const int other : beside[corner])
      if (const auto at = sums.find(other);
          at != sums.end() && (largest == sums.end() || at->second.area > largest->second.area))
        largest = at;
    if (largest != sums.end()) largest->second.add(of_small);
  }
}

double largest_coordinate(const Face& face) {
  double largest = 0.0;
  for (const SolidFacet& facet : face.facets)
    largest = std::max(largest, nodes_of(face.mesh, facet).cwiseAbs().maxCoeff());
  return largest;
}

std::vector<WeightedNode> weights_of(const std::map<int, double>& sums, double area) {
  std::vector<WeightedNode> nodes;
  for (const auto& [node, weight] : sums) nodes.push_back({node, weight / area});
  return nodes;
}

// Files have that many digits: of the length of an edge.
constexpr double plane_tolerance = 1e-5;

bool is_plane(const Face& face) {
  const Vector3d normal = normal_of(face);
  const Vector3d origin = face.mesh.nodes.col(face.facets.front().front());
  return std::all_of(face.facets.begin(), face.facets.end(), [&](const SolidFacet& facet) {
    const Matrix x = nodes_of(face.mesh, facet);
    const double allowed = plane_tolerance * (x.col(1) - x.col(0)).norm();
    return (normal.transpose() * (x.colwise() - origin)).cwiseAbs().maxCoeff() <= allowed &&
           area_of(face, facet).dot(normal) > 0.0;
  });
}

bool has_straight_edges(const Face& face) {
  return std::all_of(face.facets.begin(), face.facets.end(), [&](const SolidFacet& facet) {
    const Matrix x = nodes_of(face.mesh, facet);
    const double allowed = plane_tolerance * (x.col(1) - x.col(0)).norm();
    const auto count = static_cast<Eigen::Index>(mesh::corners_of(facet));
    for (Eigen::Index k = count; k < x.cols(); ++k)
      if ((x.col(k) - 0.5 * (x.col(k - count) + x.col((k - count + 1) % count))).norm() > allowed) return false;
    return true;
  });
}

}  // namespace

std::optional<std::string> why_no_pairs(const Face& a, const Face& b) {
  constexpr double most_angle = 1e-3;
  if (a.facets.empty() || b.facets.empty())
    return fmt::format("the {} face has no facets", a.facets.empty() ? "first" : "second");
  if (is_plane(a) && is_plane(b) && has_straight_edges(a) && has_straight_edges(b) &&
      (normal_of(a) + normal_of(b)).norm() > most_angle)
    return "the faces do not face each other";
  return {};
}

bool has_pairs_on_second(const Face& a, const Face& b) {
  struct Figures {
    double mean_area, corners, squares;
  };
  const auto figures_of = [](const Face& face) {
    double sum = 0.0, squares = 0.0;
    std::set<int> corners;
    for (const SolidFacet& facet : face.facets) {
      const double area = area_of(face, facet).norm();
      sum += area, squares += area * area;
      corners.insert(facet.begin(), facet.begin() + static_cast<std::ptrdiff_t>(mesh::corners_of(facet)));
    }
    return Figures{sum / static_cast<double>(face.facets.size()), static_cast<double>(corners.size()), squares};
  };
  const auto differ = [](double x, double y) { return std::abs(x - y) > 1e-9 * std::max(x, y); };
  const Figures of_a = figures_of(a), of_b = figures_of(b);
  if (differ(of_a.mean_area, of_b.mean_area)) return of_b.mean_area < of_a.mean_area;
  if (differ(of_a.corners, of_b.corners)) return of_b.corners > of_a.corners;
  return !differ(of_a.squares, of_b.squares) || of_b.squares > of_a.squares;
}

std::vector<FacetPair> facet_pairs(const Face& a, const Face& b, bool tied) {
  ensure(!why_no_pairs(a, b), "faces of pairs face each other");
  const bool plane = is_plane(a) && is_plane(b), straight = has_straight_edges(a) && has_straight_edges(b);
  std::map<int, Sums> sums = plane && straight ? plane_integrals(a, b) : curved_integrals(a, b, !plane && !tied);
  unite_small(sums, b);
  // Coordinates have rounding errors; faces that lie on each other have gaps of exactly 0, also if they are turned.
  const double rounding =
      16.0 * std::numeric_limits<double>::epsilon() * std::max(largest_coordinate(a), largest_coordinate(b));
  std::vector<FacetPair> pairs;
  for (const auto& [corner, of_pair] : sums) {
    FacetPair pair{corner,
                   weights_of(of_pair.a, of_pair.area),
                   weights_of(of_pair.b, of_pair.area),
                   of_pair.area,
                   of_pair.gap / of_pair.area,
                   of_pair.point / of_pair.area,
                   directions_of(of_pair.normal.normalized())};
    if (std::abs(pair.gap) <= rounding) pair.gap = 0.0;
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace scabo::mesh
