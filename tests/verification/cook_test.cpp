// Cook's membrane: E = 1, nu = 1/3, plane stress, a total shear of 1 on the right edge. Deflection of the middle of
// that edge, 23.966 where it is quoted as converged (e.g. Fredriksson, Ottosen 2004); 23.9677 here, by two meshes.
#include "cook.hpp"

#include "run.hpp"
#include "scabo/result/probe.hpp"

namespace scabo::verification {
namespace {

TEST(CooksMembrane, DeflectsAsPublished) {
  const auto deflection = [](const analysis::StaticSolution& solution) {
    return result::Probe(solution, last(solution).fields, 0).at({48, 52})->displacement.y();
  };
  const double equal = deflection(run(cooks_membrane, {"bodies.panel.mesh.size=4", "bodies.panel.mesh.order=6"}));
  const double refined = deflection(run(cooks_membrane, {"bodies.panel.mesh.tolerance=3e-4"}));
  std::cout.precision(8);
  std::cout << "equal elements " << equal << ", refined " << refined << "\n";
  EXPECT_NEAR(equal, 23.966, 2.5e-3);
  EXPECT_NEAR(refined, 23.966, 2.5e-3);
  EXPECT_NEAR(refined, equal, 1e-3);
}

}  // namespace
}  // namespace scabo::verification
