// CAD files that Gmsh's library meshes, and the messages for those that it cannot.
#include "scabo/files/cad.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <thread>

#include "scabo/base/error.hpp"

namespace {

namespace fs = std::filesystem;
using namespace scabo::files;
using testing::HasSubstr;

class Cad : public testing::Test {
 protected:
  void SetUp() override {
    if (!reads_cad()) GTEST_SKIP() << "built without Gmsh's library";
    std::string name = (fs::temp_directory_path() / "scabo_test_XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  std::string message(const std::string& name, const std::string& text, CadOptions options = {0.1, 1}) const {
    try {
      mesh_cad_file(file(name, text), options);
    } catch (const scabo::InputError& error) {
      return error.what();
    }
    return "no error";
  }

  fs::path folder_;
};

const char* const plate = R"(SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 2, 1};
Disk(2) = {1, 0.5, 0, 0.25};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
)";
const char* const square = R"(Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
)";

double area_of(const ImportedMesh& mesh) {
  double area = 0.0;
  for (const ImportedCell& cell : mesh.cells) area += scabo::files::area_of(mesh, cell);
  return area;
}
double length_of_boundary(const ImportedMesh& mesh) {
  double length = 0.0;
  for (const BoundaryLoop& loop : boundary_facets(mesh))
    for (const Facet& facet : loop.facets) length += length_of(mesh, facet);
  return length;
}

TEST_F(Cad, PlateWithAHole) {
  const double area = 2.0 - std::numbers::pi / 16.0, length = 6.0 + std::numbers::pi / 2.0;
  const ImportedMesh mesh = mesh_cad_file(file("plate.geo", plate), {0.1, 2});
  EXPECT_NEAR(area_of(mesh), area, 1e-5);  // parabolas on sides that turn by 22.5 degrees
  EXPECT_NEAR(length_of_boundary(mesh), length, 1e-4);
  EXPECT_EQ(boundary_facets(mesh).size(), 2u);
  EXPECT_EQ(mesh.regions, std::vector<std::string>{"surface_3"});
  EXPECT_EQ(mesh.facet_sets.size(), 5u);
  // Chords of a circle: sides of 0.1 are 16 of a regular polygon.
  const ImportedMesh linear = mesh_cad_file(file("plate.geo", plate), {0.1, 1});
  const double polygon = 0.5 * 16 * 0.0625 * std::sin(std::numbers::pi / 8.0);
  EXPECT_NEAR(area_of(linear), 2.0 - polygon, 1e-12);
}

