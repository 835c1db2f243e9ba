#include "scabo/analysis/march/attempt.hpp"

namespace scabo::analysis {

DiscreteProblem discrete_problem(const Prepared& prepared, const Attempt& attempt) {
  DiscreteProblem discrete{
      attempt.problem, attempt.start, attempt.solution, attempt.accepted, attempt.force_scale, {}, {}};
  for (const system::ContactSystem::Pair& pair : prepared.contact.pairs) {
    discrete.contact_of_pair.push_back(pair.is_bar() ? static_cast<int>(prepared.model.contacts.size()) + pair.index
                                                     : pair.contact);
    discrete.number_of_pair.push_back(pair.number);
  }
  return discrete;
}

}  // namespace scabo::analysis
