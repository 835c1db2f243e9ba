#include "scabo/files/solid_abaqus.hpp"

#include <gtest/gtest.h>

#include "scabo/base/error.hpp"

namespace scabo::files {
namespace {

/// Two tetrahedra with 4 nodes on a common side 1, 2, 3; node 9 belongs to none.
const std::string two_cells = R"(** as CalculiX writes it
*NODE, NSET=Nall
1, 0., 0., 0.
2, 1., 0., 0.
3, 0., 1., 0.
14, 0.,0.,1.D0
5, 0, 0, -2
9, 7, 7, 7
*ELEMENT, TYPE=C3D4, ELSET=Upper
10, 1, 2, 3,
14
*ELEMENT, TYPE=C3D4
20, 1, 3, 2, 5
*NSET, NSET=Left
1, 3, 14, 5, 9
*ELSET, ELSET=Both, GENERATE
10, 20, 10
*SURFACE, NAME=Outside
Upper, S2
20, s4
*SURFACE, NAME=Middle, TYPE=ELEMENT
Both, S1
*MATERIAL, NAME=Steel
*ELASTIC
210e9, .3
)";

TEST(SolidAbaqus, ReadsNodesCellsSetsAndSurfaces) {
  const ImportedSolidMesh mesh = parse_solid_abaqus(two_cells, "two.inp");
  ASSERT_EQ(mesh.nodes.cols(), 5);
  EXPECT_EQ(mesh.nodes.col(3), Eigen::Vector3d(0, 0, 1));
  ASSERT_EQ(mesh.cells.size(), 2);
  EXPECT_EQ(mesh.cells[0].nodes, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(mesh.cells[1].nodes, (std::vector<int>{0, 2, 1, 4}));
  EXPECT_EQ(mesh.cells[1].number, 20);
  ASSERT_EQ(mesh.node_sets.size(), 2);
  EXPECT_EQ(mesh.node_sets[0].nodes, (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(mesh.node_sets[1].name, "Left");
  EXPECT_EQ(mesh.node_sets[1].nodes, (std::vector<int>{0, 2, 3, 4}));
  ASSERT_EQ(mesh.cell_sets.size(), 2);
  EXPECT_EQ(mesh.cell_sets[1].cells, (std::vector<int>{0, 1}));
  ASSERT_EQ(mesh.side_sets.size(), 2);
  ASSERT_EQ(mesh.side_sets[0].sides.size(), 2);
  EXPECT_EQ(mesh.side_sets[0].sides[1].cell, 1);
  EXPECT_EQ(mesh.side_sets[0].sides[1].side, 3);
  EXPECT_EQ(mesh.side_sets[1].sides.size(), 2);
  EXPECT_TRUE(mesh.remarks.empty());
}

TEST(SolidAbaqus, ReadsQuadraticCellsAndLeavesOutTheSurfacesOfGmsh) {
  std::string text = "*NODE\n";
  for (int i = 1; i <= 10; ++i)  // 10 points in general position, the corners as those of a unit tetrahedron
    text += std::to_string(i) + ", " + (i == 2 ? "1" : "0") + ", " + (i == 3 ? "1" : "0") + ", " +
            (i == 4 ? "1" : "0") + "\n";
  text += "*ELEMENT, TYPE=CPS6, ELSET=Surface1\n1, 1, 2, 3, 5, 6, 7\n";
  text += "*ELEMENT, TYPE=C3D10, ELSET=Volume1\n2, 1, 2, 3, 4, 5, 6, 7, 8,\n9, 10\n";
  const ImportedSolidMesh mesh = parse_solid_abaqus(text, "quadratic.inp");
  ASSERT_EQ(mesh.cells.size(), 1);
  EXPECT_EQ(mesh.cells[0].nodes, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(mesh.cell_sets.size(), 1);
  ASSERT_EQ(mesh.remarks.size(), 1);
  EXPECT_EQ(mesh.remarks[0], "quadratic.inp:12: elements of type CPS6 are no solids and are left out");
}

struct Broken {
  const char* from;
  const char* to;
  const char* message;
};

class BrokenSolids : public testing::TestWithParam<Broken> {};

TEST_P(BrokenSolids, AreRefusedWithOneSentence) {
  const auto& [from, to, message] = GetParam();
  std::string text = two_cells;
  ASSERT_NE(text.find(from), std::string::npos);
  text.replace(text.find(from), std::string(from).size(), to);
  try {
    parse_solid_abaqus(text, "two.inp");
    FAIL() << "no error";
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.rfind(message, 0), 0) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BrokenSolids,
    testing::Values(
        Broken{"14, 0.,0.,1.D0", "14, 0.,0.,high", "two.inp:6:1: 'high' is not a coordinate"},
        Broken{"14, 0.,0.,1.D0", "14, 0.,0.,1e999", "two.inp:6:1: node 14 has a coordinate that is not finite"},
        Broken{"14, 0.,0.,1.D0", "14, 0.,0.,0", "two.inp:10:1: cell 10 is flat or turned over"},
        Broken{"20, 1, 3, 2, 5", "20, 1, 2, 3, 5", "two.inp:13:1: cell 20 is flat or turned over"},
        Broken{"20, 1, 3, 2, 5", "20, 1, 3, 2", "two.inp:13:1: cell 20 has 3 nodes, but type C3D4 has 4"},
        Broken{"20, 1, 3, 2, 5", "20, 1, 3, 2, 6", "two.inp:13:1: cell 20 has the node 6, which the file does not"},
        Broken{"20, 1, 3, 2, 5", "10, 1, 3, 2, 5", "two.inp:13:1: this number is also that of the cell in line 10"},
        Broken{"5, 0, 0, -2", "3, 0, 0, -2", "two.inp:7:1: this number is also that of the node in line 5"},
        Broken{"TYPE=C3D4\n20", "TYPE=C3D8\n20", "two.inp:12:1: elements of type C3D8 are not read; use tetrahedra"},
        Broken{"Upper, S2", "Upper, S5", "two.inp:19:1: surface 'Outside': 'S5' is no side of a tetrahedron"},
        Broken{"Upper, S2", "Uper, S2", "two.inp:19:1: surface 'Outside': there is no element set 'Uper'"},
        Broken{"20, s4", "21, s4", "two.inp:20:1: surface 'Outside': there is no cell 21"},
        Broken{"10, 20, 10", "10, 5, 10", "two.inp:17:1: GENERATE needs a first number"},
        Broken{"1, 3, 14, 5, 9", "Right", "two.inp:15:1: 'Right' is neither a number nor the name of a set"},
        Broken{"*MATERIAL, NAME=Steel", "*PART, NAME=P", "two.inp:23:1: parts and instances of solids are not read"},
        Broken{"*MATERIAL, NAME=Steel", "*NGEN", "two.inp:23:1: *NGEN makes nodes or elements and is not read"}));

TEST(SolidAbaqus, WithoutSolidsIsRefused) {
  EXPECT_THROW(parse_solid_abaqus("*NODE\n1, 0, 0, 0\n", "empty.inp"), InputError);
  EXPECT_THROW(parse_solid_abaqus("", "empty.inp"), InputError);
}

}  // namespace
}  // namespace scabo::files
