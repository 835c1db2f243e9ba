// Broken mesh files and the messages that their users should get.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "sample_files.hpp"
#include "scabo/base/error.hpp"
#include "scabo/files/read_mesh_file.hpp"

namespace {

using sample::inp_by_hand;
using sample::msh22_by_hand;
using sample::msh41_by_hand;
using sample::replaced;
using sample::Vtu;
using sample::vtu_by_hand;

struct Broken {
  std::string name;  // of the file
  std::string bytes;
  std::string message;  // part of it, with the place
};

std::string up_to(const std::string& text, const std::string& end) { return text.substr(0, text.find(end)); }

std::vector<Broken> gmsh_files() {
  const std::string a = msh22_by_hand, b = msh41_by_hand;
  const std::string binary22 = sample::msh22(sample::linear(), true), binary41 = sample::msh41(sample::linear(), true);
  sample::Mesh folded = sample::linear();
  folded.cells[3].nodes = {1, 5, 2, 4};
  sample::Mesh not_finite = sample::linear();
  not_finite.nodes[2][0] = 1.0 / 0.0;
  sample::Mesh tetrahedron = sample::linear();
  tetrahedron.cells[3].gmsh = 4;
  std::string other_order = binary41;
  std::swap(other_order[other_order.find('\x01')], other_order[other_order.find('\x01') + 3]);
  std::string many_nodes = binary41;  // 2^56 of them in the only block
  many_nodes[binary41.find("$Nodes") + 7 + 32 + 12 + 7] = 1;
  return {
      {"a.msh", "", "a.msh: the file is empty"},
      {"a.msh", "  \n\n", "the file is empty"},
      {"a.msh", "$MeshFormat\n", "a.msh:2:1: $MeshFormat must be followed by a version"},
      {"a.msh", replaced(a, "2.2 0 8", "4.0 0 8"),
       "a.msh:2:4: version 4 of the format is not read; save as 4.1 or 2.2"},
      {"a.msh", replaced(a, "2.2 0 8", "1 0 8"), "version 1 of the format is not read"},
      {"a.msh", replaced(a, "2.2 0 8", "x 0 8"), "must be followed by a version such as 4.1"},
      {"a.msh", "$NOD\n1\n1 0 0 0\n$ENDNOD\n", "version 1 of the format is not read"},
      {"a.msh", replaced(a, "2.2 0 8", "2.2 2 8"), "the type of the file is 2; it is 0 (text) or 1 (binary)"},
      {"a.msh", replaced(b, "4.1 0 8", "4.1 0 4"), "numbers have 4 bytes; only 8 are read"},
      {"a.msh", replaced(a, "$EndMeshFormat", "$EndMesh"), "expected $EndMeshFormat after line 2"},
      {"a.msh", up_to(a, "$Elements"), "the file has no $Elements; save the mesh again"},
      {"a.msh", up_to(a, "$Nodes"), "the file has no $Nodes"},
      {"a.msh", up_to(a, "4 0 1 0"),
       "a.msh:9:1: the file ends where the number of a node is expected: it is truncated"},
      {"a.msh", up_to(a, "$EndElements"), "the file ends in $Elements, which has no $EndElements"},
      {"a.msh", up_to(a, "2 6 5"), "the file ends where a node of an element is expected"},
      {"a.msh", replaced(a, "$Nodes\n6", "$Nodes\n7"), "a.msh:12:1: '$EndNodes' is not the number of a node"},
      {"a.msh", replaced(a, "$Nodes\n6", "$Nodes\n5"), "the count in line 5 does not agree with the content"},
      {"a.msh", replaced(a, "$Nodes\n6", "$Nodes\n-6"), "the count of nodes is -6, which is no count"},
      {"a.msh", replaced(a, "$Nodes\n6", "$Nodes\n9000000000000000000"), "'$EndNodes' is not the number of a node"},
      {"a.msh", replaced(a, "$Nodes\n6", "$Nodes\n99999999999999999999"), "is not the count of nodes"},
      {"a.msh", replaced(a, "$Elements\n6", "$Elements\n8000000000"), "'$EndElements' is not the number of an element"},
      {"a.msh", replaced(a, "$Elements\n6", "$Elements\n5"), "expected $EndElements"},
      {"a.msh", replaced(a, "3 2 0 0", "3 two 0 0"), "a.msh:8:3: 'two' is not a coordinate"},
      {"a.msh", replaced(a, "3 2 0 0", "3 nan 0 0"),
       "a.msh:8:1: node 3 has a coordinate that is not finite (nan, 0, 0)"},
      {"a.msh", replaced(a, "3 2 0 0", "3 1e999 0 0"), "node 3 has a coordinate that is not finite"},
      {"a.msh", replaced(a, "3 2 0 0", "3 2 0 0.5"),
       "the mesh is not in a plane z = constant: node 1 has z = 0, node 3 has z = 0.5"},
      {"a.msh", replaced(a, "3 2 0 0", "2 2 0 0"), "a.msh:8:1: node 2 is defined twice (first in line 7)"},
      {"a.msh", replaced(a, "3 2 0 0", "-3 2 0 0"), "node -3 has a negative number"},
      {"a.msh", replaced(a, "10 3 2 1 1 1 2 5 4", "10 3 2 1 1 1 5 2 4"),
       "a.msh:18:1: cell 10 (quadrilateral with 4 nodes, nodes 1 5 2 4) is folded: its Jacobian is not positive at "
       "node 5; put "
       "its nodes in order around it, or mesh again"},
      {"a.msh", replaced(a, "10 3 2 1 1 1 2 5 4", "10 4 2 1 1 1 2 5 4"),
       "cell 10 has Gmsh's type 4, a three-dimensional cell"},
      {"a.msh", replaced(a, "10 3 2 1 1 1 2 5 4", "10 21 2 1 1 1 2 5 4"),
       "a.msh:18:8: cell 10 has Gmsh's type 21, which is not read"},
      {"a.msh", replaced(a, "10 3 2 1 1 1 2 5 4", "10 3 2 1 1 1 2 99 4"),
       "a.msh:18:1: cell 10 has node 99, which is not in the file"},
      {"a.msh", replaced(a, "10 3 2 1 1 1 2 5 4", "10 3 2 1 1 1 2 1 2"),
       "cell 10 is a quadrilateral with 4 nodes and repeats a node"},
      {"a.msh", replaced(a, "10 3 2 1 1 1 2 5 4", "10 3 -2 1 1 1 2 5 4"), "element 10 has -2 tags"},
      {"a.msh", replaced(a, "11 2 2 2 2 2 3 6", "11 2 2 2 2 2 3 5"),
       "a.msh:20:1: cell 12 and cell 11 share the side from node"},
      {"a.msh", replaced(replaced(a, "5 1 1 0", "5 1 0 0"), "4 0 1 0", "4 0 0 0"),
       "a.msh:18:1: cell 10 (quadrilateral with 4 nodes, nodes 1 2 5 4) has two nodes in one place, 1 and 4 at (0, 0); "
       "move "
       "one of them, or give the cell as many nodes as it has corners"},
      {"a.msh", replaced(replaced(a, "5 1 1 0", "5 1.5 0 0"), "4 0 1 0", "4 0.5 0 0"),
       "nodes 1 2 5 4) has no area, because its corners lie on one line; move one of them, or remove the cell"},
      {"a.msh", replaced(a, "5 1 1 0", "5 0.4 0.4 0"),
       "nodes 1 2 5 4) is folded: its Jacobian is not positive at node 5; its angle there is 180 degrees or more: move "
       "the "
       "node, or divide the cell into triangles"},
      {"a.msh", replaced(a, "$Nodes", "Nodes"), "expected the start of a section such as $Nodes, found 'Nodes'"},
      {"a.msh", replaced(a, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", "$Comments\n$MeshFormat\n$EndComments\n"),
       "$Nodes comes before $MeshFormat"},
      {"a.msh", a + "$Nodes\n0\n$EndNodes\n", "$Nodes is given twice"},
      {"a.msh", a + "$NodeData\n1\n", "the file ends in $NodeData, which has no $EndNodeData"},
      {"a.msh", replaced(a, "$Nodes", "$PhysicalNames\n1\n2 1 stone\n$EndPhysicalNames\n$Nodes"),
       "a physical name of line 6 must read: dimension"},
      {"a.msh", replaced(b, "$Nodes", "$PhysicalNames\n1\n1 \"stone\"\n$EndPhysicalNames\n$Nodes"),
       "'\"stone\"' is not the tag of a physical group"},
      {"a.msh", replaced(a, "$Nodes", "$PhysicalNames\n2\n1 \"stone\"\n1 \"bottom\"\n$EndPhysicalNames\n$Nodes"),
       "the physical groups 'stone' and 'bottom' both have the tag 1, and without dimensions"},
      {"a.msh", replaced(a, "$Nodes", "$PhysicalNames\n2\n1 1 \"left\"\n1 1 \"bottom\"\n$EndPhysicalNames\n$Nodes"),
       "the physical groups 'left' and 'bottom' both have the tag 1 of one dimension"},
      {"a.msh", up_to(a, "1 1 2 3 1 1 2") + "0\n$EndElements\n", "'$EndElements' is not the type of an element"},
      {"a.msh", replaced(b, "$Elements\n4 6 1 12", "$Elements\n4 7 1 12"),
       "$Elements announces 7 elements, its blocks have 6"},
      {"a.msh", replaced(b, "$Nodes\n1 6 1 6", "$Nodes\n1 5 1 6"), "$Nodes announces 5 nodes, its blocks have 6"},
      {"a.msh", replaced(b, "2 1 0 6\n", "2 1 2 6\n"), "a block of nodes begins with dimension 2 and parametric 2"},
      {"a.msh", replaced(b, "2 1 3 1\n", "3 1 5 1\n"), "cell 10 has Gmsh's type 5, a three-dimensional cell"},
      {"a.msh", replaced(b, "$Entities", "$PartitionedEntities"), "the mesh is divided into partitions"},
      {"a.msh", replaced(b, "1 0 0 0 1 1 0 1 1 0", "1 0 0 0 1 1 0 5000000 1 0"), "at most 100 are read"},
      {"a.msh", other_order, "byte 24: the file was written on a machine with the other order of bytes"},
      {"a.msh", many_nodes, "the file ends where the number of a node is expected: it is truncated"},
      {"a.msh", binary41.substr(0, binary41.find("$EndElements") - 20),
       "the file ends where a node of an element is expected"},
      {"a.msh", binary22.substr(0, binary22.find("$EndNodes") - 9), "the file ends where a coordinate is expected"},
      {"a.msh", replaced(binary22, "$EndNodes", "$EndNodez"),
       "expected $EndNodes; the counts of this section do not agree"},
      {"a.msh", sample::msh41(folded, true), "a.msh: cell 4 (quadrilateral with 4 nodes, nodes 1 5 2 4) is folded"},
      {"a.msh", sample::msh22(not_finite, true), "node 3 has a coordinate that is not finite (inf, 0, 0)"},
      {"a.msh", sample::msh41(tetrahedron, true), "cell 4 has Gmsh's type 4, a three-dimensional cell"},
  };
}

std::vector<Broken> quadratic_files() {
  sample::Mesh far = sample::quadratic(), mixed = sample::quadratic();
  far.nodes[6][0] = 0.9;  // beyond the quarter
  mixed.cells[3] = {3, 9, 1, {1, 2, 5, 4}};
  mixed.nodes.resize(14);
  return {
      {"a.inp", sample::inp(far),
       "a.inp:21:1: cell 4 (quadrilateral with 8 nodes, nodes 1 2 5 4 7 8 9 10) is folded: its Jacobian is not "
       "positive at node 2; move its nodes"},
      {"a.msh", sample::msh41(mixed, false), "but only one of them has a middle node there: use cells of one order"},
  };
}

std::vector<Broken> abaqus_files() {
  const std::string a = inp_by_hand;
  return {
      {"a.inp", "*NODE\n1, 0, 0\n", "a.inp: the mesh is empty: the file has no plane cells"},
      {"a.inp", "** nothing\n", "the mesh is empty"},
      {"a.inp", replaced(a, "3, 2., 0.", "3, 2.x, 0."), "a.inp:7:1: '2.x' is not a coordinate"},
      {"a.inp", replaced(a, "3, 2., 0.", "c, 2., 0."), "'c' is not the number of a node"},
      {"a.inp", replaced(a, "3, 2., 0.", "3, inf, 0."), "a.inp:7:1: node 3 has a coordinate that is not finite"},
      {"a.inp", replaced(a, "3, 2., 0.", "2, 2., 0."), "node 2 is defined twice (first in line 6)"},
      {"a.inp", replaced(a, "3, 2., 0.", "3, 2., 0., 1."), "not in a plane z = constant"},
      {"a.inp", replaced(a, "CPS4R", "C3D8"), "a.inp:12:1: cell 10: type C3D8 is three-dimensional"},
      {"a.inp", replaced(a, "CPS4R", "DCAX4"), "a.inp:12:1: cell 10: type DCAX4 is an axisymmetric shell"},
      {"a.inp", replaced(a, "CPS4R", "CGAX4"), "a.inp:12:1: cell 10: type CGAX4 turns about the axis"},
      {"a.inp", replaced(a, "CPS4R", "CPS5"), "cell 10: type CPS5 is not read; use elements of a section"},
      {"a.inp", replaced(a, "type=CPS4R, ", ""), "a.inp:11:1: *ELEMENT has no TYPE"},
      {"a.inp", replaced(a, "10, 1, 2,\n5, 4\n", "10, 1, 2,\n5\n"),
       "a.inp:12:1: cell 10 has 3 nodes, but type CPS4R has 4"},
      {"a.inp", replaced(a, "11, 2, 3, 6", "11, 2, 3, 6, 5"), "a.inp:16:1: cell 11 has 4 nodes, but type CPS3 has 3"},
      {"a.inp", replaced(a, "11, 2, 3, 6", "11, 2, 3, x"), "'x' is not the number of a node"},
      {"a.inp", replaced(a, "11, 2, 3, 6", "11, 2, 3, 7"), "a.inp:16:1: cell 11 has node 7, which is not in the file"},
      {"a.inp", replaced(a, "12, 2, 6, 5", "11, 2, 6, 5"), "a.inp:17:1: element 11 is defined twice"},
      {"a.inp", replaced(a, "11, 2, 3, 6", "11, 2, 3, 1"),
       "a.inp:16:1: cell 11 (triangle with 3 nodes, nodes 2 3 1) has no area"},
      {"a.inp", replaced(a, "10, 1, 2,\n5, 4", "10, 1, 5,\n2, 4"),
       "a.inp:12:1: cell 10 (quadrilateral with 4 nodes, nodes 1 5 2 4) is folded"},
      {"a.inp", replaced(a, "region_1, S1", "region_9, S1"),
       "a.inp:19:1: surface 'boundary_3': there is no element set 'region_9'"},
      {"a.inp", replaced(a, "11, S1", "99, S1"), "a.inp:20:1: surface 'boundary_3': element 99 is not in the file"},
      {"a.inp", replaced(a, "11, S1", "11, S4"), "surface 'boundary_3': element 11 has no side S4"},
      {"a.inp", replaced(a, "11, S1", "11, top"), "'TOP' is no side of a plane element; sides are S1 to S4"},
      {"a.inp", a + "*SOLID SECTION, ELSET=none, MATERIAL=m\n", "*SOLID SECTION: there is no element set 'none'"},
      {"a.inp", a + "*SOLID SECTION, MATERIAL=m\n", "a.inp:23:1: *SOLID SECTION has no ELSET"},
      {"a.inp", a + "*NSET, NSET=x, GENERATE\n9, 1\n", "a.inp:24:1: GENERATE needs a first number"},
      {"a.inp", a + "*NSET, NSET=x, GENERATE\n1, 9000000000, 1\n", "the sets of the file are too many and too large"},
      {"a.inp", a + "*NSET, NSET=x\nother\n", "a.inp:24:1: 'other' is neither a number nor the name of a set"},
      {"a.inp", a + "*NSET\n1\n", "*NSET has no name"},
      {"a.inp", a + "*NGEN\n1, 5\n", "a.inp:23:1: *NGEN makes nodes or elements and is not read"},
      {"a.inp", a + "*INCLUDE, INPUT=no_such_file.inp\n",
       "a.inp:23:1: the included file 'no_such_file.inp' cannot be read"},
      {"a.inp", a + "*INCLUDE\n", "*INCLUDE names no file"},
      {"a.inp", a + "*ELEMENT, TYPE=T3D2, ELSET=bars\n50, 1, 2\n*SOLID SECTION, ELSET=bars, MATERIAL=m\n",
       "makes element 50 a truss or beam, which is not read"},
      {"a.inp", "*PART, NAME=a\n*END PART\n*PART, NAME=b\n*END PART\n", "several parts and no *INSTANCE of them"},
      {"a.inp", "*PART, NAME=a\n*END PART\n*PART, NAME=A\n", "a.inp:3:1: there are two parts 'A'"},
      {"a.inp", "*PART, NAME=a\n*NODE\n1, 0., 0.\n", "a.inp:1:1: part 'a' has no *END PART"},
      {"a.inp", "*INSTANCE, NAME=i, PART=a\n", "a.inp:1:1: there is no part 'a' before this line"},
      {"a.inp", "*PART, NAME=p\n" + a + "*END PART\n*INSTANCE, NAME=i, PART=p\n",
       "this *INSTANCE has no *END INSTANCE"},
      {"a.inp",
       replaced("*PART, NAME=p\n" + a, "11, 2, 3, 6", "11, 2, 3, 7") +
           "*END PART\n*INSTANCE, NAME=i, PART=p\n*END INSTANCE\n",
       "a.inp:17:1: cell 11 of 'i' has node 7 of 'i', which is not in the file"},
      {"a.inp", replaced(a, "*Node", "*Node, SYSTEM=C"),
       "coordinates in a cylindrical or spherical SYSTEM are not read"},
  };
}

std::vector<Broken> vtu_files() {
  const std::string a = vtu_by_hand;
  const auto mesh = sample::linear();
  const std::string zlib = sample::vtu(mesh, Vtu::base64_zlib), raw = sample::vtu(mesh, Vtu::raw);
  std::string damaged = sample::vtu(mesh, Vtu::raw_zlib);
  for (auto at = damaged.find("AppendedData encoding") + 60; at < damaged.size() - 40; ++at) damaged[at] ^= 0x55;
  return {
      {"a.vtu", "<VTKFile", "a.vtu:1:1: the XML ends here or is wrong, as the parser says"},
      {"a.vtu", up_to(a, "</DataArray>"),
       "the XML ends here or is wrong, as the parser says (Start-end tags mismatch)"},
      {"a.vtu", replaced(a, "\"UnstructuredGrid\"", "\"PolyData\""),
       "a.vtu:2:1: the type of the file is 'PolyData'; only UnstructuredGrid is read"},
      {"a.vtu", replaced(a, "\"0.1\"", "\"7\""), "version '7' of the format is not known"},
      {"a.vtu", replaced(a, "LittleEndian", "BigEndian"), "the byte order is BigEndian"},
      {"a.vtu", replaced(zlib, "vtkZLibDataCompressor", "vtkLZ4DataCompressor"),
       "the compressor 'vtkLZ4DataCompressor' is not read"},
      {"a.vtu", replaced(zlib, "UInt32", "UInt16"), "header_type is 'UInt16'"},
      {"a.vtu", replaced(a, "NumberOfPoints=\"6\"", "NumberOfPoints=\"5\""),
       "has more values than NumberOfPoints and NumberOfCells allow"},
      {"a.vtu", replaced(a, "NumberOfPoints=\"6\"", "NumberOfPoints=\"7\""),
       "NumberOfPoints is 7, but there are 18 coordinates instead of 21"},
      {"a.vtu", replaced(a, "NumberOfPoints=\"6\"", "NumberOfPoints=\"1999999999\""),
       "there are 18 coordinates instead of"},
      {"a.vtu", replaced(a, "NumberOfPoints=\"6\"", "NumberOfPoints=\"-6\""),
       "NumberOfPoints of a Piece is '-6', which is no count"},
      {"a.vtu", replaced(a, "NumberOfCells=\"6\"", "NumberOfCells=\"9\""),
       "NumberOfCells is 9, but there are 6 types and 6 offsets"},
      {"a.vtu", replaced(a, "NumberOfCells=\"6\"", "NumberOfCells=\"0\""), "the mesh is empty"},
      {"a.vtu", replaced(a, "NumberOfComponents=\"3\"", "NumberOfComponents=\"2\""),
       "points have NumberOfComponents '2'; it is 3"},
      {"a.vtu", replaced(a, "0 1 0 1 1 0 2 1 0", "0 1 0 1 oops 0 2 1 0"),
       "a.vtu:8:9: 'oops' is not a number of array ''"},
      {"a.vtu", replaced(a, "0 1 0 1 1 0 2 1 0", "0 1 0 1 nan 0 2 1 0"),
       "a.vtu:8:1: node 4 has a coordinate that is not finite"},
      {"a.vtu", replaced(a, "2 4 5 9 12 15", "2 4 5 9 12 19"), "cell 5 (counted from 0) ends at position 19"},
      {"a.vtu", replaced(a, "2 4 5 9 12 15", "2 4 5 9 8 15"), "a.vtu:21:1: cell 4 (counted from 0) ends at position 8"},
      {"a.vtu", replaced(a, "2 4 5 9 12 15", "2 4 5 9 13 15"),
       "cell 4 (counted from 0) of VTK's type 5 has 4 nodes instead of 3"},
      {"a.vtu", replaced(a, "3 3 1 9 5 5", "3 3 1 10 5 5"),
       "a.vtu:24:1: cell 3 (counted from 0) has VTK's type 10, a three-dimensional cell"},
      {"a.vtu", replaced(a, "3 3 1 9 5 5", "3 3 1 6 5 5"),
       "cell 3 (counted from 0) has VTK's type 6 with 4 nodes, which is not read"},
      {"a.vtu", replaced(a, "0 1 4 3\n", "0 1 9 3\n"),
       "a.vtu:16:1: cell 3 (counted from 0) has node 9, but the points are numbered from 0 to 5"},
      {"a.vtu", replaced(a, "0 1 4 3\n", "0 4 1 3\n"),
       "a.vtu:16:1: cell 3 (counted from 0) (quadrilateral with 4 nodes, nodes 0 4 1 3) is folded"},
      {"a.vtu", replaced(replaced(a, "0 1 4 3\n", "0 4 1 3\n"), "3 3 1 9 5 5", "3 3 1 7 5 5"),
       "is folded: its boundary meets itself or has no area"},
      {"a.vtu", replaced(a, "3 3 4 1 2 2", "3 3 4 1 2"), "array 'region' has 5 values, but there are 6 cells"},
      {"a.vtu", replaced(a, "Name=\"types\"", "Name=\"kinds\""), "Cells has no array 'types'"},
      {"a.vtu", replaced(a, "type=\"UInt8\"", "type=\"String\""), "array 'types' has the type 'String'"},
      {"a.vtu", replaced(a, "format=\"ascii\"", "format=\"hex\""),
       "has the format 'hex'; it is ascii, binary or appended"},
      {"a.vtu", replaced(sample::vtu(mesh, Vtu::base64), "format=\"binary\">\n", "format=\"binary\">\n*"),
       "has the character '*', which base64 does not"},
      {"a.vtu", replaced(raw, "NumberOfPoints=\"6\"", "NumberOfPoints=\"4\""), "has more values than NumberOfPoints"},
      {"a.vtu", replaced(raw, "offset=\"0\"", "offset=\"99999\""), "has the offset '99999', which is outside the "},
      {"a.vtu", up_to(raw, "</AppendedData>"), "AppendedData has no end tag"},
      {"a.vtu", damaged, "array"},
      {"a.vtk", "# vtk DataFile Version 3.0\n", "the file is a legacy file of VTK; save it as .vtu"},
      {"a.med", "\x89HDF\r\n", "an HDF5 file such as .med; convert it with meshio"},
      {"a.xml", "<?xml version='1.0'?><mesh/>", "an XML file without VTKFile"},
      {"a.txt", "hello", "of an unknown format; Scabo reads meshes of Gmsh (.msh 2.2 and 4.1)"},
  };
}

void check(const std::vector<Broken>& files) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    const Broken& broken = files[i];
    SCOPED_TRACE("file " + std::to_string(i) + ", expected: " + broken.message);
    try {
      scabo::files::parse_mesh(broken.bytes, broken.name);
      ADD_FAILURE() << "is read";
    } catch (const scabo::InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(broken.message));
      EXPECT_EQ(error.diagnostics().size(), 1u);
    }
  }
}

