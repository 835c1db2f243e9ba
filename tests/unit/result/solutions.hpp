// Solutions made by hand for the tests of result/: displacements are given, nothing is solved but
// super-elements.
#pragma once

#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/element/plane/stiffness.hpp"
#include "unit/mesh/models.hpp"

namespace scabo::test {

inline constexpr double young = 2.0e9, poisson = 0.3, density = 2500.0;

using Field = std::function<Vec2(const Vec2&)>;

/// Displacement with the uniform gradient `G`.
inline Field linear_field(const Mat2& G) {
  return [G](const Vec2& x) { return Vec2(G * x + Vec2(0.002, -0.001)); };
}

/// Stress [xx, yy, xy] of a uniform displacement gradient, by Hooke's law in three dimensions; and zz.
struct UniformStress {
  element::Vec3 in_plane;
  double zz;
};
inline UniformStress stress_of(const Mat2& G, model::Plane plane, double nu = poisson) {
  const double shear = young / (2.0 * (1.0 + nu)), lame = young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
  const double in_plane = G(0, 0) + G(1, 1);
  const double e_zz = plane == model::Plane::strain ? 0.0 : -nu / (1.0 - nu) * in_plane;
  const double volume = in_plane + e_zz;
  return {{lame * volume + 2.0 * shear * G(0, 0), lame * volume + 2.0 * shear * G(1, 1), shear * (G(0, 1) + G(1, 0))},
          lame * volume + 2.0 * shear * e_zz};
}

inline model::Model model_of(std::vector<model::Body> bodies, model::Plane plane, double nu = poisson) {
  model::Model model;
  model.file = "model.yaml";
  model.title = "Sample";
  model.analysis.plane = plane;
  model.analysis.thickness = 0.5;
  model.materials.resize(1);
  model.materials[0].name = "rock";
  model.materials[0].young = young;
  model.materials[0].poisson = nu;
  model.materials[0].density = density;
  model.bodies = std::move(bodies);
  model.steps.resize(1);
  model.steps[0].name = "press";
  model.steps[0].increments = 4;
  return model;
}

inline analysis::StaticSolution solution_of(model::Model model) {
  analysis::StaticSolution solution;
  solution.mesh = mesh::make_mesh(model);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const mesh::BodyMesh& body = solution.mesh.bodies[b];
    solution.cells.emplace_back(body.cells.size());
    for (std::size_t c = 0; c < body.cells.size(); ++c) {
      if (body.cells[c].kind != mesh::CellKind::superelement) continue;
      auto made = std::make_shared<element::SolvedSuperElement>();
      made->ring = element::ring_of(body.cells[c], body.nodes);
      made->sectors = element::sectors_of(model, body.cells[c]);
      made->thickness = model.analysis.thickness;
      made->set(element::solve_super_element(made->ring, made->sectors.D, made->thickness));
      solution.cells.back()[c] = std::move(made);
    }
  }
  solution.model = std::move(model);
  return solution;
}

/// A converged increment in which every elastic body moves by `field`; rigid bodies by `rigid`.
inline analysis::IncrementResult increment_of(const analysis::StaticSolution& solution, const Field& field,
                                              const Eigen::Vector3d& rigid = Eigen::Vector3d::Zero()) {
  analysis::IncrementResult increment;
  increment.step = 1;
  increment.step_name = solution.model.steps[0].name;
  increment.increment = 1;
  increment.reached = 0.25;
  increment.converged = true;
  for (std::size_t b = 0; b < solution.model.bodies.size(); ++b) {
    const std::vector<Vec2>& nodes = solution.mesh.bodies[b].nodes;
    Vector u(static_cast<Eigen::Index>(2 * nodes.size()));
    for (std::size_t i = 0; i < nodes.size(); ++i) u.segment<2>(static_cast<Eigen::Index>(2 * i)) = field(nodes[i]);
    increment.fields.displacements.push_back(solution.model.bodies[b].rigid ? Vector(rigid) : u);
    increment.fields.interior.emplace_back();
  }
  return increment;
}

/// A pentagon without symmetry whose edges are differently long.
inline model::Outline pentagon() {
  return polygon({{0.1, 0.0}, {2.3, 0.4}, {2.9, 1.7}, {1.2, 2.6}, {-0.4, 1.1}}, {"a", "b", "c", "d", "e"});
}

inline model::Body finite_elements(const std::string& name, const Vec2& corner, const Vec2& size, double h) {
  model::Body body = elastic(name, rectangle(corner, size), h);
  body.mesh.kind = model::MeshKind::fem;
  return body;
}

/// While it lives no file of this process may grow beyond `bytes`: a full disk.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() { setrlimit(RLIMIT_FSIZE, &before_); }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  rlimit before_{};
};

/// An empty directory that is removed at the end.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string pattern = (std::filesystem::temp_directory_path() / "scabo_result_XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~TemporaryDirectory() { std::filesystem::remove_all(path_); }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string content_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

inline void write_text(const std::filesystem::path& path, const std::string& text) { std::ofstream(path) << text; }

}  // namespace scabo::test
