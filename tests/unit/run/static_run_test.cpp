#include "scabo/run/static_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scabo/base/interruption.hpp"
#include "scabo/input/read_model.hpp"

namespace scabo::run {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A block on a rigid floor; friction holds a traction of less than three tenths of the pressure.
model::Model block(const std::string& traction = "[1, -10]", int increments = 3, const std::string& mesh = "",
                   const std::string& more = "") {
  return input::parse_model(R"(
scabo: 1
materials: {soft: {young: 1e4, poisson: 0.3}}
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [4, 1]}}}
  block: {material: soft, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.5)" +
                                mesh + R"(}}
supports: [{on: floor, fix: [x, y]}]
loads: {push: {on: block.top, traction: )" +
                                traction + R"(}}
contacts: {base: {between: [floor.top, block.bottom], friction: 0.3}}
steps: [{name: press, increments: )" +
                                std::to_string(increments) + "}]\n" + more,
                            "block.yaml");
}

class Directory {
 public:
  explicit Directory(const std::string& name) : path_(fs::temp_directory_path() / name) { fs::remove_all(path_); }
  ~Directory() { fs::remove_all(path_); }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

TEST(StaticRun, TellsOfStagesAndIncrements) {
  const model::Model model = block();
  StaticRun run{model};
  std::vector<double> parts;
  std::vector<std::string> stages;
  run.observer.on_stage = [&](const std::string& stage) { stages.push_back(stage); };
  run.observer.on_increment = [&](const auto&, const auto& increment) { parts.push_back(part_done(model, increment)); };
  run.reading = 10.0;
  const analysis::StaticSolution solution = solve(run);
  EXPECT_EQ(solution.outcome, analysis::Outcome::solved);
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_DOUBLE_EQ(parts[0], 1.0 / 3.0);
  EXPECT_EQ(parts[2], 1.0);
  EXPECT_EQ(stages.front(), "mesh");
  EXPECT_EQ(stages.back(), "step press, increment 3 of 3");
  EXPECT_EQ(solution.timing.read, 10.0);
  EXPECT_EQ(why_not_solved(solution, false), "");
}

TEST(StaticRun, EndsAfterTheCurrentIncrement) {
  const model::Model model = block();
  std::atomic<bool> stop{false};
  StaticRun run{model};
  run.stop = &stop;
  run.observer.on_increment = [&](const auto&, const auto&) { stop = true; };
  const analysis::StaticSolution solution = solve(run);
  EXPECT_EQ(solution.outcome, analysis::Outcome::interrupted);
  EXPECT_EQ(solution.increments.size(), 1u);
  EXPECT_EQ(why_not_solved(solution, true), "interrupted; 1 finished increment kept");
}

TEST(StaticRun, EndsAtOnceBeforeTheFirstIncrement) {
  const Directory folder("scabo_unit_run_stopped");
  const model::Model model = block();
  result::ResultsDirectory directory(folder.path(), model);
  StaticRun run{model, &directory};
  std::vector<std::string> stages;
  run.observer.on_stage = [&](const std::string& stage) {
    stages.push_back(stage);
    if (stage == "super-elements") throw Stopped{};
  };
  const analysis::StaticSolution solution = solve(run);
  EXPECT_THAT(stages, ElementsAre("mesh", "super-elements"));
  EXPECT_EQ(solution.outcome, analysis::Outcome::interrupted);
  EXPECT_TRUE(solution.increments.empty());
  EXPECT_EQ(why_not_solved(solution, true), "interrupted; no increment was finished");
  EXPECT_EQ(result::status_in(folder.path()), "interrupted");
}

/// Number of lines of a file without its header.
int rows_of(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  int rows = -1;
  while (std::getline(stream, line)) ++rows;
  return rows;
}

TEST(StaticRun, EndsAtInterruptionPointsOfThePreparation) {
  const model::Model model = block("[1, -10]", 3, ", kind: fem");
  const Directory folder("scabo_unit_run_prepared");
  result::ResultsDirectory directory(folder.path(), model);
  const std::atomic<bool> stop{true};
  StaticRun run{model, &directory};
  run.stop = &stop;
  std::vector<std::string> stages;
  run.observer.on_stage = [&](const std::string& stage) { stages.push_back(stage); };
  const Interruptible::Ask ask = [] { throw analysis::EndAtOnce{}; };
  const Interruptible here(&ask);
  const analysis::StaticSolution solution = solve(run);
  EXPECT_EQ(solution.outcome, analysis::Outcome::interrupted);
  EXPECT_TRUE(solution.increments.empty());
  EXPECT_GT(solution.mesh.nodes(), 0);  // the results contain it
  EXPECT_THAT(stages.back(), Not(HasSubstr("increment")));
  EXPECT_EQ(result::status_in(folder.path()), "interrupted");
}

// The third increment is solved when the end is asked for, and nothing of it is written.
TEST(StaticRun, AnIncrementThatIsInterruptedWhileItIsWrittenIsNotFinished) {
  const model::Model model = block("[1, -10]", 5, ", kind: fem");
  const Directory folder("scabo_unit_run_written");
  result::ResultsDirectory directory(folder.path(), model);
  std::atomic<bool> stop{false};
  StaticRun run{model, &directory};
  run.stop = &stop;
  int finished = 0, asked = 0;
  run.observer.on_increment = [&](const auto&, const auto&) { ++finished; };
  run.observer.on_iteration = [&](const contact::Iteration&) { stop = finished == 2; };
  const Interruptible::Ask ask = [&] {
    if (!stop) return;
    ++asked;
    throw analysis::EndAtOnce{};
  };
  const Interruptible here(&ask);
  const analysis::StaticSolution solution = solve(run);
  EXPECT_EQ(solution.outcome, analysis::Outcome::interrupted);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(finished, 2);
  ASSERT_EQ(solution.increments.size(), 2u);
  EXPECT_EQ(rows_of(folder.path() / "contact.csv"),
            2 * static_cast<int>(solution.increments.back().contacts[0].pairs.size()));
  EXPECT_TRUE(fs::exists(folder.path() / "fields_0002.vtu"));
  EXPECT_FALSE(fs::exists(folder.path() / "fields_0003.vtu"));
  EXPECT_EQ(result::status_in(folder.path()), "interrupted");
}

// Of analyses on one mesh and on several ones: whatever is at work, the run ends with results that say so.
TEST(StaticRun, EndsAtAnyInterruptionPoint) {
  const std::vector<std::pair<std::string, std::string>> kinds = {
      {", kind: fem", ""},
      {", kind: polygons", "output: {error: true}\n"},
      {"", "output: {error_of: [base.normal_force]}\n"},
      {", tolerance: 0.02", ""},
      {"", "tolerance: {of: base.normal_force, relative: 1e-2}\n"},
  };
  for (const auto& [mesh, more] : kinds) {
    SCOPED_TRACE(mesh + " " + more);
    const model::Model model = block("[1, -10]", 2, mesh, more);
    const auto run_until = [&](int last) {  // how often it asked, and whether it ended as it should
      const Directory folder("scabo_unit_run_anywhere");
      result::ResultsDirectory directory(folder.path(), model);
      std::atomic<bool> stop{false};
      std::atomic<int> asked{0};
      StaticRun run{model, &directory};
      run.stop = &stop;
      const Interruptible::Ask ask = [&] {
        if (++asked < last) return;
        stop = true;
        throw analysis::EndAtOnce{};
      };
      const Interruptible here(&ask);
      const analysis::StaticSolution solution = solve(run);
      const bool ended = asked >= last;
      EXPECT_EQ(solution.outcome == analysis::Outcome::interrupted, ended)
          << "at point " << last << ": " << solution.reason;
      if (ended) {
        EXPECT_EQ(result::status_in(folder.path()), "interrupted") << "at point " << last;
      }
      return asked.load();
    };
    const int all = run_until(1 << 30);
    EXPECT_GT(all, 3);
    for (int last = 1; last <= all; last += 1 + last / 3) run_until(last);
  }
}

TEST(StaticRun, RecordsAFailure) {
  const Directory folder("scabo_unit_run_failed");
  const model::Model model = block();
  result::ResultsDirectory directory(folder.path(), model);
  StaticRun run{model, &directory};
  run.observer.on_increment = [&](const auto&, const auto&) { throw std::runtime_error("the screen is gone"); };
  EXPECT_THROW(solve(run), std::runtime_error);
  EXPECT_EQ(result::status_in(folder.path()), "failed");
}

TEST(StaticRun, SaysWhatIsNotRestrained) {
  const model::Model model = block("[4, -10]");
  const analysis::StaticSolution solution = solve(StaticRun{model});
  EXPECT_EQ(solution.outcome, analysis::Outcome::mechanism);
  EXPECT_THAT(why_not_solved(solution, false), HasSubstr("mechanism"));
  EXPECT_THAT(why_not_solved(solution, false), HasSubstr("(no increment was finished)"));
}

TEST(StaticRun, RefusesWhatDoesNotFitInMemory) {
  const model::Model model = block();
  StaticRun run{model};
  run.plan = plan_of(model, analysis::check(model));
  run.plan->bytes = 1e18;
  run.anyway = "start it all the same";
  try {
    solve(run);
    FAIL() << "it started";
  } catch (const NotEnoughMemory& error) {
    EXPECT_THAT(error.what(), HasSubstr("or start it all the same"));
  }
  run.anyway.clear();  // not asked
  EXPECT_EQ(solve(run).outcome, analysis::Outcome::solved);
}

}  // namespace
}  // namespace scabo::run
