// Points inside the regions of a domain from which a triangulation with triangles of the wanted size is made.
//
// They grow as a triangular lattice: a point proposes its six neighbours at the spacing wanted there, in the directions
// that it has from the point that proposed it, and a proposal is accepted unless it lies too near to a point or to a
// line. With a constant spacing this is one regular lattice in every region; where the spacing varies the lattice
// follows it, with defects that smoothing removes. Growth begins at the finest segment, and a smaller spacing goes
// first.
//
// Where there were points before, those stay that are as close together as is wanted, or nearly, and far from new
// segments; new ones grow from them and from the lines, but only in the room of those that went.
#pragma once

#include <functional>
#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::mesh {

/// A segment of the lines that bound regions, or are embedded in them; no point comes near it, growth never crosses it.
struct BorderSegment {
  Vec2 start = Vec2::Zero(), end = Vec2::Zero();
  double facet = 0.0;        ///< length of the facets there, > 0: spacing is graded from it (growth_of_spacing)
  bool left_inside = false;  ///< whether a region lies on this side
  bool right_inside = false;
  bool is_new = false;  ///< points near it do not stay
};

/// The spacing increases by at most this per unit of distance from the lines.
constexpr double growth_of_spacing = 0.3;

/// Spacing of points per length of facets, where facets alone determine it.
constexpr double spacing_per_facet = 1.2;

/// Points and divisions of lines that stay are at most so many times as coarse, or as fine, as is wanted.
constexpr double coarsest = 1.5, finest = 2.0;
/// Whether what was made with a spacing stays where another one is wanted.
constexpr bool is_near(double spacing, double wanted) {
  return spacing <= coarsest * wanted && wanted <= finest * spacing;
}

struct InteriorPoints {
  std::vector<Vec2> points;
  std::vector<double> spacing;  ///< wanted distance to the neighbours, for each point
  std::vector<double> angles;   ///< of the lattice there, radians
  std::size_t kept = 0;         ///< the first ones, which are there from before, in their order
};

/// `spacing` is the wanted distance between neighbours at a point; throws BrokenInvariant where it is not positive.
/// Every connected part of a region that is wide enough for a point has one. `former`: those before; none if empty.
InteriorPoints interior_points(const std::vector<BorderSegment>& segments,
                               const std::function<double(const Vec2&)>& spacing, const InteriorPoints& former = {});

}  // namespace scabo::mesh
