// The same mesh in all formats gives the same value; areas, counts and lengths are computed by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "sample_files.hpp"
#include "scabo/base/error.hpp"
#include "scabo/files/abaqus.hpp"
#include "scabo/files/read_mesh_file.hpp"

namespace {

using namespace scabo::files;
using scabo::Vec2;
using testing::ElementsAre;

std::map<std::string, std::string> files_of(const sample::Mesh& mesh, bool linear) {
  using sample::Vtu;
  std::map<std::string, std::string> files{{"22.msh", sample::msh22(mesh, false)},
                                           {"22_binary.msh", sample::msh22(mesh, true)},
                                           {"41.msh", sample::msh41(mesh, false)},
                                           {"41_binary.msh", sample::msh41(mesh, true)},
                                           {"a.inp", sample::inp(mesh)},
                                           {"text.vtu", sample::vtu(mesh, Vtu::text)},
                                           {"base64.vtu", sample::vtu(mesh, Vtu::base64)},
                                           {"base64_wide.vtu", sample::vtu(mesh, Vtu::base64, true)},
                                           {"base64_zlib.vtu", sample::vtu(mesh, Vtu::base64_zlib)},
                                           {"raw.vtu", sample::vtu(mesh, Vtu::raw)},
                                           {"raw_zlib.vtu", sample::vtu(mesh, Vtu::raw_zlib, true)},
                                           {"appended_base64.vtu", sample::vtu(mesh, Vtu::appended_base64)}};
  if (linear) {
    files["by_hand_22.msh"] = sample::msh22_by_hand;
    files["by_hand_41.msh"] = sample::msh41_by_hand;
    files["by_hand.inp"] = sample::inp_by_hand;
    files["by_hand.vtu"] = sample::vtu_by_hand;
  }
  return files;
}

/// Everything but numbers and lines, which differ between formats; sets of a kind are sorted by their names.
std::string text_of(const ImportedMesh& mesh) {
  std::string text;
  for (const Vec2& node : mesh.nodes) text += std::to_string(node.x()) + " " + std::to_string(node.y()) + "\n";
  for (const ImportedCell& cell : mesh.cells) {
    text += std::string(name_of(cell.kind)) + " in " + mesh.regions[static_cast<std::size_t>(cell.region)] + ":";
    for (const int node : cell.nodes) text += " " + std::to_string(node);
    text += "\n";
  }
  std::map<std::string, std::string> sets;
  for (const FacetSet& set : mesh.facet_sets) {
    for (const Facet& f : set.facets) {
      sets["facets " + set.name] +=
          " " + std::to_string(f.start) + "-" + std::to_string(f.end) + "-" + std::to_string(f.middle);
    }
  }
  for (const NodeSet& set : mesh.node_sets) {
    for (const int node : set.nodes) sets["nodes " + set.name] += " " + std::to_string(node);
  }
  for (const CellSet& set : mesh.cell_sets) {
    for (const int cell : set.cells) sets["cells " + set.name] += " " + std::to_string(cell);
  }
  for (const auto& [name, members] : sets) text += name + ":" + members + "\n";
  return text;
}

double length_of_set(const ImportedMesh& mesh, const FacetSet& set) {
  double sum = 0.0;
  for (const Facet& facet : set.facets) sum += length_of(mesh, facet);
  return sum;
}

TEST(MeshFiles, TheLinearMeshHasItsAreasAndSets) {
  for (const auto& [name, bytes] : files_of(sample::linear(), true)) {
    SCOPED_TRACE(name);
    const ImportedMesh mesh = parse_mesh(bytes, name);
    ASSERT_EQ(mesh.nodes.size(), 6u);
    ASSERT_EQ(mesh.cells.size(), 3u);
    EXPECT_EQ(mesh.cells[0].kind, CellKind::quad4);
    EXPECT_THAT(mesh.cells[0].nodes, ElementsAre(0, 1, 4, 3));
    EXPECT_THAT(mesh.cells[2].nodes, ElementsAre(1, 5, 4));
    EXPECT_DOUBLE_EQ(area_of(mesh, mesh.cells[0]), 1.0);
    EXPECT_DOUBLE_EQ(area_of(mesh, mesh.cells[1]), 0.5);
    EXPECT_THAT(mesh.regions, ElementsAre("region_1", "region_2"));
    ASSERT_EQ(mesh.facet_sets.size(), 1u);
    EXPECT_EQ(mesh.facet_sets[0].name, "boundary_3");
    EXPECT_DOUBLE_EQ(length_of_set(mesh, mesh.facet_sets[0]), 2.0);
    ASSERT_EQ(mesh.node_sets.size(), 1u);
    EXPECT_THAT(mesh.node_sets[0].nodes, ElementsAre(5));
    EXPECT_EQ(text_of(mesh), text_of(parse_mesh(sample::msh22_by_hand, "by_hand.msh")));
  }
}

TEST(MeshFiles, TheQuadraticMeshHasItsAreasAndSets) {
  const std::string expected = text_of(parse_mesh(sample::msh22(sample::quadratic(), false), "a.msh"));
  for (const auto& [name, bytes] : files_of(sample::quadratic(), false)) {
    SCOPED_TRACE(name);
    const ImportedMesh mesh = parse_mesh(bytes, name);
    ASSERT_EQ(mesh.nodes.size(), 14u);
    ASSERT_EQ(mesh.cells.size(), 3u);
    EXPECT_EQ(mesh.cells[0].kind, CellKind::quad8);
    EXPECT_EQ(mesh.cells[1].kind, CellKind::triangle6);
    EXPECT_THAT(mesh.cells[0].nodes, ElementsAre(0, 1, 4, 3, 6, 7, 8, 9));
    EXPECT_DOUBLE_EQ(area_of(mesh, mesh.cells[0]), 1.1);
    EXPECT_DOUBLE_EQ(area_of(mesh, mesh.cells[2]), 0.5);
    ASSERT_EQ(mesh.facet_sets.size(), 1u);
    EXPECT_EQ(mesh.facet_sets[0].facets[1], (Facet{1, 2, 10}));
    EXPECT_NEAR(length_of_set(mesh, mesh.facet_sets[0]), 2.0, 1e-14);
    EXPECT_EQ(text_of(mesh), expected);
    const auto loops = boundary_facets(mesh);
    ASSERT_EQ(loops.size(), 1u);
    EXPECT_EQ(loops[0].facets.size(), 6u);
    EXPECT_NEAR(loops[0].area, 2.1, 1e-14);
  }
}

TEST(MeshFiles, CellsKnowTheirNumberAndLine) {
  const ImportedMesh gmsh = parse_mesh(sample::msh22_by_hand, "a.msh");
  EXPECT_EQ(gmsh.cells[1].number, 11);
  EXPECT_EQ(gmsh.cells[1].line, 19);
  const ImportedMesh abaqus = parse_mesh(sample::inp_by_hand, "a.inp");
  EXPECT_EQ(abaqus.cells[2].number, 12);
  EXPECT_EQ(abaqus.cells[2].line, 17);
  const ImportedMesh vtu = parse_mesh(sample::vtu_by_hand, "a.vtu");
  EXPECT_EQ(vtu.cells[1].number, 4);
  EXPECT_EQ(vtu.cells[1].line, 17);
}

TEST(MeshFiles, ClockwiseCellsAreTurnedRound) {
  sample::Mesh mesh = sample::quadratic();
  mesh.cells[3].nodes = {1, 4, 5, 2, 10, 9, 8, 7};
  mesh.cells[0].nodes = {2, 1, 7};  // the direction of a facet on the boundary does not matter either
  const ImportedMesh turned = parse_mesh(sample::msh41(mesh, true), "a.msh");
  EXPECT_EQ(text_of(turned), text_of(parse_mesh(sample::msh41(sample::quadratic(), true), "a.msh")));
}

TEST(MeshFiles, CentreNodesAndUnusedNodesAreDropped) {
  sample::Mesh mesh = sample::quadratic();
  mesh.nodes.push_back({0.5, 0.5, 0});
  mesh.nodes.push_back({7, 7, 7});  // in no cell: may be anywhere
  mesh.cells[3] = {10, 28, 1, {1, 2, 5, 4, 7, 8, 9, 10, 15}};
  for (const std::string& bytes :
       {sample::msh22(mesh, true), sample::vtu(mesh, sample::Vtu::raw), sample::msh41(mesh, false)}) {
    EXPECT_EQ(text_of(parse_mesh(bytes, "a")), text_of(parse_mesh(sample::msh22(sample::quadratic(), false), "a.msh")));
  }
}

TEST(MeshFiles, NumbersMayBeLargeAndHaveGaps) {
  std::string text = sample::msh41_by_hand;
  text = sample::replaced(text, "\n5\n6\n", "\n5\n9000000000000\n");
  text = sample::replaced(text, "3 6\n", "3 9000000000000\n");
  text = sample::replaced(text, "11 2 3 6", "11 2 3 9000000000000");
  text = sample::replaced(text, "12 2 6 5", "12 2 9000000000000 5");
  EXPECT_EQ(text_of(parse_mesh(text, "a.msh")), text_of(parse_mesh(sample::msh41_by_hand, "a.msh")));
}

TEST(MeshFiles, WindowsLineEndsAndByteOrderMark) {
  for (const char* sample_file :
       {sample::msh22_by_hand, sample::msh41_by_hand, sample::inp_by_hand, sample::vtu_by_hand}) {
    std::string windows = "\xEF\xBB\xBF";
    for (const char* c = sample_file; *c != '\0'; ++c) windows += *c == '\n' ? std::string("\r\n") : std::string(1, *c);
    EXPECT_EQ(text_of(parse_mesh(windows, "a.inp")), text_of(parse_mesh(sample_file, "a.inp")));
  }
}

TEST(MeshFiles, ByteOrderMarkOfAnIncludedFile) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "byte_order_mark";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "all.inp") << "*INCLUDE, INPUT=part.inp\n";
  const std::string text = sample::inp_by_hand;
  std::ofstream(folder / "part.inp") << "\xEF\xBB\xBF" << text.substr(text.find("*Node"));
  EXPECT_EQ(text_of(read_mesh_file((folder / "all.inp").string())), text_of(parse_mesh(sample::inp_by_hand, "a.inp")));
  std::filesystem::remove_all(folder);
}

