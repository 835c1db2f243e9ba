#include "scabo/analysis/cracks.hpp"

namespace scabo::analysis {

namespace {

std::string name_of(const model::Body& body) {
  if (!body.cracks.empty()) return body.name + "." + body.cracks.front().name;
  if (body.mesh.centre_corner < 0) return body.name;
  const std::vector<std::string>& names = body.outline.corners[static_cast<std::size_t>(body.mesh.centre_corner)].names;
  return body.name + "." + (names.size() > 1 ? names[1] : names[0]);  // the user's name where there is one
}

}  // namespace

std::vector<CrackResult> crack_results(const StaticSolution& solution, const IncrementResult& increment) {
  std::vector<CrackResult> results;
  for (std::size_t b = 0; b < solution.super_elements.size(); ++b) {
    const auto& super_element = solution.super_elements[b];
    if (!super_element || super_element->domain.unbounded || !super_element->ring.is_open()) continue;
    results.push_back({name_of(solution.model.bodies[b]),
                       super_element->corner().of(increment.displacements[b], increment.interior[b].loads)});
  }
  return results;
}

}  // namespace scabo::analysis
