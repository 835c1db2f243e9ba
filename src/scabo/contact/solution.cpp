#include "scabo/contact/solution.hpp"

#include <utility>

namespace scabo::contact {

Solution continued(Solution before, Solution solution) {
  for (Iteration& iteration : solution.trace) {
    iteration.iteration += before.iterations + before.coarse_iterations;
    before.trace.push_back(std::move(iteration));
  }
  solution.trace = std::move(before.trace);
  solution.iterations += before.iterations;
  solution.coarse_iterations += before.coarse_iterations;
  return solution;
}

}  // namespace scabo::contact
