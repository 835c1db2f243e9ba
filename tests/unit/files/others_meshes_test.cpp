// Meshes that others made: the input files of Debian's calculix-ccx-test and the tutorials of gmsh-doc, meshed by Gmsh.
// Each test is skipped where its package is not installed. Areas are computed by hand from the geometry.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "scabo/base/error.hpp"
#include "scabo/files/read_mesh_file.hpp"

namespace {

using namespace scabo::files;
namespace fs = std::filesystem;

double area_of_all(const ImportedMesh& mesh) {
  double sum = 0.0;
  for (const ImportedCell& cell : mesh.cells) sum += area_of(mesh, cell);
  return sum;
}

/// Length of a set of facets; 0 if there is none of that name.
double length_of_set(const ImportedMesh& mesh, const std::string& name) {
  double sum = 0.0;
  for (const FacetSet& set : mesh.facet_sets) {
    for (const Facet& facet : set.facets) sum += set.name == name ? length_of(mesh, facet) : 0.0;
  }
  return sum;
}

bool runs(const std::string& command) { return std::system(("(" + command + ") >/dev/null 2>&1").c_str()) == 0; }

class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("scabo_mesh_files_" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

TEST(OthersMeshes, CalculixTestExamples) {
  const fs::path folder = "/usr/share/doc/calculix-ccx-test/examples/test";
  if (!fs::exists(folder)) GTEST_SKIP() << "the package calculix-ccx-test is not installed";
  // Those whose mesh is plane, with their areas: most are rectangles; of dam and plate by the shoelace formula outside
  // of Scabo. The nodes of some are rounded to seven digits.
  const std::map<std::string, double> plane{{"ax6", 8.0},
                                            {"ax6ht", 8.0},
                                            {"axial", 0.0900000004190949},
                                            {"axiplane", 2.00000001490116},
                                            {"axrad", 0.15},
                                            {"axrad2", 0.00712499999959054},
                                            {"bolt", 347.109},
                                            {"concretebeam", 10.0},
                                            {"dam", 1067.551026},
                                            {"edgeload", 50.0},
                                            {"leifer1", 229.0 * 229.0},
                                            {"leifer2", 229.0 * 229.0},
                                            {"oneel", 1.0},
                                            {"planestrain", 1.0},
                                            {"planestrain2", 1.0},
                                            {"planestress", 1.0},
                                            {"planestress2", 1.0},
                                            {"planestress3", 200.0},
                                            {"plate", 30.6},
                                            {"pret2", 2.0},
                                            {"ring1", 0.02},
                                            {"ring2", 0.02},
                                            {"rot4", 1.0},
                                            {"scheibe", 1.0},
                                            {"shell1", 1.0},
                                            {"shell1lin", 1.0},
                                            {"shell3", 0.1},
                                            {"shellf", 1.0},
                                            {"shellf2", 1.0},
                                            {"spring4", 0.04},
                                            {"square", 229.0 * 229.0},
                                            {"thread", 356.6764429824544}};
  std::map<std::string, int> refused;
  int read = 0;
  const Folder unpacked;
  ASSERT_TRUE(
      runs("cp " + (folder / "*.inp*").string() + " " + unpacked.file("") + " && gunzip -f " + unpacked.file("*.gz")));
  for (const auto& entry : fs::directory_iterator(unpacked.file(""))) {
    if (entry.path().extension() != ".inp") continue;
    const std::string name = entry.path().stem().string();
    SCOPED_TRACE(name);
    try {
      const ImportedMesh mesh = read_mesh_file(entry.path().string());
      ++read;
      ASSERT_TRUE(plane.count(name) > 0) << "is plane, with area " << area_of_all(mesh);
      const double area = plane.at(name);
      EXPECT_NEAR(area_of_all(mesh), area, 1e-7 * area);
      EXPECT_FALSE(boundary_facets(mesh).empty());
    } catch (const scabo::InputError& error) {
      EXPECT_EQ(plane.count(name), 0u) << error.what();
      const std::string text = error.what();
      for (const char* reason : {"three-dimensional", "not in a plane", "truss or beam", "mesh is empty", "is not read",
                                 "cannot be read", "no area"}) {
        if (text.find(reason) == std::string::npos) continue;
        ++refused[reason];
        break;
      }
    }
  }
  std::string report = std::to_string(read) + " read";
  for (const auto& [reason, count] : refused) report += ", " + std::to_string(count) + " " + reason;
  RecordProperty("calculix", report);
  std::printf("%s\n", report.c_str());
  EXPECT_EQ(read, static_cast<int>(plane.size()));
}

TEST(OthersMeshes, GmshTutorial1InAllFormats) {
  // A rectangle 0.1 x 0.3; group 5 has the curves at its bottom, top and left: 0.1 + 0.3 + 0.3.
  const std::string geo = "/usr/share/doc/gmsh-doc/doc/gmsh/tutorial/t1.geo.gz";
  if (!fs::exists(geo) || !runs("gmsh -version")) GTEST_SKIP() << "the packages gmsh and gmsh-doc are not installed";
  const Folder folder;
  ASSERT_TRUE(runs("zcat " + geo + " > " + folder.file("t1.geo")));
  std::size_t cells = 0;
  for (const std::string options : {"-format msh22", "-format msh22 -bin", "-format msh41", "-format msh41 -bin",
                                    "-format msh41 -order 2", "-format msh22 -order 2 -bin"}) {
    SCOPED_TRACE(options);
    const std::string file = folder.file("t1.msh");
    ASSERT_TRUE(runs("gmsh -2 " + folder.file("t1.geo") + " " + options + " -o " + file));
    const ImportedMesh mesh = read_mesh_file(file);
    if (cells == 0) cells = mesh.cells.size();
    EXPECT_EQ(mesh.cells.size(), cells);
    EXPECT_NEAR(area_of_all(mesh), 0.03, 1e-14);
    EXPECT_THAT(mesh.regions, testing::ElementsAre("My surface"));
    EXPECT_NEAR(length_of_set(mesh, "boundary_5"), 0.7, 1e-13);
    const auto loops = boundary_facets(mesh);
    ASSERT_EQ(loops.size(), 1u);
    EXPECT_NEAR(loops[0].area, 0.03, 1e-14);
  }
}

TEST(OthersMeshes, GmshTutorials) {
  const fs::path folder_of_geo = "/usr/share/doc/gmsh-doc/doc/gmsh/tutorial";
  if (!fs::exists(folder_of_geo) || !runs("gmsh -version")) GTEST_SKIP() << "gmsh and gmsh-doc are not installed";
  const Folder folder;
  // t6: t1, 0.1 x 0.3, and at its left a trapezium of height 0.05 between sides of 0.3 and 0.05; t2: as t1; t11: 2.5 x
  // 1.75.
  const std::map<std::string, double> areas{{"t1", 0.03}, {"t6", 0.03875}, {"t2", 0.03}, {"t11", 2.5 * 1.75}};
  for (const auto& [name, area] : areas) {
    SCOPED_TRACE(name);
    const fs::path plain = folder_of_geo / (name + ".geo"), packed = folder_of_geo / (name + ".geo.gz");
    ASSERT_TRUE(runs(fs::exists(plain) ? "cp " + plain.string() + " " + folder.file(name + ".geo")
                                       : "zcat " + packed.string() + " > " + folder.file(name + ".geo")));
    const std::string file = folder.file(name + ".msh");
    ASSERT_TRUE(runs("gmsh -2 " + folder.file(name + ".geo") + " -format msh41 -o " + file));
    const ImportedMesh mesh = read_mesh_file(file);
    EXPECT_NEAR(area_of_all(mesh), area, 1e-12 * area);
  }
}

}  // namespace