TEST(Gmsh, NamesOfPhysicalGroupsAndEntities) {
  const std::string names =
      "$PhysicalNames\n3\n1 3 \"the bottom\"\n2 1 \"stone\"\n2 2 \"mortar\"\n$EndPhysicalNames\n$Nodes";
  for (const char* file : {sample::msh22_by_hand, sample::msh41_by_hand}) {
    const ImportedMesh mesh = parse_mesh(sample::replaced(file, "$Nodes", names), "a.msh");
    EXPECT_THAT(mesh.regions, ElementsAre("stone", "mortar"));
    EXPECT_EQ(mesh.facet_sets.at(0).name, "the bottom");
  }
  std::string no_groups = sample::msh41_by_hand;  // as Gmsh saves a model without physical groups
  const auto from = no_groups.find("$Entities"), to = no_groups.find("$Nodes");
  no_groups.erase(from, to - from);
  const ImportedMesh mesh = parse_mesh(no_groups, "a.msh");
  EXPECT_THAT(mesh.regions, ElementsAre("surface_1", "surface_2"));
  EXPECT_EQ(mesh.facet_sets.at(0).name, "curve_1");
  EXPECT_EQ(mesh.node_sets.at(0).name, "point_6");
}

TEST(Gmsh, NamesWithoutDimensionInVersion20) {
  // Version 2.0 has only tag and name: https://gmsh.info/doc/texinfo, "Legacy formats". The elements tell the
  // dimension.
  const std::string by_hand = sample::replaced(sample::msh22_by_hand, "2.2 0 8", "2 0 8");
  const std::string names = "$PhysicalNames\n3\n3 \"the bottom\"\n1 \"stone\"\n2\t\"2 \"half\" mortar\"\n";
  const std::string with_dimensions =
      "$PhysicalNames\n3\n1 3 \"the bottom\"\n2 1 \"stone\"\n2 2 \"2 \"half\" mortar\"\n";
  for (const std::string& lines : {names, with_dimensions})
    for (const bool windows : {false, true}) {
      std::string text = sample::replaced(by_hand, "$Nodes", lines + "$EndPhysicalNames\n$Nodes");
      for (std::size_t at = 0; windows && (at = text.find('\n', at)) != std::string::npos; at += 2)
        text.replace(at, 1, "\r\n");
      const ImportedMesh mesh = parse_mesh(text, "a.msh");
      EXPECT_THAT(mesh.regions, ElementsAre("stone", "2 \"half\" mortar"));
      EXPECT_EQ(mesh.facet_sets.at(0).name, "the bottom");
    }
  // The same tag as a curve and as a surface: one name for both.
  const std::string both =
      sample::replaced(by_hand, "$Nodes", "$PhysicalNames\n1\n1 \"stone\"\n$EndPhysicalNames\n$Nodes");
  const ImportedMesh mesh = parse_mesh(sample::replaced(both, "1 1 2 3 1 1 2", "1 1 2 1 1 1 2"), "a.msh");
  EXPECT_EQ(mesh.regions.at(0), "stone");
  EXPECT_EQ(mesh.facet_sets.at(0).name, "stone");
}

