// Towers of rigid blocks as contact problems, and the law asked pair by pair of what solvers find.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

/// `points`: pairs along an edge of a face.
struct TowerCase {
  int dimension, blocks, points;
};

/// Unit cubes on one another and on the ground (edge 1, mass 1, inertia 1/6), m x m pairs on each face (m in the
/// plane). The masses grow from the lowest, 1, to the highest, `ratio`. Free velocities at random plus the fall of one
/// step: q = H' v lies in the range of H'. `known`: W tells its bodies.
inline Problem tower_of_blocks(int d, int blocks, int m, double mu, double ratio = 1.0, bool known = false) {
  const int motions = d == 3 ? 6 : 3, across = d == 3 ? m : 1, N = blocks * m * across;
  std::vector<Eigen::Triplet<double>> entries;
  int pair = 0;
  for (int face = 0; face < blocks; ++face)
    for (int k = 0; k < m * across; ++k, ++pair)
      for (const int body : {face, face - 1}) {  // B above, A below
        if (body < 0) continue;
        const double sign = body == face ? 1.0 : -1.0;
        const double root = std::sqrt(std::pow(ratio, body / std::max(blocks - 1.0, 1.0)));  // of the mass
        const Eigen::Vector3d arm(-0.5 + (k % m) / (m - 1.0), d == 3 ? -0.5 + (k / m) / (m - 1.0) : 0.0, -0.5 * sign);
        const Eigen::Vector3d axes[] = {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)};
        for (int c = 0; c < d; ++c) {
          const Eigen::Vector3d moment = arm.cross(axes[c]);
          const auto put = [&](int row, double value) {
            entries.emplace_back(motions * body + row, d * pair + c, sign / root * value);
          };
          if (d == 3) {
            for (int row = 0; row < 3; ++row) put(row, axes[c][row]);
            for (int row = 0; row < 3; ++row) put(3 + row, std::sqrt(6.0) * moment[row]);
          } else {
            put(0, axes[c][0]);
            put(1, axes[c][2]);
            put(2, std::sqrt(6.0) * moment[1]);
          }
        }
      }
  Eigen::SparseMatrix<double> H(motions * blocks, d * N);  // M^(-1/2) H
  H.setFromTriplets(entries.begin(), entries.end());
  std::mt19937 random(7);
  Vector v(motions * blocks);
  for (double& component : v) component = 0.1 * (static_cast<double>(random()) / 4294967296.0 - 0.5);
  for (int body = 0; body < blocks; ++body) v[motions * body + (d == 3 ? 2 : 1)] -= 0.1;
  for (int body = 0; ratio != 1.0 && body < blocks; ++body)  // times the root of the mass
    v.segment(motions * body, motions) *= std::sqrt(std::pow(ratio, body / std::max(blocks - 1.0, 1.0)));
  Problem problem;
  problem.dimension = d;
  problem.W = Delassus(Eigen::SparseMatrix<double>(H.transpose() * H));
  if (known) problem.W = problem.W.with_bodies(H);
  problem.q = H.transpose() * v;
  problem.mu = Vector::Constant(N, mu);
  return problem;
}

/// Contact and friction of every pair, each figure against the largest force or |q|.
inline void expect_the_law(const Problem& problem, const Vector& p, double tolerance) {
  const int d = problem.dimension;
  const Vector u = problem.W * p + problem.q;
  const double force = p.lpNorm<Eigen::Infinity>(), motion = problem.q.lpNorm<Eigen::Infinity>();
  for (int i = 0; i < problem.pairs(); ++i) {
    const double p_n = p[d * i], u_n = u[d * i], mu = problem.mu[i];
    const auto p_t = p.segment(d * i + 1, d - 1), u_t = u.segment(d * i + 1, d - 1);
    ASSERT_GE(p_n, -tolerance * force) << i;
    ASSERT_GE(u_n, -tolerance * motion) << i;
    ASSERT_LE(p_t.norm(), mu * p_n + tolerance * force) << i;
    ASSERT_LE(std::abs(p_n * u_n), tolerance * force * motion) << i;
    // Slip dissipates all that friction can: p_t . u_t = -mu p_n |u_t|.
    ASSERT_NEAR(p_t.dot(u_t), -mu * p_n * u_t.norm(), tolerance * force * motion) << i;
  }
}

}  // namespace scabo::contact
