#include "sample_files.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cstdint>
#include <stdexcept>

namespace sample {

const char* const msh22_by_hand = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
6
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
$EndNodes
$Elements
6
1 1 2 3 1 1 2
2 1 2 3 1 2 3
3 15 2 4 6 6
10 3 2 1 1 1 2 5 4
11 2 2 2 2 2 3 6
12 2 2 2 2 2 6 5
$EndElements
)";

const char* const msh41_by_hand = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
1 1 2 0
6 2 1 0 1 4
1 0 0 0 2 0 0 1 3 0
1 0 0 0 1 1 0 1 1 0
2 1 0 0 2 1 0 1 2 1 1
$EndEntities
$Nodes
1 6 1 6
2 1 0 6
1
2
3
4
5
6
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 1 0
$EndNodes
$Elements
4 6 1 12
1 1 1 2
1 1 2
2 2 3
0 6 15 1
3 6
2 1 3 1
10 1 2 5 4
2 2 2 2
11 2 3 6
12 2 6 5
$EndElements
)";

const char* const inp_by_hand = R"(** by hand
*Heading
two squares
*Node
1, 0., 0., 0.
2, 1., 0., 0.
3, 2., 0.
4, 0., 1., 0.
5, 1., 1., 0.
6, 2., 1., 0.
*ELEMENT, type=CPS4R, ELSET=region_1
10, 1, 2,
5, 4
*Element, TYPE=CPS3,
 elset=region_2
11, 2, 3, 6
12, 2, 6, 5
*Surface, name=boundary_3, type=ELEMENT
region_1, S1
11, S1
*NSET, NSET=points_4
6
)";

const char* const vtu_by_hand = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid>
<Piece NumberOfPoints="6" NumberOfCells="6">
<Points>
<DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 2 0 0
0 1 0 1 1 0 2 1 0
</DataArray>
</Points>
<Cells>
<DataArray type="Int32" Name="connectivity" format="ascii">
0 1
1 2
5
0 1 4 3
1 2 5
1 5 4
</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">
2 4 5 9 12 15
</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">
3 3 1 9 5 5
</DataArray>
</Cells>
<CellData>
<DataArray type="Int32" Name="region" format="ascii">
3 3 4 1 2 2
</DataArray>
</CellData>
</Piece>
</UnstructuredGrid>
</VTKFile>
)";

Mesh linear() {
  return {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}},
          {{1, 3, 3, {1, 2}},
           {1, 3, 3, {2, 3}},
           {15, 1, 4, {6}},
           {3, 9, 1, {1, 2, 5, 4}},
           {2, 5, 2, {2, 3, 6}},
           {2, 5, 2, {2, 6, 5}}}};
}

Mesh quadratic() {
  Mesh mesh = linear();
  for (const std::vector<double>& middle : std::vector<std::vector<double>>{{0.5, 0, 0},
                                                                            {1, 0.5, 0},
                                                                            {0.5, 1, 0},
                                                                            {-0.15, 0.5, 0},
                                                                            {1.5, 0, 0},
                                                                            {2, 0.5, 0},
                                                                            {1.5, 0.5, 0},
                                                                            {1.5, 1, 0}}) {
    mesh.nodes.push_back(middle);
  }
  mesh.cells = {{8, 21, 3, {1, 2, 7}},
                {8, 21, 3, {2, 3, 11}},
                {15, 1, 4, {6}},
                {16, 23, 1, {1, 2, 5, 4, 7, 8, 9, 10}},
                {9, 22, 2, {2, 3, 6, 11, 12, 13}},
                {9, 22, 2, {2, 6, 5, 13, 14, 8}}};
  return mesh;
}

