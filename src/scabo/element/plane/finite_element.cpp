#include "scabo/element/plane/finite_element.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/base/components.hpp"
#include "scabo/geometry/line_basis.hpp"

namespace scabo::element {

namespace {

const std::array<Vec2, 6> triangle_nodes = {Vec2(0, 0),   Vec2(1, 0),     Vec2(0, 1),
                                            Vec2(0.5, 0), Vec2(0.5, 0.5), Vec2(0, 0.5)};
const std::array<Vec2, 8> quad_nodes = {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1),
                                        Vec2(0, -1),  Vec2(1, 0),  Vec2(0, 1), Vec2(-1, 0)};

constexpr bool is_triangle(FiniteElementKind kind) {
  return kind == FiniteElementKind::triangle3 || kind == FiniteElementKind::triangle6;
}

constexpr int size_of(FiniteElementKind kind) {
  switch (kind) {
    case FiniteElementKind::triangle3:
      return 3;
    case FiniteElementKind::quad4:
      return 4;
    case FiniteElementKind::triangle6:
      return 6;
    case FiniteElementKind::quad8:
      return 8;
  }
  return 0;
}

/// Calls `act` with the kind as a type, so that matrices have a fixed size.
template <typename Act>
auto with_kind(FiniteElementKind kind, const Act& act) {
  using enum FiniteElementKind;
  switch (kind) {
    case triangle3:
      return act(std::integral_constant<FiniteElementKind, triangle3>());
    case triangle6:
      return act(std::integral_constant<FiniteElementKind, triangle6>());
    case quad4:
      return act(std::integral_constant<FiniteElementKind, quad4>());
    case quad8:
      return act(std::integral_constant<FiniteElementKind, quad8>());
  }
  throw BrokenInvariant("a finite element of unknown kind");
}

template <int n>
struct Shape {
  std::array<double, n> N;
  std::array<Vec2, n> gradient;  // in natural, then in real coordinates
  double jacobian = 0.0;
};

/// Shape functions and their gradients in natural coordinates.
template <FiniteElementKind kind>
Shape<size_of(kind)> natural_shape(double r, double s) {
  Shape<size_of(kind)> shape;
  if constexpr (kind == FiniteElementKind::triangle3) {
    shape.N = {1 - r - s, r, s};
    shape.gradient = {Vec2(-1, -1), Vec2(1, 0), Vec2(0, 1)};
  } else if constexpr (kind == FiniteElementKind::triangle6) {
    const double q = 1 - r - s;
    shape.N = {q * (2 * q - 1), r * (2 * r - 1), s * (2 * s - 1), 4 * q * r, 4 * r * s, 4 * s * q};
    shape.gradient = {Vec2(1 - 4 * q, 1 - 4 * q), Vec2(4 * r - 1, 0), Vec2(0, 4 * s - 1),
                      Vec2(4 * (q - r), -4 * r),  Vec2(4 * s, 4 * r), Vec2(-4 * s, 4 * (q - s))};
  } else if constexpr (kind == FiniteElementKind::quad4) {
    for (std::size_t i = 0; i < 4; ++i) {
      const double ri = quad_nodes[i].x(), si = quad_nodes[i].y();
      shape.N[i] = 0.25 * (1 + r * ri) * (1 + s * si);
      shape.gradient[i] = {0.25 * ri * (1 + s * si), 0.25 * si * (1 + r * ri)};
    }
  } else {
    for (std::size_t i = 0; i < 8; ++i) {
      const double ri = quad_nodes[i].x(), si = quad_nodes[i].y();
      if (i < 4) {
        shape.N[i] = 0.25 * (1 + r * ri) * (1 + s * si) * (r * ri + s * si - 1);
        shape.gradient[i] = {0.25 * ri * (1 + s * si) * (2 * r * ri + s * si),
                             0.25 * si * (1 + r * ri) * (r * ri + 2 * s * si)};
      } else if (ri == 0.0) {
        shape.N[i] = 0.5 * (1 - r * r) * (1 + s * si);
        shape.gradient[i] = {-r * (1 + s * si), 0.5 * si * (1 - r * r)};
      } else {
        shape.N[i] = 0.5 * (1 - s * s) * (1 + r * ri);
        shape.gradient[i] = {0.5 * ri * (1 - s * s), -s * (1 + r * ri)};
      }
    }
  }
  return shape;
}

/// J(a, b) = d x_a / d natural_b. The gradients add to zero: positions relative to a node of the element do not lose
/// the digits of large coordinates.
template <int n>
Mat2 jacobian_matrix(const Shape<n>& shape, const FiniteElement& element) {
  Mat2 J = Mat2::Zero();
  for (std::size_t i = 1; i < n; ++i) J += (element.x[i] - element.x[0]) * shape.gradient[i].transpose();
  return J;
}

/// The position at a point relative to the first node.
template <int n>
Vec2 arm_to(const Shape<n>& shape, const FiniteElement& element) {
  Vec2 arm = Vec2::Zero();
  for (std::size_t i = 1; i < n; ++i) arm += shape.N[i] * (element.x[i] - element.x[0]);
  return arm;
}

/// The radius at a point of an element of revolution.
template <int n>
double radius_at(const Shape<n>& shape, const FiniteElement& element) {
  return element.x[0].x() + arm_to(shape, element).x();
}

/// With gradients in real coordinates; not numbers where the Jacobian is zero.
template <FiniteElementKind kind>
Shape<size_of(kind)> shape_at(const FiniteElement& element, double r, double s) {
  auto shape = natural_shape<kind>(r, s);
  const Mat2 J = jacobian_matrix(shape, element);
  shape.jacobian = J.determinant();
  const Mat2 to_real = shape.jacobian > 1e-12 * J.squaredNorm()
                           ? Mat2(J.inverse().transpose())
                           : Mat2(Mat2::Constant(std::numeric_limits<double>::quiet_NaN()));
  for (Vec2& gradient : shape.gradient) gradient = to_real * gradient;
  return shape;
}

/// `rows`: 3, or 4 with the hoop strain at the radius `x`.
template <int rows, int n>
Eigen::Matrix<double, rows, 2 * n> strain_matrix(const Shape<n>& shape, double x = 0.0) {
  Eigen::Matrix<double, rows, 2 * n> B = Eigen::Matrix<double, rows, 2 * n>::Zero();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec2& g = shape.gradient[static_cast<std::size_t>(i)];
    B(0, 2 * i) = B(2, 2 * i + 1) = g.x();
    B(1, 2 * i + 1) = B(2, 2 * i) = g.y();
    if constexpr (rows == 4) B(3, 2 * i) = shape.N[static_cast<std::size_t>(i)] / x;
  }
  return B;
}

