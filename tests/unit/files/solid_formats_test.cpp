#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <ostream>
#include <string>

#include "scabo/base/cell_topology.hpp"
#include "scabo/base/error.hpp"
#include "scabo/files/read_mesh_file.hpp"

namespace scabo::files {
namespace {

/// Two tetrahedra of two volumes on the common side 1, 2, 3; the second is turned over.
const std::string solids_of_gmsh_2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
0 5 "apex"
2 1 "bottom of it"
3 7 "upper"
3 8 "lower"
$EndPhysicalNames
$Nodes
6
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 0 0 -2
9 7 7 7
$EndNodes
$Elements
7
1 15 2 5 1 4
2 1 2 9 3 1 2
3 2 2 1 4 5 2 3
4 2 2 2 6 1 2 3
5 4 2 7 1 1 2 3 4
6 4 2 8 2 1 2 3 5
7 4 2 9 2 1 2 3 5
$EndElements
)";

const std::string solids_of_gmsh_4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
4
0 5 "apex"
2 1 "bottom of it"
3 7 "upper"
3 8 "lower"
$EndPhysicalNames
$Entities
1 1 2 2
1 0 0 1 1 5
3 0 0 0 1 0 0 1 9 0
4 0 0 -2 1 1 0 1 1 0
6 0 0 0 1 1 0 1 2 0
1 0 0 0 1 1 1 1 7 0
2 0 0 -2 1 1 0 2 8 9 0
$EndEntities
$Nodes
1 6 1 9
3 1 0 6
1
2
3
4
5
9
0 0 0
1 0 0
0 1 0
0 0 1
0 0 -2
7 7 7
$EndNodes
$Elements
6 6 1 6
0 1 15 1
1 4
1 3 1 1
2 1 2
2 4 2 1
3 5 2 3
2 6 2 1
4 1 2 3
3 1 4 1
5 1 2 3 4
3 2 4 1
6 1 2 3 5
$EndElements
)";

const std::string solids_of_vtk = R"(<VTKFile type="UnstructuredGrid" version="0.1"><UnstructuredGrid>
<Piece NumberOfPoints="5" NumberOfCells="4">
<Points><DataArray type="Float64" NumberOfComponents="3">0 0 0 1 0 0 0 1 0 0 0 1 0 0 -2</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity">0 1 2 3 0 1 2 4 4 1 2 0 1</DataArray>
<DataArray type="Int32" Name="offsets">4 8 11 13</DataArray>
<DataArray type="UInt8" Name="types">10 10 5 3</DataArray></Cells>
<CellData><DataArray type="Int32" Name="region">7 8 1 1</DataArray></CellData>
</Piece></UnstructuredGrid></VTKFile>
)";

struct SolidFile {
  const char* name;
  const std::string* text;
  const char *upper, *bottom;
};

class SolidFormats : public testing::TestWithParam<SolidFile> {};

