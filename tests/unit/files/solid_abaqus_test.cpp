#include "scabo/files/solid_abaqus.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <map>

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
        Broken{"TYPE=C3D4\n20", "TYPE=C3D5\n20", "two.inp:12:1: elements of type C3D5 are not read; use C3D4, C3D6"},
        Broken{"TYPE=C3D4\n20", "TYPE=C3D8\n20", "two.inp:13:1: cell 20 has 4 nodes, but type C3D8 has 8"},
        Broken{"Upper, S2", "Upper, S5", "two.inp:19:1: surface 'Outside': 'S5' is no side of this element"},
        Broken{"Upper, S2", "Uper, S2", "two.inp:19:1: surface 'Outside': there is no element set 'Uper'"},
        Broken{"20, s4", "21, s4", "two.inp:20:1: surface 'Outside': there is no cell 21"},
        Broken{"10, 20, 10", "10, 5, 10", "two.inp:17:1: GENERATE needs a first number"},
        Broken{"1, 3, 14, 5, 9", "Right", "two.inp:15:1: 'Right' is neither a number nor the name of a set"},
        Broken{"*MATERIAL, NAME=Steel", "*PART, NAME=P", "two.inp:23:1: parts and instances of solids are not read"},
        Broken{"*MATERIAL, NAME=Steel", "*NGEN", "two.inp:23:1: *NGEN makes nodes or elements and is not read"}));

/// Nodes of a grid of bricks with sides 1, and its middles where `quadratic`, moved by a map; elements with nodes in
/// the order of Abaqus.
std::string bricks(bool quadratic, bool wedges, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& map) {
  const auto number = [](int x, int y, int z) { return 1 + x + 7 * (y + 7 * z); };  // halves, from 0 to 4
  std::string nodes = "*NODE\n", elements;
  for (int z = 0; z <= 4; ++z)
    for (int y = 0; y <= 4; ++y)
      for (int x = 0; x <= 4; ++x) {
        if (x % 2 + y % 2 + z % 2 > (quadratic ? wedges ? 2 : 1 : 0)) continue;
        const Eigen::Vector3d at = map(0.5 * Eigen::Vector3d(x, y, z));
        nodes += fmt::format("{}, {}, {}, {}\n", number(x, y, z), at.x(), at.y(), at.z());
      }
  const std::vector<Eigen::Vector3i> corners{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0},
                                             {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}};
  const std::vector<std::vector<std::size_t>> halves{{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}};
  int element = 0;
  for (int brick = 0; brick < 8; ++brick) {
    const Eigen::Vector3i origin = 2 * Eigen::Vector3i(brick % 2, brick / 2 % 2, brick / 4);
    const auto add = [&](const std::vector<std::size_t>& of) {
      const std::size_t n = of.size() / 2;
      std::vector<Eigen::Vector3i> all;
      for (const std::size_t c : of) all.push_back(origin + corners[c]);
      for (int level = 0; quadratic && level < 2; ++level)
        for (std::size_t k = 0; k < n; ++k) all.push_back((all[level * n + k] + all[level * n + (k + 1) % n]) / 2);
      for (std::size_t k = 0; quadratic && k < n; ++k) all.push_back((all[k] + all[n + k]) / 2);
      elements += fmt::format("{}", ++element);
      for (const Eigen::Vector3i& x : all) elements += fmt::format(", {}", number(x[0], x[1], x[2]));
      elements += "\n";
    };
    if (!wedges) add({0, 1, 2, 3, 4, 5, 6, 7});
    for (const auto& half : halves)
      if (wedges) add(half);
  }
  const int count = wedges ? quadratic ? 15 : 6 : quadratic ? 20 : 8;
  return nodes + fmt::format("*ELEMENT, TYPE=C3D{}, ELSET=ALL\n", count) + elements;
}

class SplitElements : public testing::TestWithParam<std::pair<bool, bool>> {};

/// As many tetrahedra as faces without one corner, all of which fit together and fill the block; a surface of sides is
/// all of it.
TEST_P(SplitElements, FillTheirBlock) {
  const auto [quadratic, wedges] = GetParam();
  std::string text = bricks(quadratic, wedges, [](const Eigen::Vector3d& x) { return x; });
  text += "*SURFACE, NAME=below\n";
  for (int k = 1; k <= (wedges ? 8 : 4); ++k) text += fmt::format("{}, S1\n", k);
  const ImportedSolidMesh mesh = parse_solid_abaqus(text, "bricks.inp");
  EXPECT_EQ(mesh.cells.size(), wedges ? 16 * 3 : 8 * 6);
  EXPECT_EQ(mesh.cell_sets.front().cells.size(), mesh.cells.size());
  EXPECT_EQ(mesh.cells.back().number, wedges ? 16 : 8);
  EXPECT_EQ(mesh.remarks.size(), 1u);
  double volume = 0.0, below = 0.0;
  std::map<std::vector<int>, int> sides;
  for (const ImportedSolidCell& cell : mesh.cells) {
    EXPECT_EQ(cell.nodes.size(), quadratic ? 10u : 4u);
    const Matrix x = mesh.nodes(Eigen::all, cell.nodes);
    volume +=
        Eigen::Vector3d(x.col(1) - x.col(0)).cross(Eigen::Vector3d(x.col(2) - x.col(0))).dot(x.col(3) - x.col(0)) / 6.0;
    if (quadratic) {
      EXPECT_LT((x.col(4) - 0.5 * (x.col(0) + x.col(1))).norm(), 1e-15);
      EXPECT_LT((x.col(9) - 0.5 * (x.col(2) + x.col(3))).norm(), 1e-15);
    }
    for (int side = 0; side < 4; ++side) {
      std::vector<int> corners = nodes_of_side(cell, side);
      std::sort(corners.begin(), corners.end());
      ++sides[corners];
    }
  }
  EXPECT_NEAR(volume, 8.0, 1e-14);
  EXPECT_EQ(std::count_if(sides.begin(), sides.end(), [](const auto& side) { return side.second == 1; }), 6 * 4 * 2);
  EXPECT_TRUE(std::all_of(sides.begin(), sides.end(), [](const auto& side) { return side.second <= 2; }));
  ASSERT_EQ(mesh.side_sets.size(), 1u);
  for (const SolidSide& side : mesh.side_sets[0].sides) {
    const Matrix x = mesh.nodes(Eigen::all, corners_of(mesh.cells[static_cast<std::size_t>(side.cell)], side.side));
    EXPECT_EQ(x.row(2).cwiseAbs().maxCoeff(), 0.0);
    below += 0.5 * Eigen::Vector3d(x.col(1) - x.col(0)).cross(Eigen::Vector3d(x.col(2) - x.col(0))).norm();
  }
  EXPECT_NEAR(below, 4.0, 1e-14);
}

