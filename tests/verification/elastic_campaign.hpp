// Random discrete problems of elastic type: W of real bodies, condensed to their pairs, and random motions and
// histories.
#pragma once

#include <random>

#include "scabo/contact/solve.hpp"
#include "scabo/element/cell_library.hpp"
#include "scabo/input/read_model.hpp"
#include "scabo/mesh/mesh.hpp"
#include "scabo/system/contact_system.hpp"

namespace scabo::verification {

/// W of the pairs of a model whose bodies are all held by supports; the mean of its diagonal is 1.
inline Matrix flexibility_of(const std::string& text) {
  const model::Model model = input::parse_model(text, "campaign.yaml", {});
  const mesh::Mesh mesh = mesh::make_mesh(model);
  const auto cells = element::solve_cells(model, mesh, 1);
  const Matrix W = system::condense(system::make_structure(model, mesh, cells), model, mesh).W.dense();
  return W / W.diagonal().mean();
}

/// Two bodies, one on the other, of given sizes and materials; the lower one held at its bottom or left, the upper at
/// its top or left.
inline std::string two_bodies(double width, double lower, double upper, double size, double young_ratio, double poisson,
                              bool beams) {
  const auto number = [](double x) { return std::to_string(x); };
  const std::string fixed_a = beams ? "a.left" : "a.bottom", fixed_b = beams ? "b.left" : "b.top";
  return "scabo: 1\nanalysis: {plane: strain}\nmaterials:\n  m: {young: 1.0, poisson: " + number(poisson) +
         "}\n  n: {young: " + number(young_ratio) +
         ", poisson: 0.3}\nbodies:\n  a: {material: m, shape: {rectangle: {corner: [0, 0], size: [" + number(width) +
         ", " + number(lower) + "]}}, mesh: {size: " + number(size) +
         "}}\n  b: {material: n, shape: {rectangle: {corner: [0, " + number(lower) + "], size: [" + number(width) +
         ", " + number(upper) + "]}}, mesh: {size: " + number(size) + "}}\nsupports:\n  - {on: " + fixed_a +
         ", fix: [x, y]}\n  - {on: " + fixed_b +
         ", fix: [x, y]}\nloads: {l: {on: a.top, force: [1, 0]}}\ncontacts:\n  c: {between: [a.top, b.bottom], "
         "friction: 0.5}\n";
}

inline std::vector<Matrix> real_flexibilities() {
  return {flexibility_of(two_bodies(6.0, 1.5, 1.5, 0.5, 1.0, 0.3, true)),
          flexibility_of(two_bodies(2.0, 1.0, 1.0, 0.25, 1.0, 0.2, false)),
          flexibility_of(two_bodies(2.0, 2.0, 0.5, 0.25, 100.0, 0.0, false)),
          flexibility_of(two_bodies(1.0, 1.0, 3.0, 0.2, 0.01, 0.49, false)),
          flexibility_of(two_bodies(8.0, 0.5, 1.0, 1.0, 3.0, 0.45, true)),
          flexibility_of(two_bodies(4.0, 1.0, 1.0, 0.2, 10.0, 0.4, false))};
}

/// One random path: W on some of the pairs, friction, and the motions without contact of each increment.
struct Path {
  contact::Problem problem;
  std::vector<Vector> motions;
};

inline Path random_path(std::mt19937& random, const std::vector<Matrix>& flexibilities, double least_mu,
                        double most_mu) {
  const auto real = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  const auto whole = [&](int from, int to) { return std::uniform_int_distribution<int>(from, to)(random); };
  const Matrix& W = flexibilities[static_cast<std::size_t>(whole(0, static_cast<int>(flexibilities.size()) - 1))];
  const int all = static_cast<int>(W.rows()) / 2, count = whole(1, all), first = whole(0, all - count);
  const int stride = whole(0, 3) == 0 ? 2 : 1;
  std::vector<int> rows;
  for (int i = first; i < first + count; i += stride) rows.insert(rows.end(), {2 * i, 2 * i + 1});
  const auto N = static_cast<Eigen::Index>(rows.size() / 2);
  Path path;
  path.problem.W = Matrix(W(rows, rows));
  path.problem.G.resize(2 * N, 0);
  path.problem.mu = Vector::Constant(N, real(least_mu, most_mu));
  if (whole(0, 3) == 0)
    for (double& mu : path.problem.mu) mu = real(least_mu, most_mu);
  if (whole(0, 9) == 0) path.problem.mu[whole(0, static_cast<int>(N) - 1)] = least_mu;
  // Motions of mixed signs: smooth, rough, or of forces on the bodies; gaps, ties and zeros among them.
  const double press = real(-1.5, 0.5), aside = real(-1.0, 1.0), wave = real(0.0, 3.0), noise = whole(0, 2) * 0.3;
  const int kind = whole(0, 2), increments = whole(1, 5);
  const Vector forces = Vector::NullaryExpr(2 * N, [&] { return real(-1.0, 1.0); });
  const Vector driven = path.problem.W * forces;
  Vector gap = Vector::Zero(N);
  if (whole(0, 2) == 0)
    for (double& g : gap) g = whole(0, 1) * real(0.0, 0.5);
  for (int k = 1; k <= increments; ++k) {
    Vector q(2 * N);
    const double turn = 0.7 * k, size = static_cast<double>(k) / increments;
    for (Eigen::Index i = 0; i < N; ++i) {
      const double s = N > 1 ? static_cast<double>(i) / static_cast<double>(N - 1) : 0.0;
      const double smooth_n = press + std::cos(wave * 3.0 * s),
                   smooth_t = aside * std::cos(turn) + 0.5 * std::sin(wave * 2.0 * s);
      q[2 * i] = gap[i] + size * (kind == 1 ? 2.0 * driven[2 * i] : smooth_n + noise * real(-1.0, 1.0));
      q[2 * i + 1] = size * (kind == 1 ? 2.0 * driven[2 * i + 1] * std::cos(turn) : smooth_t + noise * real(-1.0, 1.0));
      if (kind == 2) q[2 * i] = 0.5 * std::round(2.0 * q[2 * i]), q[2 * i + 1] = 0.5 * std::round(2.0 * q[2 * i + 1]);
      if (whole(0, 15) == 0) q[2 * i] = 0.0;
      if (whole(0, 15) == 0) q[2 * i + 1] = 0.0;
    }
    if (whole(0, 30) == 0) q.setZero();
    path.motions.push_back(std::move(q));
  }
  return path;
}

}  // namespace scabo::verification
