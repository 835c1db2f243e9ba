#include "scabo/result/vtu.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <iterator>
#include <type_traits>
#include <vector>

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

/// Arrays as text, for small files, or appended in binary form. (meshio 5.3 confuses appended arrays if the offset of
/// one equals that of another in its own encoding, which occurs with small arrays.)
enum class Encoding { text, appended };

/// XML elements that describe arrays, and the data they describe. A block of data is its length in bytes (64 bits),
/// followed by the values as stored in memory; offsets are counted from the underscore at the beginning of the data.
class Document {
 public:
  explicit Document(std::string beginning, Encoding encoding) : text_(std::move(beginning)), encoding_(encoding) {}

  void add(std::string_view text) { text_ += text; }

  /// A scalar has no number of components, as in files written by VTK: readers then return one number for each point,
  /// not a list.
  template <typename Value>
  void add_array(std::string_view name, int components, const std::vector<Value>& values,
                 std::string_view attributes = "") {
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
                   name_of<Value>(), name, number, attributes, data_size_);
    blocks_.push_back({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)});
    data_size_ += sizeof(std::uint64_t) + values.size() * sizeof(Value);
  }

  std::string finish() && {
    if (encoding_ == Encoding::text) return std::move(text_) + "</VTKFile>\n";
    constexpr std::string_view begin = "  <AppendedData encoding=\"raw\">\n_",
                               end = "\n  </AppendedData>\n</VTKFile>\n";
    text_.reserve(text_.size() + begin.size() + data_size_ + end.size());
    text_ += begin;
    for (const std::string_view block : blocks_) {
      const std::uint64_t size = block.size();
      text_.append(reinterpret_cast<const char*>(&size), sizeof size);
      text_.append(block);
    }
    text_ += end;
    return std::move(text_);
  }

 private:
  std::string text_;
  Encoding encoding_;
  std::vector<std::string_view> blocks_;
  std::size_t data_size_ = 0;
};

void add_fields(Document& document, const Fields& fields, const model::OutputFields& wanted) {
  if (wanted.displacement) document.add_array("displacement", 3, fields.displacement);
  if (wanted.stress) {
    document.add_array("stress", 6, fields.stress,
                       " ComponentName0=\"XX\" ComponentName1=\"YY\" ComponentName2=\"ZZ\" ComponentName3=\"XY\""
                       " ComponentName4=\"YZ\" ComponentName5=\"XZ\"");
    document.add_array("stress_xx", 1, fields.stress_xx);
    document.add_array("stress_yy", 1, fields.stress_yy);
    document.add_array("stress_xy", 1, fields.stress_xy);
    document.add_array("stress_zz", 1, fields.stress_zz);
  }
  if (wanted.principal) {
    document.add_array("principal_1", 1, fields.principal_1);
    document.add_array("principal_2", 1, fields.principal_2);
    document.add_array("principal_3", 1, fields.principal_3);
    document.add_array("principal_angle", 1, fields.principal_angle);
  }
  if (wanted.von_mises) document.add_array("von_mises", 1, fields.von_mises);
}

/// The arrays that a viewer shows first.
std::string point_data(std::string_view scalars, bool displacement) {
  return fmt::format("      <PointData{}{}>\n", scalars.empty() ? "" : fmt::format(" Scalars=\"{}\"", scalars),
                     displacement ? " Vectors=\"displacement\"" : "");
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

Document begin_piece(std::size_t points, std::size_t cells, Encoding encoding) {
  Document document(opening("UnstructuredGrid", " header_type=\"UInt64\""), encoding);
  document.add(
      fmt::format("  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", points, cells));
  return document;
}

}  // namespace

std::string vtu_content(const Grid& grid, const Fields& fields, const model::OutputFields& wanted) {
  Document document = begin_piece(grid.point_count(), grid.cell_count(), Encoding::appended);
  document.add(point_data(wanted.principal ? "principal_1" : wanted.von_mises ? "von_mises" : "", wanted.displacement));
  add_fields(document, fields, wanted);
  document.add_array("body", 1, grid.point_body);
  begin_cell_data(document);
  document.add_array("body", 1, grid.cell_body);
  return finish_piece(std::move(document), grid);
}

std::string vtu_content(const ContactLines& lines) {
  Document document = begin_piece(lines.state.size(), lines.types.size(), Encoding::text);
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

std::string vtu_content(const CellPolygons& polygons) {
  Document document = begin_piece(polygons.points.size() / 3, polygons.types.size(), Encoding::appended);
  document.add(point_data("", true));
  document.add_array("displacement", 3, polygons.displacement);
  begin_cell_data(document);
  document.add_array("body", 1, polygons.body);
  document.add_array("material", 1, polygons.material);
  document.add_array("finite_element", 1, polygons.finite_element);
  return finish_piece(std::move(document), polygons);
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
