#include "scabo/system/loads.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/base/components.hpp"
#include "scabo/geometry/line_basis.hpp"
#include "scabo/geometry/plane/foot_points.hpp"

namespace scabo::system {

namespace {

/// Calls `visit(N, x, n, ds)` at the integration points of an element: shape functions, position, outward normal,
/// weighted length.
template <typename Visit>
void integrate(const mesh::LineElement& element, const std::vector<Vec2>& nodes, Visit visit) {
  const auto& basis = geometry::LineBasis::of_order(static_cast<int>(element.nodes.size()) - 1);
  for (std::size_t q = 0; q < basis.rule().points.size(); ++q) {
    const auto row = static_cast<Eigen::Index>(q);
    Vec2 x = Vec2::Zero(), x_eta = Vec2::Zero();
    for (std::size_t i = 0; i < element.nodes.size(); ++i) {
      const Vec2& node = nodes[static_cast<std::size_t>(element.nodes[i])];
      x += basis.values_at_rule()(row, static_cast<Eigen::Index>(i)) * node;
      x_eta += basis.derivatives_at_rule()(row, static_cast<Eigen::Index>(i)) * node;
    }
    const double length = x_eta.norm();
    visit(basis.values_at_rule().row(row), x, Vec2(Vec2(x_eta.y(), -x_eta.x()) / length),
          basis.rule().weights[q] * length);
  }
}

/// Parameters of an element between which the position passes no break: -1, ..., 1.
std::vector<double> parts_of(const mesh::LineElement& element, const geometry::LineBasis& basis,
                             const std::vector<Vec2>& nodes, const Breaks& breaks) {
  if (breaks.at.empty()) return {-1.0, 1.0};  // of a uniform traction there is no position either
  const auto position = [&](double eta) {
    const Vector N = basis.values(eta);
    Vec2 x = Vec2::Zero();
    for (std::size_t i = 0; i < element.nodes.size(); ++i)
      x += N[static_cast<Eigen::Index>(i)] * nodes[static_cast<std::size_t>(element.nodes[i])];
    return breaks.position(x);
  };
  constexpr int samples = 16;  // a curved element may pass a break twice
  std::vector<double> eta, value, ends{-1.0, 1.0};
  for (int k = 0; k <= samples; ++k) {
    eta.push_back(-1.0 + 2.0 * k / samples);
    value.push_back(position(eta.back()));
  }
  for (const double at : breaks.at)
    for (std::size_t k = 0; k < samples; ++k) {
      if (k > 0 && value[k] == at) ends.push_back(eta[k]);
      if (!((value[k] - at) * (value[k + 1] - at) < 0.0)) continue;
      double low = eta[k], high = eta[k + 1];
      const bool rises = value[k + 1] > at;
      for (double middle = 0.5 * (low + high); low < middle && middle < high; middle = 0.5 * (low + high))
        ((position(middle) > at) == rises ? high : low) = middle;
      ends.push_back(high);
    }
  std::sort(ends.begin(), ends.end());
  return ends;
}

/// Calls `visit(N, x, n, ds)` at `points` integration points of each part of an element.
template <typename Visit>
void integrate_in_parts(const mesh::LineElement& element, const std::vector<Vec2>& nodes, const Breaks& breaks,
                        int points, Visit visit) {
  const auto& basis = geometry::LineBasis::of_order(static_cast<int>(element.nodes.size()) - 1);
  const geometry::GaussRule rule = geometry::gauss_rule(points);
  const std::vector<double> ends = parts_of(element, basis, nodes, breaks);
  for (std::size_t part = 0; part + 1 < ends.size(); ++part) {
    const double half = 0.5 * (ends[part + 1] - ends[part]);
    for (std::size_t q = 0; half > 0.0 && q < rule.points.size(); ++q) {
      const double eta = ends[part] + half * (1.0 + rule.points[q]);
      const Vector N = basis.values(eta), N_eta = basis.derivatives(eta);
      Vec2 x = Vec2::Zero(), x_eta = Vec2::Zero();
      for (std::size_t i = 0; i < element.nodes.size(); ++i) {
        x += N[static_cast<Eigen::Index>(i)] * nodes[static_cast<std::size_t>(element.nodes[i])];
        x_eta += N_eta[static_cast<Eigen::Index>(i)] * nodes[static_cast<std::size_t>(element.nodes[i])];
      }
      const double length = x_eta.norm();
      visit(N, x, Vec2(Vec2(x_eta.y(), -x_eta.x()) / length), half * rule.weights[q] * length);
    }
  }
}

int order_of(const mesh::LineElement& element) { return static_cast<int>(element.nodes.size()) - 1; }

}  // namespace

Vector traction_forces(const std::vector<mesh::LineElement>& elements, const std::vector<Vec2>& nodes,
                       const Extent& extent, const TractionField& traction, const Breaks& breaks) {
  Vector f = Vector::Zero(places_of(nodes.size()));
  for (const mesh::LineElement& element : elements)
    // N, x and x,eta of curved elements
    integrate_in_parts(element, nodes, breaks, 3 * order_of(element) / 2 + 2,
                       [&](const Vector& N, const Vec2& x, const Vec2& n, double ds) {
                         const Vec2 force = traction(x, n) * (ds * extent.at(x.x()));
                         for (std::size_t i = 0; i < element.nodes.size(); ++i)
                           f.segment<2>(place_of(element.nodes[i])) += N[static_cast<Eigen::Index>(i)] * force;
                       });
  return f;
}

std::vector<Eigen::Triplet<double>> mass_along_normals(const std::vector<mesh::LineElement>& elements,
                                                       const std::vector<Vec2>& nodes, const Extent& extent,
                                                       const std::function<double(const Vec2& x)>& layer,
                                                       const Breaks& breaks) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const mesh::LineElement& element : elements) {
    const auto count = static_cast<Eigen::Index>(element.nodes.size());
    Matrix M = Matrix::Zero(2 * count, 2 * count);
    integrate_in_parts(element, nodes, breaks,
                       2 * order_of(element) + 6,  // a root at the level, to 1e-4 of the element
                       [&](const Vector& N, const Vec2& x, const Vec2& n, double ds) {
                         Vector along(2 * count);  // N_i n
                         for (Eigen::Index i = 0; i < count; ++i) along.segment<2>(2 * i) = N[i] * n;
                         M += layer(x) * ds * extent.at(x.x()) * along * along.transpose();
                       });
    for (Eigen::Index i = 0; i < 2 * count; ++i)
      for (Eigen::Index j = 0; j < 2 * count; ++j)
        entries.emplace_back(static_cast<int>(place_of(element.nodes[static_cast<std::size_t>(i / 2)]) + i % 2),
                             static_cast<int>(place_of(element.nodes[static_cast<std::size_t>(j / 2)]) + j % 2),
                             M(i, j));
  }
  return entries;
}