TEST(Gmsh, ACellInSeveralGroupsIsOneCell) {
  // Version 2.2 repeats the element for each group; version 4.1 lists the groups of its entity.
  std::string old = sample::replaced(sample::msh22_by_hand, "$Elements\n6", "$Elements\n7");
  old = sample::replaced(old, "10 3 2 1 1 1 2 5 4\n", "10 3 2 1 1 1 2 5 4\n13 3 2 8 1 1 2 5 4\n");
  const std::string recent = sample::replaced(sample::msh41_by_hand, "1 0 0 0 1 1 0 1 1 0", "1 0 0 0 1 1 0 2 1 8 0");
  for (const std::string& text : {old, recent}) {
    const ImportedMesh mesh = parse_mesh(text, "a.msh");
    ASSERT_EQ(mesh.cells.size(), 3u);
    EXPECT_THAT(mesh.regions, ElementsAre("region_1", "region_2"));
    ASSERT_EQ(mesh.cell_sets.size(), 3u);
    EXPECT_EQ(mesh.cell_sets[1].name, "region_8");
    EXPECT_THAT(mesh.cell_sets[1].cells, ElementsAre(0));
    EXPECT_THAT(mesh.cell_sets[2].cells, ElementsAre(1, 2));
  }
}

TEST(Abaqus, SectionsSetsAndSurfaces) {
  const std::string more = R"(*ELSET, ELSET=Right, GENERATE
11, 12, 1
** a comment
*elset, elset = all
10, right
*MATERIAL, NAME=Granite
*ELASTIC
3e10, 0.2
*SOLID SECTION, ELSET=all, MATERIAL=granite

*SOLID SECTION, ELSET=RIGHT, MATERIAL=Mortar
1.
*SURFACE, NAME=top, TYPE=NODE
4
points_4
*SURFACE, NAME=outside
all
*SURFACE, NAME=between
10, S2
*NSET, NSET=ends, GENERATE
1, 9, 2
*NSET, NSET=of_right, ELSET=right
)";
  const ImportedMesh mesh = parse_mesh(sample::inp_by_hand + more, "a.inp");
  EXPECT_THAT(mesh.regions, ElementsAre("all", "Right"));
  EXPECT_THAT(mesh.materials, ElementsAre("granite", "Mortar"));
  std::map<std::string, FacetSet> facets;
  for (const FacetSet& set : mesh.facet_sets) facets[set.name] = set;
  EXPECT_EQ(facets.at("outside").facets.size(), 6u);
  EXPECT_DOUBLE_EQ(length_of_set(mesh, facets.at("outside")), 6.0);
  EXPECT_THAT(facets.at("between").facets, ElementsAre(Facet{1, 4, -1}));
  std::map<std::string, std::vector<int>> nodes;
  for (const NodeSet& set : mesh.node_sets) nodes[set.name] = set.nodes;
  EXPECT_THAT(nodes.at("top"), ElementsAre(3, 5));
  EXPECT_THAT(nodes.at("ends"), ElementsAre(0, 2, 4));
  EXPECT_THAT(nodes.at("of_right"), testing::UnorderedElementsAre(1, 2, 4, 5));
  EXPECT_TRUE(mesh.remarks.empty());
}

