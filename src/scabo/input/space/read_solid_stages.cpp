// `added` and `removed` of models in space, and `restart`.
#include <fmt/format.h>

#include <algorithm>

#include "scabo/input/space/space_reader.hpp"

namespace scabo::input {

using namespace model;

/// Whether a body or support is put in place or taken away in the step of this name.
bool SpaceReader::has_stage(const std::string& step) const {
  const auto named = [&](const std::optional<Value>& value) { return value && value->node->text == step; };
  const auto begins_or_ends = [&](const Stages& of) { return named(of.added) || named(of.removed); };
  return std::any_of(stages_.begin(), stages_.end(), begins_or_ends) ||
         std::any_of(stages_of_supports_.begin(), stages_of_supports_.end(), begins_or_ends);
}

void SpaceReader::restart(const Value& value) {
  end_ = read_end_of_run(report_, value, model_.file);
  if (!end_) return;
  const auto names_of = [](const auto& list) {
    std::vector<std::string> names;
    for (const auto& of : list) names.push_back(of.name);
    return names;
  };
  Restart restart = end_->restart;
  restart.load_factors = end_->numbers("loads", names_of(model_.loads));
  restart.support_factors = end_->numbers("supports", names_of(model_.supports));
  const std::vector<double> placed = end_->numbers("placed", names_of(model_.supports));
  for (std::size_t i = 0; i < placed.size(); ++i) model_.supports[i].placed = placed[i] != 0.0;
  const std::vector<double> tightened = end_->numbers("bars", names_of(model_.bodies));
  for (std::size_t b = 0; b < model_.bodies.size(); ++b)
    if (auto& preload = model_.bodies[b].preload; preload && tightened[b] < 0.0)
      preload->step = static_cast<int>(tightened[b]);
  std::vector<std::string> bars;
  for (const SpaceBar& bar : model_.bars) bars.push_back(bar.name_at_end());
  const std::vector<double> of_bars = end_->numbers("bars", bars);
  for (std::size_t i = 0; i < bars.size(); ++i)
    if (of_bars[i] < 0.0) model_.bars[i].tightened = static_cast<int>(of_bars[i]);
  model_.files.insert(model_.files.end(), end_->files.begin(), end_->files.end());
  model_.restart = std::move(restart);
}

Stay SpaceReader::stay_of(const Stages& of, const char* what) {
  Stay stay;
  if (of.added) stay.added = std::max(step_named(*of.added), 0);
  if (of.removed) {
    stay.removed = step_named(*of.removed);
    if (const auto wrong = wrong_removal(stay, model_.steps, model_.restart.has_value(), what))
      report_.error(*of.removed, *wrong);
  }
  return stay;
}

void SpaceReader::find_stages() {
  const std::size_t before = report_.count();
  for (std::size_t k = 0; k < stages_.size(); ++k) {
    const Stay stay = stay_of(stages_[k], "body");
    const std::size_t end = k + 1 < stages_.size() ? stages_[k + 1].first : model_.bodies.size();
    for (std::size_t b = stages_[k].first; b < end; ++b) model_.bodies[b].stay = stay;
  }
  for (const Stages& of : stages_of_supports_) {
    SpaceSupport& support = model_.supports[of.first];
    support.stay = stay_of(of, "support");
    if (report_.count() > before || support.on.body < 0) continue;
    const SpaceBody& body = body_at(support.on.body);
    const bool too_early = support.stay.added > 0 && support.stay.added < body.stay.added;
    if (const auto wrong = wrong_stay_on_body(support.stay, body.stay, body.name, model_.steps))
      report_.error(too_early || !of.removed ? *of.added : *of.removed, *wrong);
  }
  if (report_.count() == before) check_stages();
}

/// What acts on bodies while they are absent.
void SpaceReader::check_stages() {
  const std::vector<Step>& steps = model_.steps;
  const std::vector<double> none, &at_start = model_.restart ? model_.restart->load_factors : none;
  for (std::size_t i = 0; i < model_.loads.size(); ++i) {
    const SpaceLoad& load = model_.loads[i];
    if (load.on.body < 0) continue;
    const SpaceBody& body = body_at(load.on.body);
    if (const auto never = load_never_acts(load.name, i, body.name, body.stay, steps, at_start))
      report_.error(load.on.source, *never);
  }
  for (std::size_t i = 0; i < model_.supports.size(); ++i) {
    const SpaceSupport& support = model_.supports[i];
    if (support.on.body < 0) continue;
    const SpaceBody& body = body_at(support.on.body);
    const auto moves = [](const std::optional<double>& u) { return u.value_or(0.0) != 0.0; };
    if (std::none_of(support.displacement.begin(), support.displacement.end(), moves) &&
        std::none_of(support.rotation.begin(), support.rotation.end(), moves))
      continue;
    const bool by_itself = support.stay.added > body.stay.added;
    if (const auto early =
            displaced_too_early(support.name, i, std::max(support.stay.added, body.stay.added),
                                by_itself ? std::string("it") : fmt::format("body '{}'", body.name), steps))
      report_.error(support.on.source, *early);
  }
  for (const SpaceBody& body : model_.bodies)
    if (body.preload && body.preload->step >= 0 && !body.stay.is_there(body.preload->step))
      report_.error(body.preload->source,
                    fmt::format("is tightened in step '{}', in which body '{}' is not there: name another step by "
                                "'tightened'",
                                steps[static_cast<std::size_t>(body.preload->step)].name, body.name));
  for (std::size_t s = 0; s < steps.size() && !model_.bodies.empty(); ++s)
    if (std::none_of(model_.bodies.begin(), model_.bodies.end(),
                     [&](const SpaceBody& body) { return body.stay.is_there(static_cast<int>(s)); })) {
      report_.error(steps[s].source,
                    fmt::format("no body is there in step '{}': at least one is needed", steps[s].name));
      break;
    }
}

}  // namespace scabo::input
