#include "scabo/analysis/state/cracks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <numbers>

#include "scabo/mesh/plane/crack_faces.hpp"
#include "scabo/model/side_faces.hpp"

namespace scabo::analysis {

namespace {

/// Distance from an exponent within which a load is in resonance with it.
constexpr double resonance = 1e-4;
/// The exponents of a crack are 1/2; larger deviations of the computed ones show that the boundary is too coarse.
constexpr double poor_exponent = 1e-3;

/// Whether an active load has the exponent of a singular mode. The stress then grows like that of the mode times
/// ln(xi), and the factor of the mode has no limit.
bool in_resonance(const element::StressIntensity& factors, const std::vector<element::RadialLoad>& loads) {
  return std::any_of(loads.begin(), loads.end(), [&](const element::RadialLoad& load) {
    return load.g.norm() + load.c.norm() > 0.0 &&
           std::any_of(factors.exponents.begin(), factors.exponents.end(), [&](const std::complex<double>& exponent) {
             return std::abs(exponent - load.power) < resonance;
           });
  });
}

/// Cells at the tips of cracks whose faces are in contact or held, and the cracks. They are the innermost of many
/// rings, so small that T is lost in the discretised singular field, and without the contact's tractions on their own
/// faces.
std::map<std::size_t, int> tips_in_rings(const Discretisation& discretisation, std::size_t body) {
  std::map<std::size_t, int> cells;
  const std::vector<int> cracks = mesh::cracks_with_tractions(discretisation.model, static_cast<int>(body));
  if (cracks.empty()) return cells;
  for (const mesh::TipFace& tip : mesh::tip_faces(discretisation.model.bodies[body], discretisation.mesh.bodies[body]))
    if (std::find(cracks.begin(), cracks.end(), tip.crack) != cracks.end()) cells[tip.cell] = tip.crack;
  return cells;
}

/// Tractions at the tip of a closed crack.
struct TipTraction {
  double pressure = 0.0, shear = 0.0;                         ///< of the pairs nearest to it, in the mean; magnitudes
  contact::ContactState state = contact::ContactState::open;  ///< of the nearest one
};
TipTraction traction_at(const Discretisation& discretisation, const IncrementResult& increment, std::size_t body,
                        int crack, const Vec2& tip) {
  constexpr std::size_t several = 5;  // because they swing by a few per cent about their mean
  std::vector<std::pair<double, const PairResult*>> pairs;
  for (std::size_t c = 0; c < increment.contacts.size(); ++c) {
    const model::Place& side = discretisation.model.contacts[c].a;
    if (side.kind != model::Place::Kind::face || side.body != static_cast<int>(body) || side.index / 2 != crack)
      continue;
    for (const PairResult& pair : increment.contacts[c].pairs) pairs.emplace_back((pair.position - tip).norm(), &pair);
  }
  TipTraction traction;
  if (pairs.empty()) return traction;
  const auto count = std::min(several, pairs.size());
  std::partial_sort(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(count), pairs.end());
  traction.state = pairs.front().second->state;
  for (std::size_t k = 0; k < count; ++k) {
    traction.pressure += pairs[k].second->pressure / static_cast<double>(count);
    traction.shear += std::abs(pairs[k].second->shear) / static_cast<double>(count);
  }
  return traction;
}

/// Adds what the tractions of a closed crack, p and s, would do on the innermost faces, of length d, which are free of
/// them: sqrt(pi d / 2) times the traction (a crack of length d). That holds for s where the faces slide too: friction
/// of what the pressure is more beside the innermost faces (system/tributary_lengths.hpp) is there already, and
///
///     2 sqrt(2 d / pi) - sqrt(2 / pi) integral from d to infinity of
///         ((r - d / 2) / sqrt(r (r - d)) - 1) / sqrt(r) dr = sqrt(pi d / 2)
///
/// Friction opposes the slip.
void add_innermost_tractions(element::StressIntensity& factors, const TipTraction& at, double d) {
  if (at.state == contact::ContactState::open) return;
  const double before = std::hypot(factors.K_I, factors.K_II), per_traction = std::sqrt(0.5 * std::numbers::pi * d);
  factors.K_I += at.pressure * per_traction;
  factors.K_II -= std::copysign(at.shear * per_traction, factors.K_II);
  const double ratio = before > 0.0 ? std::pow(std::hypot(factors.K_I, factors.K_II) / before, 2) : 1.0;
  if (factors.G) *factors.G *= ratio;
  if (factors.J) *factors.J *= ratio;
}

void take_back(element::StressIntensity& factors) {
  factors.K_I = factors.K_II = std::numeric_limits<double>::quiet_NaN();
  factors.T_left.reset(), factors.T_right.reset(), factors.G.reset(), factors.J.reset();
  for (element::CornerTerm& term : factors.terms) {
    term.factors.setConstant(std::numeric_limits<double>::quiet_NaN());
    term.limit.reset();
  }
}

bool resolved(const element::StressIntensity& factors) {
  if (factors.kind == element::CornerKind::corner) return true;  // its theoretical exponents are not known
  return factors.exponents.size() == 2 &&
         std::all_of(factors.exponents.begin(), factors.exponents.end(), [](const std::complex<double>& exponent) {
           return std::abs(exponent.real() - 0.5) <= poor_exponent;
         });
}

}  // namespace

std::string name_of_tip(const model::Body& body, const Vec2& tip) {
  for (const model::Crack& crack : body.cracks) {
    if (crack.path.empty()) return body.name + "." + crack.name;
    const double size = (crack.path.back() - crack.path.front()).norm();
    const bool start = (crack.path.front() - tip).norm() <= 1e-9 * size;
    if (start || (crack.path.back() - tip).norm() <= 1e-9 * size)
      return body.name + "." + crack.name + (start ? ".start" : ".end");
  }
  if (!body.cracks.empty()) return body.name;
  if (body.mesh.centre_corner < 0) return body.name;
  return body.name + "." + model::name_of_centre_corner(body);
}

std::vector<Warning> crack_warnings(const std::vector<CrackResult>& cracks) {
  std::vector<Warning> warnings;
  for (const CrackResult& crack : cracks) {
    if (crack.held)
      warnings.push_back(
          {WarningKind::crack, crack.name + " held",
           fmt::format("a support holds a face of '{}', so that the stress at its tip is not that between free faces: "
                       "the stress intensity factors are undefined",
                       crack.name)});
    else if (std::isnan(crack.factors.K_I))
      warnings.push_back(
          {WarningKind::crack, crack.name + " resonance",
           fmt::format(
               "the load on the faces of '{}' has the same singularity at the tip as the stress (resonance), so "
               "that the stress has an additional factor ln(r): the stress intensity factors are undefined",
               crack.name)});
    if (crack.held || resolved(crack.factors)) continue;
    std::string list;
    for (const std::complex<double>& exponent : crack.factors.exponents)
      list += fmt::format("{}{:.4g}", list.empty() ? "" : ", ", exponent.real());
    warnings.push_back(
        {WarningKind::crack, crack.name,
         fmt::format("the singular stress of '{}' is not resolved: the computed exponents are {} "
                     "instead of 0.5 twice, and the stress intensity factors have errors of the same size; use a "
                     "smaller mesh size, a higher order, or a tip farther from the boundary",
                     crack.name, list)});
  }
  return warnings;
}

namespace {

/// Factors of a tip or corner. An internal level moves the inside besides the boundary
/// (element/sbfem/internal_level.hpp): on the ring at a small xi, its motion divided by xi^(1/2) has the K of a motion
/// of the boundary, and divided by xi its T-stress, but for parts of xi^2 and xi^(3/2).
element::StressIntensity factors_of(const element::SolvedSuperElement& cell, const Vector& u,
                                    const element::InteriorLoads& interior) {
  element::StressIntensity factors = cell.factors(u, interior.loads);
  if (!interior.motion.modes || factors.kind != element::CornerKind::crack) return factors;
  constexpr double near = 1e-4;
  const element::RadialField inside(cell.solution(), cell.modes(), Vector::Zero(u.size()), {}, interior.motion);
  const Vector moved = inside.at(near).u;
  factors = cell.factors(u + moved / std::sqrt(near), interior.loads);
  factors.T_left = cell.factors(u + moved / near, interior.loads).T_left;
  return factors;
}

}  // namespace

std::vector<CrackResult> crack_results(const Discretisation& discretisation, const IncrementResult& increment) {
  std::vector<CrackResult> results;
  for (std::size_t b = 0; b < discretisation.cells.size(); ++b) {
    if (increment.is_absent(static_cast<int>(b))) continue;
    const std::map<std::size_t, int> touching = tips_in_rings(discretisation, b);
    const std::vector<int> held = mesh::cracks_held(discretisation.model, static_cast<int>(b));
    for (std::size_t c = 0; c < discretisation.cells[b].size(); ++c) {
      const auto& super_element = discretisation.cells[b][c];
      if (!super_element || super_element->domain.unbounded || !super_element->ring.is_open()) continue;
      const element::InteriorLoads& interior = element::loads_in(increment.fields.interior[b], c);
      const std::vector<element::RadialLoad>& loads = interior.loads;
      const Vector u = increment.fields.displacements[b](element::dofs_of(discretisation.mesh.bodies[b].cells[c]));
      results.push_back({name_of_tip(discretisation.model.bodies[b], discretisation.mesh.bodies[b].cells[c].centre),
                         factors_of(*super_element, u, interior)});
      element::StressIntensity& factors = results.back().factors;
      if (!increment.fields.initial_of(b).is_zero()) factors.T_left.reset(), factors.T_right.reset();
      if (const auto tip = touching.find(c); tip != touching.end()) {
        factors.T_left.reset(), factors.T_right.reset();
        const mesh::Cell& cell = discretisation.mesh.bodies[b].cells[c];
        const Vec2& end =
            discretisation.mesh.bodies[b].nodes[static_cast<std::size_t>(cell.boundary.back().nodes.back())];
        add_innermost_tractions(factors, traction_at(discretisation, increment, b, tip->second, cell.centre),
                                (end - cell.centre).norm());
        const bool symmetric = super_element->held && super_element->held->mirror >= 0;
        results.back().held = !symmetric && std::find(held.begin(), held.end(), tip->second) != held.end();
        if (results.back().held) take_back(factors);
      }
      if (in_resonance(factors, loads)) take_back(factors);
    }
  }
  return results;
}

}  // namespace scabo::analysis
