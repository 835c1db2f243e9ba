// Tips of cracks that may grow: where they are in the model, what they would meet, and how small the cells there must
// be. Cracks are paths in bodies of many cells.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scabo/model/model.hpp"

namespace scabo::analysis {

struct Tip {
  int body = -1, crack = -1;
  bool at_end = true;  ///< the last point of the path, otherwise the first
};

/// The tips that may grow in the last step of the model, in the order of bodies and cracks, the start of a crack before
/// its end. An end on the boundary of its body or on another crack is none.
std::vector<Tip> growing_tips(const model::Model& model);

/// An end that would grow if it did not lie on the border of a region, from where growth is not known.
std::optional<Tip> end_on_a_border(const model::Model& model);

const model::Crack& crack_of(const model::Model& model, const Tip& tip);
std::string name_of_crack(const model::Model& model, const Tip& tip);  ///< `plate.flaw`
std::string name_of(const model::Model& model, const Tip& tip);        ///< `plate.flaw.end`
Vec2 position_of(const model::Model& model, const Tip& tip);
/// Unit vector out of the crack.
Vec2 direction_of(const model::Model& model, const Tip& tip);
double length_of(const model::Crack& crack);

/// The crack gets another point beyond its tip.
void extend(model::Model& model, const Tip& tip, const Vec2& to);

/// Cells at the tips become at most half a step of growth, and a quarter of the distance to the next bend, boundary or
/// other crack. `sizes`: those that the user gave, of every body.
void refine_at_tips(model::Model& model, const std::vector<Tip>& tips,
                    const std::vector<std::vector<model::LocalSize>>& sizes);
/// The model as its first mesh is made of it.
model::Model with_fine_tips(model::Model model);

/// What a crack runs into.
struct Meeting {
  Vec2 at = Vec2::Zero();
  std::string what;  ///< `edge 'top'`
};
/// The nearest one between a tip and a point ahead of it, if there is one.
std::optional<Meeting> meeting(const model::Model& model, const Tip& tip, const Vec2& ahead);

}  // namespace scabo::analysis
