// What summary.json says of the end of a run in space: the motion of a mechanism, and warnings of increments.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "scabo/analysis/space/solid_analysis.hpp"
#include "scabo/model/solid_model.hpp"

namespace scabo::result {

/// With the bodies that move, in the order of the model.
nlohmann::ordered_json content_of_mechanism(const analysis::SolidMechanism& mechanism,
                                            const analysis::SolidModel& model);

/// Adds the warnings of an increment to `texts` and `warnings` that are not there yet: those of a run that is resumed
/// may be.
void note_warnings(const model::SpaceModel& model, const nlohmann::ordered_json& increment,
                   const std::vector<Warning>& given, nlohmann::ordered_json& texts, std::vector<Warning>& warnings);

/// At the end of a run: contacts whose force only few pairs carry after its last increment, which the mesh is then too
/// coarse for. Two rigid bodies have no others.
void note_few_pairs(const model::SpaceModel& model, const nlohmann::ordered_json& last, nlohmann::ordered_json& texts,
                    std::vector<Warning>& warnings);

}  // namespace scabo::result