// Gmsh's program writes STEP files in millimetres, and Scabo reads them in metres.
TEST_F(Cad, StepAndBrepFiles) {
  if (std::system("gmsh --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "the program gmsh writes the files";
  const std::string geo = file("plate.geo", plate);
  for (const char* format : {"step", "brep"}) {
    const std::string out = (folder_ / fmt::format("part.{}", format)).string();
    ASSERT_EQ(std::system(fmt::format("gmsh -0 {} -format {} -o {} >/dev/null 2>&1", geo, format, out).c_str()), 0);
    const double unit = std::string(format) == "step" ? 1e-3 : 1.0;
    const ImportedMesh mesh = mesh_cad_file(out, {0.1 * unit, 2});
    EXPECT_NEAR(area_of(mesh) / (unit * unit), 2.0 - std::numbers::pi / 16.0, 1e-5) << format;
    EXPECT_NEAR(length_of_boundary(mesh) / unit, 6.0 + std::numbers::pi / 2.0, 1e-4) << format;
    std::ifstream stream(out);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_NE(message(fmt::format("cut.{}", format), text.substr(0, text.size() / 2)), "no error");
  }
}

TEST_F(Cad, PhysicalGroupsAreRegionsAndEdges) {
  const std::string groups =
      std::string(square) + "Physical Surface(\"rock\") = {1}; Physical Curve(\"base\") = {1};\n";
  const ImportedMesh mesh = mesh_cad_file(file("a.geo", groups), {0.25, 1});
  EXPECT_EQ(mesh.regions, std::vector<std::string>{"rock"});
  ASSERT_EQ(mesh.facet_sets.size(), 1u);
  EXPECT_EQ(mesh.facet_sets[0].name, "base");
  EXPECT_EQ(mesh.facet_sets[0].facets.size(), 4u);  // 1 m in sides of 0.25 m
}

// Options of one file do not reach the next, also after a broken one; threads wait for each other.
TEST_F(Cad, FilesDoNotInfluenceEachOther) {
  const std::string quads =
      file("quads.geo", "Mesh.RecombineAll = 1; Mesh.MeshSizeFactor = 0.5;\n" + std::string(square));
  const std::string plain = file("plain.geo", square);
  const std::size_t cells = mesh_cad_file(plain, {0.25, 1}).cells.size();
  std::vector<std::thread> threads;
  std::array<std::size_t, 3> found{};
  for (std::size_t& each : found)
    threads.emplace_back([&] {
      mesh_cad_file(quads, {0.25, 1});
      each = mesh_cad_file(plain, {0.25, 1}).cells.size();
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(found, testing::Each(cells));
  EXPECT_EQ(mesh_cad_file(quads, {0.25, 1}).cells.front().corners(), 4);
  message("bad.geo", "Point(1) = {0, 0;\n");
  EXPECT_EQ(mesh_cad_file(plain, {0.25, 1}).cells.size(), cells);
}

TEST_F(Cad, SignalsAndTemporaryFilesAreLeftAlone) {
  const auto handlers = [] {
    std::vector<void (*)(int)> all;
    for (const int signal : {SIGINT, SIGTERM, SIGFPE, SIGSEGV, SIGABRT, SIGHUP}) {
      struct sigaction action {};
      sigaction(signal, nullptr, &action);
      all.push_back(action.sa_handler);
    }
    return all;
  };
  const std::string geo = file("a.geo", square);
  const auto before = handlers();
  const char* old = std::getenv("TMPDIR");
  const std::string kept = old != nullptr ? old : "";
  const fs::path temporary = folder_ / "tmp";
  fs::create_directory(temporary);
  setenv("TMPDIR", temporary.c_str(), 1);
  mesh_cad_file(geo, {0.25, 1});
  message("b.geo", "Point(1) = {0, 0;\n");
  old != nullptr ? setenv("TMPDIR", kept.c_str(), 1) : unsetenv("TMPDIR");
  EXPECT_EQ(handlers(), before);
  EXPECT_TRUE(fs::is_empty(temporary));
}

TEST_F(Cad, Messages) {
  EXPECT_THAT(message("a.geo", "Point(1) = {0, 0, 0};\nPoint(2) = {1, 0, 0;\n"),
              HasSubstr("a.geo:2:1: Gmsh cannot read the file: syntax error"));
  EXPECT_THAT(message("a.geo", "Point(1) = {0, 0, 0};\n"), HasSubstr("the file has no surface"));
  EXPECT_THAT(message("a.geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\n"),
              HasSubstr("the file has a solid"));
  EXPECT_THAT(message("a.geo", "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0.5, 2, 1};\n"),
              HasSubstr("surface 1 is not in the plane z = 0: it lies between z = 0.5 and z = 0.5"));
  EXPECT_THAT(message("a.geo", std::string(square), {1e-9, 1}),
              HasSubstr("about 1.2e+18 nodes, more than the 1000000 allowed"));
  EXPECT_THAT(message("a.geo",
                      "Point(1) = {0, 0, 0}; Point(2) = {1, 1, 0}; Point(3) = {1, 0, 0};\n"
                      "Line(1) = {1, 2}; Line(2) = {2, 3};\nCurve Loop(1) = {1, 2}; Plane Surface(1) = {1};\n"),
              HasSubstr("Gmsh cannot"));
  EXPECT_THAT(message("a.step", "ISO-10303-21;\nHEADER;\nfoo"), HasSubstr("Gmsh cannot read the file"));
  EXPECT_THAT(message("a.brep", "DBRep_DrawableShape\n"), HasSubstr("does not end as a BREP file"));
}

// Without Gmsh's library these are found as well.
TEST(CadCommands, AreRefused) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("scabo_commands_{}", ::getpid());
  fs::create_directory(folder);
  const auto message = [&folder](const std::string& text) -> std::string {
    std::ofstream(folder / "a.geo") << text;
    try {
      mesh_cad_file((folder / "a.geo").string(), {});
    } catch (const scabo::InputError& error) {
      return error.what();
    }
    return "no error";
  };
  for (const char* command : {"SystemCall \"touch x\";", "NonBlockingSystemCall \"touch x\";", "// SystemCall \"x\";",
                              "OnelabRun(\"a\", \"b\");", "System \"touch x\";"})
    EXPECT_THAT(message(std::string("a = 1;\n") + command), HasSubstr("a.geo:2:1: the command ")) << command;
  for (const char* command :
       {"Save \"x.msh\";", "Print \"x.png\";", "Printf(\"%g\", (1)) > \"x\";", "CreateDir \"x\";", "Plugin(Skin).Run;"})
    EXPECT_THAT(message(std::string("a = 1;\n") + command), HasSubstr("writes files")) << command;
  EXPECT_THAT(message("Exit;"), HasSubstr("ends the program"));
  EXPECT_THAT(message("Include StrCat(\"a\", \"b\");"), HasSubstr("computed"));
  std::ofstream(folder / "b.inc") << "\n\nExit;\n";
  EXPECT_THAT(message("Include \"b.inc\";"), HasSubstr("b.inc:3:1: the command Exit"));
  EXPECT_THAT(message("// Save the plate\nPrintf(\"Print\");\n"), testing::Not(HasSubstr("the command")));
  EXPECT_THAT(message("Include \"a.geo\";"), HasSubstr("includes itself"));
  fs::remove_all(folder);
  try {
    mesh_cad_file("none.step", {});
    FAIL();
  } catch (const scabo::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("none.step: there is no such file"));
  }
}

}  // namespace
