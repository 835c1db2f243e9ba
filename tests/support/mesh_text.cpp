#include "support/mesh_text.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>

namespace scabo::test {

std::string MeshText::vtu() const {
  std::string points, connectivity, offsets, types, regions;
  for (const Vec2& x : nodes) points += fmt::format("{:.17g} {:.17g} 0\n", x.x(), x.y());
  std::size_t count = 0;
  for (const Cell& cell : cells) {
    for (const int node : cell.nodes) connectivity += fmt::format("{} ", node);
    connectivity += '\n';
    offsets += fmt::format("{}\n", count += cell.nodes.size());
    types += fmt::format("{}\n", cell.type);
    regions += fmt::format("{}\n", cell.region);
  }
  const auto array = [](const char* type, const char* name, const std::string& values, const char* more = "") {
    return fmt::format("<DataArray type=\"{}\" Name=\"{}\"{} format=\"ascii\">\n{}</DataArray>\n", type, name, more,
                       values);
  };
  return fmt::format(
      "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n{}</Points>\n<Cells>\n{}{}{}</Cells>\n"
      "<CellData>\n{}</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
      nodes.size(), cells.size(), array("Float64", "Points", points, " NumberOfComponents=\"3\""),
      array("Int64", "connectivity", connectivity), array("Int64", "offsets", offsets), array("UInt8", "types", types),
      array("Int32", "region", regions));
}

namespace {

/// Files that are removed when the program ends.
struct TemporaryFiles {
  std::vector<std::filesystem::path> paths;
  ~TemporaryFiles() {
    std::error_code ignored;
    for (const auto& path : paths) std::filesystem::remove(path, ignored);
  }
};

}  // namespace

std::string MeshText::file() const {
  static TemporaryFiles files;
  static int number = 0;
  const auto path = std::filesystem::temp_directory_path() / fmt::format("scabo_mesh_{}_{}.vtu", ::getpid(), number++);
  std::ofstream(path) << vtu();
  files.paths.push_back(path);
  return path.string();
}

namespace {

bool is_quadratic(int type) { return type == 22 || type == 23 || type == 36; }

/// Adds the nodes in the middle of the sides of all cells, at `middle_of` the two ends.
void add_middle_nodes(MeshText& mesh, const std::function<Vec2(const Vec2&, const Vec2&)>& middle_of) {
  std::map<std::pair<int, int>, int> middles;
  for (MeshText::Cell& cell : mesh.cells) {
    const std::vector<int> corners = cell.nodes;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const int a = corners[i], b = corners[(i + 1) % corners.size()];
      const auto [found, is_new] = middles.emplace(std::minmax(a, b), static_cast<int>(mesh.nodes.size()));
      if (is_new)
        mesh.nodes.push_back(middle_of(mesh.nodes[static_cast<std::size_t>(found->first.first)],
                                       mesh.nodes[static_cast<std::size_t>(found->first.second)]));
      cell.nodes.push_back(found->second);
    }
  }
}

}  // namespace

MeshText mesh_of_rectangle(int type, double width, double height, int nx, int ny,
                           const std::function<int(int, int)>& region) {
  MeshText mesh;
  const Vec2 step(width / nx, height / ny);
  const auto inside = [&](int i, int j) { return i > 0 && j > 0 && i < nx && j < ny; };
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) {
      Vec2 x(i * step.x(), j * step.y());
      const bool border = region && i > 0 && i < nx && j > 0 && j < ny &&
                          (region(i - 1, j - 1) != region(i, j) || region(i, j - 1) != region(i - 1, j));
      if (inside(i, j) && !border)
        x += 0.2 * Vec2(step.x() * std::sin(5.0 * i + j), step.y() * std::cos(3.0 * j + 2.0 * i));
      mesh.nodes.push_back(x);
    }
  const auto node = [&](int i, int j) { return j * (nx + 1) + i; };
  const auto region_of = [&](int i, int j) { return region ? region(i, j) : 1; };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1), r = region_of(i, j);
      if (type == 5 || type == 22) {
        mesh.cells.push_back({type, {a, b, c}, r});
        mesh.cells.push_back({type, {a, c, d}, r});
      } else if (type == 7 || type == 36) {
        if (i % 2 == 0) mesh.cells.push_back({type, {a, b, node(i + 2, j), node(i + 2, j + 1), c, d}, r});
      } else {
        mesh.cells.push_back({type, {a, b, c, d}, r});
      }
    }
  if (is_quadratic(type)) {
    const auto on_border = [&](const Vec2& x) {
      const Vec2 far = Vec2(width, height) - x;
      return std::min({x.x(), x.y(), far.x(), far.y()}) < 1e-9;
    };
    add_middle_nodes(mesh, [&](const Vec2& a, const Vec2& b) {
      const Vec2 middle = 0.5 * (a + b), chord = b - a;
      const bool straight = on_border(middle) || region;
      return straight ? middle : Vec2(middle + 0.06 * Vec2(-chord.y(), chord.x()));
    });
  }
  return mesh;
}

MeshText mesh_of_disc_in_ring(int sides, bool quadratic) {
  MeshText mesh;
  const std::vector<double> radii{0.5, 1.0, 1.5, 2.0};
  for (const double radius : radii)
    for (int k = 0; k < sides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / sides;
      mesh.nodes.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
    }
  MeshText::Cell middle{quadratic ? 36 : 7, {}, 1};
  for (int k = 0; k < sides; ++k) middle.nodes.push_back(k);
  mesh.cells.push_back(middle);
  for (int ring = 0; ring + 1 < static_cast<int>(radii.size()); ++ring)
    for (int k = 0; k < sides; ++k) {
      const int next = (k + 1) % sides, in = ring * sides, out = in + sides;
      mesh.cells.push_back({quadratic ? 23 : 9, {in + k, out + k, out + next, in + next}, ring == 0 ? 1 : 2});
    }
  if (quadratic)
    add_middle_nodes(mesh, [](const Vec2& a, const Vec2& b) {
      const Vec2 middle = 0.5 * (a + b);
      return std::abs(a.norm() - b.norm()) < 1e-9 ? Vec2(a.norm() / middle.norm() * middle) : middle;
    });
  return mesh;
}

}  // namespace scabo::test
