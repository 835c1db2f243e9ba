// Cracks that grow: what of a mesh of polygons stays from step to step.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "verification/growth.hpp"

namespace scabo::verification {
namespace {

/// Bittencourt's beam of example 31.
std::string beam_with_three_holes(const std::string& kind) {
  return fmt::format(R"(scabo: 1
analysis: {{plane: stress, thickness: 0.5}}
materials: {{acrylic: {{young: 475e3, poisson: 0.35}}}}
bodies:
  beam:
    material: acrylic
    shape: {{polygon: {{vertices: [[-10, 0], [-9, 0], [9, 0], [10, 0], [10, 8], [0, 8], [-10, 8]]}}}}
    holes:
      low: {{circle: {{centre: [-4, 2.75], radius: 0.25}}}}
      middle: {{circle: {{centre: [-4, 4.75], radius: 0.25}}}}
      high: {{circle: {{centre: [-4, 6.75], radius: 0.25}}}}
    mesh: {{kind: {}, size: 0.6, refine: [{{on: low, size: 0.12}}, {{on: middle, size: 0.12}}]}}
    cracks: [{{path: [[-6, 0], [-6, 1]], name: notch}}]
supports: [{{on: beam.vertex_2, fix: [x, y]}}, {{on: beam.vertex_3, fix: [y]}}]
loads: {{P: {{on: beam.vertex_6, force: [0, -1]}}}}
steps: [{{growth: {{toughness: {{K_Ic: 1000}}, step: 0.15}}}}]
)",
                     kind);
}

using Place = std::pair<double, double>;

/// What one state is solved on.
struct Made {
  std::set<Place> nodes;
  std::set<std::shared_ptr<const element::SolvedSuperElement>> solved;
  std::size_t cells = 0;
  Vec2 tip = Vec2::Zero();
};

struct Grown {
  analysis::StaticSolution solution;
  std::vector<Made> made;  // of every state

  analysis::GrowthEnergy energy(std::size_t state) const { return growth_at(solution, state).energy.value(); }
};

Grown grown(const std::string& model) {
  Grown grown;
  analysis::Options options;
  options.on_increment = [&](const analysis::StaticSolution& solution, const analysis::IncrementResult& increment) {
    Made& made = grown.made.emplace_back();
    const mesh::BodyMesh& beam = solution.mesh.bodies.front();
    for (const Vec2& x : beam.nodes) made.nodes.emplace(x.x(), x.y());
    made.solved.insert(solution.cells.front().begin(), solution.cells.front().end());
    made.cells = beam.cells.size();
    made.tip = increment.growth->tips.front().position;
  };
  test::record_model(model, {});
  grown.solution = analysis::solve_static(input::parse_model(model, "test.yaml"), options);
  return grown;
}

double distance_to_piece(const Place& at, const Vec2& from, const Vec2& to) {
  const Vec2 x(at.first, at.second), along = to - from;
  return (x - from - std::clamp((x - from).dot(along) / along.squaredNorm(), 0.0, 1.0) * along).norm();
}

// Nodes a few elements away from the new piece of the crack, of the size that elements have there, are the same to the
// last bit before and after, so that the super-elements between them keep their solutions. The path is the one that
// squares have.
TEST(GrowthMeshes, PolygonsAwayFromTheNewPieceStay) {
  constexpr double step = 0.15;
  const Grown polygons = grown(beam_with_three_holes("polygons")), squares = grown(beam_with_three_holes("quadtree"));
  ASSERT_EQ(polygons.solution.outcome, analysis::Outcome::solved);
  ASSERT_EQ(polygons.made.size(), squares.made.size());
  ASSERT_EQ(polygons.made.size(), 27u);
  for (std::size_t k = 1; k < polygons.made.size(); ++k) {
    const Made &before = polygons.made[k - 1], &after = polygons.made[k];
    std::vector<Place> changed;
    std::set_symmetric_difference(before.nodes.begin(), before.nodes.end(), after.nodes.begin(), after.nodes.end(),
                                  std::back_inserter(changed));
    double elements = 0.0;  // away
    for (const Place& node : changed) {
      const double distance = distance_to_piece(node, before.tip, after.tip);
      elements = std::max(elements, distance / std::min(0.6, 0.5 * step + 0.3 * distance));
    }
    EXPECT_LT(elements, 4.0) << "state " << k + 1;
    const auto is_new = [&](const auto& one) { return before.solved.count(one) == 0; };
    const auto solved = std::count_if(after.solved.begin(), after.solved.end(), is_new);
    EXPECT_LT(static_cast<double>(solved), 0.15 * static_cast<double>(after.cells)) << "state " << k + 1;
    EXPECT_LT(std::abs(polygons.energy(k).remeshing / polygons.energy(k).integral), 0.003) << "state " << k + 1;
  }
  for (std::size_t k = 0; k < polygons.made.size(); ++k)
    EXPECT_LT((polygons.made[k].tip - squares.made[k].tip).norm(), 0.1 * step) << "state " << k + 1;
}

// Vertices along the way were laid finer, and do not stay so: the last mesh is about as large as one that is made at
// once for this crack, which has 4848 nodes.
TEST(GrowthMeshes, PolygonsBehindTheTipBecomeCoarserAgain) {
  const Grown polygons = grown(beam_with_three_holes("polygons"));
  EXPECT_LT(polygons.made.back().nodes.size(), 1.15 * 4848);
}

}  // namespace
}  // namespace scabo::verification
