// Time of super-elements on one thread, side by side with the textbook route by eigenvectors of the 2n matrix (LAPACK's
// dgeev), in turn, medians of processor time:
//
//     super_elements [--largest N] [--repeat N] [--textbook N] [--table batch|large|recover]
//
// Three tables: many small ones (batch), one of n = 40 to 5000 degrees of freedom (large), and one recovered inside
// (recover).
#include <lapacke.h>
#include <sys/resource.h>
#include <time.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstring>
#include <functional>
#include <numeric>
#include <random>
#include <theory/rings.hpp>

#include "scabo/element/plane/batch.hpp"
#include "scabo/element/plane/batch_kernel.hpp"
#include "scabo/element/plane/interior_field.hpp"
#include "scabo/linalg/cholesky_factor.hpp"
#include "scabo/linalg/dense.hpp"

namespace {

using namespace scabo;
using namespace scabo::element;
using namespace scabo::test;

const Mat3 concrete = elasticity(10e9, 0.3);

/// The textbook route (tests/theory/textbook_route.hpp) by LAPACK.
Matrix eigenvector_route(const Ring& ring, const Mat3& D) {
  const CoefficientMatrices matrices = coefficient_matrices(ring, D, 1.0);
  const Eigen::Index n = matrices.E0.rows();
  const double unit = D.cwiseAbs().maxCoeff();
  const Matrix E0 = matrices.E0 / unit, E1 = matrices.E1 / unit, E2 = matrices.E2 / unit;
  linalg::CholeskyFactor L;
  L.A = E0;
  ensure(L.factorise(), "E0");
  Matrix inverse = Matrix::Identity(n, n);
  L.divide(inverse);
  L.divide(inverse, true);
  Matrix Z(2 * n, 2 * n);
  const Matrix E1_inverse = linalg::multiply(E1, inverse);
  Z << -E1_inverse.transpose(), inverse, E2 - linalg::multiply(E1_inverse, E1.transpose()), E1_inverse;
  const auto size = static_cast<lapack_int>(2 * n);
  Vector real(2 * n), imaginary(2 * n);
  Matrix vectors(2 * n, 2 * n);
  ensure(LAPACKE_dgeev(LAPACK_COL_MAJOR, 'N', 'V', size, Z.data(), size, real.data(), imaginary.data(), nullptr, 1,
                       vectors.data(), size) == 0,
         "dgeev");
  std::vector<Eigen::Index> order(static_cast<std::size_t>(2 * n));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return real[a] > real[b]; });
  // Real and imaginary parts of the vectors span the same space: the inverse stays real. n - 2 of them and the
  // translations.
  Matrix u(n, n), q = Matrix::Zero(n, n);
  for (Eigen::Index k = 0; k < n - 2; ++k) {
    u.col(k) = vectors.col(order[static_cast<std::size_t>(k)]).head(n);
    q.col(k) = vectors.col(order[static_cast<std::size_t>(k)]).tail(n);
  }
  u.rightCols(2).setZero();
  for (Eigen::Index i = 0; i < n; ++i) u(i, n - 2 + i % 2) = 1.0;
  Matrix u_transposed = u.transpose(), K = q.transpose();  // K' = u'^-1 q'
  std::vector<lapack_int> pivots(static_cast<std::size_t>(n));
  const auto m = static_cast<lapack_int>(n);
  ensure(LAPACKE_dgesv(LAPACK_COL_MAJOR, m, m, u_transposed.data(), m, pivots.data(), K.data(), m) == 0, "dgesv");
  return unit * K.transpose();
}

double riccati_residual(const Ring& ring, const Mat3& D, const Matrix& K) {
  const CoefficientMatrices matrices = coefficient_matrices(ring, D, 1.0);
  linalg::CholeskyFactor L;
  L.A = matrices.E0;
  ensure(L.factorise(), "E0");
  Matrix X = K - Matrix(matrices.E1), P = matrices.E2;
  L.divide(X);
  linalg::subtract_square(X, P);
  return Matrix(P.selfadjointView<Eigen::Lower>()).norm() / matrices.E2.norm();
}

