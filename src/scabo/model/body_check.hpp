// What the checks of one body share.
#pragma once

#include <string>

#include "scabo/model/checking.hpp"
#include "scabo/model/side_faces.hpp"

namespace scabo::model {

/// One body under check; `outline` runs counter-clockwise, for unbounded bodies as well.
struct BodyCheck {
  Checking& checking;
  const Body& body;
  const std::string path;
  const Outline& outline;
  int centre_corner = -1;  // of `outline`

  int edges() const { return static_cast<int>(outline.edges.size()); }
  bool is_side_face(int edge) const { return model::is_side_face(outline, centre_corner, edge); }
  const Edge& edge(int index) const { return outline.edges[static_cast<std::size_t>(index)]; }
};

/// Cracks, of one super-element or of many cells. These and the checks below report what is wrong; false if anything
/// is.
bool check_cracks(const BodyCheck& of);

/// The two edges at a scaling centre on a corner are its side faces, which must be straight.
bool check_side_faces(const BodyCheck& of);

/// Values of the mesh that do not depend on the shape.
bool check_mesh_options(Checking& checking, const std::string& path, const Body& body);

/// Number of degrees of freedom and the scaling centre of a body whose shape is sound. `values_good`: the result of
/// check_mesh_options.
void check_mesh(const BodyCheck& of, bool values_good);

}  // namespace scabo::model
