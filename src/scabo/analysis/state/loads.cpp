#include "scabo/analysis/state/loads.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/base/components.hpp"
#include "scabo/linalg/twofold.hpp"
#include "scabo/system/contact_laws.hpp"
#include "scabo/system/sliding_sides.hpp"

namespace scabo::analysis {

namespace {

/// Resultants up to this part of the sum of all forces on a part are rounding of that sum; far below the tolerance of
/// the certificate, 1e-10.
constexpr double rounding_of_sums = 1e-12;

/// Sum of the sizes of all forces on part `p`.
double sum_of_loads(const Prepared& prepared, std::size_t p, const Factors& factors,
                    const std::vector<Vector>& released) {
  double sum = 0.0;
  for (std::size_t load = 0; load < factors.loads.size(); ++load)
    if (prepared.structure.loads[load][p].size() > 0)
      sum += std::abs(factors.loads[load]) * prepared.structure.loads[load][p].lpNorm<1>();
  if (!released.empty()) sum += released[p].lpNorm<1>();
  if (const Vector entered = entered_forces(prepared, factors); entered.size() > 0)
    sum += (prepared.contact.motion[p].transpose() * entered).lpNorm<1>();
  for (std::size_t b = 0; b < factors.preloads.size(); ++b)
    if (const Vector& pull = prepared.structure.bars[b].pull[p]; pull.size() > 0)
      sum += std::abs(preload_of(prepared, factors, b)) * pull.lpNorm<1>();
  return sum;
}

/// [load][part]: where they are now, of loads that move and act; empty of all others.
std::vector<std::vector<Vector>> moving_forces(const Prepared& prepared, const Factors& factors) {
  std::vector<std::vector<Vector>> forces(factors.loads.size());
  for (std::size_t load = 0; load < factors.loads.size(); ++load)
    if (prepared.model.loads[load].moving && factors.loads[load] != 0.0)
      forces[load] = system::forces_of_moving_load(prepared.structure, prepared.model, prepared.mesh,
                                                   prepared.discretisation.cells, load, factors.time);
  return forces;
}

}  // namespace

bool may_enter(const Prepared& prepared) {
  const auto& entering = prepared.structure.entering;
  return std::any_of(entering.begin(), entering.end(), [](const auto& of_load) { return !of_load.empty(); });
}

Vector entered_forces(const Prepared& prepared, const Factors& factors) {
  if (factors.entered.empty()) return {};
  Vector forces = Vector::Zero(2 * static_cast<Eigen::Index>(prepared.contact.pairs.size()));
  for (std::size_t load = 0; load < factors.loads.size(); ++load)
    for (const system::EnteringPressure& fluid : prepared.structure.entering[load])
      for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
        const system::ContactSystem::Pair& pair = prepared.contact.pairs[i];
        if (pair.contact == fluid.contact)
          forces[place_of(i)] += factors.entered[i] * factors.loads[load] * fluid.forces[pair.index];
      }
  return forces;
}

Vec2 gravity_on(const Prepared& prepared, const Factors& factors, int body) {
  Vec2 acceleration = Vec2::Zero();
  for (std::size_t load = 0; load < factors.loads.size(); ++load) {
    const model::Load& of = prepared.model.loads[load];
    const auto* gravity = std::get_if<model::Gravity>(&of.kind);
    if (gravity && (!of.on || of.on->body == body)) acceleration += factors.loads[load] * gravity->value;
  }
  return presence_of(prepared, factors, prepared.structure.dofs.part_of(body)) * acceleration;
}

double preload_of(const Prepared& prepared, const Factors& factors, std::size_t bar) {
  return factors.preloads.empty() ? 0.0 : factors.preloads[bar] * prepared.model.bars[bar].preload;
}

double presence_of(const Prepared& prepared, const Factors& factors, std::size_t p) {
  if (prepared.is_absent(p)) return 0.0;
  if (factors.presence.empty()) return 1.0;
  return factors.presence[static_cast<std::size_t>(prepared.structure.dofs.bodies_of(p).front())];
}

Factors between(const Factors& from, const Factors& to, double part) {
  if (part == 1.0) return to;
  Factors factors = to;
  for (std::size_t i = 0; i < to.loads.size(); ++i)
    factors.loads[i] = from.loads[i] + part * (to.loads[i] - from.loads[i]);
  for (std::size_t i = 0; i < to.supports.size(); ++i)
    factors.supports[i] = from.supports[i] + part * (to.supports[i] - from.supports[i]);
  for (std::size_t i = 0; i < to.friction.size(); ++i)
    factors.friction[i] = from.friction[i] + part * (to.friction[i] - from.friction[i]);
  for (std::size_t b = 0; b < to.presence.size(); ++b)
    factors.presence[b] = from.presence[b] + part * (to.presence[b] - from.presence[b]);
  for (std::size_t c = 0; c < to.fits.size(); ++c) factors.fits[c] = from.fits[c] + part * (to.fits[c] - from.fits[c]);
  for (std::size_t b = 0; b < to.preloads.size(); ++b)
    factors.preloads[b] = from.preloads[b] + part * (to.preloads[b] - from.preloads[b]);
  factors.release = from.release + part * (to.release - from.release);
  return factors;
}

contact::JointLaws laws_at(const Prepared& prepared, const Factors& factors) {
  return system::with_coefficients(prepared.contact.laws, prepared.contact.pairs, prepared.model.contacts,
                                   factors.friction);
}

