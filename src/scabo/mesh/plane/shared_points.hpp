// Points in which two contacts meet on one body, such as two pieces of a ring that is cut on its shaft.
//
// The normals of an arc pass such a point unchanged (interface.hpp). The sides of a mesh file are chains of lines,
// whose normals are weighted over the elements of each contact alone: there are two in the point, at an angle a of up
// to half that between the lines. As on arcs, an overlap d of the contacts would be slips of d a in opposite directions
// of it, and between bodies that are joined nothing but a would decide how much each contact carries. Both contacts get
// their mean, where chains are smooth: to 26 degrees.
#pragma once

#include <vector>

#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {

/// Per body: whether a bonded contact or a tie holds it to another one.
std::vector<bool> joined_to_others(const model::Model& model);

/// Whether two normals in one point of a joint would be felt, whose sides are `gap` apart; `joined`: of the model.
template <typename Sides>
bool feels_two_normals(const std::vector<bool>& joined, const Sides& joint, double gap) {
  return gap != 0.0 || joined[static_cast<std::size_t>(joint.a.body)] || joined[static_cast<std::size_t>(joint.b.body)];
}

/// Of the interfaces of a mesh that are complete.
void share_normals(const model::Model& model, Mesh& mesh);

}  // namespace scabo::mesh
