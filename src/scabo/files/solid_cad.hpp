// Solids in space by Gmsh's library: CAD files (STEP, BREP of OpenCASCADE, STL), outlines that are drawn or turned, and
// what is left of solids that are united, cut or intersected. Gmsh divides them into quadratic tetrahedra, whose middle
// nodes lie on curved faces.
//
// OpenCASCADE's tolerance is 1e-7 of its unit. A STEP file knows its unit and is read in mm; all other lengths are
// multiplied by a factor that the caller chooses, so that they are neither tiny nor huge.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scabo/base/types.hpp"
#include "scabo/files/imported_solid_mesh.hpp"

namespace scabo::files {

/// Whether the name of a file ends as that of a solid: .step, .stp, .brep or .stl, in upper or lower case.
bool is_solid_cad_file(const std::string& path);
/// Whether its lengths have a unit: .step or .stp.
bool has_unit(const std::string& path);
bool is_stl_file(const std::string& path);

/// Nodes that the mesh of a solid may have, about.
constexpr double most_solid_nodes = 3e6;

struct SolidCadSizes {
  struct Near {
    Eigen::Vector3d point;
    double size = 0.0, growth = 0.3;  ///< there, and per distance from it
  };
  double size = 0.0;  ///< of sides of tetrahedra
  std::vector<Near> near;
};

/// Points of an outline: a straight line, or an arc of less than half a circle about `centre`, leads from each to the
/// next one, and from the last to the first.
struct SolidLoop {
  struct Line {
    Eigen::Vector3d start;
    bool arc = false;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  };
  std::vector<Line> lines;
};

/// One model of Gmsh: at most one of these exists at a time in a process, others wait for it. All functions throw
/// InputError with the name `file` (of a CAD file, or of the model file) where Gmsh finds an error.
class SolidCad {
 public:
  using Solids = std::vector<int>;  ///< tags of volumes

  /// `factor`: of all lengths but those of STEP files, which are in mm.
  SolidCad(const std::string& file, double factor);
  ~SolidCad();
  SolidCad(const SolidCad&) = delete;
  SolidCad& operator=(const SolidCad&) = delete;

  Solids box(const Eigen::Vector3d& corner, const Eigen::Vector3d& size);
  Solids cylinder(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);
  Solids sphere(const Eigen::Vector3d& centre, double radius);
  /// A plane face with holes, drawn along a vector.
  Solids drawn(const std::vector<SolidLoop>& loops, const Eigen::Vector3d& along);
  /// The same, turned by an angle in radians about the axis through a point.
  Solids turned(const std::vector<SolidLoop>& loops, const Eigen::Vector3d& point, const Eigen::Vector3d& axis,
                double angle);
  /// The solids of a STEP or BREP file.
  Solids of_file(const std::string& path);
  /// The solid of an STL file, which cannot be combined with others.
  Solids of_stl(const std::string& path);

  Solids united(const Solids& a, const Solids& b);
  Solids cut(const Solids& a, const Solids& b);
  Solids common(const Solids& a, const Solids& b);

  /// Cells of all solids. Cell sets `solid_1`, ... or the names of the solids in a STEP file; side sets `face_1`, ...
  /// by the order of the faces of each solid.
  ImportedSolidMesh mesh(const SolidCadSizes& sizes);

 private:
  class Session;
  std::unique_ptr<Session> session_;
};

}  // namespace scabo::files