namespace {

template <class T>
void put(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

int dimension_of(const Cell& cell) { return cell.gmsh == 15 ? 0 : cell.gmsh == 1 || cell.gmsh == 8 ? 1 : 2; }

/// Numbers that are written as text or as bytes.
struct Writer {
  bool binary;
  std::string out;
  void whole(std::int64_t value, bool wide = false) {
    if (!binary) {
      out += fmt::format("{} ", value);
    } else if (wide) {
      put(out, value);
    } else {
      put(out, static_cast<std::int32_t>(value));
    }
  }
  void real(double value) { binary ? put(out, value) : static_cast<void>(out += fmt::format("{} ", value)); }
  void format(const char* version) {
    out = fmt::format("$MeshFormat\n{} {} 8\n", version, binary ? 1 : 0);
    if (binary) put(out, std::int32_t{1});
    if (binary) out += "\n";
    out += "$EndMeshFormat\n";
  }
};

}  // namespace

std::string msh22(const Mesh& mesh, bool binary) {
  Writer w{binary, {}};
  w.format("2.2");
  w.out += fmt::format("$Nodes\n{}\n", mesh.nodes.size());
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    w.whole(static_cast<int>(i) + 1);
    for (const double x : mesh.nodes[i]) w.real(x);
  }
  w.out += fmt::format("\n$EndNodes\n$Elements\n{}\n", mesh.cells.size());
  int number = 0;
  for (const Cell& cell : mesh.cells) {
    ++number;
    if (binary) {
      w.whole(cell.gmsh), w.whole(1), w.whole(2), w.whole(number);
    } else {
      w.whole(number), w.whole(cell.gmsh), w.whole(2);
    }
    w.whole(cell.tag), w.whole(cell.tag);
    for (const int node : cell.nodes) w.whole(node);
    if (!binary) w.out += "\n";
  }
  return w.out + "\n$EndElements\n";
}

std::string msh41(const Mesh& mesh, bool binary) {
  Writer w{binary, {}};
  w.format("4.1");
  w.out += "$Entities\n";
  for (const int n : {1, 1, 2, 0}) w.whole(n, true);
  w.whole(4), w.real(2), w.real(1), w.real(0), w.whole(1, true), w.whole(4);
  for (const int tag : {3, 1, 2}) {
    w.whole(tag);
    for (int i = 0; i < 6; ++i) w.real(i);
    w.whole(1, true), w.whole(-tag), w.whole(1, true), w.whole(7);
  }
  w.out += "\n$EndEntities\n$Nodes\n";
  const auto nodes = static_cast<int>(mesh.nodes.size());
  for (const int n : {1, nodes, 1, nodes}) w.whole(n, true);
  w.whole(2), w.whole(1), w.whole(1), w.whole(nodes, true);  // with parametric coordinates
  for (int i = 1; i <= nodes; ++i) w.whole(i, true);
  for (const std::vector<double>& node : mesh.nodes) {
    for (const double x : node) w.real(x);
    w.real(0.25), w.real(0.75);
  }
  w.out += "\n$EndNodes\n$Elements\n";
  const auto cells = static_cast<int>(mesh.cells.size());
  for (const int n : {cells, cells, 1, cells}) w.whole(n, true);
  int number = 0;
  for (const Cell& cell : mesh.cells) {
    w.whole(dimension_of(cell)), w.whole(cell.tag), w.whole(cell.gmsh), w.whole(1, true), w.whole(++number, true);
    for (const int node : cell.nodes) w.whole(node, true);
    if (!binary) w.out += "\n";
  }
  return w.out + "\n$EndElements\n";
}

std::string inp(const Mesh& mesh) {
  std::string out = "*NODE\n";
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    out += fmt::format("{}, {}, {}, {}\n", i + 1, mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2]);
  }
  int number = 0;
  for (const Cell& cell : mesh.cells) {
    ++number;
    if (dimension_of(cell) == 0) continue;
    std::vector<int> nodes = cell.nodes;
    if (cell.gmsh == 8) std::swap(nodes[1], nodes[2]);
    out +=
        fmt::format("*ELEMENT, TYPE={}{}, ELSET={}_{}\n{}, {}\n", dimension_of(cell) == 1 ? "T3D" : "CPE", nodes.size(),
                    dimension_of(cell) == 1 ? "boundary" : "region", cell.tag, number, fmt::join(nodes, ", "));
  }
  return out + "*NSET, NSET=points_4\n6\n";
}

