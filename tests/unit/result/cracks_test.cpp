// From an open super-element to the summary and the log: names, keys, null where nothing is known.
#include "scabo/analysis/state/cracks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "scabo/result/report.hpp"
#include "scabo/result/summary.hpp"
#include "theory/open_rings.hpp"

namespace scabo::result {
namespace {

using namespace test;

/// One body, `plate`, that is the ring given, moved by u.
analysis::StaticSolution solution_of(const element::Ring& ring, const std::vector<element::Mat3>& laws,
                                     const Vector& u) {
  analysis::StaticSolution solution;
  model::Body body;
  body.name = "plate";
  solution.model.bodies.push_back(body);
  auto made = std::make_shared<element::SolvedSuperElement>();
  made->ring = ring;
  made->sectors.D = element::Elasticity(laws);
  made->set(element::solve_super_element(ring, made->sectors.D, 1.0));
  solution.cells.push_back({made});
  mesh::BodyMesh& mesh = solution.mesh.bodies.emplace_back();
  mesh.nodes = ring.nodes;
  mesh.cells.emplace_back();
  mesh.cells[0].boundary = ring.elements;
  analysis::IncrementResult increment;
  increment.step = increment.increment = 1;
  increment.converged = true;
  increment.fields.displacements = {u};
  increment.fields.interior.assign(1, element::CellLoads(1));
  solution.increments.push_back(increment);
  return solution;
}

nlohmann::json cracks_in_summary(const analysis::StaticSolution& solution) {
  return nlohmann::json::parse(summary_content(solution, {}, false))["increments"][0]["cracks"];
}

TEST(CrackResults, OfACrackByItsName) {
  const element::Ring ring = cracked_square(1, 8);
  const Kolosov m(1.0, 0.3, model::Plane::stress);
  auto solution = solution_of(ring, {elasticity(1.0, 0.3)},
                              around_tip(ring, [&](double r, double t) { return williams(m, 2.0, -1.0, 0.5, r, t); }));
  solution.model.bodies[0].cracks.push_back({"flaw", {0, 0}, {-1, 0}, 0, 0.0, {}, {}});
  solution.increments[0].cracks = analysis::crack_results(solution, solution.increments[0]);
  const nlohmann::json flaw = cracks_in_summary(solution)["plate.flaw"];
  EXPECT_EQ(flaw["kind"], "crack");
  EXPECT_NEAR(flaw["K_I"], 2.0, 1e-6);
  EXPECT_NEAR(flaw["K_II"], -1.0, 1e-6);
  EXPECT_NEAR(flaw["T"], 0.5, 1e-6);
  EXPECT_NEAR(flaw["G"], 5.0, 1e-5);
  EXPECT_NEAR(flaw["J"], 5.0, 1e-5);
  EXPECT_FALSE(flaw.contains("epsilon"));
  const std::string log = report_cracks(solution.increments[0]);
  EXPECT_NE(log.find("plate.flaw"), std::string::npos) << log;
  EXPECT_NE(log.find("K_II"), std::string::npos);

  // A face pressed as far as the tip: J and T are not known, and say so.
  element::add_radial_loads(solution.increments[0].fields.interior[0][0].loads,
                            {element::face_load(ring, element::Face::first, 0.0, {0, -1}, 1.0)}, 1.0);
  solution.increments[0].cracks = analysis::crack_results(solution, solution.increments[0]);
  const nlohmann::json pressed = cracks_in_summary(solution)["plate.flaw"];
  EXPECT_TRUE(pressed["J"].is_null());
  EXPECT_TRUE(pressed["T"].is_null());
  EXPECT_TRUE(pressed["G"].is_number());
}

// xi^-1/2 on a face grows like the singular stress, which then grows like ln(r) times that.
TEST(CrackResults, HaveNoFactorsWhereALoadIsInResonance) {
  const element::Ring ring = cracked_square(1, 8);
  const Kolosov m(1.0, 0.3, model::Plane::stress);
  auto solution = solution_of(ring, {elasticity(1.0, 0.3)},
                              around_tip(ring, [&](double r, double t) { return williams(m, 2.0, -1.0, 0.5, r, t); }));
  const auto loaded = [&](double power) {
    solution.increments[0].fields.interior[0][0].loads.clear();
    element::add_radial_loads(solution.increments[0].fields.interior[0][0].loads,
                              {element::face_load(ring, element::Face::first, power, {0, -1}, 1.0)}, 1.0);
    return solution.increments[0].cracks = analysis::crack_results(solution, solution.increments[0]);
  };
  const auto resonant = loaded(-0.5);
  EXPECT_TRUE(std::isnan(resonant[0].factors.K_I));
  EXPECT_FALSE(resonant[0].factors.G);
  EXPECT_TRUE(cracks_in_summary(solution)["plate"]["K_I"].is_null());
  ASSERT_EQ(analysis::crack_warnings(resonant).size(), 1u);
  EXPECT_NE(analysis::crack_warnings(resonant)[0].text.find("are undefined"), std::string::npos);
  for (const double power : {-0.9, -0.4, 0.0, 0.5}) {
    const auto found = loaded(power);
    EXPECT_TRUE(std::isfinite(found[0].factors.K_I)) << power;
    EXPECT_TRUE(analysis::crack_warnings(found).empty()) << power;
  }
}

TEST(CrackResults, SayWhereTheBoundaryIsTooCoarseForThem) {
  for (const auto& [order, coarse] : {std::pair{1, true}, {8, false}}) {
    const element::Ring ring = cracked_square(1, order);
    auto solution = solution_of(ring, {elasticity(1.0, 0.3)}, at_nodes(ring.nodes, [](const Vec2& x) { return x; }));
    const auto warnings = analysis::crack_warnings(analysis::crack_results(solution, solution.increments[0]));
    ASSERT_EQ(warnings.size(), coarse ? 1u : 0u);
    if (coarse) {
      EXPECT_NE(warnings[0].text.find("is not resolved: the computed exponents are"), std::string::npos)
          << warnings[0].text;
    }
  }
}

TEST(CrackResults, OfAnInterfaceCrackAndACorner) {
  const element::Ring crack = cracked_square(1, 6);
  std::vector<element::Mat3> laws;
  for (const double angle : middle_angles(crack)) laws.push_back(elasticity(angle < std::numbers::pi ? 1.0 : 5.0, 0.3));
  auto solution = solution_of(crack, laws, around_tip(crack, [](double r, double t) { return Vec2(r * t, t); }));
  solution.increments[0].cracks = analysis::crack_results(solution, solution.increments[0]);
  const nlohmann::json interface = cracks_in_summary(solution)["plate"];
  EXPECT_EQ(interface["kind"], "interface_crack");
  for (const char* key : {"K_I", "K_II", "T_left", "T_right", "G", "J", "epsilon", "reference_length"})
    EXPECT_TRUE(interface[key].is_number()) << key;

  const element::Ring notch = sector_ring(0.0, 1.5 * std::numbers::pi, {}, 0.8, 6);
  solution = solution_of(notch, {elasticity(1.0, 0.3)},
                         at_nodes(notch.nodes, [](const Vec2& x) { return Vec2(x.y() * x.y(), x.x()); }));
  solution.increments[0].cracks = analysis::crack_results(solution, solution.increments[0]);
  const nlohmann::json corner = cracks_in_summary(solution)["plate"];
  EXPECT_EQ(corner["kind"], "corner");
  EXPECT_EQ(corner["terms"].size(), 2u);
  EXPECT_EQ(corner["exponents"].size(), 2u);
  for (const char* key : {"K_tt", "K_rt", "ray", "reference_length"}) EXPECT_TRUE(corner[key].is_number()) << key;
  EXPECT_NE(report_cracks(solution.increments[0]).find("0.544"), std::string::npos);
}

// The strain e along the crack is the same in both halves, and the stress E' e: 4 times as much above. Left of who
// walks from the mouth to the tip is above.
TEST(InterfaceCrack, HasItsTStressOnEitherSide) {
  const test::Kolosov above(4.0, 0.3, model::Plane::strain), below(1.0, 0.3, model::Plane::strain);
  const double e = 0.3;
  for (const double angle : {0.0, 2.0}) {
    const element::Ring ring = test::cracked_square(1, 12, angle);
    std::vector<element::Mat3> laws;
    for (const double at : test::middle_angles(ring))  // from the right face on
      laws.push_back(test::elasticity(at < std::numbers::pi ? 1.0 : 4.0, 0.3, model::Plane::strain));
    const Vector u = test::around_tip(ring, [&](double r, double t) {
      return test::interface_crack(above, below, {1.0, 0.5}, 1.0, e, r, t);
    });
    analysis::StaticSolution solution = solution_of(ring, laws, u);
    solution.model.bodies.front().cracks.push_back({"flaw", {0, 0}, {-1, 0}, 0, 0.0, {}, {}});
    analysis::IncrementResult& increment = solution.increments.front();
    increment.cracks = analysis::crack_results(solution, increment);

    const nlohmann::json flaw = cracks_in_summary(solution)["plate.flaw"];
    EXPECT_EQ(flaw["kind"], "interface_crack");
    const double left = 4.0 / 0.91 * e, right = 1.0 / 0.91 * e;
    EXPECT_NEAR(flaw["T_left"].get<double>(), left, 1e-8);
    EXPECT_NEAR(flaw["T_right"].get<double>(), right, 1e-8);
    EXPECT_FALSE(flaw.contains("T"));
    const std::string log = report_cracks(increment);
    EXPECT_NE(log.find("1.31868, 0.32967"), std::string::npos) << log;
  }
}

}  // namespace
}  // namespace scabo::result
