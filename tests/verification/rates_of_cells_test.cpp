// Rates of convergence in the energy norm of bodies of polygons and of quadtrees: p with edges of order p, for smooth
// solutions and, on graded meshes, for singular ones.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

#include "scabo/element/cell_library.hpp"
#include "scabo/mesh/mesh.hpp"
#include "scabo/system/loads.hpp"
#include "scabo/system/structure.hpp"
#include "verification/run.hpp"

namespace scabo::verification {
namespace {

/// Degrees of freedom and error in the energy norm, relative.
struct Reached {
  double dofs = 0.0, error = 0.0;
};

/// Of the error over the square root of the degrees of freedom: p means that the error falls as with cells of half the
/// size.
double rate(const Reached& coarse, const Reached& fine) {
  return 2.0 * std::log(coarse.error / fine.error) / std::log(fine.dofs / coarse.dofs);
}

class RatesOfCells : public testing::TestWithParam<const char*> {
 protected:
  std::string kind() const { return GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(Kinds, RatesOfCells, testing::Values("polygons", "quadtree"),
                         [](const auto& kind) { return std::string(kind.param); });

/// Timoshenko's cantilever, L = 8, D = 4, E = 3e7, nu = 0.3, P = 1000, plane stress, under its exact tractions on the
/// whole boundary; it is held without force.
Reached timoshenko(const std::string& kind, int order, double size) {
  constexpr double L = 8, D = 4, P = 1000, I = D * D * D / 12,
                   energy = P * P * L * L * L / (6 * 3e7 * I) + P * P * L * 1.3 * D * D / (10 * 3e7 * I);
  const model::Model model = input::parse_model(fmt::format(R"(scabo: 1
analysis: {{plane: stress, thickness: 1}}
materials: {{steel: {{young: 3e7, poisson: 0.3}}}}
bodies:
  beam: {{material: steel, shape: {{rectangle: {{corner: [0, -2], size: [8, 4]}}}}, mesh: {{kind: {}, order: {}, size: {}}}}}
supports: [{{on: beam.bottom_left, fix: [x, y]}}, {{on: beam.top_left, fix: x}}]
loads: {{none: {{on: beam.right, traction: [1, 0]}}}}
)",
                                                            kind, order, size),
                                                "test.yaml", {});
  const mesh::Mesh mesh = mesh::make_mesh(model);
  const system::Structure structure = system::make_structure(model, mesh, element::solve_cells(model, mesh, 1));
  const std::vector<Vec2>& nodes = mesh.bodies[0].nodes;
  Vector forces = Vector::Zero(static_cast<Eigen::Index>(2 * nodes.size()));
  for (const std::vector<mesh::LineElement>& edge : mesh.bodies[0].edges)
    forces += system::traction_forces(edge, nodes, 1.0, [](const Vec2& x, const Vec2& n) {
      const double bending = P * (L - x.x()) * x.y() / I, shear = -P / (2 * I) * (D * D / 4 - x.y() * x.y());
      return Vec2(bending * n.x() + shear * n.y(), shear * n.x());
    });
  const Vector u = structure.parts[0]->displacement(forces, Eigen::Vector3d::Zero());
  return {2.0 * nodes.size(), std::sqrt(std::abs(1.0 - structure.parts[0]->elastic_energy(u) / energy))};
}

TEST_P(RatesOfCells, TimoshenkosCantilever) {
  for (const int order : {1, 2}) {
    const Reached coarse = timoshenko(kind(), order, 0.5), fine = timoshenko(kind(), order, 0.25);
    std::cout << kind() << " cantilever, order " << order << ": " << fine.error << " with " << fine.dofs
              << " dofs, rate " << rate(coarse, fine) << "\n";
    EXPECT_GT(rate(coarse, fine), order - 0.15);
  }
  for (const int order : {3, 4}) {  // a cubic solution: exact
    const Reached reached = timoshenko(kind(), order, 1.0);
    std::cout << kind() << " cantilever, order " << order << ": " << reached.error << "\n";
    EXPECT_LT(reached.error, 1e-6);  // a square root: the energy to 1e-12
  }
}

/// With the energy of a body that is refined at points; the cells there get smaller by h^(p / exponent), those
/// elsewhere by h.
Reached graded(const std::string& text, const std::string& kind, int order, int halvings, double size, double exponent,
               const std::string& places, double energy) {
  const double h = std::pow(0.5, halvings), tip = 0.25 * size * std::pow(h, order / exponent);
  std::string refine;
  for (std::size_t begin = 0; begin < places.size();) {
    const std::size_t end = std::min(places.find(';', begin), places.size());
    refine += fmt::format("{}{{near: {}, size: {}}}", begin ? ", " : "", places.substr(begin, end - begin), tip);
    begin = end + 1;
  }
  const auto solution =
      run(fmt::format(fmt::runtime(text),
                      fmt::format("{{kind: {}, order: {}, size: {}, refine: [{}]}}", kind, order, size * h, refine)));
  return {2.0 * solution.mesh.nodes(), std::sqrt(std::abs(last(solution).energy.elastic / energy - 1.0))};
}

/// Places around the re-entrant corner at the origin with sizes h r^(1 - 0.8 * 0.5445 / p) at the distance r, so that
/// every ring contributes about the same error: cells that merely grow by 0.3 of the distance would converge with
/// 0.5445 in the end.
std::string around_the_corner(int order, double h) {
  constexpr double exponent = 0.5445;
  const double tip = 0.5 * std::pow(h, order / exponent);
  std::string places = fmt::format("{{near: [0, 0], size: {}}}", tip);
  for (double r = 1.0; r > 3.0 * tip; r *= 0.6)
    for (int i = 0; i < 12; ++i) {
      const double angle = std::numbers::pi * (-0.5 + 1.5 * i / 11.0);
      places += fmt::format(", {{near: [{}, {}], size: {}}}", r * std::cos(angle), r * std::sin(angle),
                            h * std::pow(r, 1.0 - 0.8 * exponent / order));
    }
  return places;
}

// Energy by one super-element with the corner as its scaling centre, orders 14 and 16.
TEST_P(RatesOfCells, ReEntrantCorner) {
  for (int order = 1; order <= 4; ++order) {
    const auto reach = [&](double h) {
      const auto solution = run(fmt::format(R"(scabo: 1
materials: {{steel: {{young: 1, poisson: 0.3}}}}
bodies:
  body:
    material: steel
    shape: {{polygon: {{vertices: [[0, 0], [0, -1], [1, -1], [1, 1], [-1, 1], [-1, 0]]}}}}
    mesh: {{kind: {}, order: {}, size: {}, refine: [{}]}}
supports: [{{on: body.edge_5, fix: x}}, {{on: body.edge_2, fix: y}}]
loads: {{right: {{on: body.edge_3, traction: [1, 0]}}, up: {{on: body.edge_4, traction: [0, 0.5]}}}}
)",
                                            kind(), order, h, around_the_corner(order, h)));
      return Reached{2.0 * solution.mesh.nodes(),
                     std::sqrt(std::abs(last(solution).energy.elastic / 4.98789291788 - 1.0))};
    };
    const double h = order == 1 ? 0.0625 : order == 2 ? 0.125 : order == 3 ? 0.25 : 0.5;
    const Reached coarse = reach(h), fine = reach(0.5 * h);
    std::cout << kind() << " corner, order " << order << ": " << fine.error << " with " << fine.dofs << " dofs, rate "
              << rate(coarse, fine) << ", by size " << std::log2(coarse.error / fine.error) << "\n";
    EXPECT_GT(rate(coarse, fine), order - 0.15) << "order " << order;
  }
}

// Cook's membrane, singular at all four corners. Energy by a quadtree of order 8 with cells of 1e-5 there, the same
// with 1e-3: twelve digits of the deflection 2 x 12.02080309; its deflection in the middle of the end, 23.96774, agrees
// with Cook's 23.966.
TEST_P(RatesOfCells, CooksMembrane) {
  const char* const text = R"(scabo: 1
materials: {{panel: {{young: 1, poisson: 0.3333333333333333}}}}
bodies:
  panel: {{material: panel, shape: {{polygon: {{vertices: [[0, 0], [48, 44], [48, 60], [0, 44]]}}}}, mesh: {}}}
supports: [{{on: panel.edge_4, fix: [x, y]}}]
loads: {{shear: {{on: panel.edge_2, force: [0, 1]}}}}
)";
  for (int order = 1; order <= 3; ++order) {
    const int halvings = order == 1 ? 3 : order == 2 ? 2 : 1;
    const auto reach = [&](int n) {
      return graded(text, kind(), order, n, 12.0, 0.56, "[0, 0];[0, 44];[48, 44];[48, 60]", 12.0208030943);
    };
    const Reached coarse = reach(halvings), fine = reach(halvings + 1);
    std::cout << kind() << " membrane, order " << order << ": " << fine.error << " with " << fine.dofs << " dofs, rate "
              << rate(coarse, fine) << "\n";
    EXPECT_GT(rate(coarse, fine), order - 0.15) << "order " << order;
  }
}

}  // namespace
}  // namespace scabo::verification