namespace {

std::string base64(const std::string& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
  }
  return out;
}

std::string compressed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  out.resize(size);
  return out;
}

}  // namespace

std::string vtu(const Mesh& mesh, Vtu form, bool wide_header) {
  const bool zlib = form == Vtu::base64_zlib || form == Vtu::raw_zlib;
  const bool appended = form == Vtu::raw || form == Vtu::raw_zlib || form == Vtu::appended_base64;
  std::string appended_data;
  // `bytes` of one array, and its numbers as text.
  const auto array = [&](const std::string& attributes, const std::string& bytes, const std::string& text) {
    if (form == Vtu::text) return fmt::format("<DataArray {} format=\"ascii\">\n{}\n</DataArray>\n", attributes, text);
    std::string header, body = bytes;
    const auto count = [&](std::size_t value) {
      wide_header ? put(header, static_cast<std::uint64_t>(value)) : put(header, static_cast<std::uint32_t>(value));
    };
    if (zlib) {  // two blocks
      const std::size_t block = bytes.size() / 2 + 1;
      const std::string first = compressed(bytes.substr(0, block)), last = compressed(bytes.substr(block));
      count(2), count(block), count(bytes.size() - block), count(first.size()), count(last.size());
      body = first + last;
    } else {
      count(bytes.size());
    }
    const bool is_raw = form == Vtu::raw || form == Vtu::raw_zlib;
    const std::string data = is_raw ? header + body : zlib ? base64(header) + base64(body) : base64(header + body);
    if (!appended) return fmt::format("<DataArray {} format=\"binary\">\n{}\n</DataArray>\n", attributes, data);
    const std::string element =
        fmt::format("<DataArray {} format=\"appended\" offset=\"{}\"/>\n", attributes, appended_data.size());
    appended_data += data;
    return element;
  };
  std::string points, point_text, connectivity, connectivity_text, offsets, offset_text, types, type_text, tags,
      tag_text;
  for (const std::vector<double>& node : mesh.nodes) {
    for (const double x : node) put(points, x);
    point_text += fmt::format("{} {} {}\n", node[0], node[1], node[2]);
  }
  std::int64_t end = 0;
  for (const Cell& cell : mesh.cells) {
    for (const int node : cell.nodes) {
      put(connectivity, static_cast<std::int64_t>(node - 1));
      connectivity_text += fmt::format("{} ", node - 1);
    }
    end += static_cast<std::int64_t>(cell.nodes.size());
    put(offsets, end);
    offset_text += fmt::format("{} ", end);
    put(types, static_cast<std::uint8_t>(cell.vtk));
    type_text += fmt::format("{} ", cell.vtk);
    put(tags, static_cast<std::int32_t>(cell.tag));
    tag_text += fmt::format("{} ", cell.tag);
  }
  std::string out = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"{}\"{}>\n<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<CellData>\n",
      wide_header ? "UInt64" : "UInt32", zlib ? " compressor=\"vtkZLibDataCompressor\"" : "", mesh.nodes.size(),
      mesh.cells.size());
  out += array("type=\"Int32\" Name=\"region\"", tags, tag_text);
  out += "</CellData>\n<Points>\n" + array("type=\"Float64\" NumberOfComponents=\"3\"", points, point_text);
  out += "</Points>\n<Cells>\n" + array("type=\"Int64\" Name=\"connectivity\"", connectivity, connectivity_text);
  out += array("type=\"Int64\" Name=\"offsets\"", offsets, offset_text);
  out += array("type=\"UInt8\" Name=\"types\"", types, type_text) + "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
  if (appended) {
    out += fmt::format("<AppendedData encoding=\"{}\">\n_", form == Vtu::appended_base64 ? "base64" : "raw");
    out += appended_data + "\n</AppendedData>\n";
  }
  return out + "</VTKFile>\n";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the sample has no '" + from + "'");
  return text.replace(at, from.size(), to);
}

}  // namespace sample
