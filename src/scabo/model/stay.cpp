#include "scabo/model/stay.hpp"

#include <fmt/format.h>

namespace scabo::model {

std::optional<std::string> wrong_removal(const Stay& stay, const std::vector<Step>& steps, bool restarts,
                                         const char* what) {
  if (stay.removed < 0 || stay.removed > stay.added) return {};
  if (stay.removed > 0)
    return fmt::format("must be a step after '{}', in which the {} is added",
                       steps[static_cast<std::size_t>(stay.added)].name, what);
  if (restarts)
    return "is the first step of a restart, which begins with what is there at the other run's end: put a step before "
           "it in which nothing changes, as {name: rest, loads: {}}";
  return fmt::format("is the first step, so that the {} is never there: name a later step, or leave the {} out", what,
                     what);
}

std::optional<std::string> wrong_stay_on_body(const Stay& support, const Stay& body, const std::string& name,
                                              const std::vector<Step>& steps) {
  const auto name_of = [&](int step) { return steps[static_cast<std::size_t>(step)].name; };
  if (support.added > 0 && support.added < body.added)
    return fmt::format(
        "is before step '{}', in which body '{}' is added: a support without 'added' begins with its "
        "body",
        name_of(body.added), name);
  if (body.removed >= 0 && (support.removed > body.removed || support.added >= body.removed))
    return fmt::format("is not before step '{}', in which body '{}' is removed: its supports end with it",
                       name_of(body.removed), name);
  return {};
}

bool acts_in(const std::vector<Step>& steps, const std::vector<double>& at_start, std::size_t load, std::size_t step) {
  const Step& of = steps[step];
  const bool before = step > 0 ? steps[step - 1].load_factors[load] != 0.0 : !at_start.empty() && at_start[load] != 0.0;
  return before || of.load_factors[load] != 0.0 || load_curve(of, load) >= 0;
}

std::optional<std::string> load_never_acts(const std::string& load, std::size_t index, const std::string& body,
                                           const Stay& stay, const std::vector<Step>& steps,
                                           const std::vector<double>& at_start) {
  if (!stay.is_staged()) return {};
  for (std::size_t s = 0; s < steps.size(); ++s)
    if (stay.is_there(static_cast<int>(s)) && acts_in(steps, at_start, index, s)) return {};
  return fmt::format("load '{}' never acts: body '{}' is not there when it does", load, body);
}

std::optional<std::string> displaced_too_early(const std::string& support, std::size_t index, int added,
                                               const std::string& begins, const std::vector<Step>& steps) {
  if (added <= 0 || added >= static_cast<int>(steps.size())) return {};
  const auto step = static_cast<std::size_t>(added);
  if (steps[step - 1].support_factors[index] == 0.0) return {};
  return fmt::format(
      "the displacement of support '{}' is applied before step '{}', in which {} is added: give the "
      "support a name, and its factor a value in that step or a later one",
      support, steps[step].name, begins);
}

}  // namespace scabo::model
