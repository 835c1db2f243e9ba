// Time and memory of dividing a plate with a hole, of the stiffness of all its cells, and of reading a mesh file:
//
//     meshes polygons|quadtree|distinct [cells = 1e6] [order = 1] [threads = 2]
//     meshes read FILE
//
// Where sizes are equal, polygons inside are equal, and are solved once like those of a quadtree. `distinct`: polygons
// whose nodes are moved by up to a hundredth of their size, so that every one is another one; their stiffness also in a
// batch (element/plane/batch.hpp), which gives K alone.
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <random>
#include <set>
#include <string>

#include "scabo/element/cell_library.hpp"
#include "scabo/element/plane/batch.hpp"
#include "scabo/files/read_mesh_file.hpp"
#include "scabo/linalg/dense.hpp"
#include "scabo/mesh/plane/many_cells.hpp"

namespace {

using namespace scabo;

/// 2 x 1, with a round hole of radius 0.2 in the middle.
model::Model plate(model::MeshKind kind, double cells, int order) {
  model::Model model;
  model.materials.resize(1);
  model.materials[0].young = 30e9;
  model.materials[0].poisson = 0.2;
  model::Body& body = model.bodies.emplace_back();
  body.name = "plate";
  body.material = 0;
  const auto add = [&](const Vec2& from, const Vec2& to, const std::optional<model::Arc>& arc) {
    model::Edge edge;
    edge.names = {"edge"};
    edge.start = from;
    edge.end = to;
    edge.arc = arc;
    body.outline.edges.push_back(edge);
    body.outline.corners.push_back({{"corner"}, from});
  };
  const Vec2 corners[4] = {{0, 0}, {2, 0}, {2, 1}, {0, 1}}, centre(1.0, 0.5);
  for (int i = 0; i < 4; ++i) add(corners[i], corners[(i + 1) % 4], {});
  body.outline.holes = {4};
  constexpr double radius = 0.2, pi = std::numbers::pi;
  const Vec2 right = centre + Vec2(radius, 0.0), left = centre - Vec2(radius, 0.0);
  add(right, left, model::Arc{centre, radius, 0.0, -pi});
  add(left, right, model::Arc{centre, radius, -pi, -pi});
  body.mesh.kind = kind;
  body.mesh.order = order;
  body.mesh.size = std::sqrt((2.0 - pi * radius * radius) / cells);
  return model;
}

/// Wall and processor time since it was made, seconds.
class Clock {
 public:
  double wall() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }
  double processor() const { return static_cast<double>(std::clock() - processor_) / CLOCKS_PER_SEC; }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::clock_t processor_ = std::clock();
};

void print(const char* what, const Clock& clock) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("%-28s %7.2f s, %7.2f s of processor time; peak memory so far %.2f GB\n", what, clock.wall(),
              clock.processor(), static_cast<double>(usage.ru_maxrss) / 1048576.0);
}

int divide(const std::string& kind, double cells, int order, int threads) {
  const model::Model model =
      plate(kind == "quadtree" ? model::MeshKind::quadtree : model::MeshKind::polygons, cells, order);
  const Clock dividing;
  auto divided = mesh::divide_into_cells(model.bodies[0], {}, 1e9);
  print("division", dividing);
  if (const auto* wrong = std::get_if<Diagnostic>(&divided)) {
    std::fprintf(stderr, "%s\n", wrong->message.c_str());
    return 1;
  }
  mesh::Mesh mesh;
  mesh.bodies.push_back(std::get<mesh::BodyMesh>(std::move(divided)));
  if (kind == "distinct") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> move(-0.01 * model.bodies[0].mesh.size, 0.01 * model.bodies[0].mesh.size);
    for (Vec2& node : mesh.bodies[0].nodes) node += Vec2(move(random), move(random));
  }
  linalg::set_blas_threads(1);
  const Clock solving;
  const std::vector<element::SolvedCells> solved = element::solve_cells(model, mesh, threads);
  print("stiffness of all cells", solving);
  const std::set<const element::SolvedSuperElement*> distinct = [&] {
    std::set<const element::SolvedSuperElement*> set;
    for (const auto& cell : solved[0]) set.insert(cell.get());
    return set;
  }();
  if (kind == "distinct") {
    std::vector<element::BatchItem> items;
    for (const auto& cell : solved[0]) items.push_back({cell->ring, cell->sectors.D, cell->thickness});
    const Clock batch;
    const element::BatchSolution K = element::solve_batch(items, {.threads = threads});
    print("stiffness in a batch", batch);
    std::printf("%zu do not fit into a batch\n", K.alone.size());
  }
  std::printf("%zu cells, %zu distinct, %zu nodes\n", mesh.bodies[0].cells.size(), distinct.size(),
              mesh.bodies[0].nodes.size());
  return 0;
}

}  // namespace

int main(int count, char** words) {
  const std::string what = count > 1 ? words[1] : "";
  if (what == "read" && count > 2) {
    const Clock reading;
    const files::ImportedMesh mesh = files::read_mesh_file(words[2]);
    print("reading", reading);
    std::printf("%zu cells, %zu nodes\n", mesh.cells.size(), mesh.nodes.size());
    return 0;
  }
  if (what == "polygons" || what == "quadtree" || what == "distinct")
    return divide(what, count > 2 ? std::atof(words[2]) : 1e6, count > 3 ? std::atoi(words[3]) : 1,
                  count > 4 ? std::atoi(words[4]) : 2);
  std::fprintf(stderr, "meshes polygons|quadtree|distinct [cells] [order] [threads], or meshes read FILE\n");
  return 1;
}