struct IntegrationPoint {
  Vec2 natural;
  double weight;
};
using IntegrationRule = std::vector<IntegrationPoint>;

/// Products of Gauss rules.
IntegrationRule quad_rule(int count) {
  const geometry::GaussRule rule = geometry::gauss_rule(count);
  IntegrationRule points;
  for (std::size_t i = 0; i < rule.points.size(); ++i)
    for (std::size_t j = 0; j < rule.points.size(); ++j)
      points.push_back({{rule.points[i], rule.points[j]}, rule.weights[i] * rule.weights[j]});
  return points;
}

/// Three points at the fraction 1 - 2 a along each median; weights of the area 1/2.
void add_orbit(IntegrationRule& rule, double a, double weight) {
  for (const Vec2& at : {Vec2(a, a), Vec2(1 - 2 * a, a), Vec2(a, 1 - 2 * a)}) rule.push_back({at, 0.5 * weight});
}

/// Exact for polynomials of degree 2 (3 points), or 4 (6 points; Strang and Fix 1973, Cowper 1973).
IntegrationRule triangle_rule(int degree) {
  IntegrationRule rule;
  if (degree == 2) {
    add_orbit(rule, 1.0 / 6.0, 1.0 / 3.0);
    return rule;
  }
  const double ten = std::sqrt(10.0), root = std::sqrt(38.0 - 44.0 * std::sqrt(0.4)),
               weights = std::sqrt(213125.0 - 53320.0 * ten);
  add_orbit(rule, (8.0 - ten + root) / 18.0, (620.0 + weights) / 3720.0);
  add_orbit(rule, (8.0 - ten - root) / 18.0, (620.0 - weights) / 3720.0);
  return rule;
}

const IntegrationRule& rule_of(FiniteElementKind kind) {
  static const std::array<IntegrationRule, 4> rules = {triangle_rule(2), triangle_rule(4), quad_rule(2), quad_rule(3)};
  return rules[static_cast<std::size_t>(kind)];
}

/// Calls `visit(shape, weight)` at the integration points; weights include the Jacobian.
template <FiniteElementKind kind, typename Visit>
void integrate(const FiniteElement& element, const Visit& visit) {
  for (const IntegrationPoint& point : rule_of(kind)) {
    const auto shape = shape_at<kind>(element, point.natural.x(), point.natural.y());
    ensure(shape.jacobian > 0.0, "a finite element is turned inside out");
    visit(shape, point.weight * shape.jacobian);
  }
}

