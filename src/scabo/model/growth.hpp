// A step in which cracks grow: where to, against which toughness, and until when (analysis/growth).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scabo/base/error.hpp"
#include "scabo/base/types.hpp"

namespace scabo::model {

/// What decides the direction of growth and when it begins (analysis/growth/criteria.hpp).
enum class GrowthCriterion { hoop_stress, energy_release, strain_energy_density, zero_K_II, straight };

/// A crack between cells that may grow, at one of its ends or at both. An end on the boundary or on another crack does
/// not grow.
struct GrowingCrack {
  int body = -1, crack = -1;  ///< Body::cracks
  bool at_start = true, at_end = true;
  Source source;
};

/// Growth per cycle of load, da/dN (analysis/growth/fatigue.hpp).
enum class FatigueLaw { paris, forman, walker };

/// Cycles of load between two sets of factors.
struct LoadCycles {
  FatigueLaw law = FatigueLaw::paris;
  double C = 0.0, m = 0.0;      ///< > 0; C: length over (force / length^(3/2))^m; forman: ^(m - 1)
  std::optional<double> gamma;  ///< walker: 0 to 1
  std::optional<double> K_c;    ///< forman: force / length^(3/2), > 0
  /// Factors of all loads and supports at the lowest and at the highest load.
  std::array<std::vector<double>, 2> loads, supports;
};

/// What a material resists: one number for all of them, or one for each.
struct Toughness {
  std::optional<double> of_all;
  std::vector<std::optional<double>> of_material;  ///< for each of the model, if there is none for all

  double of(int material) const { return of_all ? *of_all : of_material[static_cast<std::size_t>(material)].value(); }
};

/// Loads are lambda times a pattern plus constants. In every state lambda is such that the leading tip is critical;
/// then the crack grows by a given length.
struct GrowthStep {
  GrowthCriterion criterion = GrowthCriterion::hoop_stress;
  std::optional<Toughness> K_Ic, G_c;  ///< force / length^(3/2), force / length; > 0, one of the two; of cycles at most
  std::optional<LoadCycles> cycles;    ///< instead of growth under a load; `loads` and `supports` have no meaning then
  /// Of hoop_stress: distance from the tip at which the stress is taken, so that the T-stress counts; length, > 0.
  std::optional<double> distance;
  double step = 0.0;                  ///< length, > 0: the largest sum of the growth of all tips between two states
  std::vector<GrowingCrack> cracks;   ///< empty: all of the model
  std::vector<char> loads, supports;  ///< for each of the model: lambda multiplies its factor
  // When it ends, besides where a tip meets something:
  std::optional<double> length;       ///< of one crack, length
  std::optional<Vec2> tip;            ///< a tip is within half a step of this point
  std::optional<double> load_factor;  ///< lambda would have to be larger
  std::optional<int> steps;           ///< growth steps
  bool broken = false;  ///< not where a tip meets something, but where a body is in pieces or no tip is left
};

}  // namespace scabo::model
