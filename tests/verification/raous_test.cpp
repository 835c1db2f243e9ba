// Raous, Chabrand, Lebon (1988), also code_aster SSNV128: a block pressed down and aside on a rigid floor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

#include "models.hpp"
#include "run.hpp"
#include "support/mesh_text.hpp"

namespace scabo::verification {
namespace {

/// Slip of B (the block) along t = +x is its displacement, since the floor stands still.
double displacement_at(const analysis::ContactResult& contact, double x) {
  for (const analysis::PairResult& pair : contact.pairs)
    if (std::abs(pair.position.x() - x) < 1e-9) return pair.slip;
  ADD_FAILURE() << "no pair at x = " << x;
  return 0.0;
}

class Raous : public testing::TestWithParam<const char*> {};

TEST_P(Raous, DisplacementsOfTheFloorAndExtentOfTheZones) {
  const auto solution = run(block_of_raous(std::string("size: 1.25e-3, kind: ") + GetParam()));
  const auto& increment = last(solution);
  const analysis::ContactResult& contact = increment.contacts.front();
  for (const auto& [x, displacement] : displacements_of_raous)
    EXPECT_NEAR(displacement_at(contact, x), displacement, 0.01e-6);

  double open_to = 0.0, slip_to = 0.0;
  for (const analysis::PairResult& pair : contact.pairs) {
    if (pair.state == contact::ContactState::open) open_to = std::max(open_to, pair.position.x());
    if (pair.state == contact::ContactState::slip) slip_to = std::max(slip_to, pair.position.x());
  }
  EXPECT_NEAR(open_to, 3.4e-3, 0.625e-3);  // to the distance of two nodes
  EXPECT_NEAR(slip_to, 29.8e-3, 0.625e-3);
  // In one increment the work of the loads is what is stored and what friction takes.
  EXPECT_NEAR(increment.energy.external, increment.energy.elastic + increment.energy.friction,
              1e-10 * increment.energy.external);
}

INSTANTIATE_TEST_SUITE_P(SuperElementAndFiniteElements, Raous, testing::Values("superelement", "fem"),
                         [](const auto& parameter) { return std::string(parameter.param); });

// Other kinds of mesh, 8 to 32 sides along the floor: `imported` cells of a mesh file, as super-elements or
// finite elements of the types of support/mesh_text.hpp.
TEST(RaousOnOtherMeshes, Displacements) {
  const auto file = [](int type, const char* more) {
    return block_of_raous_from_file(
        fmt::format("file: {}, {}", test::mesh_of_rectangle(type, 0.04, 0.04, 16, 16).file(), more));
  };
  const std::pair<const char*, std::string> models[] = {
      {"super-element of order 4", block_of_raous("size: 5e-3, order: 4")},
      {"polygons", block_of_raous("size: 2.5e-3, kind: polygons")},
      {"polygons of order 1", block_of_raous("size: 1.25e-3, order: 1, kind: polygons")},
      {"quadtree", block_of_raous("size: 2.5e-3, kind: quadtree")},
      {"triangles", block_of_raous("size: 2.5e-3, kind: fem, refine: [{near: [0, 0], size: 2.5e-3}]")},
      {"quadrilaterals of order 1", block_of_raous("size: 1.25e-3, order: 1, kind: fem")},
      {"imported polygons", file(7, "order: 2")},
      {"imported quadrilaterals", file(23, "elements: superelement")},
      {"imported triangles of order 3", file(5, "order: 3")},
      {"imported finite elements, triangles", file(22, "elements: fem")},
      {"imported finite elements, quadrilaterals", file(23, "elements: fem")}};
  for (const auto& [name, model] : models) {
    const auto solution = run(model);
    std::vector<std::array<double, 2>> slips;
    for (const analysis::PairResult& pair : contact_of(last(solution)).pairs)
      slips.push_back({pair.position.x(), pair.slip});
    std::sort(slips.begin(), slips.end());
    double worst = 0.0;
    for (const auto& [x, displacement] : displacements_of_raous) {
      std::size_t k = 0;  // between the pairs k and k + 1
      while (k + 2 < slips.size() && slips[k + 1][0] < x) ++k;
      const double s = (x - slips[k][0]) / (slips[k + 1][0] - slips[k][0]);
      worst = std::max(worst, std::abs(std::lerp(slips[k][1], slips[k + 1][1], s) / displacement - 1.0));
    }
    std::cout << name << ", " << 2 * solution.mesh.nodes() << " dofs: " << worst << "\n";
    EXPECT_LT(worst, 2e-3) << name;
  }
}

}  // namespace
}  // namespace scabo::verification
