// A model in space (`analysis: {space: true}`): bodies of tetrahedra, from mesh files or of simple shapes, with
// contacts and ties between named faces. Plain values, checked by the reader but for what needs geometry
// (analysis/space/posed_solids.hpp).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scabo/base/error.hpp"
#include "scabo/base/warning.hpp"
#include "scabo/files/imported_solid_mesh.hpp"
#include "scabo/model/solid_shape.hpp"

namespace scabo::model {

struct SpaceMaterial {
  std::string name;
  double young = 0.0, poisson = 0.0;  ///< force / length^2, > 0; -1 < poisson < 1/2
  double density = 0.0;               ///< mass / length^3, >= 0
};

struct SpaceBody {
  std::string name;
  std::shared_ptr<const files::ImportedSolidMesh> mesh;  ///< either this or `shape`
  std::optional<SolidShape> shape;
  SolidSizes sizes;  ///< of a shape
  int material = -1;
  Source source;
};

/// A surface of the mesh file of a body, the outer facets whose corners are in a set of nodes, or a face of its shape.
struct SpaceFace {
  int body = -1;
  int side_set = -1, node_set = -1;  ///< one of them, of `body`'s mesh; or none
  std::string of_shape;              ///< the name of a face of `body`'s shape
  std::string text;                  ///< `block.bottom`
  Source source;
};

struct SpaceSupport {
  std::string name;
  bool named = false;  ///< by the user, so that steps give it a factor
  SpaceFace on;
  std::array<std::optional<double>, 3> displacement;  ///< length, at factor 1; none: free
};

struct SpaceLoad {
  enum class Kind { pressure, traction, gravity };
  std::string name;
  Kind kind = Kind::pressure;
  SpaceFace on;                                      ///< of pressure and traction
  double pressure = 0.0;                             ///< against the outward normal
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();  ///< traction, or acceleration of all bodies
};

/// Also a tie: without friction.
struct SpaceContact {
  std::string name;
  SpaceFace a, b;
  std::optional<double> friction;  ///< none: tied
  double gap = 0.0;                ///< added to that of the meshes
};

struct SpaceStep {
  std::string name;
  int increments = 1;
  std::vector<double> load_factors, support_factors;  ///< at its end
};

struct SpaceModel {
  std::string file, title;
  std::vector<std::string> files;           ///< that it names
  std::shared_ptr<const std::string> text;  ///< of the model file
  std::vector<SpaceMaterial> materials;
  std::vector<SpaceBody> bodies;
  std::vector<SpaceSupport> supports;
  std::vector<SpaceLoad> loads;
  std::vector<SpaceContact> contacts;
  std::vector<SpaceStep> steps;
  double tolerance = 1e-10;  ///< of the certificate
  std::vector<Warning> warnings;
};

}  // namespace scabo::model
