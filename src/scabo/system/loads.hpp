// Consistent nodal forces of loads on elastic bodies, and forces on rigid bodies.
#pragma once

#include <Eigen/SparseCore>
#include <functional>
#include <vector>

#include "scabo/mesh/mesh.hpp"

namespace scabo::system {

/// Traction, force / length^2, at a boundary point `x` whose outward unit normal is `n`.
using TractionField = std::function<Vec2(const Vec2& x, const Vec2& n)>;

/// Nodal forces (two per node) of a traction on line elements, computed with their shape functions.
Vector traction_forces(const std::vector<mesh::LineElement>& elements, const std::vector<Vec2>& nodes,
                       const Extent& extent, const TractionField& traction);

/// The same of a traction that is smooth but where `position(x)` takes one of the values `breaks`: elements are
/// integrated in parts there. Exact on straight elements for a traction that is linear between the breaks.
struct Breaks {
  std::function<double(const Vec2& x)> position;
  std::vector<double> at;
};
Vector traction_forces(const std::vector<mesh::LineElement>& elements, const std::vector<Vec2>& nodes,
                       const Extent& extent, const TractionField& traction, const Breaks& breaks);

/// Mass of a layer that moves with line elements along their normals, mass / length^2 at a point, as entries at the
/// places of the nodes. Smooth but for the breaks.
std::vector<Eigen::Triplet<double>> mass_along_normals(const std::vector<mesh::LineElement>& elements,
                                                       const std::vector<Vec2>& nodes, const Extent& extent,
                                                       const std::function<double(const Vec2& x)>& layer,
                                                       const Breaks& breaks);

/// A traction on an edge that varies along it, and where it is not smooth.
struct VaryingTraction {
  TractionField traction;
  Breaks breaks;
};
VaryingTraction varying_traction(const model::EdgeTable& table, const model::Edge& edge);
VaryingTraction varying_traction(const model::Water& water);

/// N^T F of a force at a place on line elements along an edge, by length from its start; zero beyond its ends.
Vector forces_at_place(const std::vector<mesh::LineElement>& elements, const std::vector<Vec2>& nodes,
                       const model::Edge& edge, double place, const Vec2& force);

/// Line elements of the edge of a rigid body, which has no mesh: exact for lines, to rounding for arcs.
struct EdgeElements {
  std::vector<Vec2> nodes;
  std::vector<mesh::LineElement> elements;
};
EdgeElements elements_of(const model::Edge& edge);

/// Area of the elements as divided.
double area_of(const std::vector<mesh::LineElement>& elements, const std::vector<Vec2>& nodes, const Extent& extent);

}  // namespace scabo::system
