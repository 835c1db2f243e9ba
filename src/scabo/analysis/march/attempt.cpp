#include "scabo/analysis/march/attempt.hpp"

namespace scabo::analysis {

DiscreteProblem discrete_problem(const Prepared& prepared, const Attempt& attempt) {
  DiscreteProblem discrete{
      attempt.problem, attempt.start, attempt.solution, attempt.accepted, attempt.force_scale, {}, {}};
  const auto contacts = static_cast<int>(prepared.model.contacts.size()),
             bars = static_cast<int>(prepared.model.bars.size());
  for (const system::ContactSystem::Pair& pair : prepared.contact.pairs) {
    int number = pair.contact;
    if (is_held_point(prepared, pair))
      number = contacts + bars + prepared.structure.bars[static_cast<std::size_t>(pair.index)].held->support;
    else if (pair.is_bar())
      number = contacts + pair.index;
    discrete.contact_of_pair.push_back(number);
    discrete.number_of_pair.push_back(pair.number);
  }
  return discrete;
}

}  // namespace scabo::analysis
