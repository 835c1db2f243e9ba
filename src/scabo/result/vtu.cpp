#include "scabo/result/vtu.hpp"

#include <fmt/format.h>
#include <isa-l/igzip_lib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <iterator>
#include <memory>
#include <type_traits>
#include <vector>

#include "scabo/linalg/parallel.hpp"
#include "scabo/result/solid/solid_cells.hpp"
#include "scabo/result/solid/solid_faces.hpp"
#include "scabo/result/solid/solid_mechanism_cells.hpp"
#include "scabo/result/version.hpp"

namespace scabo::result {

namespace {

constexpr std::string_view byte_order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
constexpr std::string_view collection_footer = "  </Collection>\n</VTKFile>\n";

std::string opening(std::string_view type, std::string_view attributes) {
  return fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"{}\" byte_order=\"{}\"{}>\n{} {} -->\n",
                     type, attributes.empty() ? "0.1" : "1.0", byte_order, attributes, vtk_mark, version());
}

template <typename Value>
constexpr std::string_view name_of() {
  if constexpr (std::is_same_v<Value, double>) return "Float64";
  if constexpr (std::is_same_v<Value, float>) return "Float32";
  if constexpr (std::is_same_v<Value, std::int32_t>) return "Int32";
  if constexpr (std::is_same_v<Value, std::uint8_t>) return "UInt8";
}

/// Arrays as text, for small files, or appended in binary form, compressed by zlib in large files. (meshio 5.3 confuses
/// appended arrays if the offset of one equals that of another in its own encoding, which occurs with small arrays.)
enum class Encoding { text, appended, compressed };

/// Whether an array is the same in every increment.
enum class Content { grid, field };

/// In the format of zlib, by ISA-L: a third of the time that zlib takes to look for nothing but runs, and a little
/// smaller.
std::string compressed_piece(std::string_view piece) {
  const std::size_t room = piece.size() + piece.size() / 8 + 1024;  // blocks that do not shrink are stored
  const auto workspace = std::make_unique_for_overwrite<std::uint8_t[]>(ISAL_DEF_LVL1_DEFAULT);
  const auto output = std::make_unique_for_overwrite<std::uint8_t[]>(room);
  const auto stream = std::make_unique<isal_zstream>();
  isal_deflate_init(stream.get());
  stream->level = 1;
  stream->level_buf = workspace.get();
  stream->level_buf_size = ISAL_DEF_LVL1_DEFAULT;
  stream->gzip_flag = IGZIP_ZLIB;
  stream->flush = NO_FLUSH;
  stream->end_of_stream = 1;
  stream->next_in = const_cast<std::uint8_t*>(reinterpret_cast<const std::uint8_t*>(piece.data()));  // it only reads
  stream->avail_in = static_cast<std::uint32_t>(piece.size());
  stream->next_out = output.get();
  stream->avail_out = static_cast<std::uint32_t>(room);
  const int status = isal_deflate(stream.get());
  ensure(status == COMP_OK && stream->avail_in == 0 && stream->internal_state.state == ZSTATE_END,
         "a piece of an array is compressed into the room that it may need");
  return std::string(reinterpret_cast<const char*>(output.get()), stream->total_out);
}

/// An array in pieces of `piece_size` bytes, each compressed by itself, with the header that VTK wants: the number of
/// pieces, their size, that of the last one if it is smaller (else 0), and the compressed size of each, in 64 bits.
std::string compressed(std::string_view values, int threads) {
  constexpr std::size_t piece_size = 1 << 18;
  const std::size_t count = (values.size() + piece_size - 1) / piece_size;
  std::vector<std::string> pieces(count);
  linalg::parallel_for(static_cast<int>(count), threads, [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    pieces[i] = compressed_piece(values.substr(i * piece_size, piece_size));
  });
  std::string content;
  const auto add = [&](std::uint64_t number) { content.append(reinterpret_cast<const char*>(&number), sizeof number); };
  add(count);
  add(piece_size);
  add(values.size() % piece_size);
  for (const std::string& piece : pieces) add(piece.size());
  for (const std::string& piece : pieces) content += piece;
  return content;
}

/// XML elements that describe arrays, and the data they describe. A block of data is its length in bytes (64 bits),
/// followed by the values as stored in memory, or what `compressed` makes of it; offsets are counted from the
/// underscore at the beginning of the data.
class Document {
 public:
  Document(std::string beginning, Encoding encoding, int threads = 1, PackedGrid* grid = nullptr)
      : text_(std::move(beginning)), encoding_(encoding), threads_(threads), grid_(grid) {}

