// What the elements of a deck are: whether they can be taken, the kind of analysis, and their materials.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scabo/convert/deck_content.hpp"
#include "scabo/model/material.hpp"

namespace scabo::convert {

/// The analysis that the elements which are taken are of; nothing without any. The others become
/// remarks.
std::optional<model::Plane> plane_of(const files::AbaqusDeck& deck, Remarks& remarks);

struct GivenMaterials {
  std::vector<std::string> of_cell;  ///< names of the model; empty for a cell without one
  std::vector<double> young;         ///< per cell, the smallest of its directions; 0 for a cell without a material
  std::vector<double> thickness;     ///< per cell; 0 for a cell without a material
  std::string lines;                 ///< of the section `materials` of the model
};

/// A material of the deck that has several orientations becomes as many of the model.
GivenMaterials materials_of(const files::AbaqusDeck& deck, const DeckContent& content, model::Plane plane,
                            Remarks& remarks);

}  // namespace scabo::convert