/// Integral of B' D B over the volume.
template <FiniteElementKind kind, int rows>
ElementMatrix integrated_stiffness(const FiniteElement& element, const SectionLaw& law, const Extent& extent) {
  constexpr int n = size_of(kind);
  using Square = Eigen::Matrix<double, 2 * n, 2 * n>;
  const Eigen::Matrix<double, rows, rows> D = law.D.topLeftCorner<rows, rows>();
  Square K = Square::Zero();
  integrate<kind>(element, [&](const auto& shape, double weight) {
    const double x = rows == 4 ? radius_at(shape, element) : 0.0;
    const Eigen::Matrix<double, rows, 2 * n> B = strain_matrix<rows, n>(shape, x);
    K.noalias() += B.transpose() * (D * (weight * extent.at(x))) * B;
  });
  return 0.5 * (K + K.transpose());
}

double jacobian_at(const FiniteElement& element, const Vec2& natural) {
  return with_kind(element.kind, [&](auto kind) {
    return jacobian_matrix(natural_shape<kind()>(natural.x(), natural.y()), element).determinant();
  });
}

struct Box {
  Vec2 low, high;
};

Box box_of(const FiniteElement& element) {
  Box box{element.x[0], element.x[0]};
  for (int i = 1; i < element.size(); ++i) {
    box.low = box.low.cwiseMin(element.x[static_cast<std::size_t>(i)]);
    box.high = box.high.cwiseMax(element.x[static_cast<std::size_t>(i)]);
  }
  return box;
}

struct Residual {
  Vec2 miss;
  Mat2 J;
};

Residual residual_at(const FiniteElement& element, const Vec2& x, const Vec2& natural) {
  return with_kind(element.kind, [&](auto kind) {
    const auto shape = natural_shape<kind()>(natural.x(), natural.y());
    return Residual{(x - element.x[0]) - arm_to(shape, element), jacobian_matrix(shape, element)};
  });
}

/// Newton's method for position(natural) = x with halved steps; nothing if it ends elsewhere.
std::optional<Vec2> solve_for_natural(const FiniteElement& element, const Vec2& x, const Vec2& start, double size) {
  Vec2 natural = start;
  Residual now = residual_at(element, x, natural);
  for (int iteration = 0; iteration < 50; ++iteration) {
    const double miss = now.miss.norm();
    if (miss <= 1e-14 * size) return natural;
    const double determinant = now.J.determinant();
    if (!(std::abs(determinant) > 1e-14 * now.J.squaredNorm())) break;
    Vec2 step = now.J.inverse() * now.miss;
    step *= std::min(1.0, 2.0 / step.lpNorm<Eigen::Infinity>());
    bool closer = false;
    for (int halving = 0; halving < 12 && !closer; ++halving, step *= 0.5) {
      const Residual next = residual_at(element, x, natural + step);
      if (!(next.miss.norm() < miss)) continue;
      natural += step;
      now = next;
      closer = true;
      break;
    }
    if (!closer) break;
    if (!(natural.lpNorm<Eigen::Infinity>() < 5.0)) return std::nullopt;
  }
  // Coordinates that are large compared with the element leave more rounding.
  if (now.miss.norm() <= 1e-12 * size + 8.0 * std::numeric_limits<double>::epsilon() * x.norm()) return natural;
  return std::nullopt;
}

bool holds(FiniteElementKind kind, const Vec2& natural, double slack) {
  if (is_triangle(kind)) return natural.minCoeff() >= -slack && natural.sum() <= 1.0 + slack;
  return natural.lpNorm<Eigen::Infinity>() <= 1.0 + slack;
}

Vec2 natural_centre(FiniteElementKind kind) {
  return is_triangle(kind) ? Vec2(Vec2::Constant(1.0 / 3.0)) : Vec2(Vec2::Zero());
}

}  // namespace

int FiniteElement::corners() const { return is_triangle(kind) ? 3 : 4; }

int FiniteElement::size() const { return size_of(kind); }

