// Raous, Chabrand, Lebon (1988), also code_aster SSNV128: a block pressed down and aside on a rigid floor.
#include "models.hpp"
#include "run.hpp"

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
  EXPECT_LE(increment.newton_iterations, 10);

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

}  // namespace
}  // namespace scabo::verification
