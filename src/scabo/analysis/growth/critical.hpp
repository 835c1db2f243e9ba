// The load factor at which tips are critical (grow.hpp, eq. 1).
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "scabo/analysis/growth/criteria.hpp"
#include "scabo/analysis/growth/tips.hpp"
#include "scabo/analysis/march/options.hpp"
#include "scabo/analysis/march/reached.hpp"
#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// Tips that are critical at load factors up to so much above that of the leading one grow with it.
constexpr double together = 1e-3;

/// Whether no force acts at these factors, and no support prescribes a displacement: without pairs bodies are then at
/// rest, and states are proportional to the load factor if this is so without the loads that are scaled.
bool is_at_rest(const Prepared& prepared, const Factors& factors);

/// Of loads and supports in the last step.
Factors factors_at(const model::Model& model, double lambda);

/// The state at these factors, from another one on the same mesh.
Reached reach_from(const Prepared& prepared, const State& from, const Factors& factors, const Options& options);
/// The same from rest.
Reached reach_from_rest(const Prepared& prepared, const Factors& factors, const Options& options);

/// Constants of the material around a tip.
struct MaterialConstants {
  double kappa = 0.0;    ///< criteria.hpp
  double modulus = 0.0;  ///< E', force / length^2
  int material = -1;     ///< index into Model::materials
};
MaterialConstants material_constants(const Prepared& prepared, const Tip& tip);

/// Of all tips, or why there are none.
using FactorsOfTips = std::variant<std::vector<TipFactors>, std::string>;
/// In a state.
FactorsOfTips factors_of_tips(const Prepared& prepared, const std::vector<Tip>& tips, const State& state);
/// At these factors of the loads, from rest.
FactorsOfTips factors_of_tips(const Prepared& prepared, const std::vector<Tip>& tips, const Factors& factors,
                              const Options& options);
/// From the results at a tip; `kind` is a crack.
TipFactors tip_factors(const model::GrowthStep& growth, const element::StressIntensity& factors);

/// Factors at a tip: constant + lambda per_lambda.
struct TipPattern {
  TipFactors constant, per_lambda;
  MaterialConstants material;
  double toughness = 0.0;  ///< K_Ic

  TipFactors at(double lambda) const { return constant + lambda * per_lambda; }
};
/// Of all tips, or why there is none.
std::variant<std::vector<TipPattern>, std::string> tip_patterns(const Prepared& prepared, const std::vector<Tip>& tips,
                                                                const Options& options);

/// The smallest lambda > 0 at which a tip is critical; infinite if there is none, 0 if it is critical without any load
/// that is scaled.
double critical_factor(model::GrowthCriterion criterion, const TipPattern& tip);

/// K* by which a tip is compared with its toughness; a tip that its load closes counts with K_I = 0.
double equivalent_factor(model::GrowthCriterion criterion, const TipFactors& factors, double kappa);
/// Toughness as a factor K_Ic.
double toughness_of(const model::GrowthStep& growth, const MaterialConstants& material);

}  // namespace scabo::analysis
