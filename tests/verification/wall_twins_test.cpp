// Twins of a wall of 1,266 pairs near its limit load, to whose equilibrium a path leads
// (docs/methods/12_contact_solver.md): in other units, turned, mirrored, in another order. Of each every block is
// balanced by hand.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "blocks.hpp"
#include "run.hpp"

namespace scabo::verification {
namespace {

/// What acts between two blocks in a point, as in the wall in metres that stands upright and is pushed from the left:
/// the force on the second one and its motion away from the first.
struct Touch {
  std::string first, second;
  Vec2 at, normal, force, motion;
};

struct Twin {
  Blocks blocks;
  analysis::StaticSolution solution;
  std::map<std::tuple<std::string, std::string, long, long>, Touch> touches;
  double largest_force = 0.0, largest_motion = 0.0;

  Vec2 upright(const Vec2& v) const {
    const double angle = blocks.angle * std::acos(-1.0) / 180.0, c = std::cos(angle), s = std::sin(angle);
    const Vec2 turned_back(c * v.x() + s * v.y(), c * v.y() - s * v.x());
    return {blocks.mirrored ? -turned_back.x() : turned_back.x(), turned_back.y()};
  }

  Twin(const Blocks& of, double push) : blocks(of), solution(run(model_of(of, push, 1))) {
    const auto name_of = [&](const auto& side) {
      return solution.model.bodies[static_cast<std::size_t>(side.body)].name;
    };
    for (std::size_t c = 0; c < solution.model.contacts.size(); ++c)
      for (const analysis::PairResult& pair : contact_of(last(solution), c).pairs) {
        const Vec2 n = pair.normal, t(n.y(), -n.x());
        const double sign = blocks.reversed ? -1.0 : 1.0;
        Touch touch{name_of(solution.model.contacts[c].a),
                    name_of(solution.model.contacts[c].b),
                    upright(pair.position) / blocks.unit,
                    sign * upright(n),
                    sign * upright(pair.normal_force * n + pair.tangential_force * t),
                    sign * upright(pair.gap * n + pair.slip * t) / blocks.unit};
        if (blocks.reversed) std::swap(touch.first, touch.second);
        largest_force = std::max(largest_force, touch.force.norm());
        largest_motion = std::max(largest_motion, pair.displacement_b.norm() / blocks.unit);
        touches.emplace(
            std::tuple(touch.first, touch.second, std::lround(4.0 * touch.at.x()), std::lround(4.0 * touch.at.y())),
            touch);
      }
  }
};

/// Force and moment left over on each block, and what it would be on the floor.
void balances(const Twin& twin, double push) {
  std::map<std::string, Vec2> force, middle;
  std::map<std::string, double> moment;
  const double height = twin.blocks.height(), weight = twin.blocks.weight();
  for (int z = 0; z < twin.blocks.courses; ++z) {
    const auto spans = spans_of_course(twin.blocks, z);
    for (std::size_t k = 0; k < spans.size(); ++k) {
      const auto [left, right] = spans[k];
      const std::string name = fmt::format("b{}_{}", z, k);
      middle[name] = Vec2(0.5 * (left + right), (z + 0.5) * height);
      force[name] = Vec2(k == 0 ? push * height : 0.0, -weight_per_volume * (right - left) * height);
    }
  }
  middle["floor"] = Vec2::Zero();
  force["floor"] = Vec2(-push * twin.blocks.whole_height(), weight);  // what it takes
  moment["floor"] = weight * 0.5 * twin.blocks.width() + push * 0.5 * std::pow(twin.blocks.whole_height(), 2);
  for (const auto& [key, touch] : twin.touches)
    for (const auto& [body, sign] : {std::pair(touch.first, -1.0), std::pair(touch.second, 1.0)}) {
      const Vec2 arm = touch.at - middle.at(body), acts = sign * touch.force;
      force[body] += acts;
      moment[body] += arm.x() * acts.y() - arm.y() * acts.x();
    }
  double left_of_forces = 0.0, left_of_moments = 0.0;
  for (const auto& [body, left] : force) {
    left_of_forces = std::max(left_of_forces, left.norm());
    left_of_moments = std::max(left_of_moments, std::abs(moment[body]));
  }
  EXPECT_LT(left_of_forces, 1e-9 * weight);
  EXPECT_LT(left_of_moments, 1e-9 * weight * twin.blocks.width());
}

/// No pair pulls, is penetrated, presses across a gap, has more friction than it may, or slips with less or along it.
/// Half of the work of friction by hand is what the run says, and with the elastic energy the work of the loads.
void obeys_the_laws(const Twin& twin) {
  const double F = twin.largest_force, U = twin.largest_motion, mu = twin.blocks.friction;
  double worst = 0.0, friction = 0.0;
  for (const auto& [key, touch] : twin.touches) {
    const Vec2 t(touch.normal.y(), -touch.normal.x());
    const double p_n = touch.force.dot(touch.normal) / F, p_t = touch.force.dot(t) / F,
                 gap = touch.motion.dot(touch.normal) / U, slip = touch.motion.dot(t) / U;
    worst = std::max({worst, -p_n, -gap, std::abs(p_n * gap), std::abs(p_t) - mu * p_n, p_t * slip,
                      std::abs(slip) * (mu * p_n - std::abs(p_t))});
    friction -= 0.5 * p_t * slip * F * U;
  }
  EXPECT_LT(worst, 1e-9);
  const auto& energy = last(twin.solution).energy;
  EXPECT_NEAR(energy.friction / twin.blocks.unit, friction, 1e-9 * friction);
  EXPECT_NEAR(energy.external, energy.elastic + energy.friction, 1e-9 * energy.external);
}

TEST(Wall, HasTheSameForcesAsItsTwins) {
  const Blocks upright{12, 12, 0.6};
  const double push = 0.95 * upright.collapse_push();
  const Twin wall(upright, push);
  EXPECT_GT(wall.touches.size(), 1000u);
  balances(wall, push);
  obeys_the_laws(wall);
  const auto with = [&](double unit, double angle, bool mirrored, bool reversed) {
    Blocks blocks = upright;
    blocks.unit = unit, blocks.angle = angle, blocks.mirrored = mirrored, blocks.reversed = reversed;
    return blocks;
  };
  std::vector<Blocks> others = {with(1024.0, 0.0, false, false), with(1e-3, 30.0, true, false),
                                with(1.0, 0.0, true, true)};
  if (std::getenv("SCABO_LONG"))  // what the second one does at once, alone
    others.insert(others.end(), {with(1e3, 0.0, false, false), with(1.0, 137.0, false, false)});
  for (const Blocks& blocks : others) {
    SCOPED_TRACE(fmt::format("unit {}, turned by {}{}{}", blocks.unit, blocks.angle,
                             blocks.mirrored ? ", mirrored" : "", blocks.reversed ? ", reversed" : ""));
    const Twin twin(blocks, push);
    balances(twin, push);
    obeys_the_laws(twin);
    ASSERT_EQ(twin.touches.size(), wall.touches.size());
    double force_error = 0.0, motion_error = 0.0;
    for (const auto& [key, touch] : wall.touches) {
      const Touch& other = twin.touches.at(key);
      force_error = std::max(force_error, (other.force - touch.force).norm());
      motion_error = std::max(motion_error, (other.motion - touch.motion).norm());
    }
    EXPECT_LT(force_error, 1e-8 * wall.largest_force);
    EXPECT_LT(motion_error, 1e-8 * wall.largest_motion);
    EXPECT_NEAR(last(twin.solution).energy.external / blocks.unit, last(wall.solution).energy.external,
                1e-8 * last(wall.solution).energy.external);
    if (blocks.unit == 1024.0) {  // only exponents differ
      EXPECT_EQ(force_error, 0.0);
      EXPECT_EQ(motion_error, 0.0);
    }
  }
}

}  // namespace
}  // namespace scabo::verification
