#include "scabo/analysis/state/step_factors.hpp"

#include <algorithm>

namespace scabo::analysis {

namespace {

/// Factors at the start of a step.
Factors start_of(const model::Model& model, std::size_t step) {
  const std::vector<double> presence = presence_at(model, static_cast<int>(step) - 1);
  const double release = takes_away(model, step) ? 1.0 : 0.0;
  if (step == 0 && model.restart)
    return {
        model.restart->load_factors, model.restart->support_factors, coefficients_at_start(model), presence, release,
        fits_at(model, -1),          preloads_at(model, -1)};
  if (step == 0)
    return {std::vector<double>(model.loads.size(), 0.0),
            std::vector<double>(model.supports.size(), 0.0),
            coefficients_at_start(model),
            presence,
            release,
            fits_at(model, -1),
            preloads_at(model, -1)};
  const model::Step& before = model.steps[step - 1];
  return {before.load_factors,
          before.support_factors,
          model::coefficients_of(before),
          presence,
          release,
          fits_at(model, static_cast<int>(step) - 1),
          preloads_at(model, static_cast<int>(step) - 1)};
}

}  // namespace

std::vector<double> presence_at(const model::Model& model, int step) {
  std::vector<double> presence;
  if (!model::has_stages(model.bodies)) return presence;
  for (const model::Body& body : model.bodies) presence.push_back(body.is_there(step) ? 1.0 : 0.0);
  return presence;
}

bool takes_away(const model::Model& model, std::size_t step) {
  const auto ends = [&](const auto& of) { return of.removed == static_cast<int>(step); };
  return std::any_of(model.bodies.begin(), model.bodies.end(), ends) ||
         std::any_of(model.supports.begin(), model.supports.end(), ends);
}

namespace {

/// Those of a step, held from its begin, where no curve has others. Supports are where they are at `time`.
template <typename ValueOf>
Factors held_in(const model::Model& model, std::size_t index, double time, const ValueOf& value_of_curve) {
  const model::Step& step = model.steps[index];
  const auto number = static_cast<int>(index);
  Factors factors{
      step.load_factors,      step.support_factors,      model::coefficients_of(step), presence_at(model, number), 0.0,
      fits_at(model, number), preloads_at(model, number)};
  const auto follow = [&](const std::vector<int>& curves, std::vector<double>& of, const auto& value) {
    for (std::size_t i = 0; i < curves.size(); ++i)
      if (curves[i] >= 0) of[i] = value(model.curves[static_cast<std::size_t>(curves[i])]);
  };
  follow(step.load_curves, factors.loads, value_of_curve);
  follow(step.support_curves, factors.supports,
         [&](const model::Curve& curve) { return model::displacement_at(curve, time, step.dynamic->duration); });
  return factors;
}

}  // namespace

Factors factors_at_time(const model::Model& model, std::size_t step, double time) {
  const double duration = model.steps[step].dynamic->duration;
  return held_in(model, step, time, [&](const model::Curve& curve) { return model::value_at(curve, time, duration); });
}

Factors mean_factors(const model::Model& model, std::size_t step, double from, double to) {
  const double duration = model.steps[step].dynamic->duration;
  return held_in(model, step, to,
                 [&](const model::Curve& curve) { return model::mean_between(curve, from, to, duration); });
}

double ground_velocity(const model::Model& model, std::size_t index, double s, std::size_t axis) {
  double velocity = model.restart && model.restart->motion ? model.restart->motion->ground[axis] : 0.0;
  for (std::size_t i = 0; i <= index; ++i) {
    const auto& dynamic = model.steps[i].dynamic;
    if (!dynamic || dynamic->ground[axis] < 0) continue;
    const model::Curve& acceleration = model.curves[static_cast<std::size_t>(dynamic->ground[axis])];
    const double time = i == index ? s * dynamic->duration : dynamic->duration;
    velocity += model::ground_motion(acceleration, dynamic->duration, time).velocity;
  }
  return velocity;
}

Factors factors_in(const model::Model& model, std::size_t index, double s) {
  const model::Step& step = model.steps[index];
  if (step.dynamic) return factors_at_time(model, index, s * step.dynamic->duration);
  Factors factors = between(start_of(model, index),
                            {step.load_factors, step.support_factors, model::coefficients_of(step),
                             presence_at(model, static_cast<int>(index)), 0.0, fits_at(model, static_cast<int>(index)),
                             preloads_at(model, static_cast<int>(index))},
                            s);
  if (s == 1.0) return factors;  // those of the curves
  const auto follow = [&](const std::vector<int>& curves, std::vector<double>& of) {
    for (std::size_t i = 0; i < curves.size(); ++i)
      if (curves[i] >= 0) of[i] = model::value_of(model.curves[static_cast<std::size_t>(curves[i])], s);
  };
  follow(step.load_curves, factors.loads);
  follow(step.support_curves, factors.supports);
  return factors;
}

}  // namespace scabo::analysis