TEST_P(SolidFormats, GiveTheSameMesh) {
  const auto& [name, text, upper, bottom] = GetParam();
  const ImportedSolidMesh mesh = parse_solid_mesh(*text, name);
  ASSERT_EQ(mesh.nodes.cols(), 5);
  EXPECT_EQ(mesh.nodes.col(4), Eigen::Vector3d(0, 0, -2));
  ASSERT_EQ(mesh.cells.size(), 2);
  EXPECT_EQ(mesh.cells[0].nodes, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(mesh.cells[1].nodes, (std::vector<int>{0, 2, 1, 4}));
  ASSERT_GE(mesh.cell_sets.size(), 2);
  EXPECT_EQ(mesh.cell_sets[0].name, upper);
  EXPECT_EQ(mesh.cell_sets[0].cells, std::vector<int>{0});
  EXPECT_EQ(mesh.cell_sets[1].cells, std::vector<int>{1});
  ASSERT_GE(mesh.side_sets.size(), 1);
  EXPECT_EQ(mesh.side_sets[0].name, bottom);
  ASSERT_EQ(mesh.side_sets[0].sides.size(), 1);
  const SolidSide at = mesh.side_sets[0].sides[0];
  EXPECT_EQ(at.cell, 1);
  const std::vector<int> corners = corners_of(mesh.cells[1], at.side);
  const Eigen::Vector3d a = mesh.nodes.col(corners[1]) - mesh.nodes.col(corners[0]),
                        b = mesh.nodes.col(corners[2]) - mesh.nodes.col(corners[0]);
  EXPECT_EQ(a.cross(b), Eigen::Vector3d(2, 2, -1));  // outwards
}

INSTANTIATE_TEST_SUITE_P(All, SolidFormats,
                         testing::Values(SolidFile{"two.msh", &solids_of_gmsh_2, "upper", "bottom of it"},
                                         SolidFile{"two.msh", &solids_of_gmsh_4, "upper", "bottom of it"},
                                         SolidFile{"two.vtu", &solids_of_vtk, "region_7", "boundary_1"}));

/// A side between two cells is in its set as that of both, so that each body has it.
TEST(SolidFormatsOfGmsh, HaveSidesOfBothCellsCurvesPointsAndOtherGroups) {
  for (const std::string& text : {solids_of_gmsh_2, solids_of_gmsh_4}) {
    const ImportedSolidMesh mesh = parse_solid_mesh(text, "two.msh");
    ASSERT_EQ(mesh.side_sets.size(), 2);
    EXPECT_EQ(mesh.side_sets[1].name, "boundary_2");
    ASSERT_EQ(mesh.side_sets[1].sides.size(), 2);
    ASSERT_EQ(mesh.node_sets.size(), 1);
    EXPECT_EQ(mesh.node_sets[0].name, "apex");
    EXPECT_EQ(mesh.node_sets[0].nodes, std::vector<int>{3});
    ASSERT_EQ(mesh.line_sets.size(), 1);
    EXPECT_EQ(mesh.line_sets[0].name, "curve_9");
    EXPECT_EQ(mesh.line_sets[0].edges, (std::vector<std::array<int, 2>>{{0, 1}}));
    ASSERT_EQ(mesh.cell_sets.size(), 3);
    EXPECT_EQ(mesh.cell_sets[2].name, "region_9");  // a cell in two groups is one cell
    EXPECT_EQ(mesh.cell_sets[2].cells, std::vector<int>{1});
  }
}

/// Middle nodes are those between the corners, whichever order the format has and however the cell is turned.
TEST(SolidFormats, PutTheMiddleNodesOfQuadraticCellsInOrder) {
  const std::vector<Eigen::Vector3d> corners{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  using Edges = std::vector<std::pair<std::size_t, std::size_t>>;
  const Edges of_gmsh{{0, 1}, {1, 2}, {2, 0}, {3, 0}, {3, 2}, {3, 1}},
      of_vtk{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  for (const bool turned : {false, true}) {
    std::vector<Eigen::Vector3d> at = corners;
    if (turned) std::swap(at[0], at[3]);
    const auto points = [&](const Edges& edges, bool numbered) {
      std::string text;
      std::vector<Eigen::Vector3d> all = at;
      for (const auto& [i, j] : edges) all.push_back(0.5 * (at[i] + at[j]));
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (numbered) text += std::to_string(i + 1) + " ";
        for (const double x : all[i]) text += std::to_string(x) + " ";
        text += "\n";
      }
      return text;
    };
    const std::string gmsh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n" + points(of_gmsh, true) +
                             "$EndNodes\n$Elements\n1\n1 11 2 0 3 1 2 3 4 5 6 7 8 9 10\n$EndElements\n";
    const std::string vtk =
        "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\"><UnstructuredGrid><Piece NumberOfPoints=\"10\" "
        "NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">" +
        points(of_vtk, false) +
        "</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\">0 1 2 3 4 5 6 7 8 "
        "9</DataArray><DataArray type=\"Int32\" Name=\"offsets\">10</DataArray><DataArray type=\"UInt8\" "
        "Name=\"types\">24</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
    for (const ImportedSolidMesh& mesh : {parse_solid_mesh(gmsh, "one.msh"), parse_solid_mesh(vtk, "one.vtu")}) {
      ASSERT_EQ(mesh.cells.size(), 1);
      const auto x = [&](std::size_t i) -> Eigen::Vector3d { return mesh.nodes.col(mesh.cells[0].nodes[i]); };
      EXPECT_GT((x(1) - x(0)).cross(x(2) - x(0)).dot(x(3) - x(0)), 0.0);
      for (std::size_t k = 0; k < 6; ++k)
        EXPECT_EQ(x(4 + k), 0.5 * (x(of_vtk[k].first) + x(of_vtk[k].second))) << turned << k;
    }
  }
}

/// A hexahedron or wedge by its corners, with nodes in the middle of edges, and of sides and itself where a format has
/// them, as .msh and .vtu.
struct BrickFile {
  const char* name;
  std::size_t corners;
  std::vector<std::pair<std::size_t, std::size_t>> edges;  // in the order of the middle nodes
  std::size_t more;                                        // nodes behind those
  bool gmsh;
  int type;
};

void PrintTo(const BrickFile& file, std::ostream* out) { *out << file.name; }

using BrickEdges = std::vector<std::pair<std::size_t, std::size_t>>;
const BrickEdges brick_of_gmsh{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3},
                               {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}},
    wedge_of_gmsh{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}},
    brick_of_vtk{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}},
    wedge_of_vtk{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};

