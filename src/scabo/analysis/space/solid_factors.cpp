#include "scabo/analysis/space/solid_factors.hpp"

#include "scabo/analysis/space/solid_stages.hpp"
#include "scabo/system/contact_laws.hpp"

namespace scabo::analysis {

namespace {

Vector vector_of(const std::vector<double>& of) {
  return Eigen::Map<const Vector>(of.data(), static_cast<Eigen::Index>(of.size()));
}

Vector between(const Vector& from, const Vector& to, double part) { return (1.0 - part) * from + part * to; }
/// Of parts of something, which stay as they are to the last bit.
Vector part_between(const Vector& from, const Vector& to, double part) { return from + part * (to - from); }

/// The coefficients of the contacts, before a step changes them.
Vector coefficients_at_start(const model::SpaceModel& model) {
  std::vector<model::Contact> laws;
  for (const model::SpaceContact& contact : model.contacts) laws.push_back(contact.law);
  return vector_of(system::coefficients_of(laws));
}

/// At the end of a step; -1: before the first.
SolidFactors factors_at_end(const model::SpaceModel& model, const PosedSolids& posed, int step) {
  SolidFactors factors;
  factors.step = step;
  factors.coefficients = coefficients_at_start(model);
  if (step >= 0) {
    const model::Step& of = model.steps[static_cast<std::size_t>(step)];
    factors.loads = vector_of(of.load_factors), factors.supports = vector_of(of.support_factors);
    if (const auto changed = model::coefficients_of(of); !changed.empty()) factors.coefficients = vector_of(changed);
  } else if (model.restart) {
    factors.loads = vector_of(model.restart->load_factors);
    factors.supports = vector_of(model.restart->support_factors);
  } else {
    factors.loads = Vector::Zero(static_cast<Eigen::Index>(model.loads.size()));
    factors.supports = Vector::Zero(static_cast<Eigen::Index>(model.supports.size()));
  }
  factors.fits = Vector::Ones(static_cast<Eigen::Index>(model.contacts.size()));
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    if (model.contacts[c].fit_in > step) factors.fits[static_cast<Eigen::Index>(c)] = 0.0;
  factors.tightened = Vector::Zero(static_cast<Eigen::Index>(posed.model.preloads.size()));
  for (std::size_t i = 0; i < posed.model.preloads.size(); ++i)
    if (model.bodies[static_cast<std::size_t>(posed.model.preloads[i].body)].preload->step <= step)
      factors.tightened[static_cast<Eigen::Index>(i)] = 1.0;
  factors.bars = Vector::Ones(static_cast<Eigen::Index>(model.bars.size()));
  for (std::size_t i = 0; i < model.bars.size(); ++i)
    if (model.bars[i].preload != 0.0 && model.bars[i].tightened > step)
      factors.bars[static_cast<Eigen::Index>(i)] = 0.0;
  factors.presence = presence_at(posed.model, step);
  return factors;
}

/// At part `t` of the step of `to`.
SolidFactors factors_in(const model::SpaceModel& model, const PosedSolids& posed, const SolidFactors& from,
                        const SolidFactors& to, double t) {
  const model::Step& step = model.steps[static_cast<std::size_t>(to.step)];
  SolidFactors factors{between(from.loads, to.loads, t), between(from.supports, to.supports, t)};
  const auto follow = [&](const std::vector<int>& curves, Vector& values) {
    for (std::size_t i = 0; i < curves.size(); ++i)
      if (curves[i] >= 0)
        values[static_cast<Eigen::Index>(i)] = model::value_of(model.curves[static_cast<std::size_t>(curves[i])], t);
  };
  follow(step.load_curves, factors.loads);
  follow(step.support_curves, factors.supports);
  if (!model::coefficients_of(step).empty()) factors.coefficients = between(from.coefficients, to.coefficients, t);
  factors.fits = part_between(from.fits, to.fits, t);
  factors.tightened = part_between(from.tightened, to.tightened, t);
  factors.bars = part_between(from.bars, to.bars, t);
  factors.step = to.step;
  if (to.presence.size() > 0) factors.presence = part_between(from.presence, to.presence, t);
  factors.release = takes_away(posed.model, to.step) ? 1.0 - t : 0.0;
  return factors;
}

}  // namespace

SolidFactors factors_at_start(const model::SpaceModel& model, const PosedSolids& posed) {
  return factors_at_end(model, posed, -1);
}

void add_steps(const model::SpaceModel& model, PosedSolids& posed) {
  SolidFactors from = factors_at_start(model, posed);
  for (std::size_t s = 0; s < model.steps.size(); ++s) {
    const model::Step& step = model.steps[s];
    SolidFactors to = factors_at_end(model, posed, static_cast<int>(s));
    for (int k = 1; k <= step.increments; ++k) {
      const double t =
          step.ends.empty() ? static_cast<double>(k) / step.increments : step.ends[static_cast<std::size_t>(k - 1)];
      posed.increments.push_back(factors_in(model, posed, from, to, t));
      posed.step_and_number.emplace_back(s, k);
    }
    from = std::move(to);
  }
}

}  // namespace scabo::analysis