Vector forces_at_place(const std::vector<mesh::LineElement>& elements, const std::vector<Vec2>& nodes,
                       const model::Edge& edge, double place, const Vec2& force) {
  Vector f = Vector::Zero(places_of(nodes.size()));
  const double length = edge.length();
  if (!(place >= 0.0 && place <= length)) return f;
  const auto position = [&](const Vec2& x) { return length * geometry::closest_position(edge, x); };
  const mesh::LineElement* nearest = nullptr;
  double distance = HUGE_VAL;  // of the place from the element, along the edge
  for (const mesh::LineElement& element : elements) {
    const double from = position(nodes[static_cast<std::size_t>(element.nodes.front())]);
    double to = position(nodes[static_cast<std::size_t>(element.nodes.back())]);
    if (to < from) to = length;  // the end of a closed edge is its start
    const double beyond = std::max({from - place, place - to, 0.0});
    if (beyond < distance) distance = beyond, nearest = &element;
  }
  ensure(nearest != nullptr, "an edge has elements");
  const auto& basis = geometry::LineBasis::of_order(order_of(*nearest));
  const auto point = [&](const Vector& N) {
    Vec2 x = Vec2::Zero();
    for (std::size_t i = 0; i < nearest->nodes.size(); ++i)
      x += N[static_cast<Eigen::Index>(i)] * nodes[static_cast<std::size_t>(nearest->nodes[i])];
    return x;
  };
  double low = -1.0, high = 1.0;
  for (double middle = 0.0; low < middle && middle < high; middle = 0.5 * (low + high))
    (position(point(basis.values(middle))) > place ? high : low) = middle;
  const Vector N = basis.values(high);
  for (std::size_t i = 0; i < nearest->nodes.size(); ++i)
    f.segment<2>(place_of(nearest->nodes[i])) += N[static_cast<Eigen::Index>(i)] * force;
  return f;
}

