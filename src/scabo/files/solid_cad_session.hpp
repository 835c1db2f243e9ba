// What the functions of SolidCad share. Only for sources that are compiled with SCABO_GMSH.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "scabo/files/gmsh_session.hpp"
#include "scabo/files/solid_cad.hpp"
#include "scabo/files/step_names.hpp"

namespace scabo::files {

/// The functions that solids need beside those of all sessions.
struct SolidLibrary {
  decltype(&gmshModelOccAddBox) box;
  decltype(&gmshModelOccAddCylinder) cylinder;
  decltype(&gmshModelOccAddSphere) sphere;
  decltype(&gmshModelOccAddPoint) point;
  decltype(&gmshModelOccAddLine) line;
  decltype(&gmshModelOccAddCircleArc) arc;
  decltype(&gmshModelOccAddCurveLoop) loop;
  decltype(&gmshModelOccAddPlaneSurface) surface;
  decltype(&gmshModelOccExtrude) extrude;
  decltype(&gmshModelOccRevolve) revolve;
  decltype(&gmshModelOccFuse) fuse;
  decltype(&gmshModelOccCut) cut;
  decltype(&gmshModelOccIntersect) intersect;
  decltype(&gmshModelOccImportShapes) import;
  decltype(&gmshModelOccSynchronize) synchronize;
  decltype(&gmshModelOccGetMass) mass;
  decltype(&gmshModelGetEntityName) name;
  decltype(&gmshModelMeshOptimize) optimize;
  decltype(&gmshModelMeshClassifySurfaces) classify;
  decltype(&gmshModelMeshCreateGeometry) create_geometry;
  decltype(&gmshModelGeoAddSurfaceLoop) shell;
  decltype(&gmshModelGeoAddVolume) volume;
  decltype(&gmshModelGeoSynchronize) synchronize_triangles;
  decltype(&gmshModelMeshFieldAdd) add_field;
  decltype(&gmshModelMeshFieldSetString) set_field_text;
  decltype(&gmshModelMeshFieldSetNumbers) set_field_numbers;
  decltype(&gmshModelMeshFieldSetAsBackgroundMesh) use_field;
};

const SolidLibrary& solid_library();

/// The library's session and the operations on one model.
class SolidCad::Session {
 public:
  Session(const std::string& file, double factor)
      : session(file, "MM"), gmsh(gmsh_library()), solids(solid_library()), factor_(factor) {}

  int surface_of(const std::vector<SolidLoop>& loops);
  Solids volumes_of(const GmshSession::DimTags& made) const;
  template <class Operation>
  Solids combined(Operation operation, const Solids& a, const Solids& b, const char* what);
  void check_count(const SolidCadSizes& sizes);
  void set_sizes(const SolidCadSizes& sizes);
  std::map<int, std::string> names_of_solids();
  /// By the tags of surfaces, where the STEP file has some; false if they cannot be told apart.
  bool name_faces(std::map<int, std::string>& names);

  double stl_volume = 0.0;
  std::string step_file;  ///< the only file, if it is one

  GmshSession session;
  const GmshLibrary& gmsh;
  const SolidLibrary& solids;
  double factor() const { return factor_; }
  /// In the unit of the model of Gmsh, rounded to 1e-10 of it: what differs by rounding alone gets the same cells.
  double scaled(double length) const {
    constexpr double step = 1.0 / 8589934592.0;  // 2^-33
    return step * std::nearbyint(length * factor_ / step);
  }
  Eigen::Vector3d scaled(const Eigen::Vector3d& x) const { return {scaled(x.x()), scaled(x.y()), scaled(x.z())}; }

 private:
  std::vector<int> boundary_of(int dimension, int tag, bool points);
  double width_of(int surface);
  bool matches(const std::vector<int>& surfaces, const std::vector<StepFace>& faces);
  double factor_;
};

}  // namespace scabo::files
