#include "scabo/files/gmsh_library.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "scabo/base/error.hpp"
#include "scabo/files/gmsh.hpp"
#include "scabo/files/text_cursor.hpp"

#ifdef SCABO_GMSH
#include "scabo/files/gmsh_session.hpp"
#endif

namespace scabo::files {

#ifdef SCABO_GMSH

namespace {

/// The faces of one file.
class GmshFaces {
 public:
  explicit GmshFaces(const std::string& path) : session_(path, "M"), gmsh_(gmsh_library()), path_(path) {}

  void read() {
    session_.merge(path_);
    if (!session_.entities(3).empty())
      fail_in_file(path_, 0, 0, "the file has a solid; Scabo needs plane faces in x and y: export a face of it");
    surfaces_ = session_.entities(2);
    if (surfaces_.empty())
      fail_in_file(path_, 0, 0, "the file has no surface, which a body is made of; add one (.geo: Plane Surface)");
    check_plane();
  }

  std::string mesh(const CadOptions& options) {
    check_count(options);
    session_.generate(2, options.size, options.size, options.order);
    return session_.written(groups_of_surfaces() == 0);
  }

 private:
  std::size_t groups_of_surfaces() {
    int* values = nullptr;
    std::size_t count = 0;
    int error = 0;
    gmsh_.get_groups(&values, &count, 2, &error);
    return session_.taken(values, count).size();
  }

  void check_plane() {
    for (const auto& [dimension, tag] : surfaces_) {
      std::array<double, 3> low{}, high{};
      int error = 0;
      gmsh_.get_box(dimension, tag, &low[0], &low[1], &low[2], &high[0], &high[1], &high[2], &error);
      if (error != 0) continue;
      const double size = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
      const double allowed = 1e-6 * size + 2e-7;  // OpenCASCADE widens boxes by 1e-7
      if (low[2] < -allowed || high[2] > allowed)
        fail_in_file(
            path_, 0, 0,
            fmt::format("surface {} is not in the plane z = 0: it lies between z = {:.4g} and z = {:.4g}; move "
                        "it there",
                        tag, low[2], high[2]));
    }
  }

  /// Points along a curve, in its direction.
  std::vector<Vec2> points_of(int curve) {
    constexpr int steps = 32;
    double *least = nullptr, *most = nullptr, *values = nullptr;
    std::size_t least_count = 0, most_count = 0, count = 0;
    int error = 0;
    std::vector<Vec2> points;
    gmsh_.get_bounds(1, curve, &least, &least_count, &most, &most_count, &error);
    if (error == 0 && least_count == 1 && most_count == 1) {
      std::array<double, steps + 1> at{};
      for (int i = 0; i <= steps; ++i) at[static_cast<std::size_t>(i)] = *least + (*most - *least) * i / steps;
      gmsh_.get_value(1, curve, at.data(), at.size(), &values, &count, &error);
      for (std::size_t i = 0; error == 0 && i + 2 < count; i += 3) points.emplace_back(values[i], values[i + 1]);
    }
    for (double* each : {least, most, values}) gmsh_.free(each);
    return points;
  }

  /// Equilateral triangles of the size have 1.15 nodes on an area of its square.
  void check_count(const CadOptions& options) {
    if (options.size <= 0.0) return;
    double nodes = 0.0;
    for (const auto& [dimension, tag] : surfaces_) {
      std::array<int, 2> surface{dimension, tag};
      int* values = nullptr;
      std::size_t count = 0;
      int error = 0;
      gmsh_.get_boundary(surface.data(), surface.size(), &values, &count, 0, 1, 0, &error);
      double area = 0.0, length = 0.0;
      for (const auto& [curve_dimension, curve] : session_.taken(values, count)) {
        const std::vector<Vec2> points = points_of(std::abs(curve));
        double swept = 0.0;
        for (std::size_t i = 1; i < points.size(); ++i) {
          const Vec2 &a = points[i - 1], &b = points[i];
          swept += 0.5 * (a.x() * b.y() - a.y() * b.x());
          length += (b - a).norm();
        }
        area += curve < 0 ? -swept : swept;
      }
      const double sizes = options.size * options.size;
      nodes += (1.15 * std::abs(area) / sizes + 0.5 * length / options.size) * options.order * options.order;
    }
    if (!(nodes <= most_cad_nodes))
      fail_in_file(
          path_, 0, 0,
          fmt::format("with 'size' {:g} the mesh would have about {:.2g} nodes, more than the {:.7g} allowed: use a "
                      "larger 'size'",
                      options.size, nodes, most_cad_nodes));
  }

  GmshSession session_;
  const GmshLibrary& gmsh_;
  std::string path_;
  GmshSession::DimTags surfaces_;
};

}  // namespace

bool reads_cad() { return true; }

ImportedMesh mesh_by_gmsh(const std::string& path, const CadOptions& options) {
  std::string bytes;
  try {
    GmshFaces faces(path);
    faces.read();
    bytes = faces.mesh(options);
  } catch (const GmshLoadError& error) {
    fail_in_file(path, 0, 0, fmt::format("Gmsh's library, which reads CAD files, cannot be loaded: {}", error.what()));
  }
  return parse_gmsh(bytes, path);
}

#else

bool reads_cad() { return false; }

ImportedMesh mesh_by_gmsh(const std::string& path, const CadOptions&) {
  fail_in_file(
      path, 0, 0,
      fmt::format("this program was built without Gmsh's library, which reads .geo and .step: install libgmsh-dev "
                  "and build again, or write a .msh with gmsh -2 {}",
                  std::filesystem::path(path).filename().string()));
}

#endif

}  // namespace scabo::files