TEST(Abaqus, CollapsedQuadrilateralsAreTriangles) {
  std::string text = sample::replaced(sample::inp_by_hand, "*Element, TYPE=CPS3,\n", "*Element, TYPE=CPS4,\n");
  text = sample::replaced(text, "11, 2, 3, 6\n12, 2, 6, 5\n", "11, 2, 3, 6, 6\n12, 2, 6, 5, 2\n");
  EXPECT_EQ(text_of(parse_mesh(text, "a.inp")), text_of(parse_mesh(sample::inp_by_hand, "a.inp")));
}

TEST(Abaqus, ShellSidesCountAfterTheirFaces) {
  std::string text = sample::replaced(sample::inp_by_hand, "CPS4R", "S4R5");
  text = sample::replaced(text, "region_1, S1\n", "region_1, S3\n10, SPOS\n");
  EXPECT_EQ(text_of(parse_mesh(text, "a.inp")), text_of(parse_mesh(sample::inp_by_hand, "a.inp")));
}

TEST(Abaqus, IncludedFiles) {
  std::string text = sample::inp_by_hand;
  const auto first = text.find("*Node"), last = text.find("*ELEMENT");
  const std::string nodes = text.substr(first, last - first);
  text.replace(first, last - first, "*INCLUDE, INPUT=\"nodes, all.inp\"\n");
  const ReadInclude reader = [&](const std::string& name, const std::string&) -> std::optional<IncludedFile> {
    if (name == "nodes, all.inp") return IncludedFile{name, nodes};
    return std::nullopt;
  };
  EXPECT_EQ(text_of(parse_abaqus(text, "a.inp", reader)), text_of(parse_mesh(sample::inp_by_hand, "a.inp")));
}