/// Processor time of this thread, which does all the work: other programs on the machine do not count.
double now() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double seconds(const std::function<void()>& task) {
  const double begin = now();
  task();
  return now() - begin;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Median seconds of each task; the tasks in turn, after one run of each that does not count (where `warm`).
std::vector<double> medians(const std::vector<std::function<void()>>& tasks, int repeat, bool warm = true) {
  std::vector<std::vector<double>> times(tasks.size());
  for (int k = warm ? -1 : 0; k < repeat; ++k)
    for (std::size_t t = 0; t < tasks.size(); ++t) {
      const double time = seconds(tasks[t]);
      if (k >= 0) times[t].push_back(time);
    }
  std::vector<double> result;
  for (const auto& of_task : times) result.push_back(median(of_task));
  return result;
}

/// A quadrilateral without symmetry, about as slender as the rectangle of 6 x 1.5 m.
Ring crooked_ring(int n) {
  return polygon_ring({{-3.0, -0.75}, {3.1, -0.8}, {2.8, 0.85}, {-2.9, 0.7}}, {n / 10, n / 40, n / 10, n / 40}, 2);
}

/// Polygons without symmetry.
std::vector<BatchItem> polygons(int count, int edges) {
  std::mt19937 random(1);
  std::vector<BatchItem> items;
  for (int k = 0; k < count; ++k) {
    std::vector<Vec2> vertices;
    for (int i = 0; i < edges; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + uniform(random, -0.2, 0.2)) / edges;
      vertices.emplace_back(uniform(random, 0.8, 1.0) * Vec2(std::cos(angle), std::sin(angle)));
    }
    items.push_back({polygon_ring(vertices, 1, 1), concrete, 1.0});
  }
  return items;
}

void batch_table(int repeat) {
  std::printf(
      "Many small ones, polygons of two-node edges: microseconds each\n\n"
      "| n | eigenvectors | one at a time | batch | eigenvectors / batch | error: eigenvectors, batch "
      "|\n|---|---|---|---|---|---|\n");
  for (int n : {8, 12, 16, 24, 32, 48, 64}) {
    const int many = std::max(256, 65536 / (n * n)), few = 64;
    const std::vector<BatchItem> items = polygons(many, n / 2);
    const auto t = medians({[&] {
                              for (int i = 0; i < few; ++i) eigenvector_route(items[i].ring, concrete);
                            },
                            [&] {
                              for (int i = 0; i < few; ++i) solve_super_element(items[i].ring, concrete, 1.0);
                            },
                            [&] { solve_batch(items); }},
                           repeat);
    const Matrix K = solve_super_element(items[0].ring, concrete, 1.0).K;
    const BatchSolution batch = solve_batch(items);
    double eigen = 0.0, lanes = 0.0;
    for (int i = 0; i < few; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Matrix exact = solve_super_element(items[at].ring, concrete, 1.0).K;
      eigen = std::max(eigen, largest(eigenvector_route(items[at].ring, concrete) - exact) / largest(exact));
      lanes = std::max(lanes, largest(batch.K[at] - exact) / largest(exact));
    }
    std::printf("| %d | %.1f | %.1f | %.2f | %.0f | %.0e, %.0e |\n", n, t[0] / few * 1e6, t[1] / few * 1e6,
                t[2] / many * 1e6, t[0] / few / (t[2] / many), eigen, lanes);
    std::fflush(stdout);
  }
  std::printf("\n%s, %d lanes\n\n", batch_kernel(0)->instructions, batch_kernel(0)->lanes);
}

