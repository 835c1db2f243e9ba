// Factors of loads and supports, and coefficients of friction, over the steps of a model.
#pragma once

#include "scabo/analysis/increment.hpp"

namespace scabo::analysis {

/// At part `s` of a step, 0 to 1: between those at the end of the step before it (or of the run from which this one
/// starts; zero before the first step) and those of the step, or along curves.
Factors factors_in(const model::Model& model, std::size_t step, double s);

}  // namespace scabo::analysis
