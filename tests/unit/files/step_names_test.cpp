#include "scabo/files/step_names.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scabo/base/error.hpp"
#include "scabo/files/stl.hpp"

namespace scabo::files {
namespace {

TEST(StepNames, OfFacesInTheOrderOfTheirShell) {
  const auto solids = step_solids(R"(ISO-10303-21;
DATA;
#1 = MANIFOLD_SOLID_BREP('part; of two',#2);
#2 = CLOSED_SHELL('',(#4,
  #3));
#3=ADVANCED_FACE('it''s the (first) #9; face',(#10),#99,.T.);
#4 = ADVANCED_FACE('',(),#99,.F.);
#10 = FACE_OUTER_BOUND('',#11,.T.);
#11 = EDGE_LOOP('',(#12));
#12 = ORIENTED_EDGE('',*,*,#13,.T.);
#13 = EDGE_CURVE('',#14,#15,#98,.T.);
#14 = VERTEX_POINT('',#16);
#15 = VERTEX_POINT('',#17);
#16 = CARTESIAN_POINT('',(0.,1.5,-2.E0));
#17 = CARTESIAN_POINT('end, of it',( 3.,4.,5.));
#20 = BREP_WITH_VOIDS('',#2,(#21));
#21 = ORIENTED_CLOSED_SHELL('',*,#22,.F.);
#22 = CLOSED_SHELL('',(#23));
#23 = ADVANCED_FACE('of the void',(),#99,.T.);
#30 = ( A() B(#3) );
ENDSEC;
)");
  ASSERT_EQ(solids.size(), 2u);
  ASSERT_EQ(solids[0].size(), 2u);
  EXPECT_EQ(solids[0][0].name, "");
  EXPECT_EQ(solids[0][1].name, "it's the (first) #9; face");
  ASSERT_EQ(solids[0][1].vertices.size(), 2u);
  EXPECT_EQ(solids[0][1].vertices[0], Eigen::Vector3d(0, 1.5, -2));
  EXPECT_EQ(solids[0][1].vertices[1], Eigen::Vector3d(3, 4, 5));
  EXPECT_EQ(solids[1].size(), 3u);
}

TEST(StepNames, GoRoundInNoCircle) {
  const std::string circles =
      R"(#1=BREP_WITH_VOIDS('',#2,(#7));#2=CLOSED_SHELL('',(#2,#3));#3=ADVANCED_FACE('one',(#4));
#4=FACE_BOUND('',#5);#5=EDGE_LOOP('',(#5,#4,#6));#6=ORIENTED_EDGE('',#6,#5);#7=ORIENTED_CLOSED_SHELL('',#7,#2);)";
  const auto solids = step_solids(circles);
  ASSERT_EQ(solids.size(), 1u);
  EXPECT_EQ(solids[0].size(), 1u);  // the shell turned over is the same
  EXPECT_TRUE(solids[0][0].vertices.empty());
  for (std::size_t k = 0; k < circles.size(); ++k) step_solids(circles.substr(0, k));
}

TEST(StepNames, OfBrokenTextAreNone) {
  for (const char* text :
       {"", "#1", "#1=", "#1=MANIFOLD_SOLID_BREP('',#1);", "#1=MANIFOLD_SOLID_BREP('',#2);#2=CLOSED_SHELL('",
        "#1=MANIFOLD_SOLID_BREP(#2);#2=CLOSED_SHELL((#3));#3=ADVANCED_FACE();"})
    for (const auto& faces : step_solids(text))
      for (const StepFace& face : faces) EXPECT_EQ(face.name, "");
}

TEST(StepNames, RepetitionsAreFollowedOnce) {
  std::string repeated = "#1=BREP_WITH_VOIDS(''";
  const auto refer = [&repeated](int number, int next, const char* type) {
    repeated += fmt::format(");#{}={}(''", number, type);
    for (int k = 0; k < 300; ++k) repeated += fmt::format(",#{}", next);
  };
  for (int k = 0; k < 300; ++k) repeated += ",#2";
  refer(2, 3, "CLOSED_SHELL");
  refer(3, 4, "ADVANCED_FACE");
  refer(4, 5, "FACE_BOUND");
  refer(5, 6, "EDGE_LOOP");
  refer(6, 7, "ORIENTED_EDGE");
  refer(7, 8, "EDGE_CURVE");
  repeated += ");#8=VERTEX_POINT('',#9);#9=CARTESIAN_POINT('',(1.,2.,3.));";
  const auto solids = step_solids(repeated);
  ASSERT_EQ(solids.at(0).size(), 1u);
  EXPECT_EQ(solids[0][0].vertices.size(), 1u);
}

TEST(StepNames, PointsThatAreNoNumbersAreNoVertices) {
  const auto solids = step_solids(
      "#1=MANIFOLD_SOLID_BREP('',#2);#2=CLOSED_SHELL('',(#3));#3=ADVANCED_FACE('a',(#4));#4=FACE_BOUND('',#5);"
      "#5=VERTEX_LOOP('',#6,#7,#8);#6=VERTEX_POINT('',#9);#7=VERTEX_POINT('',#10);#8=VERTEX_POINT('',#11);"
      "#9=CARTESIAN_POINT('',(nan,0.,0.));#10=CARTESIAN_POINT('',(0.,1e999,0.));#11=CARTESIAN_POINT('',(1.,2.,3.));");
  ASSERT_EQ(solids.at(0).size(), 1u);
  ASSERT_EQ(solids[0][0].vertices.size(), 1u);
  EXPECT_EQ(solids[0][0].vertices[0], Eigen::Vector3d(1, 2, 3));
}

class Stl : public testing::Test {
 protected:
  std::string message(const std::string& text) const {
    const auto path = std::filesystem::temp_directory_path() / "scabo_stl_test.stl";
    std::ofstream(path, std::ios::binary) << text;
    try {
      return std::to_string(volume_of_stl(path.string()));
    } catch (const InputError& error) {
      return error.diagnostics().front().message;
    }
  }
  static std::string triangle(const char* a, const char* b, const char* c) {
    const std::string v = "vertex ";
    return "facet normal 0 0 0 outer loop " + v + a + " " + v + b + " " + v + c + " endloop endfacet\n";
  }
  const std::string side_1_ = triangle("0 0 0", "0 1 0", "1 0 0"), side_2_ = triangle("0 0 0", "1 0 0", "0 0 1"),
                    side_3_ = triangle("0 0 0", "0 0 1", "0 1 0"), side_4_ = triangle("1 0 0", "0 1 0", "0 0 1");
};

TEST_F(Stl, OfATetrahedronEnclosesASixth) {
  EXPECT_EQ(message("solid a\n" + side_1_ + side_2_ + side_3_ + side_4_), "0.166667");
}

TEST_F(Stl, IsRefusedUnlessItClosesASolid) {
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  EXPECT_TRUE(has(message("solid a\n" + side_1_ + side_2_ + side_3_), "do not close a solid"));
  EXPECT_TRUE(has(message("solid a\n" + side_1_ + side_1_ + side_2_ + side_3_ + side_4_), "do not close a solid"));
  EXPECT_TRUE(
      has(message("solid a\n" + side_1_ + side_2_ + side_3_ + triangle("1 0 0", "0 0 1", "0 1 0")), "turned over"));
  EXPECT_TRUE(has(message("solid a\n" + triangle("0 0 0", "1 0 0", "0 1 0") + triangle("0 0 0", "0 0 1", "1 0 0") +
                          triangle("0 0 0", "0 1 0", "0 0 1") + triangle("0 1 0", "1 0 0", "0 0 1")),
                  "turned inwards"));
  EXPECT_TRUE(has(message("solid a\nfacet outer loop vertex 0 0\n endloop"), "three corners"));
  EXPECT_TRUE(has(message("solid a\nfacet outer loop vertex 0 0 nan vertex"), "three corners"));
  EXPECT_TRUE(has(message(""), "no triangles"));
  EXPECT_TRUE(has(message(std::string(90, 'x')), "no triangles"));
}

}  // namespace
}  // namespace scabo::files
