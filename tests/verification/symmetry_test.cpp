// Lines of symmetry: edges on them are fixed along their normals.
#include <fmt/format.h>

#include "run.hpp"

namespace scabo::verification {
namespace {

// Uniform pressure on a sector of a disc between two lines of symmetry at any angle: the stress is -q everywhere, and
// u = -q (1 - nu) / E x in plane stress.
TEST(Symmetry, OfADiscUnderPressureAtAnyAngle) {
  const double E = 1e9, nu = 0.25, q = 1e6;
  for (const double scale : {1e-3, 1.0, 1e3})
    for (const char* mesh : {"order: 4", "kind: polygons", "kind: fem"}) {
      const Vec2 a(scale, 0.0), b(0.6 * scale, 0.8 * scale);
      const auto solution = run(fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: {}, poisson: {}}}}}
bodies:
  sector:
    material: stuff
    shape: {{polygon: {{vertices: [[0, 0], [{}, {}], [{}, {}]]}}}}
    mesh: {{size: {}, {}}}
supports: [{{symmetry: {{y: 0}}}}, {{symmetry: {{from: [0, 0], to: [3, 4]}}}}]
loads: {{all_round: {{on: sector.edge_2, pressure: {}}}}}
)",
                                            E, nu, a.x(), a.y(), b.x(), b.y(), 0.4 * scale, mesh, q));
      ASSERT_EQ(solution.model.supports.size(), 2U);
      EXPECT_EQ(solution.model.supports[0].name, "sector.edge_1");
      EXPECT_EQ(solution.model.supports[1].name, "sector.edge_3");
      const auto& nodes = solution.mesh.bodies[0].nodes;
      const Vector& u = last(solution).fields.displacements[0];
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Vec2 exact = -q * (1.0 - nu) / E * nodes[i];
        EXPECT_LT((u.segment<2>(static_cast<Eigen::Index>(2 * i)) - exact).norm(), 1e-10 * q / E * scale) << mesh;
      }
      EXPECT_NEAR(last(solution).reactions[1].norm(), q * scale, 1e-9 * q * scale);
    }
}

}  // namespace
}  // namespace scabo::verification
