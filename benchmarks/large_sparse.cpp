// Time and memory of a large sparse factorisation and of the flexibility of contact degrees of freedom:
//
//     large_sparse [degrees of freedom = 100000] [threads = 1] [cholmod | mumps] [automatic | amd | metis | position]
//     [grid | polygons | quadtree]
//
// grid: a square of n x n eight-node elements in plane strain, held statically determinate; 32, 300, 1,000 and 3,000 of
// its boundary nodes, consecutive from the middle of the upper side, are contact pairs against something rigid. X is
// the processor time of factorisation, condensation and one solve over that of factorisation and one solve.
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <vector>

#include "scabo/element/cell_library.hpp"
#include "scabo/element/plane/elasticity.hpp"
#include "scabo/element/plane/finite_element.hpp"
#include "scabo/linalg/dense.hpp"
#include "scabo/linalg/symmetric_positive_solver.hpp"
#include "scabo/mesh/plane/many_cells.hpp"
#include "scabo/system/assembly.hpp"

using namespace scabo;

namespace {

/// Nodes of a grid of n x n eight-node elements: grid points (i, j) of half the spacing, except the middles of
/// elements.
class Grid {
 public:
  explicit Grid(int n) : n_(n), number_(static_cast<std::size_t>(side() * side()), -1) {
    for (int j = 0; j < side(); ++j)
      for (int i = 0; i < side(); ++i)
        if (i % 2 == 0 || j % 2 == 0) number_[static_cast<std::size_t>(i + j * side())] = nodes_++;
  }
  int side() const { return 2 * n_ + 1; }
  int nodes() const { return nodes_; }
  int node(int i, int j) const { return number_[static_cast<std::size_t>(i + j * side())]; }

  /// Boundary nodes, clockwise from the middle of the upper side.
  std::vector<int> boundary() const {
    std::vector<int> around;
    const int m = side() - 1;
    for (int i = m / 2; i < m; ++i) around.push_back(node(i, m));
    for (int j = m; j > 0; --j) around.push_back(node(m, j));
    for (int i = m; i > 0; --i) around.push_back(node(i, 0));
    for (int j = 0; j < m; ++j) around.push_back(node(0, j));
    for (int i = 0; i < m / 2; ++i) around.push_back(node(i, m));
    return around;
  }

  linalg::SparseMatrix stiffness() const {
    element::FiniteElement square;
    square.x = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1), Vec2(0.5, 0), Vec2(1, 0.5), Vec2(0.5, 1), Vec2(0, 0.5)};
    model::Material material;
    material.young = 30e9;
    material.poisson = 0.2;
    const element::ElementMatrix K =
        element::finite_element_stiffness(square, element::elasticity_matrix(material, model::Plane::strain), 1.0);
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_) * 256);
    for (int j = 0; j < 2 * n_; j += 2)
      for (int i = 0; i < 2 * n_; i += 2) {
        const int of[8] = {node(i, j),     node(i + 2, j),     node(i + 2, j + 2), node(i, j + 2),
                           node(i + 1, j), node(i + 2, j + 1), node(i + 1, j + 2), node(i, j + 1)};
        for (int b = 0; b < 16; ++b)
          for (int a = 0; a < 16; ++a)
            if (const int row = place(2 * of[a / 2] + a % 2), column = place(2 * of[b / 2] + b % 2);
                row >= 0 && column >= 0)
              entries.emplace_back(row, column, K(a, b));
      }
    linalg::SparseMatrix A(2 * nodes_ - 3, 2 * nodes_ - 3);
    A.setFromTriplets(entries.begin(), entries.end());
    return A;
  }
  std::vector<Vec2> positions() const {
    std::vector<Vec2> of_unknowns;
    for (int j = 0; j < side(); ++j)
      for (int i = 0; i < side(); ++i)
        for (int k = 0; k < 2 && node(i, j) >= 0; ++k)
          if (place(2 * node(i, j) + k) >= 0) of_unknowns.emplace_back(i, j);
    return of_unknowns;
  }
  /// Three components are held: both of the first node of the lower side, the vertical one of its last node.
  int place(int dof) const {
    const int last = 2 * node(side() - 1, 0) + 1;
    return dof < 2 || dof == last ? -1 : dof - 2 - (dof > last ? 1 : 0);
  }

 private:
  int n_, nodes_ = 0;
  std::vector<int> number_;
};

/// Processor seconds of the process, all threads together: other work on the machine does not count.
template <typename Function>
auto processor_time(double& seconds, Function function) {
  const std::clock_t begin = std::clock();
  auto result = function();
  seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  return result;
}