VaryingTraction varying_traction(const model::EdgeTable& table, const model::Edge& edge) {
  VaryingTraction varying;
  switch (table.over) {
    case model::EdgeTable::Over::length:
      varying.breaks.position = [edge, length = edge.length()](const Vec2& x) {
        return length * geometry::closest_position(edge, x);
      };
      break;
    case model::EdgeTable::Over::x:
      varying.breaks.position = [](const Vec2& x) { return x.x(); };
      break;
    case model::EdgeTable::Over::y:
      varying.breaks.position = [](const Vec2& x) { return x.y(); };
      break;
  }
  for (const model::EdgeTable::Point& point : table.points) varying.breaks.at.push_back(point.at);
  varying.traction = [table, position = varying.breaks.position](const Vec2& x, const Vec2& n) -> Vec2 {
    const double at = position(x);
    const auto after = std::upper_bound(table.points.begin(), table.points.end(), at,
                                        [](double value, const auto& point) { return value < point.at; });
    if (after == table.points.begin()) return Vec2::Zero();
    const auto before = after - 1;
    Vec2 value = before->value;
    if (after == table.points.end()) {
      if (at > before->at) return Vec2::Zero();
    } else {
      value += (at - before->at) / (after->at - before->at) * (after->value - before->value);
    }
    return table.pressure ? Vec2(-value.x() * n) : value;
  };
  return varying;
}

VaryingTraction varying_traction(const model::Water& water) {
  const auto depth = [water](const Vec2& x) { return water.level - water.up.dot(x); };
  return {
      [water, depth](const Vec2& x, const Vec2& n) -> Vec2 { return -water.unit_weight * std::max(depth(x), 0.0) * n; },
      {depth, {0.0}}};
}

EdgeElements elements_of(const model::Edge& edge) {
  EdgeElements made;
  const auto add = [&](const std::vector<Vec2>& points) {  // of the next element
    mesh::LineElement& element = made.elements.emplace_back();
    for (const Vec2& x : points) {
      element.nodes.push_back(static_cast<int>(made.nodes.size()));
      made.nodes.push_back(x);
    }
  };
  if (!edge.arc) {
    for (int i = 0; i < edge.segments(); ++i) add({edge.chain_point(i), edge.chain_point(i + 1)});
    return made;
  }
  constexpr int parts = 32, order = 6;
  for (int k = 0; k < parts; ++k) {
    std::vector<Vec2> points;
    for (const double eta : geometry::lobatto_points(order)) points.push_back(edge.at((k + 0.5 + 0.5 * eta) / parts));
    add(points);
  }
  return made;
}

Vector traction_forces(const std::vector<mesh::LineElement>& elements, const std::vector<Vec2>& nodes,
                       const Extent& extent, const TractionField& traction) {
  Vector f = Vector::Zero(places_of(nodes.size()));
  for (const mesh::LineElement& element : elements)
    integrate(element, nodes, [&](const auto& N, const Vec2& x, const Vec2& n, double ds) {
      const Vec2 force = traction(x, n) * (ds * extent.at(x.x()));
      for (std::size_t i = 0; i < element.nodes.size(); ++i)
        f.segment<2>(place_of(element.nodes[i])) += N[static_cast<Eigen::Index>(i)] * force;
    });
  return f;
}

double area_of(const std::vector<mesh::LineElement>& elements, const std::vector<Vec2>& nodes, const Extent& extent) {
  double area = 0.0;
  for (const mesh::LineElement& element : elements)
    integrate(element, nodes,
              [&](const auto&, const Vec2& x, const Vec2&, double ds) { area += ds * extent.at(x.x()); });
  return area;
}

}  // namespace scabo::system
