#include "scabo/result/results_directory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "scabo/result/contact_table.hpp"
#include "scabo/result/report.hpp"
#include "scabo/result/summary.hpp"
#include "unit/result/finished_run.hpp"

namespace scabo::result {
namespace {

using testing::HasSubstr;
using testing::UnorderedElementsAre;

TEST_F(Results, FilesOfARun) {
  const FinishedRun run(path_);
  EXPECT_THAT(names_in(path_), UnorderedElementsAre("summary.json", "contact.csv", "fields.pvd", "fields_0001.vtu",
                                                    "fields_0002.vtu", "cells.vtu", "convergence.csv", "log.txt"));
  EXPECT_GT(run.directory.recover_seconds(), 0.0);
  EXPECT_GT(run.directory.write_seconds(), 0.0);
}

/// Names of the .vtu and .pvd files of a run of `count` converged increments, of four.
std::vector<std::string> field_files(const std::filesystem::path& path, const model::Output& output, int count) {
  analysis::StaticSolution solution = two_bodies();
  solution.model.output = output;
  solution.model.contacts.resize(1);
  ResultsDirectory directory(path, solution.model);
  for (int number = 1; number <= count; ++number) {
    solution.increments.push_back(increment_number(solution, number));
    directory.add(solution, solution.increments.back());
  }
  directory.finish(solution);
  std::vector<std::string> names;
  for (const std::string& name : names_in(path))
    if (name.ends_with(".vtu") || name.ends_with(".pvd")) names.push_back(name);
  return names;
}

TEST_F(Results, FieldsOfEveryThirdIncrementAndTheLast) {
  model::Output output;
  output.every = 3;
  EXPECT_THAT(field_files(path_, output, 4),
              UnorderedElementsAre("fields.pvd", "fields_0003.vtu", "fields_0004.vtu", "contact.pvd",
                                   "contact_0003.vtu", "contact_0004.vtu", "cells.vtu"));
  const std::string collection = content_of(path_ / "fields.pvd");
  EXPECT_THAT(collection, HasSubstr("timestep=\"0.75\" part=\"0\" file=\"fields_0003.vtu\""));
  EXPECT_THAT(collection, HasSubstr("timestep=\"1\" part=\"0\" file=\"fields_0004.vtu\""));
}

TEST_F(Results, FieldsOfTheLastIncrementWhereTheRunEndedEarly) {
  model::Output output;
  output.every = 3;
  output.fields.contact = false;
  EXPECT_THAT(field_files(path_, output, 2), UnorderedElementsAre("fields.pvd", "fields_0002.vtu", "cells.vtu"));
}

TEST_F(Results, OnlyTheFieldsThatAreWanted) {
  model::Output output;
  output.fields = {.displacement = true, .stress = false, .principal = false, .von_mises = true, .contact = false};
  field_files(path_, output, 1);
  const std::string vtu = content_of(path_ / "fields_0001.vtu");
  EXPECT_THAT(vtu, HasSubstr("Name=\"displacement\""));
  EXPECT_THAT(vtu, HasSubstr("Name=\"von_mises\""));
  EXPECT_THAT(vtu, HasSubstr("Name=\"body\""));
  for (const char* name : {"stress", "stress_xx", "principal_1", "principal_angle"})
    EXPECT_EQ(vtu.find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
}

TEST_F(Results, NoFieldsNoVtuFiles) {
  model::Output output;
  output.fields = {false, false, false, false, false};
  EXPECT_THAT(field_files(path_, output, 2), testing::IsEmpty());
}

TEST_F(Results, ContactTable) {
  const FinishedRun run(path_);
  const std::string rows =
      "1,1,\"joint, left\",1,0.1,1,0.0001,0,0,0,0,0,open,0,0,0,0\n"
      "1,1,\"joint, left\",2,0.2,1,0,-0.3,100,0.3333333333333333,400000,-2.5,slip,1.5,2.5,3.5,4.5\n";
  std::string second = rows;
  for (std::size_t at = 0; (at = second.find("1,1,\"", at)) != std::string::npos; ++at) second[at + 2] = '2';
  EXPECT_EQ(content_of(path_ / "contact.csv"),
            "step,increment,contact,pair,x,y,gap,slip,normal_force,tangential_force,pressure,shear,state,"
            "normal_displacement_a,tangential_displacement_a,normal_displacement_b,tangential_displacement_b\n" +
                rows + second);
}

TEST_F(Results, FinishedIncrementsAreReadableWithoutTheEndOfTheRun) {
  auto solution = two_bodies();
  ResultsDirectory directory(path_, solution.model);
  solution.increments.push_back(increment_number(solution, 1));
  directory.add(solution, solution.increments.back());
  EXPECT_TRUE(content_of(path_ / "fields.pvd").ends_with("</VTKFile>\n"));
  EXPECT_TRUE(content_of(path_ / "fields_0001.vtu").ends_with("</VTKFile>\n"));
  EXPECT_TRUE(content_of(path_ / "contact.csv").ends_with("4.5\n"));
  EXPECT_THAT(content_of(path_ / "log.txt"), HasSubstr("step press, increment 1 of 4: tip = 0.25; 3 iterations"));
}

TEST_F(Results, TheSummaryIsThereFromTheStart) {
  auto solution = two_bodies();
  ResultsDirectory directory(path_, solution.model, solution.mesh);
  auto summary = Json::parse(content_of(path_ / "summary.json"));
  EXPECT_EQ(summary["status"], "running");
  EXPECT_EQ(summary["model"]["nodes"], solution.mesh.nodes());
  EXPECT_TRUE(summary["increments"].empty());
  mark_failed(path_, "the disk is full");
  summary = Json::parse(content_of(path_ / "summary.json"));
  EXPECT_EQ(summary["status"], "failed");
  EXPECT_EQ(summary["reason"], "the disk is full");
}

TEST_F(Results, AnIncrementThatDoesNotFitIsInNoFile) {
  auto solution = two_bodies();
  ResultsDirectory directory(path_, solution.model);
  solution.increments.push_back(increment_number(solution, 1));
  directory.add(solution, solution.increments.back());
  std::map<std::string, std::string> before;
  for (const auto& file : std::filesystem::directory_iterator(path_))
    before[file.path().filename()] = content_of(file.path());
  // The name is too long for the last tables, which are written after contact.csv and the fields.
  solution.increments.push_back(increment_number(solution, 2));
  {
    const SmallDisk disk(20'000);
    solution.increments.back().step_name = std::string(25'000, 'x');
    EXPECT_THROW(directory.add(solution, solution.increments.back()), WriteError);
    mark_failed(path_, "the disk is full");
  }
  for (const auto& [name, content] : before)
    if (name != "summary.json") EXPECT_EQ(content_of(path_ / name), content) << name;
  EXPECT_FALSE(std::filesystem::exists(path_ / "fields_0002.vtu"));
  const auto summary = Json::parse(content_of(path_ / "summary.json"));
  EXPECT_EQ(summary["increments"].size(), 1u);
  EXPECT_EQ(summary["status"], "failed");
}

TEST_F(Results, AFullDiskHasRoomForTheStatus) {
  auto solution = two_bodies();
  ResultsDirectory directory(path_, solution.model, solution.mesh);
  const std::string before = content_of(path_ / "summary.json");
  {
    const SmallDisk disk(before.size() / 2);
    mark_failed(path_, "the disk is full");
  }
  const auto summary = Json::parse(content_of(path_ / "summary.json"));
  EXPECT_EQ(summary["status"], "failed");
  EXPECT_EQ(content_of(path_ / "summary.json").size(), before.size());
}

TEST_F(Results, LeftoversOfAKilledRunAreRemoved) {
  std::filesystem::create_directories(path_);
  for (const char* name : {"fields_0007.vtu.part", "contact_0007.vtu.part", "cells.vtu.part"})
    write_file(path_ / name, std::string("<?xml version=\"1.0\"?>\n") + std::string(vtk_mark));
  auto solution = two_bodies();
  const ResultsDirectory directory(path_, solution.model);
  for (const auto& file : std::filesystem::directory_iterator(path_))
    EXPECT_NE(file.path().extension(), ".part") << file.path();
}

TEST_F(Results, TwoRunsAtOnceAreRefused) {
  auto solution = two_bodies();
  {
    const ResultsDirectory first(path_, solution.model);
    try {
      const ResultsDirectory second(path_, solution.model);
      ADD_FAILURE();
    } catch (const WriteError& error) {
      EXPECT_THAT(error.what(), HasSubstr("another run is writing there"));
    }
    EXPECT_EQ(content_of(path_ / "contact.csv"), contact_table_header);
  }
  const ResultsDirectory third(path_, solution.model);  // the first has ended
}

TEST_F(Results, LogTellsTheRun) {
  const FinishedRun run(path_);
  const std::string log = content_of(path_ / "log.txt");
  for (const char* text : {"Scabo ", "Sample", "2 bodies, 37 nodes, 74 degrees of freedom, 1 super-element",
                           "certificate 3e-13", "P2", "lower.bottom", "warning: a first warning", "total"})
    EXPECT_THAT(log, HasSubstr(text));
}

TEST_F(Results, AnEarlierRunLeavesNothingBehind) {
  { const FinishedRun run(path_); }
  write_text(path_ / "notes.txt", "mine");
  write_text(path_ / "fields_mine.vtu", "mine");
  auto solution = two_bodies();
  const ResultsDirectory directory(path_, solution.model);
  EXPECT_THAT(names_in(path_), UnorderedElementsAre("summary.json", "contact.csv", "fields.pvd", "convergence.csv",
                                                    "log.txt", "notes.txt", "fields_mine.vtu"));
  EXPECT_EQ(content_of(path_ / "contact.csv"), contact_table_header);
}

TEST_F(Results, FilesOfOthersAreNeverOverwritten) {
  for (const char* name : {"fields_0001.vtu", "summary.json", "contact.csv", "convergence.csv", "convergence.svg",
                           "log.txt", "fields.pvd"}) {
    const TemporaryDirectory directory;
    { const FinishedRun run(directory.path()); }
    write_text(directory.path() / name, "of somebody else");
    const auto before = names_in(directory.path());
    try {
      const ResultsDirectory again(directory.path(), two_bodies().model);
      ADD_FAILURE() << name;
    } catch (const WriteError& error) {
      EXPECT_THAT(error.what(), HasSubstr(directory.path().string()));
      EXPECT_THAT(error.what(), HasSubstr(name));
    }
    EXPECT_EQ(content_of(directory.path() / name), "of somebody else");
    EXPECT_EQ(names_in(directory.path()), before);
  }
}

TEST_F(Results, APlaceThatIsAFileIsNamed) {
  const auto file = holder_.path() / "file";
  write_text(file, "");
  for (const auto& place : {file, file / "out"}) {
    try {
      const ResultsDirectory directory(place, two_bodies().model);
      ADD_FAILURE();
    } catch (const WriteError& error) {
      EXPECT_THAT(error.what(), HasSubstr(place.string()));
    }
  }
}

TEST_F(Results, ADirectoryThatVanishesIsAnError) {
  auto solution = two_bodies();
  ResultsDirectory directory(path_, solution.model);
  std::filesystem::remove_all(path_);
  const auto increment = increment_number(solution, 1);
  EXPECT_THROW(directory.add(solution, increment), WriteError);
  EXPECT_THROW(directory.finish(solution), WriteError);
}

TEST(Report, ContactTable) {
  auto increment = analysis::IncrementResult{};
  increment.contacts = {contact_result()};
  increment.contacts[0].first_in_contact = 28;
  increment.contacts[0].last_in_contact = 32;
  const std::string text = report_contacts({}, increment);
  EXPECT_THAT(text, HasSubstr("joint, left           100          0.333333     1      0     1  P28 to P32"));
  EXPECT_EQ(report_contacts({}, {}), "");
}

/// 1e5 along the normal, rounding along the tangent: people see 0, programs what was computed.
TEST_F(Results, FiguresAtTheLevelOfRoundingAreShownAsZero) {
  analysis::StaticSolution solution = two_bodies();
  analysis::IncrementResult increment = increment_number(solution, 1);
  increment.largest_force = 1e5;
  analysis::ContactResult& contact = increment.contacts[0];
  contact.normal_force = 1e5;
  contact.tangential_force = -1.4e-11;
  contact.max_gap = 3e-18;
  increment.reactions = {{-2.3e-9, -1e5}, {1e-5, 0.0}};
  EXPECT_THAT(report_contacts(solution.model, increment),
              testing::ContainsRegex("joint, left +100000 +0 +1 +0 +1 +P2 +4e\\+05 +0\n"));
  EXPECT_THAT(report_reactions(solution.model, increment), testing::ContainsRegex("lower.bottom +0 +-100000\n"));
  EXPECT_THAT(report_reactions(solution.model, increment), testing::ContainsRegex("upper.top +1e-05 +0\n"));
  // The certificate leaves 1e-9 of equilibrium: 1e-5 is nothing then.
  increment.certificate.equilibrium = 1e-9;
  EXPECT_THAT(report_reactions(solution.model, increment), testing::ContainsRegex("upper.top +0 +0\n"));
  // Far from the origin the rounding of coordinates is as large.
  increment.certificate.equilibrium = 0.0;
  model::Model far = solution.model;
  for (model::Body& body : far.bodies)
    for (model::Edge& edge : body.outline.edges) edge = geometry::translated(edge, {5e5, 5e6});
  EXPECT_THAT(report_reactions(far, increment), testing::ContainsRegex("upper.top +0 +0\n"));
  increment.certificate.equilibrium = 1e-9;
  solution.increments.push_back(increment);
  EXPECT_THAT(summary_content(solution, {}, false), HasSubstr("-1.4e-11"));
}

TEST_F(Results, TotalsAreContactsAndReactions) {
  const analysis::StaticSolution solution = two_bodies();
  const std::string totals = report_totals(solution.model, increment_number(solution, 1));
  EXPECT_THAT(totals, testing::StartsWith("After step "));
  EXPECT_THAT(totals, HasSubstr("normal force"));
  EXPECT_THAT(totals, HasSubstr("\n\n  support"));
}

TEST_F(Results, ABarOfZeroIsNotRelative) {
  const analysis::StaticSolution solution = two_bodies();
  analysis::IncrementResult increment = increment_number(solution, 1);
  increment.quantities = {{"joint.max_gap", 0.0, 2.5e-15, 0.0, {}}, {"tip.uy", 2.0, 0.02, 2.0, {}}};
  const std::string totals = report_totals(solution.model, increment);
  EXPECT_THAT(totals, HasSubstr("quantity: joint.max_gap = 0 +- 2.5e-15\n"));
  EXPECT_THAT(totals, HasSubstr("quantity: tip.uy = 2 +- 0.02 (1.0e-02)\n"));
}

}  // namespace
}  // namespace scabo::result
