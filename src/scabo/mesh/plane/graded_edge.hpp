// Edges with elements whose lengths change along them, as `mesh.refine` asks.
#pragma once

#include <functional>
#include <vector>

#include "scabo/mesh/mesh.hpp"
#include "scabo/mesh/plane/size_field.hpp"

namespace scabo::mesh {

/// Wanted length of the sides of cells at a point of the body: mesh.size (from a file: any), less near places of
/// mesh.refine, and no more than `sizes`.
double wanted_size(const model::Body& body, const SizeField& sizes, const Vec2& x);

/// The part of an edge between two fractions of its length.
struct EdgePart {
  double from = 0.0, to = 1.0;
};

/// How finely a part of an edge is divided at least.
struct LeastDivision {
  double elements = 1.0;
  double turn = 0.0;       ///< radian; an element of an arc turns by at most this; 0: by any angle
  double rounding = 1e-6;  ///< part of an element by which their number may be rounded down
  double most = 1e7;       ///< elements; with more there is no division
};

/// Fractions of the length of the edge at which the part is divided, both its ends included: as many elements as the
/// integral of 1 / `size` along it, each with an equal share of the integral. Nothing if they are more than
/// `least.most`. `size`: wanted length at a point, > 0, which changes by less than the distance.
std::vector<double> graded_breaks(const geometry::Edge& edge, const EdgePart& part,
                                  const std::function<double(const Vec2&)>& size, const LeastDivision& least);

}  // namespace scabo::mesh
