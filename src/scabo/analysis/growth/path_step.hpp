// A step of the paths of cracks: how far each tip goes, what it meets, and when growth ends.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scabo/analysis/growth/fatigue.hpp"
#include "scabo/analysis/growth/tips.hpp"
#include "scabo/analysis/state/solution.hpp"

namespace scabo::analysis {

/// The paths of the cracks of these tips.
GrownCracks cracks_of(const model::Model& model, const std::vector<Tip>& tips, std::string ended);

/// Why growth ends in state `number` though nothing is met; empty if it goes on.
std::string end_wanted(const model::GrowthStep& growth, const GrowthResult& at, int number);

/// How far each tip grows in a step of the length `whole` of all: in proportion to its rate, or by equal parts where
/// growth follows the load; less where a crack would become longer than wanted.
std::vector<double> shares(const model::GrowthStep& growth, const GrowthResult& at,
                           const std::vector<CycledTip>& cycled, double whole);

/// How far the tips grew, together, between two states.
double grown_between(const GrowthResult& before, const GrowthResult& after);

Vec2 turned(const Vec2& direction, double angle);

/// What tips run into.
struct Meetings {
  std::vector<std::optional<Vec2>> at;  ///< of every tip: where its crack ends
  std::string told;                     ///< "'plate.flaw.end' meets edge 'top' at (1, 2)"
  model::Model model;                   ///< the cracks go on to these points
  bool broken = false;                  ///< a body is in pieces then
};
/// Of the tips that grow by these lengths along these directions, none if nothing is met.
std::optional<Meetings> meetings(const model::Model& model, const std::vector<Tip>& tips, const GrowthResult& at,
                                 const std::vector<Vec2>& directions, const std::vector<double>& lengths);

/// The tips that go on.
std::vector<Tip> without_met(const std::vector<Tip>& tips, const std::vector<std::optional<Vec2>>& met);

/// From the cracks of one state, `here`, to those of the `next`, as both were reported.
void follow(model::Model& model, std::vector<Tip>& tips, const GrowthResult& here, const GrowthResult& next);

/// How far tips go until they meet something, and in which direction: in place of `lengths`.
double length_until(const Meetings& met, const GrowthResult& at);

}  // namespace scabo::analysis