void large_table(const char* name, Ring (*make)(int), int most, int textbook, int repeat) {
  std::printf(
      "%s, quadratic edges: milliseconds\n\n"
      "| n | blocks | eigenvectors | stiffness | stiffness and modes | eigenvectors / stiffness | / with modes | "
      "residual: "
      "eigenvectors, doubling |\n|---|---|---|---|---|---|---|---|\n",
      name);
  for (int n : {40, 80, 160, 320, 640, 1280, 2560, 5000}) {
    if (n > most) break;
    const Ring ring = make(n);
    SuperElementSolution solution;
    ModalSolution modes;
    Matrix K;
    std::vector<std::function<void()>> tasks = {
        [&] { solution = solve_super_element(ring, concrete, 1.0); },
        [&] { modes = modal_solution(solve_super_element(ring, concrete, 1.0)); }};
    if (n <= textbook) tasks.push_back([&] { K = eigenvector_route(ring, concrete); });
    const auto t = medians(tasks, n > 1000 ? 1 : n >= 640 ? std::min(repeat, 5) : repeat, n < 1000);
    const double residual = riccati_residual(ring, concrete, solution.K);
    std::printf("| %ld | %zu | ", static_cast<long>(solution.K.rows()), solution.blocks.size());
    if (K.size() > 0)
      std::printf("%.2f | %.3f | %.3f | %.1f | %.1f | %.0e, %.0e |\n", t[2] * 1e3, t[0] * 1e3, t[1] * 1e3, t[2] / t[0],
                  t[2] / t[1], riccati_residual(ring, concrete, K), residual);
    else
      std::printf("| %.3f | %.3f | | | , %.0e |\n", t[0] * 1e3, t[1] * 1e3, residual);
    std::fflush(stdout);
  }
  std::printf("\n");
}

/// Solved, taken apart into modes, and one point inside asked for: a linear field, known everywhere.
void recover_table(int most) {
  std::printf(
      "Recovered inside, without symmetry\n\n"
      "| n | stiffness, s | modes, s | a point, ms | error of K u | error of stress | peak memory, MB "
      "|\n|---|---|---|---|---|---|---|\n");
  for (int n : {640, 1280, 2560, 5000}) {
    if (n > most) break;
    const Ring ring = crooked_ring(n);
    SuperElementSolution solution;
    ModalSolution modes;
    const double solve = seconds([&] { solution = solve_super_element(ring, concrete, 1.0); });
    const double modal = seconds([&] { modes = modal_solution(solution); });
    Mat2 gradient;
    gradient << 1e-3, 2e-4, -3e-4, -5e-4;
    const Vec3 stress = concrete * Vec3(gradient(0, 0), gradient(1, 1), gradient(0, 1) + gradient(1, 0));
    const Vector u = at_nodes(ring.nodes, [&](const Vec2& x) { return Vec2(gradient * x); });
    const RadialField field(solution, modes, u, {});
    PointValues values;
    const double point = seconds([&] { values = point_values(ring, field.at(0.4), concrete, 7, 0.3); });
    const CoefficientMatrices matrices = coefficient_matrices(ring, concrete, 1.0);
    const Vector q = matrices.E0 * u + matrices.E1.transpose() * u;  // xi u,xi = u for a linear field
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf("| %ld | %.2f | %.2f | %.1f | %.0e | %.0e | %.0f |\n", static_cast<long>(solution.K.rows()), solve,
                modal, point * 1e3, largest(solution.K * u - q) / largest(q),
                largest(values.stress - stress) / largest(stress), static_cast<double>(usage.ru_maxrss) / 1024.0);
    std::fflush(stdout);
  }
  std::printf("\n");
}

}  // namespace

int main(int count, char** arguments) {
  int most = 5000, repeat = 9, textbook = 640;
  std::string table;
  for (int i = 1; i + 1 < count; i += 2) {
    const std::string key = arguments[i];
    if (key == "--largest")
      most = std::atoi(arguments[i + 1]);
    else if (key == "--repeat")
      repeat = std::atoi(arguments[i + 1]);
    else if (key == "--textbook")
      textbook = std::atoi(arguments[i + 1]);
    else if (key == "--table")
      table = arguments[i + 1];
    else
      return std::fprintf(stderr, "super_elements: no option '%s'\n", key.c_str()), 1;
  }
  linalg::set_blas_threads(1);
  if (table.empty() || table == "batch") batch_table(repeat);
  if (table.empty() || table == "large") {
    large_table("Without symmetry", crooked_ring, most, textbook, repeat);
    large_table(
        "Rectangle 6 x 1.5 m", [](int n) { return rectangle_ring(6.0, 1.5, n / 10, n / 40, 2); }, most, textbook,
        repeat);
  }
  if (table.empty() || table == "recover") recover_table(most);
}