TEST(Abaqus, WhatIsLeftOutIsRemarked) {
  const ImportedMesh mesh = parse_mesh(
      sample::inp_by_hand + std::string("*ELEMENT, TYPE=SPRINGA\n77, 1, 2\n*NSET, NSET=gone\n88\n"), "a.inp");
  ASSERT_EQ(mesh.remarks.size(), 2u);
  EXPECT_THAT(mesh.remarks[0], testing::HasSubstr("a.inp:24: elements of type SPRINGA"));
  EXPECT_THAT(mesh.remarks[1], testing::HasSubstr("node 88"));
}

TEST(Vtu, PolygonsPixelsAndPieces) {
  // A pixel, and a pentagon that is not convex: (1, 0) (2, 0) (1.5, 0.5) (2, 1) (1, 1), of area 0.75.
  const std::string piece = R"(<Piece NumberOfPoints="7" NumberOfCells="2"><Points>
<DataArray type="Float32" NumberOfComponents="3">0 0 5 1 0 5 0 1 5 1 1 5 2 0 5 1.5 0.5 5 2 1 5</DataArray></Points><Cells>
<DataArray type="Int32" Name="connectivity">0 1 2 3 1 4 5 6 3</DataArray>
<DataArray type="Int32" Name="offsets">4 9</DataArray><DataArray type="Int32" Name="types">8 7</DataArray></Cells></Piece>)";
  const std::string text =
      "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>" + piece +
      sample::replaced(piece, "0 0 5 1 0 5 0 1 5 1 1 5 2 0 5 1.5 0.5 5 2 1 5",
                       "0 3 5 1 3 5 0 4 5 1 4 5 2 3 5 1.5 3.5 5 2 4 5") +
      "</UnstructuredGrid></VTKFile>";
  const ImportedMesh mesh = parse_mesh(text, "a.vtu");
  ASSERT_EQ(mesh.cells.size(), 4u);
  EXPECT_EQ(mesh.cells[3].kind, CellKind::polygon);
  EXPECT_DOUBLE_EQ(area_of(mesh, mesh.cells[0]), 1.0);
  EXPECT_DOUBLE_EQ(area_of(mesh, mesh.cells[3]), 0.75);
  EXPECT_THAT(mesh.regions, ElementsAre("elements"));
  const auto loops = boundary_facets(mesh);
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_DOUBLE_EQ(loops[0].area, 1.75);
}

TEST(Boundary, AHoleAndCornersThatTouch) {
  // 3 x 3 unit squares without the middle one, and one more square that touches a corner.
  std::string text = "*NODE\n";
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 5; ++i) {
      text += std::to_string(10 * j + i + 1) + ", " + std::to_string(i) + ", " + std::to_string(j) + "\n";
    }
  }
  text += "*ELEMENT, TYPE=CPE4\n";
  const auto square = [&](int i, int j) {
    const int a = 10 * j + i + 1;
    for (const int node : {a, a, a + 1, a + 11, a + 10}) text += std::to_string(node) + ",";
    text += "\n";
  };
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      if (i != 1 || j != 1) square(i, j);
    }
  }
  square(3, 3);
  const auto loops = boundary_facets(parse_mesh(text, "a.inp"));
  ASSERT_EQ(loops.size(), 3u);
  EXPECT_DOUBLE_EQ(loops[0].area, 9.0);
  EXPECT_EQ(loops[0].facets.size(), 12u);
  EXPECT_DOUBLE_EQ(loops[1].area, -1.0);
  EXPECT_TRUE(loops[1].hole());
  EXPECT_EQ(loops[1].facets.size(), 4u);
  EXPECT_DOUBLE_EQ(loops[2].area, 1.0);
}

}  // namespace