FiniteElement finite_element_of(const mesh::Cell& cell, const std::vector<Vec2>& nodes) {
  const std::size_t sides = cell.boundary.size();
  ensure(sides == 3 || sides == 4, "a finite element has three or four sides");
  const std::size_t order = cell.boundary.front().nodes.size() - 1;
  ensure(order == 1 || order == 2, "a side of a finite element has order 1 or 2");
  FiniteElement element;
  using enum FiniteElementKind;
  element.kind = sides == 3 ? (order == 1 ? triangle3 : triangle6) : (order == 1 ? quad4 : quad8);
  for (std::size_t side = 0; side < sides; ++side) {
    ensure(cell.boundary[side].nodes.size() == order + 1, "all sides of a finite element have the same order");
    element.numbers[side] = cell.boundary[side].nodes[0];
    if (order == 2) element.numbers[side + sides] = cell.boundary[side].nodes[1];
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(element.size()); ++i)
    element.x[i] = nodes[static_cast<std::size_t>(element.numbers[i])];
  return element;
}

std::vector<int> dofs_of(const FiniteElement& element) {
  std::vector<int> dofs;
  dofs.reserve(static_cast<std::size_t>(2 * element.size()));
  for (const int node : element.nodes()) {
    for (const int c : {0, 1}) dofs.push_back(static_cast<int>(place_of(node, c)));
  }
  return dofs;
}

std::span<const Vec2> natural_nodes(FiniteElementKind kind) {
  const auto size = static_cast<std::size_t>(size_of(kind));
  return is_triangle(kind) ? std::span<const Vec2>(triangle_nodes).first(size)
                           : std::span<const Vec2>(quad_nodes).first(size);
}

double least_jacobian(const FiniteElement& element) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2& natural : natural_nodes(element.kind)) least = std::min(least, jacobian_at(element, natural));
  for (const IntegrationPoint& point : rule_of(element.kind))
    least = std::min(least, jacobian_at(element, point.natural));
  return least;
}

bool is_well_shaped(const FiniteElement& element) {
  const Box box = box_of(element);
  const double rounding = 1e-12 * (box.high - box.low).squaredNorm();
  const auto at_least = [&](const Vec2& natural, double bound) { return jacobian_at(element, natural) >= bound; };
  return std::all_of(rule_of(element.kind).begin(), rule_of(element.kind).end(),
                     [&](const IntegrationPoint& point) { return at_least(point.natural, rounding); }) &&
         std::all_of(natural_nodes(element.kind).begin(), natural_nodes(element.kind).end(),
                     [&](const Vec2& natural) { return at_least(natural, -rounding); });
}

ElementMatrix finite_element_stiffness(const FiniteElement& element, const SectionLaw& law, const Extent& extent) {
  return with_kind(element.kind, [&](auto kind) {
    return extent.revolved ? integrated_stiffness<kind(), 4>(element, law, extent)
                           : integrated_stiffness<kind(), 3>(element, law, extent);
  });
}

ElementMatrix finite_element_mass(const FiniteElement& element, double density, const Extent& extent) {
  return with_kind(element.kind, [&](auto kind) -> ElementMatrix {
    constexpr int n = size_of(kind());
    using Square = Eigen::Matrix<double, n, n>;
    Square of_nodes = Square::Zero();
    integrate<kind()>(element, [&](const auto& shape, double weight) {
      const Eigen::Map<const Eigen::Matrix<double, n, 1>> N(shape.N.data());
      of_nodes.noalias() += N * N.transpose() * (weight * density * extent.at(radius_at(shape, element)));
    });
    ElementMatrix M = ElementMatrix::Zero(2 * n, 2 * n);  // equal for the two components
    for (Eigen::Index j = 0; j < n; ++j)
      for (Eigen::Index i = 0; i < n; ++i) M(2 * i, 2 * j) = M(2 * i + 1, 2 * j + 1) = of_nodes(i, j);
    return M;
  });
}

ElementVector finite_element_body_force(const FiniteElement& element, const LinearField& b_x, const LinearField& b_y,
                                        const Extent& extent) {
  return with_kind(element.kind, [&](auto kind) -> ElementVector {
    constexpr int n = size_of(kind());
    const Vec2 origin = element.x[0];  // moments about a node of the element have no large numbers that cancel
    std::array<double, n> volumes{};
    std::array<Vec2, n> moments;
    moments.fill(Vec2::Zero());
    integrate<kind()>(element, [&](const auto& shape, double weight) {
      const Vec2 arm = arm_to(shape, element);
      const double across = extent.at(origin.x() + arm.x());
      for (std::size_t i = 0; i < n; ++i) {
        volumes[i] += shape.N[i] * weight * across;
        moments[i] += shape.N[i] * weight * across * arm;
      }
    });
    Mat2 slope;
    slope << b_x.per_x, b_x.per_y, b_y.per_x, b_y.per_y;
    ElementVector f(2 * n);
    for (std::size_t i = 0; i < n; ++i)
      f.template segment<2>(place_of(i)) = volumes[i] * Vec2(b_x.at(origin), b_y.at(origin)) + slope * moments[i];
    return f;
  });
}