class BrickFiles : public testing::TestWithParam<BrickFile> {
 protected:
  /// `turned`: both ends change places. The side at its first edge is a set.
  ImportedSolidMesh read(Bricks bricks, bool turned) const {
    const BrickFile& file = GetParam();
    std::vector<Eigen::Vector3d> at{{0, 0, 0},    {2, 0, 0},    {2.5, 1.5, 0},  {0.5, 1.5, 0},
                                    {0, 0.25, 1}, {2, 0.25, 1}, {2.5, 1.75, 1}, {0.5, 1.75, 1}};
    if (file.corners == 6) at = {at[0], at[1], at[2], at[4], at[5], at[6]};
    const std::size_t half = file.corners / 2;
    if (turned) std::rotate(at.begin(), at.begin() + static_cast<std::ptrdiff_t>(half), at.end());
    for (const auto& [i, j] : file.edges) at.push_back(0.5 * (at[i] + at[j]));
    for (std::size_t k = 0; k < file.more; ++k) at.emplace_back(9.0, 9.0, 9.0 + static_cast<double>(k));
    const std::vector<std::size_t> side{0, 1, half + 1, half};
    std::string points, nodes, of_side;
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (file.gmsh) points += std::to_string(i + 1) + " ";
      for (const double x : at[i]) points += std::to_string(x) + " ";
      points += "\n";
      nodes += " " + std::to_string(file.gmsh ? i + 1 : i);
    }
    for (const std::size_t i : side) of_side += " " + std::to_string(file.gmsh ? i + 1 : i);
    const std::string count = std::to_string(at.size()), type = std::to_string(file.type);
    if (file.gmsh)
      return parse_solid_mesh("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + count + "\n" + points +
                                  "$EndNodes\n$Elements\n3\n1 3 2 7 7" + of_side + "\n2 " + type + " 2 0 3" + nodes +
                                  "\n3 " + type + " 2 4 3" + nodes + "\n$EndElements\n",
                              "one.msh", bricks);
    return parse_solid_mesh(
        "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\"><UnstructuredGrid><Piece NumberOfPoints=\"" + count +
            "\" NumberOfCells=\"2\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">" + points +
            "</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\">" + of_side + nodes +
            "</DataArray><DataArray type=\"Int32\" Name=\"offsets\">4 " + std::to_string(4 + at.size()) +
            "</DataArray><DataArray type=\"UInt8\" Name=\"types\">9 " + type +
            "</DataArray></Cells><CellData><DataArray type=\"Int32\" Name=\"region\">7 4</DataArray></CellData>"
            "</Piece></UnstructuredGrid></VTKFile>",
        "one.vtu", bricks);
  }
};