/// Where that is wanted: cells in the order of the file, their sides named by surfaces.
TEST_P(SplitElements, RemainWholeIfTheyAreKept) {
  const auto [quadratic, wedges] = GetParam();
  std::string text = bricks(quadratic, wedges, [](const Eigen::Vector3d& x) { return x; });
  text += "*SURFACE, NAME=below\n";
  for (int k = 1; k <= (wedges ? 8 : 4); ++k) text += fmt::format("{}, S1\n", k);
  const ImportedSolidMesh mesh = parse_solid_abaqus(text, "bricks.inp", {}, Bricks::kept);
  EXPECT_EQ(mesh.cells.size(), wedges ? 16 : 8);
  EXPECT_TRUE(mesh.remarks.empty());
  for (const ImportedSolidCell& cell : mesh.cells) {
    EXPECT_EQ(sides_of(cell), wedges ? 5 : 6);
    EXPECT_EQ(cell.nodes.size(), (wedges ? 6u : 8u) + (quadratic ? (wedges ? 9u : 12u) : 0u));
  }
  double below = 0.0;
  for (const SolidSide& side : mesh.side_sets.at(0).sides)
    for (const std::vector<int>& corners :
         triangles_of_side(mesh.cells[static_cast<std::size_t>(side.cell)], side.side)) {
      const Eigen::Matrix3d x = mesh.nodes(Eigen::all, corners);
      EXPECT_EQ(x.row(2).cwiseAbs().maxCoeff(), 0.0);
      const Eigen::Vector3d area = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0));
      EXPECT_LT(area.z(), 0.0);  // outwards
      below += 0.5 * area.norm();
    }
  EXPECT_NEAR(below, 4.0, 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SplitElements,
                         testing::Values(std::pair(false, false), std::pair(true, false), std::pair(false, true),
                                         std::pair(true, true)));

/// A map of second order in the plane is that of the serendipity functions, so that added nodes lie where it leads.
TEST(SplitElements, PutAddedNodesWhereACurvedFaceLies) {
  const auto map = [](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x.x() + 0.1 * x.y() * x.y(), x.y(), x.z() + 0.2 * x.x() * x.y());
  };
  const ImportedSolidMesh mesh = parse_solid_abaqus(bricks(true, false, map), "bricks.inp");
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i) {
    const Eigen::Vector3d at = mesh.nodes.col(i),
                          halves = 2.0 * Eigen::Vector3d(at.x() - 0.1 * at.y() * at.y(), at.y(), 0.0);
    EXPECT_NEAR(halves.x(), std::round(halves.x()), 1e-14);
    const double z = 2.0 * (at.z() - 0.1 * halves.x() * at.y());
    EXPECT_NEAR(z, std::round(z), 1e-14);
  }
}

/// So a distorted mesh of hexahedra passes a constant pressure as exactly as one of tetrahedra.
TEST(SplitElements, HaveStraightDiagonalsWhereEdgesAreStraight) {
  const auto corner = [](const Eigen::Vector3d& x) {  // plane faces z = 0 and z = 2, warped ones between them
    return Eigen::Vector3d(x.x() + 0.1 * x.x() * x.y(), x.y() - 0.15 * x.x() * x.y() * x.z(), x.z());
  };
  const auto map = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {  // straight between the corners
    const Eigen::Vector3d low = x.array().floor(), high = x.array().ceil();
    return 0.5 * (corner(low) + corner(high));
  };
  const ImportedSolidMesh mesh = parse_solid_abaqus(bricks(true, false, map), "bricks.inp");
  int in_the_plane = 0;
  for (const ImportedSolidCell& cell : mesh.cells)
    for (int side = 0; side < 4; ++side) {
      const std::vector<int> nodes = nodes_of_side(cell, side);
      const Matrix x = mesh.nodes(Eigen::all, nodes);
      if (x.row(2).cwiseAbs().maxCoeff() > 1e-12) continue;
      ++in_the_plane;
      for (Eigen::Index k = 0; k < 3; ++k)
        EXPECT_LT((x.col(3 + k) - 0.5 * (x.col(k) + x.col((k + 1) % 3))).norm(), 1e-15);
    }
  EXPECT_EQ(in_the_plane, 8);
}

TEST(SolidAbaqus, WithoutSolidsIsRefused) {
  EXPECT_THROW(parse_solid_abaqus("*NODE\n1, 0, 0, 0\n", "empty.inp"), InputError);
  EXPECT_THROW(parse_solid_abaqus("", "empty.inp"), InputError);
}

}  // namespace
}  // namespace scabo::files
