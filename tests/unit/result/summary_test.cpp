// summary.json of a run.
#include "scabo/result/summary.hpp"

#include <gmock/gmock.h>

#include "unit/result/finished_run.hpp"

namespace scabo::result {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

TEST_F(Results, SummaryHasTheDocumentedKeys) {
  const FinishedRun run(path_);
  const Json summary = Json::parse(content_of(path_ / "summary.json"));
  EXPECT_THAT(keys_of(summary), ElementsAre("scabo", "title", "status", "reason", "warnings", "warning_kinds", "model",
                                            "passes", "increments", "timing", "peak_memory_bytes"));
  EXPECT_THAT(keys_of(summary["model"]), ElementsAre("nodes", "dofs", "super_elements", "contact_pairs", "plane",
                                                     "thickness", "materials", "bodies", "contacts", "steps"));
  EXPECT_THAT(keys_of(summary["model"]["materials"][0]), ElementsAre("name", "law", "young", "poisson", "density"));
  EXPECT_THAT(keys_of(summary["model"]["bodies"][0]),
              ElementsAre("name", "rigid", "unbounded", "materials", "nodes", "super_elements", "finite_elements"));
  EXPECT_THAT(keys_of(summary["timing"]), ElementsAre("read", "mesh", "super_elements", "assemble", "factorise",
                                                      "condense", "newton", "recover", "write", "total"));
  const Json& increment = summary["increments"][0];
  EXPECT_THAT(keys_of(increment), ElementsAre("step", "increment", "reached", "factors", "converged",
                                              "newton_iterations", "coarse_iterations", "residual", "contacts",
                                              "reactions", "cracks", "certificate", "energy", "error"));
  EXPECT_THAT(keys_of(increment["contacts"]["joint, left"]),
              ElementsAre("normal_force", "tangential_force", "force", "moment", "centre_of_pressure", "open", "stick",
                          "slip", "max_gap", "max_pressure", "first_pair_in_contact", "last_pair_in_contact"));
  EXPECT_THAT(keys_of(increment["certificate"]), ElementsAre("equilibrium", "penetration", "tension", "friction_excess",
                                                             "complementarity", "slip_direction", "rigid_balance"));
  EXPECT_THAT(keys_of(increment["energy"]), ElementsAre("external", "elastic", "friction", "friction_error"));
}

// A run drops the pairs of earlier increments; the summary once counted 0 pairs for it.
TEST_F(Results, PairsAreCountedByTheTotalsThatRemain) {
  analysis::StaticSolution solution = two_bodies();
  for (const int number : {1, 2}) solution.increments.push_back(increment_number(solution, number));
  for (analysis::ContactResult& contact : solution.increments.front().contacts) contact.pairs.clear();
  EXPECT_EQ(sizes_of(solution).contact_pairs, 2);
}

TEST_F(Results, SummaryValues) {
  const FinishedRun run(path_);
  const Json summary = Json::parse(content_of(path_ / "summary.json"));
  EXPECT_EQ(summary["status"], "not_converged");
  EXPECT_EQ(summary["reason"], "step press, increment 3: the line search found no descent");
  EXPECT_EQ(summary["warnings"], Json::array({"a first warning"}));
  EXPECT_EQ(summary["warning_kinds"], Json::array({"few_pairs"}));
  EXPECT_EQ(summary["model"]["nodes"], 16 + 21);
  EXPECT_EQ(summary["model"]["dofs"], 2 * (16 + 21));
  EXPECT_EQ(summary["model"]["super_elements"], 1);
  EXPECT_EQ(summary["model"]["contact_pairs"], 2);
  EXPECT_EQ(summary["model"]["plane"], "stress");
  const Json& bodies = summary["model"]["bodies"];
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_EQ(bodies[0]["name"], "upper");
  EXPECT_EQ(bodies[0]["materials"], Json::array({run.solution.model.materials[0].name}));
  EXPECT_EQ(bodies[0]["super_elements"], 1);
  EXPECT_EQ(bodies[1]["finite_elements"], 4);
  EXPECT_EQ(bodies[1]["nodes"], 21);
  ASSERT_EQ(summary["increments"].size(), 3U);
  const Json& increment = summary["increments"][1];
  EXPECT_EQ(increment["increment"], 2);
  EXPECT_EQ(increment["factors"]["tip"], 0.5);
  EXPECT_EQ(increment["contacts"]["joint, left"]["tangential_force"].get<double>(), 1.0 / 3.0);
  EXPECT_EQ(increment["contacts"]["joint, left"]["first_pair_in_contact"], 2);
  EXPECT_EQ(increment["reactions"]["lower.bottom"], Json::array({1.0, -2.0}));
  EXPECT_EQ(increment["certificate"]["penetration"], 3e-13);
  EXPECT_EQ(increment["energy"]["friction"], 1.0);
  EXPECT_EQ(summary["timing"]["total"], 1.25);
  EXPECT_GT(summary["timing"]["recover"], 0.0);
  EXPECT_GT(summary["peak_memory_bytes"], 1000000);
}

TEST_F(Results, AnIncrementThatDidNotConvergeIsNoResult) {
  const FinishedRun run(path_);
  const Json summary = Json::parse(content_of(path_ / "summary.json"));
  const Json& failed = summary["increments"][2];
  EXPECT_EQ(failed["converged"], false);
  EXPECT_EQ(failed["newton_iterations"], 50);
  EXPECT_TRUE(failed["residual"].is_null());
  EXPECT_TRUE(failed["contacts"].empty());
  EXPECT_TRUE(failed["reactions"].empty());
  EXPECT_TRUE(failed["certificate"].is_null());
  EXPECT_TRUE(failed["energy"].is_null());
  EXPECT_THAT(content_of(path_ / "log.txt"), HasSubstr("NOT CONVERGED: the line search found no descent"));
}

TEST_F(Results, NothingInContactIsNull) {
  auto solution = two_bodies();
  auto increment = increment_number(solution, 1);
  increment.contacts[0].first_in_contact.reset();
  increment.contacts[0].last_in_contact.reset();
  solution.increments = {increment};
  const Json summary = Json::parse(summary_content(solution, solution.timing, false));
  EXPECT_TRUE(summary["increments"][0]["contacts"]["joint, left"]["first_pair_in_contact"].is_null());
  EXPECT_TRUE(summary["reason"].is_null());
}

TEST_F(Results, ARunningSummarySaysSo) {
  const auto solution = two_bodies();
  const Json summary = Json::parse(summary_content(solution, solution.timing, true));
  EXPECT_EQ(summary["status"], "running");
  EXPECT_TRUE(summary["timing"]["total"].is_null());
}

TEST_F(Results, ATitleThatIsNoUtf8DoesNotLoseTheSummary) {
  auto solution = two_bodies();
  solution.model.title = "b\xf6se";
  EXPECT_NO_THROW(Json::parse(summary_content(solution, solution.timing, false)));
}

TEST_F(Results, TimeOfTheCollectionRunsFromStepToStep) {
  const FinishedRun run(path_);
  const std::string collection = content_of(path_ / "fields.pvd");
  EXPECT_THAT(collection, HasSubstr(R"(<DataSet timestep="0.25" part="0" file="fields_0001.vtu"/>)"));
  EXPECT_THAT(collection, HasSubstr(R"(<DataSet timestep="0.5" part="0" file="fields_0002.vtu"/>)"));
}

}  // namespace
}  // namespace scabo::result
