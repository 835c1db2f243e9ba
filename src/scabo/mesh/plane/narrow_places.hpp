// Where lines of a body come close to each other without meeting: cells are small there, so that they fit between.
#pragma once

#include <functional>
#include <vector>

#include "scabo/mesh/plane/line_net.hpp"
#include "scabo/mesh/plane/size_field.hpp"

namespace scabo::mesh {

struct NarrowOptions {
  double sizes_per_width = 4.0;  ///< cells between two lines are at most this many times as long as the lines are apart
  bool gaps = false;             ///< the same where no material is between the lines
  bool arcs = false;             ///< cells beside an arc are not larger than its radius
  double sizes_per_tip = 0.5;    ///< the same of a crack tip and whatever is next to it
  double most = 1e6;             ///< about as many cells at most
  double finer_arcs = 1.0;       ///< sides on arcs turn by this part of what they may at most
};

struct NarrowPlaces {
  /// Where less than the wanted size is needed, with the size.
  std::vector<SizeField::Sample> samples;
  double cells = 0.0;  ///< about as many lie there; if more than allowed, samples are not complete
  double width = 0.0;  ///< of the narrowest place between lines, 0: there is none
  Vec2 narrowest = Vec2::Zero();
};

/// `size`: wanted without regard to narrow places; `largest`: it is not more anywhere.
NarrowPlaces narrow_places(const std::vector<NetLine>& lines, const std::vector<Vec2>& tips,
                           const std::function<double(const Vec2&)>& size, double largest,
                           const NarrowOptions& options);

}  // namespace scabo::mesh
