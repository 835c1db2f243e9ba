#include "scabo/element/plane/singular_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scabo/linalg/decompositions.hpp"
#include "scabo/linalg/ordered_schur.hpp"

namespace scabo::element {

namespace {

using std::numbers::pi;

/// Modes of a subspace of S of one block, in the displacements of the whole super-element.
ModeGroup group_of(const Block& block, const linalg::InvariantSubspace& subspace) {
  ModeGroup group{Matrix(), subspace.T, Matrix(), subspace.eigenvalues, subspace.projection_norm};
  // xi a,xi = A v, v = V xi^T c: a = A V T^-1 xi^T c.
  const Matrix a = subspace.T.transpose().partialPivLu().solve((block.A * subspace.V).transpose()).transpose();
  group.Phi = block.T * block.join(subspace.V, a);
  group.Q = (block.T * block.from_v(subspace.Q.transpose())).transpose();
  return group;
}

ModeGroup empty_group(Eigen::Index n) { return {Matrix(n, 0), Matrix(0, 0), Matrix(0, n), {}, 1.0}; }

/// Two groups of different blocks side by side.
ModeGroup joined(const ModeGroup& a, const ModeGroup& b) {
  if (a.size() == 0) return b;
  ModeGroup both = empty_group(a.Phi.rows());
  both.Phi.resize(a.Phi.rows(), a.size() + b.size());
  both.Phi << a.Phi, b.Phi;
  both.Q.resize(a.size() + b.size(), a.Q.cols());
  both.Q << a.Q, b.Q;
  both.T = Matrix::Zero(a.size() + b.size(), a.size() + b.size());
  both.T.topLeftCorner(a.size(), a.size()) = a.T;
  both.T.bottomRightCorner(b.size(), b.size()) = b.T;
  both.exponents = a.exponents;
  both.exponents.insert(both.exponents.end(), b.exponents.begin(), b.exponents.end());
  both.projection_norm = std::max(a.projection_norm, b.projection_norm);
  return both;
}

/// Ring of one element, with the node numbers of the whole.
Ring single(const Ring& ring, std::size_t element) { return {ring.nodes, {ring.elements[element]}}; }

double angle_between(const Vec2& from, const Vec2& to) { return std::atan2(cross(from, to), from.dot(to)); }

/// Angles of the ends of the elements from the first face: 0, ..., opening angle.
std::vector<double> end_angles(const Ring& ring) {
  std::vector<double> angles = {0.0};
  for (const mesh::LineElement& element : ring.elements)
    angles.push_back(angles.back() + angle_between(ring.node(element.nodes.front()), ring.node(element.nodes.back())));
  return angles;
}

/// [u; phi](t) of a group along the ray where element `element` ends (`at_end`) or begins, 4 x m, with r = `r` of the
/// node. Stress functions are divided by `unit`.
Matrix state_at_node(const Corner& corner, const ModeGroup& group, std::size_t element, bool at_end, double unit) {
  const CoefficientMatrices one =
      coefficient_matrices(single(corner.ring, element), Mat3(corner.D.of(element) / unit), 1.0);
  const auto& nodes = corner.ring.elements[element].nodes;
  const Eigen::Index row = 2 * (at_end ? nodes.back() : nodes.front());
  const Matrix slope = group.Phi * group.T, curve = slope * group.T;
  const Matrix residual = one.E0 * curve + (one.E1.transpose() * slope - one.E1 * slope) - one.E2 * group.Phi;
  Matrix state(4, group.size());
  state.topRows(2) = group.Phi.middleRows(row, 2);
  // Traction on the side of the ray that faces against t: r s_t = -R at the end of an element, +R at its beginning; r
  // phi,r = phi T is this traction times r.
  const Matrix flux = (at_end ? -1.0 : 1.0) * residual.middleRows(row, 2);
  state.bottomRows(2) = group.T.transpose().partialPivLu().solve(flux.transpose()).transpose();
  return state;
}

/// Integrates a state from ray angle t0 to t1 (absolute angles) by dw/dt = N(t) w T. Gauss-Legendre integration of
/// order 4 would need implicit solves; the classical Runge-Kutta step is sufficient at this size.
Matrix carried(const Mat3& law, Matrix w, const Matrix& T, double t0, double t1) {
  if (t0 == t1) return w;
  const int steps = std::max(8, static_cast<int>(std::ceil(std::abs(t1 - t0) / 0.004)));
  const double h = (t1 - t0) / steps;
  const auto slope = [&](double t, const Matrix& x) { return Matrix(fundamental_elasticity(law, t) * x * T); };
  for (int i = 0; i < steps; ++i) {
    const double t = t0 + i * h;
    const Matrix k1 = slope(t, w), k2 = slope(t + 0.5 * h, w + 0.5 * h * k1), k3 = slope(t + 0.5 * h, w + 0.5 * h * k2),
                 k4 = slope(t + h, w + h * k3);
    w += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return w;
}

}  // namespace

bool ModeGroup::defective(double spread) const { return linalg::is_defective(T, exponents, spread); }

Vector ModeGroup::displacement(double xi, const Vector& c) const {
  if (size() == 0 || xi <= 0.0) return Vector::Zero(Phi.rows());
  return Phi * (linalg::small_exponential(T, std::log(xi)) * c);
}

SingularModes singular_modes(const SuperElementSolution& solution, const SingularOptions& options) {
  const Eigen::Index n = solution.K.rows();
  std::vector<linalg::OrderedSchur> forms;
  std::vector<std::complex<double>> below;  // singular exponents of all blocks
  const auto group_of_exponent = [&](std::complex<double> value) {
    if (std::abs(value - 1.0) <= options.tolerance) return 1;
    return value.real() < 1.0 - options.tolerance ? 0 : 2;
  };
  for (const Block& block : solution.blocks) {
    forms.emplace_back(block.S, group_of_exponent);
    for (const auto& value : forms.back().eigenvalues())
      if (group_of_exponent(value) == 0) below.push_back(value);
  }
  const std::vector<int> cluster = linalg::clusters(below, options.cluster);
  const auto cluster_of = [&](std::complex<double> value) {
    std::size_t best = 0;
    for (std::size_t i = 0; i < below.size(); ++i)
      if (std::abs(below[i] - value) < std::abs(below[best] - value)) best = i;
    return cluster[best];
  };
  const int count = cluster.empty() ? 0 : *std::max_element(cluster.begin(), cluster.end()) + 1;
  SingularModes modes;
  modes.singular.assign(static_cast<std::size_t>(count), empty_group(n));
  modes.linear = empty_group(n);
  for (std::size_t k = 0; k < forms.size(); ++k) {
    const linalg::OrderedSchur sorted(solution.blocks[k].S, [&](std::complex<double> value) {
      const int group = group_of_exponent(value);
      return group == 0 ? cluster_of(value) : count + group;
    });
    for (int c = 0; c < count; ++c)
      if (const auto part = sorted.group(c); part.T.rows() > 0)
        modes.singular[static_cast<std::size_t>(c)] =
            joined(modes.singular[static_cast<std::size_t>(c)], group_of(solution.blocks[k], part));
    if (const auto part = sorted.group(count + 1); part.T.rows() > 0)
      modes.linear = joined(modes.linear, group_of(solution.blocks[k], part));
  }
  return modes;
}

bool is_crack(const Ring& ring) {
  const Vec2 &first = ring.node(ring.first_node()), &last = ring.node(ring.last_node());
  return ring.is_open() && (first - last).norm() <= 1e-12 * first.norm();
}

double opening_angle(const Ring& ring) { return end_angles(ring).back(); }

RayTraction ray_traction(const Corner& corner, const ModeGroup& group, double angle) {
  const Ring& ring = corner.ring;
  const std::vector<double> ends = end_angles(ring);
  ensure(angle >= -1e-9 && angle <= ends.back() + 1e-9, "a ray lies outside the material");
  std::size_t element = 0;
  while (element + 1 < ring.elements.size() && angle > ends[element + 1]) ++element;
  // The closer end. At the faces the tractions are known to vanish, so that the other end is the better start.
  const bool last = element + 1 == ring.elements.size(), first = element == 0;
  bool at_end = ends[element + 1] - angle < angle - ends[element];
  if (at_end && last && !first) at_end = false;
  if (!at_end && first && !last) at_end = true;

  const Vec2& face = ring.node(ring.first_node());
  const double zero = std::atan2(face.y(), face.x());
  const Mat3& law = corner.D.of(element);
  const double unit = law.trace() / 3.0;
  const auto& nodes = ring.elements[element].nodes;
  const double start = at_end ? ends[element + 1] : ends[element];
  const Matrix w =
      carried(law / unit, state_at_node(corner, group, element, at_end, unit), group.T, zero + start, zero + angle);
  RayTraction ray;
  ray.r0 = ring.node(at_end ? nodes.back() : nodes.front()).norm();
  const Matrix flux = unit * (w.bottomRows(2) * group.T) / ray.r0;  // traction at r0, along x and y
  const Vec2 along(std::cos(zero + angle), std::sin(zero + angle)), across(-along.y(), along.x());
  ray.F.resize(2, group.size());
  ray.F << across.transpose() * flux, along.transpose() * flux;
  return ray;
}

Vec2 generalised_factors(const RayTraction& ray, const ModeGroup& group, const Vector& c, double r) {
  if (group.size() == 0) return Vec2::Zero();
  const Matrix power =
      linalg::small_exponential(group.T - Matrix::Identity(group.size(), group.size()), std::log(r / ray.r0));
  return std::sqrt(2.0 * pi * r) * Vec2(ray.F * (power * c));
}

}  // namespace scabo::element
