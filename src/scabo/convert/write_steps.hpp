// The steps of the model of a converted deck, with the factors of its loads and displacements.
#pragma once

#include <string>
#include <vector>

#include "scabo/convert/deck_content.hpp"
#include "scabo/convert/write_model.hpp"

namespace scabo::convert {

/// What a load or a displacement that varies is in `steps`.
struct Driven {
  std::string name;
  Course factors;
};

/// The names of the steps in the model.
std::vector<std::string> names_of_steps(const std::vector<DeckStep>& steps);

/// The lines of `steps`. `counted`: with a number of increments, as models in space have it, which is that of the first
/// increment. Factors that follow a table become curves, which are added to `parts`.
std::string steps_text(const std::vector<DeckStep>& steps, const std::vector<Driven>& driven, ModelParts& parts,
                       bool counted = false);

}  // namespace scabo::convert