/// In the order of CellTopology, whichever the format has and however the cell is turned.
TEST_P(BrickFiles, KeepTheirCellsAndSides) {
  for (const bool turned : {false, true}) {
    const ImportedSolidMesh mesh = read(Bricks::kept, turned);
    const BrickFile& file = GetParam();
    ASSERT_EQ(mesh.cells.size(), 1u);  // also where Gmsh repeats it for a group
    EXPECT_TRUE(mesh.remarks.empty());
    const ImportedSolidCell& cell = mesh.cells[0];
    ASSERT_EQ(cell.nodes.size(), file.corners + file.edges.size());
    EXPECT_EQ(mesh.nodes.cols(), static_cast<Eigen::Index>(cell.nodes.size()));  // none of those in the middle of sides
    const auto& topology = CellTopology::of(cell.nodes.size());
    const auto x = [&](std::size_t i) -> Eigen::Vector3d { return mesh.nodes.col(cell.nodes[i]); };
    for (std::size_t e = 0; e < file.edges.size(); ++e)
      EXPECT_EQ(x(file.corners + e), 0.5 * (x(topology.edges[e][0]) + x(topology.edges[e][1]))) << turned << e;
    EXPECT_GT((x(1) - x(0)).cross(x(2) - x(0)).dot(x(file.corners / 2) - x(0)), 0.0);
    EXPECT_EQ(mesh.cell_sets.back().cells, std::vector<int>{0});
    ASSERT_EQ(mesh.side_sets.size(), 1u);
    ASSERT_EQ(mesh.side_sets[0].sides.size(), 1u);
    const std::vector<int> corners = corners_of(cell, mesh.side_sets[0].sides[0].side);
    ASSERT_EQ(corners.size(), 4u);
    const Eigen::Vector3d a = mesh.nodes.col(corners[1]) - mesh.nodes.col(corners[0]),
                          b = mesh.nodes.col(corners[2]) - mesh.nodes.col(corners[0]);
    EXPECT_LT(a.cross(b).y(), 0.0);  // outwards: along the first edge
    EXPECT_EQ(a.cross(b).x(), 0.0);
  }
}

