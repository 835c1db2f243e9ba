#include "theory/long_double_route.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace scabo::test::oracle {
namespace {

/// P_n and its first two derivatives.
std::array<Real, 3> legendre(int n, Real x) {
  Real before = 1, value = x;
  if (n == 0) return {1, 0, 0};
  for (int k = 2; k <= n; ++k) {
    const Real next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
    before = value, value = next;
  }
  const Real slope = n * (x * value - before) / (x * x - 1);
  return {value, slope, (2 * x * slope - n * (n + 1) * value) / (1 - x * x)};
}

/// Shape functions of Lobatto points and their derivatives at Gauss points.
struct Basis {
  Dense N, slope;  // points x nodes
  Column weights;
  explicit Basis(int order) {
    const Real pi = std::numbers::pi_v<Real>;
    std::vector<Real> nodes(static_cast<std::size_t>(order) + 1);
    for (int i = 0; i <= order; ++i) {
      Real x = -std::cos(pi * i / order);
      if (i == 0 || i == order)
        x = i == 0 ? -1 : 1;
      else
        for (int k = 0; k < 50; ++k) {
          const auto [value, first, second] = legendre(order, x);
          x -= first / second;
        }
      nodes[static_cast<std::size_t>(i)] = x;
    }
    const int count = order + 2;
    N.setZero(count, order + 1), slope.setZero(count, order + 1), weights.setZero(count);
    for (int q = 0; q < count; ++q) {
      Real x = -std::cos(pi * (q + 0.75L) / (count + 0.5L));
      for (int k = 0; k < 50; ++k) {
        const auto [value, first, second] = legendre(count, x);
        x -= value / first;
      }
      const Real first = legendre(count, x)[1];
      weights[q] = 2 / ((1 - x * x) * first * first);
      for (int j = 0; j <= order; ++j) {
        Real value = 1, over = 0;
        for (int k = 0; k <= order; ++k)
          if (k != j) {
            const Real apart = nodes[static_cast<std::size_t>(j)] - nodes[static_cast<std::size_t>(k)],
                       from = x - nodes[static_cast<std::size_t>(k)];
            value *= from / apart, over += 1 / from;
          }
        N(q, j) = value, slope(q, j) = value * over;
      }
    }
  }
};

}  // namespace

Coefficients coefficients(const element::Ring& ring, const element::Elasticity& elasticity, double thickness) {
  const auto n = static_cast<Eigen::Index>(2 * ring.nodes.size());
  Coefficients result{Dense::Zero(n, n), Dense::Zero(n, n), Dense::Zero(n, n)};
  for (std::size_t e = 0; e < ring.elements.size(); ++e) {
    const auto& nodes = ring.elements[e].nodes;
    const Basis basis(static_cast<int>(nodes.size()) - 1);
    const Dense D = elasticity.of(e).cast<Real>();
    for (Eigen::Index q = 0; q < basis.weights.size(); ++q) {
      Real x = 0, y = 0, tx = 0, ty = 0;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Vec2& node = ring.nodes[static_cast<std::size_t>(nodes[i])];
        const auto at = static_cast<Eigen::Index>(i);
        x += basis.N(q, at) * node.x(), y += basis.N(q, at) * node.y();
        tx += basis.slope(q, at) * node.x(), ty += basis.slope(q, at) * node.y();
      }
      const Real J = x * ty - y * tx;
      Dense b1(3, 2), b2(3, 2);
      b1 << ty, 0, 0, -tx, -tx, ty;
      b2 << -y, 0, 0, x, x, -y;
      const Dense weighted = D * (basis.weights[q] * thickness / J);
      const Dense c0 = b1.transpose() * weighted * b1, c1 = b2.transpose() * weighted * b1,
                  c2 = b2.transpose() * weighted * b2;
      for (std::size_t i = 0; i < nodes.size(); ++i)
        for (std::size_t j = 0; j < nodes.size(); ++j) {
          const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(j);
          result.E0.block(2 * nodes[i], 2 * nodes[j], 2, 2) += basis.N(q, a) * basis.N(q, b) * c0;
          result.E1.block(2 * nodes[i], 2 * nodes[j], 2, 2) += basis.slope(q, a) * basis.N(q, b) * c1;
          result.E2.block(2 * nodes[i], 2 * nodes[j], 2, 2) += basis.slope(q, a) * basis.slope(q, b) * c2;
        }
    }
  }
  return result;
}

Dense stiffness(const Coefficients& of) {
  const auto& [E0, E1, E2] = of;
  const Eigen::Index n = E0.rows(), m = n - 2;
  Eigen::Index node = 0;  // the heaviest: its two rows are taken out
  for (Eigen::Index i = 0; i < n; i += 2)
    if (E0(i, i) + E0(i + 1, i + 1) > E0(node, node) + E0(node + 1, node + 1)) node = i;
  Dense R = Dense::Zero(n, 2);
  std::vector<Eigen::Index> I;
  for (Eigen::Index i = 0; i < n; ++i) {
    R(i, i % 2) = 1;
    if (i / 2 != node / 2) I.push_back(i);
  }
  const Dense E0R = E0 * R, E1R = E1 * R, M = R.transpose() * E0R;
  const Eigen::LLT<Dense> root(M);
  const Dense G = root.matrixL().solve(Dense(E0R.transpose())), H = root.matrixL().solve(Dense(E1R.transpose()));
  const Dense e0 = Dense(E0 - G.transpose() * G)(I, I), e1 = Dense(E1 - H.transpose() * G)(I, I),
              e2 = Dense(E2 - H.transpose() * H)(I, I);
  Real h = 2;
  for (Eigen::Index i = 0; i < m; ++i) h = std::max(h, e2(i, i) / e0(i, i));
  const Real g = std::sqrt(std::sqrt(h)), even = g / 2, other = 1 / (2 * g);
  const Dense odd = (e1 + e1.transpose()) / 2;
  Dense K11 = even * e0 + other * e2 - odd, K22 = even * e0 + other * e2 + odd,
        K12 = other * e2 - even * e0 + (e1 - e1.transpose()) / 2;
  for (int k = 0; k < 60; ++k) {
    const Column scale = K22.diagonal().cwiseSqrt().cwiseInverse();
    const bool last = (scale.asDiagonal() * K12 * scale.asDiagonal()).cwiseAbs().maxCoeff() < 1e-10L;
    const Dense B = K11 + K22;
    const Eigen::LLT<Dense> L(B);
    const Dense X = L.matrixL().solve(K12), Y = L.matrixL().solve(Dense(K12.transpose()));
    K22 -= X.transpose() * X, K11 -= Y.transpose() * Y, K12 = -Y.transpose() * X;
    if (last) break;
  }
  const Dense R_I = R(I, Eigen::all), K_I = (K22 + K22.transpose()) / 2, K_IJ = -(K_I * R_I);
  Dense K(n, n);
  const std::vector<Eigen::Index> J{node, node + 1};
  K(I, I) = K_I, K(I, J) = K_IJ, K(J, I) = K_IJ.transpose(), K(J, J) = -(R_I.transpose() * K_IJ);
  return K;
}

Dense stiffness(const element::Ring& ring, const element::Elasticity& D, double thickness) {
  return stiffness(coefficients(ring, D, thickness));
}

}  // namespace scabo::test::oracle
