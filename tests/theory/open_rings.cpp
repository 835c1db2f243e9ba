#include "theory/open_rings.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/geometry/line_basis.hpp"
#include "support/decompositions.hpp"

namespace scabo::test {

element::Ring open_ring(const std::vector<Vec2>& vertices, const std::vector<std::vector<double>>& ends, int order) {
  const std::vector<double> points = geometry::lobatto_points(order);
  element::Ring ring;
  ring.nodes.push_back(vertices.front());
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    double from = 0.0;
    for (double to : ends[i]) {
      mesh::LineElement line;
      line.nodes.push_back(static_cast<int>(ring.nodes.size()) - 1);
      for (int k = 1; k <= order; ++k) {
        const double t = from + 0.5 * (points[static_cast<std::size_t>(k)] + 1.0) * (to - from);
        line.nodes.push_back(static_cast<int>(ring.nodes.size()));
        ring.nodes.push_back((1.0 - t) * vertices[i] + t * vertices[i + 1]);
      }
      ring.elements.push_back(line);
      from = to;
    }
  }
  return ring;
}

std::vector<double> equal_parts(int count) {
  std::vector<double> ends;
  for (int i = 1; i <= count; ++i) ends.push_back(static_cast<double>(i) / count);
  return ends;
}

element::Ring open_ring(const std::vector<Vec2>& vertices, int divisions, int order) {
  return open_ring(vertices, std::vector<std::vector<double>>(vertices.size() - 1, equal_parts(divisions)), order);
}

element::Ring open_ring(const std::vector<Vec2>& vertices, const std::vector<int>& divisions, int order) {
  std::vector<std::vector<double>> ends;
  for (const int count : divisions) ends.push_back(equal_parts(count));
  return open_ring(vertices, ends, order);
}

Vec2 turned(const Vec2& x, double angle) {
  return {std::cos(angle) * x.x() - std::sin(angle) * x.y(), std::sin(angle) * x.x() + std::cos(angle) * x.y()};
}

element::Ring cracked_square(int divisions, int order, double angle, double size) {
  std::vector<Vec2> vertices = {{-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}};
  for (Vec2& vertex : vertices) vertex = size * turned(vertex, angle);
  return open_ring(vertices, divisions, order);
}

element::Ring sector_ring(double first, double opening, std::vector<double> marks, double longest, int order) {
  marks.push_back(opening);
  std::sort(marks.begin(), marks.end());
  std::vector<Vec2> vertices = {{std::cos(first), std::sin(first)}};
  double from = 0.0;
  for (double to : marks) {
    const int parts = std::max(1, static_cast<int>(std::ceil((to - from) / longest - 1e-9)));
    for (int i = 1; i <= parts; ++i) {
      const double angle = first + from + (to - from) * i / parts;
      vertices.emplace_back(std::cos(angle), std::sin(angle));
    }
    from = to;
  }
  if (std::abs(opening - 2.0 * std::numbers::pi) < 1e-12) vertices.back() = vertices.front();
  return open_ring(vertices, 1, order);
}

std::vector<double> middle_angles(const element::Ring& ring) {
  std::vector<double> middles;
  double angle = 0.0;
  for (const auto& line : ring.elements) {
    const Vec2 &a = ring.nodes[static_cast<std::size_t>(line.nodes.front())],
               &b = ring.nodes[static_cast<std::size_t>(line.nodes.back())];
    const double seen = std::atan2(cross(a, b), a.dot(b));
    middles.push_back(angle + 0.5 * seen);
    angle += seen;
  }
  return middles;
}

Vec2 williams(const Kolosov& m, double K_I, double K_II, double T, double r, double t) {
  const double f = std::sqrt(r / (2 * std::numbers::pi)) / (2 * m.mu), c = std::cos(t / 2), s = std::sin(t / 2),
               cost = std::cos(t);
  const Vec2 singular(f * (K_I * c * (m.kappa - cost) + K_II * s * (m.kappa + 2 + cost)),
                      f * (K_I * s * (m.kappa - cost) - K_II * c * (m.kappa - 2 + cost)));
  return singular + T / m.young * r * Vec2(std::cos(t), -m.poisson * std::sin(t));
}

Vec2 sih_paris_irwin(const element::Mat3& a, double K_I, double K_II, double r, double t) {
  using C = std::complex<double>;
  Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();  // a11 s^4 - 2 a16 s^3 + (2 a12 + a66) s^2 - 2 a26 s + a22 = 0
  companion.bottomLeftCorner<3, 3>().setIdentity();
  companion.col(3) << -a(1, 1), 2 * a(1, 2), -(2 * a(0, 1) + a(2, 2)), 2 * a(0, 2);
  companion.col(3) /= a(0, 0);
  const ComplexVector roots = eigenvalues(companion);
  std::vector<C> s;
  for (const C& root : roots)
    if (root.imag() > 0) s.push_back(root);
  C p[2], q[2], w[2];
  for (std::size_t j = 0; j < 2; ++j) {
    p[j] = a(0, 0) * s[j] * s[j] + a(0, 1) - a(0, 2) * s[j];
    q[j] = a(0, 1) * s[j] + a(1, 1) / s[j] - a(1, 2);
    w[j] = std::sqrt(std::cos(t) + s[j] * std::sin(t));
    // On the left face the root is that reached through the upper half plane, on the right through the lower.
    if (std::abs(std::abs(t) - std::numbers::pi) < 1e-9) w[j] = C(0, t > 0 ? 1 : -1);
  }
  const double f = std::sqrt(2 * r / std::numbers::pi);
  const C over = 1.0 / (s[0] - s[1]);
  return {f * (K_I * (over * (s[0] * p[1] * w[1] - s[1] * p[0] * w[0])).real() +
               K_II * (over * (p[1] * w[1] - p[0] * w[0])).real()),
          f * (K_I * (over * (s[0] * q[1] * w[1] - s[1] * q[0] * w[0])).real() +
               K_II * (over * (q[1] * w[1] - q[0] * w[0])).real())};
}

double interface_epsilon(const Kolosov& above, const Kolosov& below) {
  return std::log((above.kappa / above.mu + 1 / below.mu) / (below.kappa / below.mu + 1 / above.mu)) /
         (2 * std::numbers::pi);
}

Vec2 interface_crack(const Kolosov& above, const Kolosov& below, std::complex<double> K, double l, double e11, double r,
                     double t) {
  using C = std::complex<double>;
  const double pi = std::numbers::pi, epsilon = interface_epsilon(above, below);
  const C s(-0.5, -epsilon), i(0, 1);
  const C a =
      std::conj(K) * std::exp(i * epsilon * std::log(l)) / (std::sqrt(2 * pi) * (1 + std::exp(2 * pi * epsilon)));
  const C upper = a, lower = a * std::exp(2 * pi * epsilon);
  const bool is_above = t > 0;
  const Kolosov& m = is_above ? above : below;
  const C own = is_above ? upper : lower, other = is_above ? lower : upper;
  const C log_z(std::log(r), t), z = std::exp(log_z);
  const C phi = own * std::exp((s + 1.0) * log_z) / (s + 1.0),
          omega = other * std::exp((s + 1.0) * std::conj(log_z)) / (s + 1.0);
  const C slope = own * std::exp(s * log_z);
  const C u = (m.kappa * phi - omega - (z - std::conj(z)) * std::conj(slope)) / (2 * m.mu);
  return {u.real() + e11 * r * std::cos(t), u.imag() - m.poisson * e11 * r * std::sin(t)};
}

}  // namespace scabo::test
