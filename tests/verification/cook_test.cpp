// Cook's membrane: E = 1, nu = 1/3, plane stress, a total shear of 1 on the right edge. Deflection of the middle of
// that edge, 23.966 where it is quoted as converged (e.g. Fredriksson, Ottosen 2004); 23.9677 here, by two meshes.
#include "run.hpp"
#include "scabo/result/probe.hpp"

namespace scabo::verification {
namespace {

TEST(CooksMembrane, DeflectsAsPublished) {
  const char* const cook = R"(
scabo: 1
materials: {panel: {young: 1000, poisson: 0.333333333333333333}}
bodies:
  panel:
    material: panel
    shape: {polygon: {vertices: [[0, 0], [48, 44], [48, 60], [0, 44]]}}
    mesh: {size: 11, order: 2}
supports: [{on: panel.edge_4, fix: [x, y]}]
loads: {shear: {on: panel.edge_2, force: [0, 1]}}
)";
  const auto deflection = [](const analysis::StaticSolution& solution) {
    return 1000 * result::Probe(solution, last(solution), 0).at({48, 52})->displacement.y();
  };
  const double equal = deflection(run(cook, {"bodies.panel.mesh.size=4", "bodies.panel.mesh.order=6"}));
  const double refined = deflection(run(cook, {"bodies.panel.mesh.tolerance=3e-4"}));
  std::cout.precision(8);
  std::cout << "equal elements " << equal << ", refined " << refined << "\n";
  EXPECT_NEAR(equal, 23.966, 2.5e-3);
  EXPECT_NEAR(refined, 23.966, 2.5e-3);
  EXPECT_NEAR(refined, equal, 1e-3);
}

}  // namespace
}  // namespace scabo::verification