  void add(std::string_view text) { text_ += text; }

  /// A scalar has no number of components, as in files written by VTK: readers then return one number for each point,
  /// not a list.
  template <typename Value>
  void add_array(std::string_view name, int components, const std::vector<Value>& values,
                 std::string_view attributes = "", Content content = Content::grid) {
    if (encoding_ == Encoding::text) {
      fmt::format_to(std::back_inserter(text_), "        <DataArray type=\"{}\" Name=\"{}\"{}{} format=\"ascii\">",
                     name_of<Value>(), name,
                     components == 1 ? "" : fmt::format(" NumberOfComponents=\"{}\"", components), attributes);
      for (const Value value : values) fmt::format_to(std::back_inserter(text_), "{} ", +value);
      text_ += "</DataArray>\n";
      return;
    }
    const std::string number = components == 1 ? "" : fmt::format(" NumberOfComponents=\"{}\"", components);
    fmt::format_to(std::back_inserter(text_),
                   "        <DataArray type=\"{}\" Name=\"{}\"{}{} format=\"appended\" offset=\"{}\"/>\n",
                   name_of<Value>(), name, number, attributes, data_.size());
    const std::string_view bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
    if (encoding_ == Encoding::compressed && content == Content::grid && grid_ != nullptr) {
      if (next_of_grid_ == grid_->arrays.size()) grid_->arrays.push_back(compressed(bytes, threads_));
      data_ += grid_->arrays[next_of_grid_++];
    } else if (encoding_ == Encoding::compressed) {
      data_ += compressed(bytes, threads_);
    } else {
      const std::uint64_t size = bytes.size();
      data_.append(reinterpret_cast<const char*>(&size), sizeof size);
      data_ += bytes;
    }
  }

  template <typename Value>
  void add_field(std::string_view name, int components, const std::vector<Value>& values,
                 std::string_view attributes = "") {
    add_array(name, components, values, attributes, Content::field);
  }

  std::string finish() && {
    if (encoding_ == Encoding::text) return std::move(text_) + "</VTKFile>\n";
    constexpr std::string_view begin = "  <AppendedData encoding=\"raw\">\n_",
                               end = "\n  </AppendedData>\n</VTKFile>\n";
    text_.reserve(text_.size() + begin.size() + data_.size() + end.size());
    text_ += begin;
    text_ += data_;
    text_ += end;
    return std::move(text_);
  }

