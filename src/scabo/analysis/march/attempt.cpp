#include "scabo/analysis/march/attempt.hpp"

#include <algorithm>

namespace scabo::analysis {

namespace {

/// Of the support of a held point, among those that begin or end.
int number_among_staged(const Prepared& prepared, const system::ContactSystem::Pair& pair) {
  const std::vector<model::Support>& supports = prepared.model.supports;
  const int support = prepared.structure.bars[static_cast<std::size_t>(pair.index)].held->support;
  return static_cast<int>(std::count_if(supports.begin(), supports.begin() + support,
                                        [](const model::Support& of) { return of.is_staged(); }));
}

}  // namespace

DiscreteProblem discrete_problem(const Prepared& prepared, const Attempt& attempt) {
  DiscreteProblem discrete{
      attempt.problem, attempt.start, attempt.solution, attempt.accepted, attempt.force_scale, {}, {}};
  const auto contacts = static_cast<int>(prepared.model.contacts.size()),
             bars = static_cast<int>(prepared.model.bars.size());
  for (const system::ContactSystem::Pair& pair : prepared.contact.pairs) {
    int number = pair.contact;
    if (is_held_point(prepared, pair))
      number = contacts + bars + number_among_staged(prepared, pair);
    else if (pair.is_bar())
      number = contacts + pair.index;
    discrete.contact_of_pair.push_back(number);
    discrete.number_of_pair.push_back(pair.number);
  }
  return discrete;
}

}  // namespace scabo::analysis
