#include "scabo/result/ring_sampling.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/base/components.hpp"
#include "scabo/element/plane/interior_field.hpp"
#include "scabo/geometry/line_basis.hpp"
#include "scabo/result/ring_values.hpp"

namespace scabo::result {

namespace {

constexpr int ring_count = 10, inner_rings = 6;
/// Boundary nodes that are further apart than this part of their distance from the centre get a point between them.
constexpr double coarse = 0.1;

/// Mean distance of boundary nodes over their mean distance from the centre.
double relative_spacing(const element::Ring& ring) {
  double length = 0.0, radius = 0.0;
  for (std::size_t i = 0; i < ring.nodes.size(); ++i) {
    length += (ring.nodes[(i + 1) % ring.nodes.size()] - ring.nodes[i]).norm();
    radius += ring.nodes[i].norm();
  }
  return length / radius;
}

}  // namespace

std::vector<double> ring_levels(const element::Ring& ring, bool fine) {
  // Widths w, w g, w g^2 ... of `count` rings add up to 1; g grows with the sum.
  const int count = fine ? 2 * ring_count : ring_count;
  const double width = std::clamp(relative_spacing(ring), 0.02, 1.0 / ring_count) * ring_count / count;
  double low = 1.0, high = 2.0;
  for (int halving = 0; halving < 50; ++halving) {
    const double growth = 0.5 * (low + high);
    double sum = 0.0, next = width;
    for (int i = 0; i < count; ++i, next *= growth) sum += next;
    (sum < 1.0 ? low : high) = growth;
  }
  std::vector<double> levels;
  double xi = 1.0, next = width;
  for (int i = 0; i < count; ++i, xi -= next, next *= low) levels.push_back(xi);
  // Stresses may be unbounded towards the centre of an open super-element: each ring is at half the distance of the
  // previous one.
  if (ring.is_open())
    for (int i = 0; i < inner_rings; ++i) levels.push_back(0.5 * levels.back());
  return levels;
}

std::vector<double> cell_levels(const element::Ring& ring, bool fine) {
  constexpr double wide = 0.3, growth = 1.5;  // a hexagon of order 3 has 0.35, one of order 2 0.52
  std::vector<double> levels{1.0};
  double width = std::max(relative_spacing(ring), 0.02);
  if (!fine || width >= wide) return {1.0, 0.5};
  for (; levels.back() > 1.5 * width; width *= growth) levels.push_back(levels.back() - width);
  return levels;
}

std::vector<double> outer_ring_levels() {
  std::vector<double> levels{1.0};
  constexpr int rings = 16;
  for (int i = 1; i <= rings; ++i) levels.push_back(std::pow(farthest, static_cast<double>(i) / rings));
  return levels;
}

namespace {

/// Points of the elements of a ring: where materials meet, one point for each of them.
void share_points(const element::Ring& ring, const element::Sectors& sectors, RingSampling& sampling) {
  const std::size_t count = ring.elements.size();
  std::vector<int> point_of(ring.nodes.size(), -1), material_at(ring.nodes.size(), -1);
  for (std::size_t node = 0; node < ring.nodes.size(); ++node) sampling.nodes.push_back(static_cast<int>(node));
  sampling.sectors.assign(ring.nodes.size(), 0);
  for (std::size_t e = 0; e < count; ++e) {
    const int material = sectors.material_of(e);
    const bool goes_on = e > 0 && sectors.material_of(e - 1) == material;
    sampling.centre.push_back(e == 0 ? 0 : sampling.centre.back() + (goes_on ? 0 : 1));
    std::vector<int>& points = sampling.points.emplace_back();
    for (const int node : ring.elements[e].nodes) {
      const auto i = static_cast<std::size_t>(node);
      if (material_at[i] == -1) {
        material_at[i] = material;
        point_of[i] = node;
        sampling.sectors[i] = e;
      } else if (material_at[i] != material) {
        point_of[i] = static_cast<int>(sampling.nodes.size());
        sampling.nodes.push_back(node);
        sampling.sectors.push_back(e);
        material_at[i] = material;
      }
      points.push_back(point_of[i]);
    }
  }
}

/// Derivative of the position along an element at one of its two ends; half its length in size.
Vec2 tangent_at(const element::Ring& ring, const mesh::LineElement& element, double eta) {
  const int order = static_cast<int>(element.nodes.size()) - 1;
  const auto derivatives = geometry::LineBasis::of_order(order).derivatives(eta);
  Vec2 tangent = Vec2::Zero();
  for (std::size_t i = 0; i < element.nodes.size(); ++i)
    tangent += derivatives[static_cast<Eigen::Index>(i)] * ring.node(element.nodes[i]);
  return tangent;
}

bool aligned(const Vec2& one, const Vec2& other) {
  constexpr double straight = 1e-6;  // rounding of coordinates; on arcs of three nodes tangents are further apart
  return (one / one.norm() - other / other.norm()).norm() <= straight;
}

/// Where the stress of an end of an element is taken from, and its weight there.
struct EndSample {
  std::size_t element = 0;
  double eta = 0.0, weight = 1.0;
};

/// Stress along an element of order 2 is linear; where the true one is curved, it is too large at both ends and too
/// small in the middle, or the other way round, and right at the two Gauss points (Barlow 1976). Where two elements
/// continue each other, their stress at the node between them is therefore interpolated between the Gauss points on
/// either side of it. Nothing where they meet at a corner or differ in order.
std::optional<EndSample> end_sample(const element::Ring& ring, std::size_t e, bool at_end) {
  const std::size_t count = ring.elements.size();
  const mesh::LineElement& element = ring.elements[e];
  const mesh::LineElement& other = ring.elements[at_end ? (e + 1) % count : (e + count - 1) % count];
  if (element.nodes.size() != 3 || other.nodes.size() != 3) return {};
  if (at_end ? other.nodes.front() != element.nodes.back() : other.nodes.back() != element.nodes.front()) return {};
  const double side = at_end ? 1.0 : -1.0;
  const Vec2 mine = tangent_at(ring, element, side), next = tangent_at(ring, other, -side);
  const double lengths = mine.norm() + next.norm();
  if (!aligned(mine, next)) return {};
  return EndSample{e, side / std::sqrt(3.0), next.norm() / lengths};
}

/// The element that continues element `e` in a straight line beyond its other end, of the same order and material.
std::optional<std::size_t> straight_neighbour(const element::Ring& ring, const element::Sectors& sectors, std::size_t e,
                                              bool before) {
  const std::size_t count = ring.elements.size(), n = before ? (e + count - 1) % count : (e + 1) % count;
  const mesh::LineElement &mine = ring.elements[e], &other = ring.elements[n];
  const bool touch = before ? other.nodes.back() == mine.nodes.front() : other.nodes.front() == mine.nodes.back();
  if (n == e || !touch || other.nodes.size() != mine.nodes.size() || sectors.material_of(n) != sectors.material_of(e))
    return {};
  const double side = before ? -1.0 : 1.0;
  return aligned(tangent_at(ring, mine, side), tangent_at(ring, other, -side)) ? std::optional(n) : std::nullopt;
}

/// The same of an element of order 1, whose stress is right in its middle: between elements that continue each other it
/// is interpolated, and at a corner, whose end has the share 1 / `shared`, extrapolated from the two nearest middles.
std::vector<EndSample> middle_samples(const element::Ring& ring, const element::Sectors& sectors, std::size_t e,
                                      bool at_end, int shared) {
  const double own = tangent_at(ring, ring.elements[e], 0.0).norm();
  if (const auto next = straight_neighbour(ring, sectors, e, !at_end)) {
    const double other = tangent_at(ring, ring.elements[*next], 0.0).norm();
    return {{e, 0.0, other / (own + other)}};
  }
  const auto behind = straight_neighbour(ring, sectors, e, at_end);
  if (!behind) return {};
  const double beyond = own / (own + tangent_at(ring, ring.elements[*behind], 0.0).norm());
  return {{e, 0.0, (1.0 + beyond) / shared}, {*behind, 0.0, -beyond / shared}};
}

RingSampling::Sample sample_of(const element::Ring& ring, std::size_t e, int point, double eta, double weight) {
  const mesh::LineElement& element = ring.elements[e];
  const geometry::LineBasis& basis = geometry::LineBasis::of_order(static_cast<int>(element.nodes.size()) - 1);
  element::StrainMatrices strain = element::strain_matrices(ring, element, basis.values(eta), basis.derivatives(eta));
  return {point, weight, e, std::move(strain.B1), std::move(strain.B2)};
}

/// A point in the middle between each two nodes. Its stress is that of the element; on elements of order 2 the parabola
/// through the values at the three nodes, which are better (`end_sample`). Those of order 1 have none: between values
/// at their ends there is nothing to add.
void add_points_between(const element::Ring& ring, RingSampling& sampling) {
  std::vector<std::vector<RingSampling::Sample>> at_node(sampling.nodes.size());
  for (const RingSampling::Sample& sample : sampling.samples)
    at_node[static_cast<std::size_t>(sample.point)].push_back(sample);
  for (std::size_t e = 0; e < ring.elements.size(); ++e) {
    const std::vector<int>& nodes = ring.elements[e].nodes;
    const geometry::LineBasis& basis = geometry::LineBasis::of_order(static_cast<int>(nodes.size()) - 1);
    if (basis.order() == 1) continue;
    const std::vector<int> old = sampling.points[e];
    std::vector<int> points;
    for (std::size_t i = 0; i + 1 < old.size(); ++i) {
      const double eta = 0.5 * (basis.points()[i] + basis.points()[i + 1]);
      const auto point = static_cast<int>(sampling.size());
      points.insert(points.end(), {old[i], point});
      sampling.between.push_back({nodes, basis.values(eta)});
      sampling.sectors.push_back(e);
      if (basis.order() > 2) {
        sampling.samples.push_back(sample_of(ring, e, point, eta, 1.0));
        continue;
      }
      for (std::size_t k = 0; k < old.size(); ++k)
        for (RingSampling::Sample sample : at_node[static_cast<std::size_t>(old[k])]) {
          sample.point = point;
          sample.weight *= sampling.between.back().values[static_cast<Eigen::Index>(k)];
          sampling.samples.push_back(std::move(sample));
        }
    }
    points.push_back(old.back());
    sampling.points[e] = std::move(points);
  }
}

}  // namespace

RingSampling ring_sampling(const element::Ring& ring, const element::Sectors& sectors, bool unbounded, bool fine) {
  RingSampling sampling;
  share_points(ring, sectors, sampling);
  std::vector<int> elements_at(sampling.nodes.size(), 0);
  for (const std::vector<int>& points : sampling.points)
    for (const int point : points) ++elements_at[static_cast<std::size_t>(point)];
  for (std::size_t e = 0; e < ring.elements.size(); ++e) {
    const mesh::LineElement& element = ring.elements[e];
    const int order = static_cast<int>(element.nodes.size()) - 1;
    const std::vector<double> lobatto = geometry::lobatto_points(order);
    for (std::size_t i = 0; i < element.nodes.size(); ++i) {
      const int point = sampling.points[e][i], shared = elements_at[static_cast<std::size_t>(point)];
      const bool between = shared == 2 && (i == 0 || i + 1 == element.nodes.size());
      std::vector<EndSample> from;
      if (fine && order == 1) from = middle_samples(ring, sectors, e, i > 0, shared);
      if (from.empty())
        from.push_back((between ? end_sample(ring, e, i > 0) : std::nullopt)
                           .value_or(EndSample{e, lobatto[i], 1.0 / static_cast<double>(shared)}));
      for (const EndSample& at : from)
        sampling.samples.push_back(sample_of(ring, at.element, point, at.eta, at.weight));
    }
  }
  if (fine && relative_spacing(ring) > coarse) add_points_between(ring, sampling);
  sampling.levels = unbounded ? outer_ring_levels() : ring_levels(ring, fine);
  return sampling;
}

std::shared_ptr<const RingSampling> SamplingLibrary::of_body(const element::SolvedSuperElement& super_element) {
  std::shared_ptr<const RingSampling>& sampling = known_[&super_element];
  if (!sampling)
    sampling = std::make_shared<const RingSampling>(
        ring_sampling(super_element.ring, super_element.sectors, super_element.domain.unbounded, fine_));
  return sampling;
}

namespace {

/// Column by column: the values of a unit displacement.
CellMap cell_map(const element::SolvedSuperElement& super_element, const RingSampling& sampling) {
  CellMap map;
  const auto n = places_of(super_element.ring.nodes.size());
  for (Eigen::Index j = 0; j < n; ++j) {
    const element::RadialField field(super_element.solution(), super_element.modes(), Vector::Unit(n, j));
    std::vector<double> column;
    map.materials.clear();
    values_inside(super_element, Vec2::Zero(), sampling, field, {}, 1,
                  [&](const Vec2& u, const element::Vec3& stress, int material, const Vec2&) {
                    column.insert(column.end(), {u[0], u[1], stress[0], stress[1], stress[2]});
                    map.materials.push_back(material);
                  });
    const Eigen::Matrix3Xd outer = ring_stresses(super_element, sampling, field.at(1.0), Vec2::Zero(), 1.0, {});
    column.insert(column.end(), outer.data(), outer.data() + outer.size());
    if (j == 0) map.values.resize(static_cast<Eigen::Index>(column.size()), n);
    map.values.col(j) = Eigen::Map<const Vector>(column.data(), map.values.rows());
  }
  return map;
}

}  // namespace

std::shared_ptr<const RingSampling> SamplingLibrary::of_cell(const element::SolvedSuperElement& super_element,
                                                             std::size_t cells, bool fine) {
  std::shared_ptr<const RingSampling>& sampling = known_cells_[&super_element];
  if (sampling) return sampling;
  RingSampling made = ring_sampling(super_element.ring, super_element.sectors, false);
  if (!super_element.ring.is_open()) {
    made.levels = cell_levels(super_element.ring, fine);
    if (cells > 4 * super_element.ring.nodes.size()) made.map = cell_map(super_element, made);
  }
  sampling = std::make_shared<const RingSampling>(std::move(made));
  return sampling;
}

}  // namespace scabo::result
