#include "scabo/analysis/state/results.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/analysis/state/solution.hpp"

namespace scabo::analysis {

const element::InitialStress& FieldState::initial_of(std::size_t body) const {
  static const element::InitialStress none;
  return initial.empty() ? none : initial[body];
}

IncrementResult with_velocities(const IncrementResult& increment) {
  IncrementResult moving;
  moving.absent = increment.absent;
  moving.fields.interior.resize(increment.fields.displacements.size());
  for (std::size_t b = 0; b < increment.fields.interior.size(); ++b)
    if (const element::CellLoads& inside = increment.fields.interior[b];
        inside.size() == 1 && inside.front().motion.modes) {
      element::InteriorLoads& moves = moving.fields.interior[b].emplace_back();
      moves.motion = {inside.front().motion.modes, inside.front().motion.velocity};
    }
  moving.fields.displacements = increment.fields.velocities;
  if (increment.fields.velocities.empty())
    for (const Vector& u : increment.fields.displacements)
      moving.fields.displacements.emplace_back(Vector::Zero(u.size()));
  return moving;
}

bool IncrementResult::is_absent(int body) const { return std::binary_search(absent.begin(), absent.end(), body); }

double QuantityResult::relative() const {
  if (bar == 0.0) return 0.0;
  return value == 0.0 ? std::numeric_limits<double>::infinity() : bar / std::abs(value);
}

std::optional<Vec2> BodyMotion::centre() const {
  if (rotation == 0.0 || std::abs(rotation) * size <= 1e-6 * shift.norm()) return std::nullopt;  // as describe_motion()
  return Vec2(about + Vec2(-shift.y(), shift.x()) / rotation);
}

int Mechanism::present() const {
  return static_cast<int>(std::count_if(bodies.begin(), bodies.end(), [](const auto& body) { return body.present; }));
}

long rank(const BodyMotion& motion) { return std::lround(1e4 * motion.largest); }

int Mechanism::moving() const {
  return static_cast<int>(std::count_if(bodies.begin(), bodies.end(), [](const auto& body) { return body.moves(); }));
}

std::size_t Mechanism::most() const {
  std::size_t most = 0;
  for (std::size_t b = 1; b < bodies.size(); ++b)
    if (rank(bodies[b]) > rank(bodies[most])) most = b;
  return most;
}

}  // namespace scabo::analysis
