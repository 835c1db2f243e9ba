// Shapes of bodies in space that Gmsh's library divides (files/solid_cad.hpp), and the names of their faces.
//
// A face of united, cut or intersected shapes has the name of each face of them on which it lies, after the name of its
// shape: `plate_top`, `bore_side`. Faces without such a name, and those of CAD files, are face_1, face_2 and so on, by
// the order of the faces of each solid.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "scabo/files/imported_solid_mesh.hpp"
#include "scabo/model/solid_shape.hpp"

namespace scabo::model {

/// The solids of a CAD file.
struct CadFile {
  std::string path;
};

/// A plane outline, turned about an axis in its plane, counter-clockwise about `from` to `to`. Faces: those of the
/// edges of the outline by their names; start and end if the angle is less than a full turn.
struct SolidRevolution {
  geometry::Outline outline;
  std::array<int, 3> axes{0, 1, 2};  ///< of the first and second coordinate of the outline, and across
  Vec2 from, to;                     ///< of the axis, in the coordinates of the outline
  double angle = 360.0;              ///< degrees, 0 < angle <= 360

  bool is_whole() const { return angle >= 360.0; }
};

struct SolidOperand;

struct SolidCombination {
  enum class Kind { united, cut, common };
  Kind kind = Kind::united;
  std::vector<SolidOperand> of;  ///< two or more; from the first one all others are cut
};

using CadShape = std::variant<CadFile, SolidRevolution, SolidCombination>;
using AnyShape = std::variant<SolidShape, CadShape>;

struct SolidOperand {
  std::string name;
  AnyShape shape;
};

/// The CAD files of a shape.
std::vector<std::string> files_of(const CadShape& shape);

/// Names of faces that are known before the shape is made: all but those of files.
std::vector<std::string> face_names(const CadShape& shape);

/// How far a point is from a face of that name (face_names), length; a measure that is 0 on the face only.
double distance_to_face(const AnyShape& shape, const std::string& name, const Eigen::Vector3d& point);

/// The mesh of all solids of a shape, with side sets of these names. Throws InputError of `file`, the model, or of a
/// CAD file.
files::ImportedSolidMesh divided_cad_shape(const CadShape& shape, const SolidSizes& sizes, const std::string& file);

}  // namespace scabo::model