TEST(BrokenMeshFiles, Gmsh) { check(gmsh_files()); }
TEST(BrokenMeshFiles, Quadratic) { check(quadratic_files()); }
TEST(BrokenMeshFiles, Abaqus) { check(abaqus_files()); }
TEST(BrokenMeshFiles, Vtu) { check(vtu_files()); }

TEST(BrokenMeshFiles, TextOfOtherSystems) {
  std::string little = "\xFF\xFE", big = "\xFE\xFF", old_mac = sample::inp_by_hand;
  for (const char* c = sample::inp_by_hand; *c != '\0'; ++c)
    little += std::string{*c, '\0'}, big += std::string{'\0', *c};
  std::replace(old_mac.begin(), old_mac.end(), '\n', '\r');
  check({{"a.inp", little, "a.inp: the file is text in UTF-16; save it as UTF-8"},
         {"a.inp", big, "a.inp: the file is text in UTF-16; save it as UTF-8"},
         {"a.inp", old_mac, "a.inp: its lines end with a carriage return alone; save it with line feeds"}});
}

TEST(BrokenMeshFiles, AFileThatIsMissing) {
  EXPECT_THROW(scabo::files::read_mesh_file("no_such_file.msh"), scabo::InputError);
  EXPECT_THROW(scabo::files::read_mesh_file("/"), scabo::InputError);
}

/// Wherever a file ends, it is an error or, in the last few characters, the mesh: never a crash.
TEST(BrokenMeshFiles, EveryTruncation) {
  const auto mesh = sample::quadratic();
  for (const std::string& bytes :
       {sample::msh22(mesh, false), sample::msh22(mesh, true), sample::msh41(mesh, false), sample::msh41(mesh, true),
        sample::vtu(mesh, Vtu::text), sample::vtu(mesh, Vtu::raw_zlib), sample::vtu(mesh, Vtu::base64)}) {
    for (std::size_t size = 0; size + 20 < bytes.size(); ++size) {
      EXPECT_THROW(scabo::files::parse_mesh(bytes.substr(0, size), "a.msh"), scabo::InputError) << size;
    }
  }
}

}  // namespace