/// Tetrahedra that fill the cell, in all its sets; its side is two triangles.
TEST_P(BrickFiles, AreDividedIfTheyAreNotKept) {
  for (const bool turned : {false, true}) {
    const ImportedSolidMesh mesh = read(Bricks::divided, turned);
    ASSERT_EQ(mesh.cells.size(), GetParam().corners == 8 ? 6u : 3u);
    ASSERT_EQ(mesh.remarks.size(), 1u);
    EXPECT_NE(mesh.remarks[0].find("1 hexahedra and wedges are divided"), std::string::npos);
    double volume = 0.0;
    for (const ImportedSolidCell& cell : mesh.cells) {
      EXPECT_EQ(cell.nodes.size(), GetParam().edges.empty() ? 4u : 10u);
      const Matrix x = mesh.nodes(Eigen::all, cell.nodes);
      const double six =
          Eigen::Vector3d(x.col(1) - x.col(0)).cross(Eigen::Vector3d(x.col(2) - x.col(0))).dot(x.col(3) - x.col(0));
      EXPECT_GT(six, 0.0);
      volume += six / 6.0;
      if (cell.nodes.size() == 10) {
        EXPECT_LT((x.col(5) - 0.5 * (x.col(1) + x.col(2))).norm(), 1e-15);
        EXPECT_LT((x.col(8) - 0.5 * (x.col(1) + x.col(3))).norm(), 1e-15);
      }
    }
    EXPECT_EQ(mesh.cell_sets.back().cells.size(), mesh.cells.size());
    ASSERT_EQ(mesh.side_sets.size(), 1u);
    EXPECT_EQ(mesh.side_sets[0].sides.size(), 2u);
    EXPECT_NEAR(volume, GetParam().corners == 8 ? 3.0 : 1.5, 1e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(All, BrickFiles,
                         testing::Values(BrickFile{"hexahedron of Gmsh", 8, {}, 0, true, 5},
                                         BrickFile{"wedge of Gmsh", 6, {}, 0, true, 6},
                                         BrickFile{"quadratic hexahedron of Gmsh", 8, brick_of_gmsh, 0, true, 17},
                                         BrickFile{"quadratic wedge of Gmsh", 6, wedge_of_gmsh, 0, true, 18},
                                         BrickFile{"hexahedron of Gmsh with 27 nodes", 8, brick_of_gmsh, 7, true, 12},
                                         BrickFile{"wedge of Gmsh with 18 nodes", 6, wedge_of_gmsh, 3, true, 13},
                                         BrickFile{"hexahedron of VTK", 8, {}, 0, false, 12},
                                         BrickFile{"wedge of VTK", 6, {}, 0, false, 13},
                                         BrickFile{"hexahedron of Lagrange", 8, {}, 0, false, 72},
                                         BrickFile{"quadratic hexahedron of VTK", 8, brick_of_vtk, 0, false, 25},
                                         BrickFile{"quadratic wedge of VTK", 6, wedge_of_vtk, 0, false, 26},
                                         BrickFile{"hexahedron of VTK with 24 nodes", 8, brick_of_vtk, 4, false, 33},
                                         BrickFile{"hexahedron of VTK with 27 nodes", 8, brick_of_vtk, 7, false, 29},
                                         BrickFile{"wedge of VTK with 18 nodes", 6, wedge_of_vtk, 3, false, 32}));

/// Its corners, and those of a pixel on it, go row by row.
TEST(SolidFormats, ReadVoxels) {
  const std::string text = R"(<VTKFile type="UnstructuredGrid" version="0.1"><UnstructuredGrid>
<Piece NumberOfPoints="8" NumberOfCells="2">
<Points><DataArray type="Float64" NumberOfComponents="3">0 0 0 1 0 0 0 2 0 1 2 0 0 0 3 1 0 3 0 2 3 1 2 3</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity">0 1 2 3 4 5 6 7 4 5 6 7</DataArray>
<DataArray type="Int32" Name="offsets">8 12</DataArray>
<DataArray type="UInt8" Name="types">11 8</DataArray></Cells>
<CellData><DataArray type="Int32" Name="region">7 1</DataArray></CellData>
</Piece></UnstructuredGrid></VTKFile>
)";
  const ImportedSolidMesh mesh = parse_solid_mesh(text, "one.vtu", Bricks::kept);
  ASSERT_EQ(mesh.cells.size(), 1u);
  EXPECT_EQ(mesh.cells[0].nodes, (std::vector<int>{0, 1, 3, 2, 4, 5, 7, 6}));
  EXPECT_EQ(corners_of(mesh.cells[0], mesh.side_sets.at(0).sides.at(0).side), (std::vector<int>{4, 5, 7, 6}));
  EXPECT_EQ(parse_solid_mesh(text, "one.vtu").cells.size(), 6u);
}

/// A hexahedron with one of its sides.
const std::string brick_of_gmsh_2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
8
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 0 1
6 1 0 1
7 1 1 1
8 0 1 1
$EndNodes
$Elements
2
1 3 2 1 1 1 2 3 4
2 5 2 7 1 1 2 3 4 5 6 7 8
$EndElements
)";

struct BrokenSolidFile {
  const std::string* text;
  const char *from, *to, *message;
};

class BrokenSolidFiles : public testing::TestWithParam<BrokenSolidFile> {};

TEST_P(BrokenSolidFiles, AreRefusedWithOneSentence) {
  const auto& [of, from, to, message] = GetParam();
  std::string text = *of;
  ASSERT_NE(text.find(from), std::string::npos);
  text.replace(text.find(from), std::string(from).size(), to);
  try {
    parse_solid_mesh(text, of == &solids_of_vtk ? "two.vtu" : "two.msh");
    FAIL() << "no error";
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find(message), std::string::npos) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BrokenSolidFiles,
    testing::Values(
        BrokenSolidFile{&solids_of_gmsh_2, "6 4 2 8", "6 7 2 8",
                        "two.msh:27:6: cell 6 has Gmsh's type 7, a pyramid, which is not"},
        BrokenSolidFile{&solids_of_gmsh_2, "6 4 2 8", "6 29 2 8",
                        "two.msh:27:7: cell 6 has Gmsh's type 29, which is not"},
        BrokenSolidFile{&brick_of_gmsh_2, "7 1 1 2 3 4", "7 1 1 2 4 3",
                        "two.msh:18:1: cell 2 is folded: put its nodes in order"},
        BrokenSolidFile{&brick_of_gmsh_2, "5 0 0 1", "5 0 0 0", "two.msh:18:1: cell 2 is flat"},
        BrokenSolidFile{&brick_of_gmsh_2, "1 2 3 4 5 6 7 8", "1 2 2 1 1 2 2 1", "two.msh:18:1: cell 2 is flat"},
        BrokenSolidFile{&brick_of_gmsh_2, "1 2 3 4 5 6 7 8", "1 2 3 4 5 6 7 -8",
                        "two.msh:18:1: cell 2 has the node -8; numbers"},
        BrokenSolidFile{&brick_of_gmsh_2, "1 2 3 4 5 6 7 8", "1 2 3 4 5 6 7 9",
                        "cell 2 has the node 9, which the file does not"},
        BrokenSolidFile{&brick_of_gmsh_2, "1 2 3 4 5 6 7 8", "1 2 3 4 5 6 7", "two.msh:19:"},
        BrokenSolidFile{&solids_of_gmsh_2, "4 0 0 1", "4 0 0 0", "two.msh:26:1: cell 5 is flat"},
        BrokenSolidFile{&solids_of_gmsh_2, "4 0 0 1", "5 0 0 1", "two.msh:17:1: this number is also that of the node"},
        BrokenSolidFile{&solids_of_gmsh_2, "4 0 0 1", "4 0 0 nan", "two.msh:16:"},
        BrokenSolidFile{&solids_of_gmsh_2, "1 2 3 4\n", "1 2 3 6\n", "cell 5 has the node 6, which the file does not"},
        BrokenSolidFile{&solids_of_gmsh_2, "7 4 2 9 2", "5 4 2 9 3",
                        "two.msh:28:1: this number is also that of the cell"},
        BrokenSolidFile{&solids_of_gmsh_4, "$Elements\n6 6", "$Elements\n6 7",
                        "$Elements announces 7 elements, its blocks have 6"},
        BrokenSolidFile{&solids_of_vtk, "10 10 5 3", "14 10 5 3",
                        "cell 0 (counted from 0) has VTK's type 14 with 4 nodes, which is not read in space"},
        BrokenSolidFile{&solids_of_vtk, "10 10 5 3", "72 10 5 3",
                        "cell 0 (counted from 0) has VTK's type 72 with 4 nodes, which is not read in space"},
        BrokenSolidFile{&solids_of_vtk, "10 10 5 3", "12 10 5 3",
                        "cell 0 (counted from 0) of VTK's type 12 has 4 nodes instead of 8"},
        BrokenSolidFile{&solids_of_vtk, "10 10 5 3", "10 24 5 3",
                        "cell 1 (counted from 0) of VTK's type 24 has 4 nodes"},
        BrokenSolidFile{&solids_of_vtk, "10 10 5 3", "0 0 5 3",
                        "two.vtu: the file has no tetrahedra, hexahedra or wedges"},
        BrokenSolidFile{&solids_of_vtk, "0 0 1 0 0 -2", "0 0 0 0 0 -2", "cell 0 is flat"}));

}  // namespace
}  // namespace scabo::files