ElementVector finite_element_spin_force(const FiniteElement& element, double density, double spin,
                                        const Extent& extent) {
  return finite_element_body_force(element, {0.0, density * spin * spin, 0.0}, {}, extent);
}

ElementVector finite_element_thermal_force(const FiniteElement& element, const SectionLaw& law,
                                           const LinearField& temperature, const Extent& extent) {
  return with_kind(element.kind, [&](auto kind) -> ElementVector {
    constexpr int n = size_of(kind());
    Eigen::Matrix<double, 2 * n, 1> f = Eigen::Matrix<double, 2 * n, 1>::Zero();
    const Vec4 unit_stress = law.D * law.unit_strain;
    integrate<kind()>(element, [&](const auto& shape, double weight) {
      const Vec2 x = element.x[0] + arm_to(shape, element);
      const double part = temperature.at(x) * weight * extent.at(x.x());
      if (extent.revolved)
        f.noalias() += strain_matrix<4, n>(shape, x.x()).transpose() * (unit_stress * part);
      else
        f.noalias() += strain_matrix<3, n>(shape).transpose() * (unit_stress.head<3>() * part);
    });
    return f;
  });
}

double finite_element_product(const FiniteElement& element, const LinearField& one, const LinearField& other,
                              const Extent& extent) {
  return with_kind(element.kind, [&](auto kind) {
    double sum = 0.0;
    integrate<kind()>(element, [&](const auto& shape, double weight) {
      const Vec2 x = element.x[0] + arm_to(shape, element);
      sum += one.at(x) * other.at(x) * weight * extent.at(x.x());
    });
    return sum;
  });
}

PointValues finite_element_values(const FiniteElement& element, const ElementVector& u, const SectionLaw& law,
                                  const Vec2& natural, double temperature, bool revolved) {
  return with_kind(element.kind, [&](auto kind) {
    constexpr int n = size_of(kind());
    const auto shape = shape_at<kind()>(element, natural.x(), natural.y());
    PointValues point;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 of_node = u.template segment<2>(place_of(i)), &g = shape.gradient[i];
      point.displacement += shape.N[i] * of_node;
      point.strain += Vec3(g.x() * of_node.x(), g.y() * of_node.y(), g.y() * of_node.x() + g.x() * of_node.y());
    }
    if (revolved) {
      const Box box = box_of(element);
      const double x = radius_at(shape, element);
      const bool on_axis = x <= 1e-9 * (box.high.x() - box.low.x());
      point.strain_zz = on_axis ? point.strain[0] : point.displacement.x() / x;
    }
    const Vec4 strain(point.strain[0], point.strain[1], point.strain[2], point.strain_zz);
    point.stress = law.D.topRows<3>() * (strain - law.unit_strain * temperature);
    return point;
  });
}

Vec2 position_in(const FiniteElement& element, const Vec2& natural) {
  return element.x[0] - residual_at(element, element.x[0], natural).miss;
}

std::optional<Vec2> natural_coordinates(const FiniteElement& element, const Vec2& x) {
  constexpr double slack = 1e-9;  // points between two elements belong to one of them
  const Box box = box_of(element);
  const Vec2 size = box.high - box.low;
  // Curved sides may extend beyond the bounding box of their nodes by less than a quarter of its size.
  const Vec2 margin = (element.size() > element.corners() ? 0.25 : 1e-6) * size;
  if (((x - box.low).array() < -margin.array()).any() || ((x - box.high).array() > margin.array()).any())
    return std::nullopt;
  const auto accept = [&](const std::optional<Vec2>& natural) {
    return natural && holds(element.kind, *natural, slack);
  };
  const Vec2 centre = natural_centre(element.kind);
  const auto first = solve_for_natural(element, x, centre, size.norm());
  if (accept(first)) return first;
  if (element.kind == FiniteElementKind::triangle3) return std::nullopt;  // the equation is linear
  // Distorted elements may need a start nearby.
  for (const Vec2& node : natural_nodes(element.kind)) {
    const auto other = solve_for_natural(element, x, 0.9 * node + 0.1 * centre, size.norm());
    if (accept(other)) return other;
  }
  return std::nullopt;
}

}  // namespace scabo::element