 private:
  std::string text_, data_;
  Encoding encoding_;
  int threads_;
  PackedGrid* grid_;
  std::size_t next_of_grid_ = 0;
};

/// Describes arrays as a .pvtu file does.
class ArrayNames {
 public:
  template <typename Value>
  void add_field(std::string_view name, int components, const std::vector<Value>&, std::string_view attributes = "") {
    const std::string number = components == 1 ? "" : fmt::format(" NumberOfComponents=\"{}\"", components);
    fmt::format_to(std::back_inserter(text_), "      <PDataArray type=\"{}\" Name=\"{}\"{}{}/>\n", name_of<Value>(),
                   name, number, attributes);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

constexpr std::string_view components_of_stress =
    " ComponentName0=\"XX\" ComponentName1=\"YY\" ComponentName2=\"ZZ\" ComponentName3=\"XY\""
    " ComponentName4=\"YZ\" ComponentName5=\"XZ\"";

template <typename To>
void add_fields(To& document, const Fields& fields, const model::OutputFields& wanted) {
  if (wanted.displacement) document.add_field("displacement", 3, fields.displacement);
  if (wanted.displacement && !fields.velocity.empty()) document.add_field("velocity", 3, fields.velocity);
  if (wanted.stress) {
    document.add_field("stress", 6, fields.stress, components_of_stress);
    document.add_field("stress_xx", 1, fields.stress_xx);
    document.add_field("stress_yy", 1, fields.stress_yy);
    document.add_field("stress_xy", 1, fields.stress_xy);
    document.add_field("stress_zz", 1, fields.stress_zz);
  }
  if (wanted.principal) {
    document.add_field("principal_1", 1, fields.principal_1);
    document.add_field("principal_2", 1, fields.principal_2);
    document.add_field("principal_3", 1, fields.principal_3);
    document.add_field("principal_angle", 1, fields.principal_angle);
  }
  if (wanted.von_mises) document.add_field("von_mises", 1, fields.von_mises);
}

/// The arrays that a viewer shows first.
std::string attributes_of(std::string_view scalars, bool displacement) {
  return fmt::format("{}{}", scalars.empty() ? "" : fmt::format(" Scalars=\"{}\"", scalars),
                     displacement ? " Vectors=\"displacement\"" : "");
}
std::string point_data(std::string_view scalars, bool displacement) {
  return fmt::format("      <PointData{}>\n", attributes_of(scalars, displacement));
}
std::string_view first_scalars(const model::OutputFields& wanted) {
  return wanted.principal ? "principal_1" : wanted.von_mises ? "von_mises" : "";
}

void begin_cell_data(Document& document) { document.add("      </PointData>\n      <CellData>\n"); }

/// Everything after the arrays of the cells.
template <typename Cells>
std::string finish_piece(Document document, const Cells& cells) {
  document.add("      </CellData>\n      <Points>\n");
  document.add_array("Points", 3, cells.points);
  document.add("      </Points>\n      <Cells>\n");
  document.add_array("connectivity", 1, cells.connectivity);
  document.add_array("offsets", 1, cells.offsets);
  document.add_array("types", 1, cells.types);
  document.add("      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n");
  return std::move(document).finish();
}

/// `field_data`: what belongs to the file as a whole, as XML.
Document begin_piece(std::size_t points, std::size_t cells, Encoding encoding, int threads = 1,
                     PackedGrid* grid = nullptr, std::string_view field_data = "") {
  Document document(opening("UnstructuredGrid", encoding == Encoding::compressed
                                                    ? " header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\""
                                                    : " header_type=\"UInt64\""),
                    encoding, threads, grid);
  document.add(fmt::format("  <UnstructuredGrid>\n{}    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                           field_data, points, cells));
  return document;
}

/// Small files are read by any program and compared by eye; the arrays of large ones lose half of their size.
Encoding encoding_of(std::size_t points) {
  constexpr std::size_t many = 50000;  // 7 MB
  return points < many ? Encoding::appended : Encoding::compressed;
}

}  // namespace

std::string vtu_content(const Grid& grid, const Fields& fields, const model::OutputFields& wanted, int threads,
                        const std::vector<std::int32_t>& nodes, PackedGrid* packed) {
  Document document =
      begin_piece(grid.point_count(), grid.cell_count(), encoding_of(grid.point_count()), threads, packed);
  document.add(point_data(first_scalars(wanted), wanted.displacement));
  add_fields(document, fields, wanted);
  document.add_array("body", 1, grid.point_body);
  if (!nodes.empty()) document.add_array("node", 1, nodes);
  begin_cell_data(document);
  document.add_array("body", 1, grid.cell_body);
  return finish_piece(std::move(document), grid);
}

std::string pvtu_content(const model::OutputFields& wanted, const std::vector<std::string>& parts) {
  std::string text = opening("PUnstructuredGrid", " header_type=\"UInt64\"") +
                     fmt::format("  <PUnstructuredGrid GhostLevel=\"0\">\n    <PPointData{}>\n",
                                 attributes_of(first_scalars(wanted), wanted.displacement));
  ArrayNames of_points, body, node;
  add_fields(of_points, Fields(), wanted);
  body.add_field("body", 1, std::vector<std::int32_t>());
  node.add_field("node", 1, std::vector<std::int32_t>());
  text +=
      of_points.text() + body.text() + node.text() + "    </PPointData>\n    <PCellData>\n" + body.text() +
      "    </PCellData>\n" +
      "    <PPoints>\n      <PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n    </PPoints>\n";
  for (const std::string& part : parts) text += fmt::format("    <Piece Source=\"{}\"/>\n", part);
  return text + "  </PUnstructuredGrid>\n</VTKFile>\n";
}

std::string vtu_content(const ContactLines& lines) {
  std::string angle;
  if (lines.forces_of_radians)
    angle = fmt::format(
        "    <FieldData>\n      <DataArray type=\"Float64\" Name=\"forces_of_radians\" NumberOfTuples=\"1\" "
        "format=\"ascii\">{}</DataArray>\n    </FieldData>\n",
        *lines.forces_of_radians);
  Document document = begin_piece(lines.state.size(), lines.types.size(), Encoding::text, 1, nullptr, angle);
  document.add(point_data("pressure", true));
  document.add_array("state", 1, lines.state);
  document.add_array("pressure", 1, lines.pressure);
  document.add_array("shear", 1, lines.shear);
  document.add_array("gap", 1, lines.gap);
  document.add_array("slip", 1, lines.slip);
  document.add_array("normal_force", 1, lines.normal_force);
  document.add_array("tangential_force", 1, lines.tangential_force);
  document.add_array("traction", 3, lines.traction);
  document.add_array("displacement", 3, lines.displacement);
  document.add_array("pair", 1, lines.pair);
  document.add_array("contact", 1, lines.contact);
  begin_cell_data(document);
  document.add_array("contact", 1, lines.cell_contact);
  return finish_piece(std::move(document), lines);
}

std::string vtu_content(const CellPolygons& polygons, int threads) {
  const std::size_t points = polygons.points.size() / 3;
  Document document = begin_piece(points, polygons.types.size(), encoding_of(points), threads);
  document.add(point_data("", true));
  document.add_field("displacement", 3, polygons.displacement);
  begin_cell_data(document);
  document.add_array("body", 1, polygons.body);
  document.add_array("material", 1, polygons.material);
  document.add_array("finite_element", 1, polygons.finite_element);
  return finish_piece(std::move(document), polygons);
}

std::string vtu_content(const SolidCells& cells, int threads) {
  const std::size_t points = cells.point_body.size();
  Document document = begin_piece(points, cells.types.size(), encoding_of(points), threads);
  document.add(point_data("von_mises", true));
  document.add_field("displacement", 3, cells.displacement);
  document.add_field("stress", 6, cells.stress, components_of_stress);
  document.add_field("principal_1", 1, cells.principal_1);
  document.add_field("principal_2", 1, cells.principal_2);
  document.add_field("principal_3", 1, cells.principal_3);
  document.add_field("von_mises", 1, cells.von_mises);
  document.add_array("body", 1, cells.point_body);
  begin_cell_data(document);
  document.add_array("body", 1, cells.cell_body);
  return finish_piece(std::move(document), cells);
}

std::string vtu_content(const SolidFaces& faces) {
  Document document = begin_piece(faces.pair.size(), faces.types.size(), encoding_of(faces.pair.size()));
  document.add(point_data("pressure", true));
  document.add_array("state", 1, faces.state);
  document.add_array("pressure", 1, faces.pressure);
  document.add_array("gap", 1, faces.gap);
  document.add_array("shear", 3, faces.shear);
  document.add_array("slip", 3, faces.slip);
  document.add_array("normal", 3, faces.normal);
  document.add_array("pair", 1, faces.pair);
  document.add_array("contact", 1, faces.contact);
  begin_cell_data(document);
  document.add_array("contact", 1, faces.cell_contact);
  return finish_piece(std::move(document), faces);
}

namespace {

/// `tangents`: components of the slip.
template <typename Cells>
std::string mechanism_content(const Cells& cells, int tangents, Encoding encoding, int threads) {
  Document document = begin_piece(cells.pair.size(), cells.types.size(), encoding, threads);
  document.add(point_data("", true));
  document.add_field("displacement", 3, cells.displacement);
  document.add_field("opening", 1, cells.opening);
  document.add_field("slip", tangents, cells.slip);
  document.add_array("pair", 1, cells.pair);
  document.add_array("body", 1, cells.point_body);
  begin_cell_data(document);
  document.add_field("motion", 1, cells.motion);
  document.add_array("body", 1, cells.body);
  document.add_array("contact", 1, cells.contact);
  return finish_piece(std::move(document), cells);
}

}  // namespace

std::string vtu_content(const SolidMechanismCells& cells, int threads) {
  return mechanism_content(cells, 3, encoding_of(cells.pair.size()), threads);
}

std::string vtu_content(const MechanismCells& cells, int threads) {
  constexpr std::size_t few = 5000;
  const std::size_t points = cells.pair.size();
  return mechanism_content(cells, 1, points < few ? Encoding::text : encoding_of(points), threads);
}

FieldCollection::FieldCollection(const std::filesystem::path& path) : file_(path) {
  file_.append_before_footer(opening("Collection", "") + "  <Collection>\n", collection_footer);
}

FieldCollection::FieldCollection(const std::filesystem::path& path, long long size) : file_(path, size) {
  file_.append_before_footer("", collection_footer);
}

void FieldCollection::add(double time, std::string_view file) {
  file_.append_before_footer(fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time, file),
                             collection_footer);
}

}  // namespace scabo::result