/// The same square divided into polygons or by a quadtree, held by its first two nodes.
struct Divided {
  linalg::SparseMatrix stiffness;
  std::vector<int> boundary;    // its nodes, in order, beginning with the upper side
  std::vector<Vec2> positions;  // of the unknowns
};
Divided divided(model::MeshKind kind, double dofs) {
  model::Model model;
  model.materials.resize(1);
  model.materials[0].young = 30e9;
  model.materials[0].poisson = 0.2;
  model::Body& body = model.bodies.emplace_back();
  body.name = "square";
  body.material = 0;
  const Vec2 corners[4] = {{1, 1}, {0, 1}, {0, 0}, {1, 0}};
  for (int i = 0; i < 4; ++i) {
    model::Edge edge;
    edge.names = {"edge"};
    edge.start = corners[i];
    edge.end = corners[(i + 1) % 4];
    body.outline.edges.push_back(edge);
    body.outline.corners.push_back({{"corner"}, corners[i]});
  }
  body.mesh.kind = kind;
  body.mesh.order = 1;
  body.mesh.size = std::sqrt((kind == model::MeshKind::polygons ? 4.0 : 2.0) / dofs);
  mesh::Mesh mesh;
  mesh.bodies.push_back(std::get<mesh::BodyMesh>(mesh::divide_into_cells(body, {}, 1e9)));
  const auto cells = element::solve_cells(model, mesh, 1);
  const system::Stiffness K = system::body_stiffness(model, mesh.bodies[0], cells[0]);
  const auto size = static_cast<int>(K.sparse.rows()) - 4;  // two nodes are held
  Divided result;
  result.stiffness = K.sparse.bottomRightCorner(size, size);
  result.stiffness.makeCompressed();
  for (const auto& edge : mesh.bodies[0].edges)
    for (const mesh::LineElement& element : edge) result.boundary.push_back(element.nodes.front());
  for (int dof = 4; dof < 4 + size; ++dof)
    result.positions.push_back(mesh.bodies[0].nodes[static_cast<std::size_t>(dof / 2)]);
  return result;
}

double peak_gigabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1048576.0;
}

}  // namespace

int main(int count, char** words) {
  const double wanted = count > 1 ? std::atof(words[1]) : 1e5;
  linalg::set_blas_threads(count > 2 ? std::atoi(words[2]) : 1);
  const auto is_word = [&](int at, const char* word) { return count > at && std::strcmp(words[at], word) == 0; };
  linalg::SparseOptions options;
  if (is_word(3, "mumps")) options.library = linalg::SparseLibrary::mumps;
  if (is_word(4, "amd")) options.ordering = linalg::Ordering::minimum_degree;
  if (is_word(4, "metis")) options.ordering = linalg::Ordering::nested_dissection;
  const bool by_position = is_word(4, "position");
  if (by_position) options.ordering = linalg::Ordering::dissection_by_position;
  const Grid grid(static_cast<int>(std::lround(std::sqrt(wanted / 6.0))));
  const bool is_grid = !is_word(5, "polygons") && !is_word(5, "quadtree");
  Divided square;
  if (is_grid)
    square = {grid.stiffness(), grid.boundary(), grid.positions()};
  else
    square = divided(is_word(5, "polygons") ? model::MeshKind::polygons : model::MeshKind::quadtree, wanted);
  const linalg::SparseMatrix& A = square.stiffness;
  if (by_position || options.ordering == linalg::Ordering::automatic) options.positions = square.positions;
  const auto place = [&](int dof) { return is_grid ? grid.place(dof) : dof - 4; };
  const double memory_before = peak_gigabytes();

  double factorise = 0.0, solve = 0.0;
  const auto solver = processor_time(factorise, [&] { return linalg::SymmetricPositiveSolver(A, options); });
  const Vector f = Vector::Ones(A.rows());
  const Vector u = processor_time(solve, [&] { return Vector(solver.solve(f)); });
  const linalg::FactorisationCosts& costs = solver.costs();
  std::printf("%ld degrees of freedom: order %.3f s, analyse %.3f s, factorise %.3f s, together %.3f s; solve %.4f s\n",
              static_cast<long>(A.rows()), costs.order, costs.analyse, costs.factorise, factorise, solve);
  std::printf("%.3g entries of L, %.3g operations, residual %.1e; peak memory %.2f GB (matrix %.2f)\n", costs.entries,
              costs.operations, (A * u - f).norm() / f.norm(), peak_gigabytes(), memory_before);

  for (const std::size_t pairs : {32u, 300u, 1000u, 3000u}) {
    if (pairs > square.boundary.size()) break;
    std::vector<int> dofs;
    for (std::size_t i = 0; i < pairs; ++i)
      for (int k = 0; k < 2; ++k)
        if (const int at = place(2 * square.boundary[i] + k); at >= 0) dofs.push_back(at);
    double condense = 0.0;
    const Matrix W = processor_time(condense, [&] { return solver.inverse_block(dofs); });
    const double T1 = factorise + solve;
    std::printf("%5zu pairs: condensation %.3f s, %.3f T1, X = %.3f, peak memory %.2f GB, trace %.12e\n", pairs,
                condense, condense / T1, (factorise + condense + solve) / T1, peak_gigabytes(), W.trace());
    std::fflush(stdout);
  }
}
