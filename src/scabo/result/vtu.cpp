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

/// Elements that describe arrays, and the data they describe. A block of data is its length in bytes (64
/// bits), then the values as they lie in memory; offsets count from the underscore that begins the data.
class Document {
 public:
  explicit Document(std::string beginning) : text_(std::move(beginning)) {}

  void add(std::string_view text) { text_ += text; }

  template <typename Value>
  void add_array(std::string_view name, int components, const std::vector<Value>& values,
                 std::string_view attributes = "") {
    fmt::format_to(std::back_inserter(text_),
                   "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"{} format=\"appended\" "
                   "offset=\"{}\"/>\n",
                   name_of<Value>(), name, components, attributes, data_size_);
    blocks_.push_back({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)});
    data_size_ += sizeof(std::uint64_t) + values.size() * sizeof(Value);
  }

  std::string finish() && {
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
  std::vector<std::string_view> blocks_;
  std::size_t data_size_ = 0;
};

void add_fields(Document& document, const Fields& fields) {
  document.add_array("displacement", 3, fields.displacement);
  document.add_array("stress", 6, fields.stress,
                     " ComponentName0=\"XX\" ComponentName1=\"YY\" ComponentName2=\"ZZ\" ComponentName3=\"XY\""
                     " ComponentName4=\"YZ\" ComponentName5=\"XZ\"");
  document.add_array("stress_xx", 1, fields.stress_xx);
  document.add_array("stress_yy", 1, fields.stress_yy);
  document.add_array("stress_xy", 1, fields.stress_xy);
  document.add_array("stress_zz", 1, fields.stress_zz);
  document.add_array("principal_1", 1, fields.principal_1);
  document.add_array("principal_2", 1, fields.principal_2);
  document.add_array("principal_3", 1, fields.principal_3);
  document.add_array("principal_angle", 1, fields.principal_angle);
  document.add_array("von_mises", 1, fields.von_mises);
}

}  // namespace

std::string vtu_content(const Grid& grid, const Fields& fields) {
  Document document(opening("UnstructuredGrid", " header_type=\"UInt64\""));
  document.add(fmt::format("  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                           grid.point_count(), grid.cell_count()));
  document.add("      <PointData Scalars=\"principal_1\" Vectors=\"displacement\">\n");
  add_fields(document, fields);
  document.add_array("body", 1, grid.point_body);
  document.add("      </PointData>\n      <CellData>\n");
  document.add_array("body", 1, grid.cell_body);
  document.add("      </CellData>\n      <Points>\n");
  document.add_array("Points", 3, grid.points);
  document.add("      </Points>\n      <Cells>\n");
  document.add_array("connectivity", 1, grid.connectivity);
  document.add_array("offsets", 1, grid.offsets);
  document.add_array("types", 1, grid.types);
  document.add("      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n");
  return std::move(document).finish();
}

FieldCollection::FieldCollection(const std::filesystem::path& path) : file_(path) {
  file_.append_before_footer(opening("Collection", "") + "  <Collection>\n", collection_footer);
}

void FieldCollection::add(double time, std::string_view file) {
  file_.append_before_footer(fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time, file),
                             collection_footer);
}

}  // namespace scabo::result