std::vector<double> coefficients_at_start(const model::Model& model) {
  if (model.steps.empty() || model.steps.front().friction.empty()) return {};
  return system::coefficients_of(model.contacts);
}

double gap_at(const Prepared& prepared, const Factors& factors, Eigen::Index i) {
  const double gap = prepared.contact.gap[i];
  const system::ContactSystem::Pair& pair = prepared.contact.pairs[static_cast<std::size_t>(i)];
  if (pair.is_bar()) {  // a held point moves by what its support prescribes
    const auto& held = prepared.structure.bars[static_cast<std::size_t>(pair.index)].held;
    return held ? gap - held->value * factors.supports[static_cast<std::size_t>(held->support)] : gap;
  }
  if (gap >= 0.0 || factors.fits.empty()) return gap;
  return gap * factors.fits[static_cast<std::size_t>(pair.contact)];
}

std::vector<double> fits_at(const model::Model& model, int step) {
  std::vector<double> fits;
  for (const model::Contact& contact : model.contacts) fits.push_back(contact.fit_in <= step ? 1.0 : 0.0);
  const bool any = std::any_of(model.contacts.begin(), model.contacts.end(),
                               [](const model::Contact& contact) { return contact.fit_in >= 0; });
  return any ? fits : std::vector<double>();
}

std::vector<double> preloads_at(const model::Model& model, int step) {
  std::vector<double> preloads;
  for (const model::Bar& bar : model.bars) preloads.push_back(bar.tightened <= step ? 1.0 : 0.0);
  const bool any =
      std::any_of(model.bars.begin(), model.bars.end(), [](const model::Bar& bar) { return bar.preload != 0.0; });
  return any ? preloads : std::vector<double>();
}

void take_out_rounding(const Matrix& rigid, double sum, Vector& forces) {
  Vector resultants(rigid.cols());
  for (Eigen::Index k = 0; k < rigid.cols(); ++k) {
    linalg::Twofold work;  // of many small forces, as weight, a sum in working precision is rounding itself
    for (Eigen::Index i = 0; i < forces.size(); ++i)
      if (forces[i] != 0.0) work = work + linalg::exact_product(rigid(i, k), forces[i]);
    resultants[k] = work.high;
  }
  for (double& resultant : resultants)
    if (std::abs(resultant) > rounding_of_sums * sum) resultant = 0.0;
  if (resultants.isZero(0.0)) return;
  system::add_resultants(rigid, -resultants, forces);
}

std::vector<Vector> applied_forces(const Prepared& prepared, const Factors& factors,
                                   const std::vector<Vector>& released) {
  std::vector<Vector> forces;
  for (const auto& part : prepared.structure.parts) forces.push_back(Vector::Zero(part->size()));
  const std::vector<std::vector<Vector>> moving = moving_forces(prepared, factors);
  const Vector entered = entered_forces(prepared, factors);
  for (std::size_t p = 0; p < forces.size(); ++p) {
    const double presence = presence_of(prepared, factors, p);
    if (presence == 0.0) continue;
    for (std::size_t load = 0; load < factors.loads.size(); ++load) {
      const Vector& of = moving[load].empty() ? prepared.structure.loads[load][p] : moving[load][p];
      if (of.size() > 0) forces[p] += presence * factors.loads[load] * of;
    }
    for (std::size_t b = 0; b < factors.preloads.size(); ++b)
      if (const Vector& pull = prepared.structure.bars[b].pull[p]; pull.size() > 0)
        forces[p] += preload_of(prepared, factors, b) * pull;
    if (entered.size() > 0) forces[p] += prepared.contact.motion[p].transpose() * entered;
    if (!released.empty() && released[p].size() > 0 && factors.release != 0.0)
      forces[p] += factors.release * released[p];
    if (const Matrix& rigid = prepared.structure.parts[p]->rigid_motions(); rigid.cols() > 0)
      take_out_rounding(rigid, sum_of_loads(prepared, p, factors, released), forces[p]);
  }
  return forces;
}

Vector loads_on_motions(const Prepared& prepared, std::size_t p, const State& state) {
  const double sum = sum_of_loads(prepared, p, state.factors, state.released);
  Vector f = prepared.structure.parts[p]->rigid_motions().transpose() * state.forces[p];
  for (double& resultant : f)
    if (std::abs(resultant) <= rounding_of_sums * sum) resultant = 0.0;
  return f;
}

std::vector<Vector> prescribed_values(const Prepared& prepared, const std::vector<double>& factors,
                                      const std::vector<Vec2>& moved) {
  std::vector<Vector> values;
  for (std::size_t p = 0; p < prepared.structure.parts.size(); ++p) {
    const auto& part = prepared.structure.parts[p];
    Vector value = Vector::Zero(static_cast<Eigen::Index>(part->constraints().size()));
    for (std::size_t c = 0; c < part->constraints().size() && !prepared.is_absent(p); ++c) {
      const system::Constraint& constraint = part->constraints()[c];
      double& of = value[static_cast<Eigen::Index>(c)];
      of = constraint.value * factors[static_cast<std::size_t>(constraint.support)];
      if (!moved.empty() && !constraint.rotation) of -= constraint.direction().dot(moved[values.size()]);
    }
    values.push_back(std::move(value));
  }
  return values;
}

}  // namespace scabo::analysis
